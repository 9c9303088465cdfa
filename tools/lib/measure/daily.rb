# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'subjects'
require_relative 'modules'

# What `tools/cost --daily` leaves out, in the words of docs/cost.md: each is a form of what
# it measures, on the same core, by the same compiler. Their figures are then those that
# stand in the documents, which `tools/cost --check` judges.
module Daily
  STEPS = {
    "on #{CHIPS.select(&:weekly).map(&:title).join(', ')}" => ->(one) { one.chip.weekly },
    'through a pointer on a PIC' => ->(one) { one.build == 'pointer' },
    'in access-RAM' => ->(one) { one.variant&.name == 'access-RAM' },
    'of PID, plain' => ->(one) { one.controller.id == 'pid_plain' },
    'at -Os elsewhere than on an AVR' => ->(one) { one.build == '-Os' && one.chip.kind != :avr }
  }.freeze
  MODULES = {
    'on Cortex-M4' => ->(one) { one.chip.name == 'cortex-m4' },
    'at -Os' => ->(one) { one.build == '-Os' },
    'in the second mode of a PIC' => ->(one) { one.chip.kind == :pic && one.build != ModuleSubject.builds_of(one.called, one.chip).first }
  }.freeze

  class << self
    def left_out
      Subject.all.select { |one| STEPS.values.any? { |form| form.call(one) } }
    end

    def modules_left_out
      ModuleSubject.all.select { |one| MODULES.values.any? { |form| form.call(one) } }
    end

    def sentence
      "leaves out only the steps #{STEPS.keys.join('; ')}; and of what stands beside a controller what is #{MODULES.keys.join('; ')}; " \
        'and the price of each feature of fixpid_pid.'
    end
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'subjects'
require_relative 'modules'

# What `tools/cost --daily` measures, in the words of docs/cost.md: each controller on a chip
# of each kind, as one would build it, and what stands beside a controller on one chip. The
# figures of what it leaves out are then those that stand in the documents, which
# `tools/cost --check` judges each week.
module Daily
  # A chip and its build.
  STEPS = { 'pic16f684' => 'object', 'pic18f4520' => 'object', 'atmega328p' => '-O2', 'cortex-m0' => '-O2', 'rv32imc' => '-O2' }.freeze
  MODULES = { 'atmega328p' => '-O2' }.freeze
  PLAIN = 'pid_plain' # a form of PID

  class << self
    def left_out
      Subject.all.reject { |one| one.variant.nil? && one.controller.id != PLAIN && STEPS[one.chip.name] == one.build }
    end

    def modules_left_out
      ModuleSubject.all.reject { |one| MODULES[one.chip.name] == one.build }
    end

    def sentence
      "measures each controller but PID, plain, on #{named(STEPS)}; and what stands beside a controller on #{named(MODULES)}."
    end

    private

    def named(builds)
      builds.map { |chip, build| "#{CHIPS.find { |one| one.name == chip }.title} (#{build})" }.join(', ')
    end
  end
end

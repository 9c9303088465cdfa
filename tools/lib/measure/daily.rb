# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'subjects'
require_relative 'modules'

# What `tools/cost --daily` measures: each controller on a chip of each kind, as one would
# build it, and what stands beside a controller on one chip. The figures of what it leaves
# out are then those of docs/data, which `tools/cost --check` judges each week.
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
  end
end

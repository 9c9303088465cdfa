# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What linked code takes at most and how deep its stack gets, from the code alone: of any
# program, on these chips. This is the only file to require, and what else is in this folder
# is for nobody outside of it; README.md says how it works and when it refuses.
#
#   code = Bound.code('pic18f4520', 'build/firmware/motor')
#   code.longest('fixpid_an937_step').cost     cycles, or where the core has timings instructions
#   code.stack('fixpid_an937_step').bytes      with its return address
#   code.shown(code.stack_of_all)              of all, interrupts too, in words
#
# Each fails with Bound::Failure where it cannot tell, and says why.
require_relative 'elf_code'
require_relative 'pic_code'
require_relative 'longest_path'
require_relative 'stack'

module Bound
  OBJDUMP_LINE = ElfCode::LINE # address, code, mnemonic and operands

  CODES = { /\Aat(?:mega|tiny)/ => AvrCode, /\Acortex-m/ => ArmCode, 'rv32imc' => RiscvCode, 'rv32ec' => Rv32eCode }.freeze

  # Of cores that are metered in instructions; the slow multiplier of a Cortex-M0, too.
  TIMINGS = { 'cortex-m0' => [Timing::CortexM0.new(1), Timing::CortexM0.new(32)], 'cortex-m4' => [Timing::CortexM4.new],
              'rv32imc' => [Timing::Ibex.new], 'rv32ec' => [Timing::Ibex.new] }.freeze

  class << self
    # The linked code of a chip: PATH.elf, or of a PIC PATH.hex with PATH.map. nil for a PIC
    # of another core.
    def code(chip, path)
      core = CODES.find { |name, _| name === chip }&.last
      core ? core.new("#{path}.elf") : PicCode.of(chip)&.new(path)
    end

    # The longest path by each of the core's timings, in cycles.
    def cycles(chip, code, function, turns = {})
      TIMINGS.fetch(chip).map { |timing| code.timed(timing).longest(function, turns).cost }
    end

    # Of a linker's map for a PIC: name, address, place (program or data) and bytes.
    def sections(map)
      PicCode.sections(map)
    end
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What an instruction costs on a core: `staying` if the next one follows, `leaving` if
# it jumps, calls or returns; nil for one that the core's table does not have. Mnemonics
# and operands are objdump's, without `.n` and `.w`. Memory has no wait states.
module Timing
  # QEMU's: each costs one.
  class Instructions
    def staying(_mnemonic, _operands)
      1
    end

    def leaving(_mnemonic, _operands)
      1
    end

    # What a jump costs more if it leads to an instruction of 32 bits that two words
    # of memory share.
    def unaligned
      0
    end
  end

  # What the Cortex-M have alike. An instruction of an IT block costs as much as
  # one that is executed.
  class CortexM
    CONDITION = '(?:eq|ne|cs|cc|mi|pl|vs|vc|hi|ls|ge|lt|gt|le)?'

    # Whole mnemonics, also with the flags' `s` and with a condition.
    def self.any(names)
      /\A(?:#{names.split.join('|')})s?#{CONDITION}\z/
    end

    LOAD = any('ldr ldrb ldrh ldrsb ldrsh').freeze
    STORE = any('str strb strh').freeze
    SEVERAL = any('ldm ldmia ldmdb stm stmia stmdb push pop').freeze

    def staying(mnemonic, operands)
      case mnemonic
      when self.class::ONE then 1
      when SEVERAL then 1 + CortexM.listed(operands)
      when /\Ab#{CONDITION}\z/, /\Acbn?z\z/ then 1
      else other(mnemonic, operands)
      end
    end

    # How many registers a list has.
    def self.listed(operands)
      operands[/\{(.*)\}/, 1].split(', ').sum do |item|
        first, last = item.split('-').map { |register| number(register) }
        last ? last - first + 1 : 1
      end
    end

    def self.number(register)
      { 'sl' => 10, 'fp' => 11, 'ip' => 12, 'sp' => 13, 'lr' => 14, 'pc' => 15 }.fetch(register) { register.delete('r').to_i }
    end
  end

  # Cortex-M0 Technical Reference Manual (ARM DDI 0432C), table 3-1; a Cortex-M0+ has
  # none that takes longer (DDI 0484C). The multiplier has 1 or 32 cycles.
  class CortexM0 < CortexM
    ONE = any('adc add adr and asr bic cmn cmp eor lsl lsr mov mvn neg nop orr rev rev16 revsh ror rsb sbc sub sxtb sxth
               tst uxtb uxth').freeze

    def initialize(multiplier)
      super()
      @multiplier = multiplier
    end

    def leaving(mnemonic, operands)
      case mnemonic
      when /\Ab#{CONDITION}\z/, 'bx' then 3
      when 'bl' then 4
      when 'pop' then 4 + CortexM.listed(operands)
      end
    end

    private

    def other(mnemonic, _operands)
      case mnemonic
      when LOAD, STORE then 2
      when 'muls', 'mul' then @multiplier
      end
    end
  end

  # Cortex-M3 (DDI 0337I) and Cortex-M4 (ARM 100166), table 3-1 of both, the upper values
  # of their ranges: three cycles to refill the pipeline, twelve for a quotient, no
  # load or store that overlaps another, and a constant behind the code takes its cycle
  # from the fetch unit.
  class CortexM3 < CortexM
    REFILL = 3
    ONE = any('adc add addw adr and asr bfc bfi bic clz cmn cmp eor it[te]* lsl lsr mov movt movw mul mvn neg nop orn orr rbit
               rev rev16 revsh ror rrx rsb sbc sbfx ssat sub subw sxtb sxth teq tst ubfx usat uxtb uxth').freeze
    PRODUCTS = { any('mla mls') => 2, any('smull umull') => 5, any('smlal umlal') => 7 }.freeze

    def leaving(mnemonic, operands)
      case mnemonic
      when /\Ab[lx]?#{CONDITION}\z/, /\Acbn?z\z/ then 1 + REFILL
      when SEVERAL then 1 + CortexM.listed(operands) + REFILL
      when LOAD then 2 + REFILL
      end
    end

    private

    def other(mnemonic, operands)
      case mnemonic
      when LOAD then operands.include?('[pc') ? 3 : 2
      when STORE then 2
      when /\A(?:ldr|str)d#{CONDITION}\z/ then 3
      when /\A[su]div#{CONDITION}\z/ then 12
      else self.class::PRODUCTS.find { |names, _| mnemonic.match?(names) }&.last
      end
    end
  end

  # With one cycle for each product, and the instructions for signal processing.
  class CortexM4 < CortexM3
    EXTENDED = 'pkhbt pkhtb q?d?add q?d?sub [su]?[qh]?(?:add|sub)(?:8|16) [su]?[qh]?(?:asx|sax) sel smmul[r]? smml[as][r]?
                smu[as]dx? sml[as]l?dx? [su]xtab(?:16)? [su]xtah [su]xtb16 [su]sat16 usad8 usada8 umaal'
    HALVES = 'smul[bt][bt] smla[bt][bt] smlal[bt][bt] smulw[bt] smlaw[bt]'
    PRODUCTS = { any("mla mls smull umull smlal umlal #{EXTENDED} #{HALVES}") => 1 }.freeze
  end

  # lowRISC's Ibex in its smallest configuration, by "Pipeline Details" of its
  # reference: two stages, the fast multiplier of three cycles, no second adder for
  # branches. With RV32E and without M it is what the RV32EC stands for.
  class Ibex
    ONE = /\A(?:add|and|or|xor|sub|sll|srl|sra|slti?u?|seqz|snez|sltz|sgtz|neg|not|mv|li|lui|auipc|nop|zext\.b|csr\w+)\z/.freeze
    BRANCH = /\Ab(?:eq|ne|lt|ge|gt|le|ltu|geu|gtu|leu|eqz|nez|ltz|gez|gtz|lez)\z/.freeze

    def staying(mnemonic, _operands)
      case mnemonic
      when ONE, BRANCH then 1
      when /\A(?:l[bh]u?|lw|s[bhw])\z/ then 2
      when 'mul' then 3
      when /\Amulh(?:s?u)?\z/ then 4
      when /\A(?:div|rem)u?\z/ then 38
      end
    end

    # Who called is not known, so that his next instruction may be unaligned.
    def leaving(mnemonic, _operands)
      case mnemonic
      when BRANCH then 3
      when 'j', 'jal' then 2
      when 'ret' then 2 + unaligned
      end
    end

    def unaligned
      1
    end
  end

  INSTRUCTIONS = Instructions.new.freeze
end

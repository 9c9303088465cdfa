# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'mutant'

# The instructions of assembly in a source, and every small break of each: it is left
# out, taken for its twin, with the other destination, with a number one off.
module Instructions
  TWINS = [%w[addwf subwf], %w[addwfc addwf], %w[subwfb subwf], %w[btfsc btfss], %w[bcf bsf], %w[rrf rlf], %w[rrcf rlcf],
           %w[rrncf rlncf], %w[incf decf], %w[incfsz decfsz], %w[infsnz incfsz], %w[andwf iorwf], %w[xorwf iorwf],
           %w[andlw iorlw], %w[xorlw andlw], %w[addlw sublw], %w[comf movf], %w[negf comf], %w[clrf setf], %w[swapf movf],
           %w[bz bnz], %w[bc bnc], %w[bn bnn], %w[cpfslt cpfsgt],
           %w[add sub], %w[adc add], %w[sbc sub], %w[sbci subi], %w[brvc brvs], %w[brcc brcs], %w[breq brne], %w[brpl brmi],
           %w[sbrc sbrs], %w[lsl lsr], %w[rol lsl], %w[ror lsr], %w[asr lsr], %w[mulsu mul], %w[muls mul], %w[fmul mul], %w[and or],
           %w[andi ori], %w[eor or], %w[com neg], %w[inc dec], %w[bst bld], %w[swap com],
           %w[adds subs], %w[sbcs adcs], %w[bvc bvs], %w[lsls lsrs], %w[eors orrs]].freeze
  OTHERS = %w[tstfsz movwf movf movff movlw movlb mulwf mullw lfsr call rcall goto bra return retlw retfie nop pagesel banksel clrw
              sublw addlw mov movw clr ldi mul tst cp cpc cpi rjmp ret push pop ld st ldd std lds sts in out movs].freeze
  MNEMONICS = (TWINS.flatten + OTHERS).uniq.freeze
  # Of a word in a string or of a line between __asm and __endasm.
  WORD = /(?<name>#{MNEMONICS.join('|')})\b(?<operands>(?:[ \t]+[^;\n"\\]*)?)/.freeze
  NUMBER = /(?<![\w.%$])(?:0x\h+|\d+)(?![\w.])/.freeze

  class << self
    # The files of src/ that have some.
    def files
      Dir['src/*/*_{arm,avr,pic14,pic18}.[ch]'].sort.reject { |file| places(File.read(file)).empty? }
    end

    def breaks(file, text = File.read(file))
      places(text).flat_map do |place, name, operands|
        changes(name, operands).map do |name_now, operands_now|
          from = (name + operands).rstrip
          to = (name_now + operands_now).rstrip
          broken = text[0...place] + to + text[(place + from.size)..]
          Mutant.new(file, text[0...place].count("\n") + 1, place, from.squeeze(' '), to.squeeze(' '), broken)
        end
      end
    end

    # [where, mnemonic, operands] of each instruction.
    def places(text)
      inside = false
      position = 0
      text.lines.flat_map do |line|
        starts = position
        position += line.size
        inside = line.match?(/__asm\s*$/) || (inside && !line.include?('__endasm'))
        parts = inside ? [[0, line[/\A[^;\n]*/]]] : macro(line) + strings(line)
        unknown = inside && line[/\A\s+([a-z]\w*)/, 1]
        unknown && !MNEMONICS.include?(unknown) and abort "FAILED what does #{unknown} do?"
        parts.flat_map { |offset, part| words(part).map { |at, name, operands| [starts + offset + at, name, operands] } }
      end
    end

    private

    # That a macro stands for, in a source with __asm.
    def macro(line)
      match = line.match(/\A#define \w+ (?=(?:#{MNEMONICS.join('|')})\b)/)
      match ? [[match.end(0), match.post_match]] : []
    end

    def strings(line)
      return [] if line.match?(%r{\A\s*(?://|#include)}) || !line.include?('"')

      line.to_enum(:scan, /"((?:[^"\\]|\\.)*)"/).map { [Regexp.last_match.begin(1), Regexp.last_match[1]] }
          .select { |_, part| part.match?(/\A(?:[\w]+:)?(?:\\[nt]|\s)*(?:#{MNEMONICS.join('|')})\b|\\n/) }
    end

    # An instruction begins a line, or follows a label or a \n or \t.
    def words(part)
      part.to_enum(:scan, WORD).map do
        match = Regexp.last_match
        before = part[0...match.begin(0)]
        [match.begin(0), match[:name], match[:operands]] if before.match?(/(?:\A|\\n|\\t|\n|:)\s*\z/)
      end.compact
    end

    def changes(name, operands)
      left_out = name == 'nop' ? [] : [['nop', '']]
      left_out + twins(name).map { |twin| [twin, operands] } + destinations(operands).map { |other| [name, other] } +
        numbers(operands).map { |other| [name, other] }
    end

    def twins(name)
      TWINS.select { |pair| pair.include?(name) }.map { |pair| (pair - [name]).first }.first(2)
    end

    # Into W or into the file.
    def destinations(operands)
      return [] unless operands.match?(/,\s*[wf]\b/)

      [operands.sub(/,(\s*)([wf])\b/) { ",#{$1}#{$2 == 'w' ? 'f' : 'w'}" }]
    end

    # A bit or a constant; the place of a byte is not one.
    def numbers(operands)
      found = operands.to_enum(:scan, NUMBER).map { Regexp.last_match }.reject { |match| operands[0...match.begin(0)].match?(/\+\s*\z/) }
      found.flat_map do |match|
        value = Integer(match[0])
        [value + 1, value - 1].reject(&:negative?).map { |other| operands[0...match.begin(0)] + other.to_s + match.post_match }
      end
    end
  end
end

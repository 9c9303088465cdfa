# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'translation'

# What an AVR's instructions do to the registers of test/proof/assembly/avr.h.
class AvrTranslation < Translation
  STATEMENTS = {
    'mov' => 'R[$1] = R[$2];',
    'movw' => 'R[$1] = R[$2]; R[$1 + 1] = R[$2 + 1];',
    'ldi' => 'R[$1] = $2;',
    'add' => 'R[$1] = added(cpu, R[$1], R[$2], 0);',
    'adc' => 'R[$1] = added(cpu, R[$1], R[$2], cpu->c);',
    'sub' => 'R[$1] = subtracted(cpu, R[$1], R[$2], 0);',
    'sbc' => 'R[$1] = subtracted_on(cpu, R[$1], R[$2]);',
    'subi' => 'R[$1] = subtracted(cpu, R[$1], $2, 0);',
    'sbci' => 'R[$1] = subtracted_on(cpu, R[$1], $2);',
    'cp' => 'subtracted(cpu, R[$1], R[$2], 0);',
    'cpc' => 'subtracted_on(cpu, R[$1], R[$2]);',
    'cpi' => 'subtracted(cpu, R[$1], $2, 0);',
    'and' => 'R[$1] = logical(cpu, R[$1] & R[$2]);',
    'andi' => 'R[$1] = logical(cpu, R[$1] & $2);',
    'or' => 'R[$1] = logical(cpu, R[$1] | R[$2]);',
    'ori' => 'R[$1] = logical(cpu, R[$1] | $2);',
    'eor' => 'R[$1] = logical(cpu, R[$1] ^ R[$2]);',
    'com' => 'R[$1] = complemented(cpu, R[$1]);',
    'neg' => 'R[$1] = subtracted(cpu, 0, R[$1], 0);',
    'inc' => 'R[$1] = stepped(cpu, (uint8_t)(R[$1] + 1u), 0x80);',
    'dec' => 'R[$1] = stepped(cpu, (uint8_t)(R[$1] - 1u), 0x7F);',
    'swap' => 'R[$1] = (uint8_t)((R[$1] << 4) | (R[$1] >> 4));',
    'lsr' => 'R[$1] = moved_right(cpu, R[$1], 0);',
    'ror' => 'R[$1] = moved_right(cpu, R[$1], cpu->c);',
    'asr' => 'R[$1] = moved_right(cpu, R[$1], R[$1] >> 7);',
    'bst' => 'cpu->t = (R[$1] >> $2) & 1u;',
    'bld' => 'R[$1] = (uint8_t)((R[$1] & ~(1u << $2)) | (cpu->t << $2));',
    'mul' => 'multiplied(cpu, bytes_product(R[$1], R[$2]));',
    'mulsu' => 'multiplied(cpu, signed_by_unsigned(R[$1], R[$2]));',
    'muls' => 'multiplied(cpu, signed_by_signed(R[$1], R[$2]));',
    'fmul' => 'multiplied_fractions(cpu, bytes_product(R[$1], R[$2]));',
    'push' => 'push(cpu, R[$1]);',
    'pop' => 'R[$1] = pop(cpu);',
    'nop' => ''
  }.freeze
  SKIPS = { 'sbrc' => '((R[$1] >> $2) & 1u) == 0u', 'sbrs' => '((R[$1] >> $2) & 1u) != 0u' }.freeze
  BRANCHES = {
    'brcc' => '!cpu->c', 'brcs' => 'cpu->c', 'breq' => 'cpu->z', 'brne' => '!cpu->z', 'brpl' => '!cpu->n', 'brmi' => 'cpu->n',
    'brvc' => '!cpu->v', 'brvs' => 'cpu->v', 'brge' => 'cpu->n == cpu->v', 'brlt' => 'cpu->n != cpu->v'
  }.freeze
  JUMPS = %w[rjmp jmp].freeze
  CALLS = %w[rcall call].freeze
  RETURNS = { 'ret' => '' }.freeze
  MODEL = 'avr.h'
  NAME = 'an AVR'
  COMPILE = %w[cc -std=c99].freeze
  SIMULATOR = %w[test/proof/assembly/simavr.c -lsimavr].freeze
  # What an instruction is compared with the simulator in. One behind it may be left out,
  # or come to.
  EXAMPLES = {
    ['%s r20, r21', '%s r20, r20', '%s r0, r31'] => %w[mov add adc sub sbc cp cpc and or eor],
    ['%s r20, r30', '%s r0, r2'] => %w[movw],
    ['%s r20, 0x35', '%s r31, 0xFF'] => %w[ldi subi sbci cpi andi ori],
    ['%s r0', '%s r20', '%s r31'] => %w[com neg inc dec swap lsr ror asr],
    ['%s r20, 0', '%s r7, 6', '%s r31, 7'] => %w[bst bld sbrc sbrs],
    ['%s r20, r21', '%s r20, r20', '%s r17, r23'] => %w[mul mulsu muls fmul],
    ["push r20\npop r21"] => %w[push pop],
    ['%s'] => %w[nop ret],
    ['%s 1f'] => [*BRANCHES.keys, *JUMPS, *CALLS]
  }.freeze
  LINE = /^\s*(\h+):\t([\h ]+?)\s*\t(\w+)(?:\t([^;\n]*?))?\s*(?:;\s*(\S+).*)?$/.freeze
  CHIPS = { 'avr' => 'atmega328p', 'avr_tiny' => 'attiny85' }.freeze # with a multiplier and without

  class << self
    def images
      CHIPS.keys
    end

    # The files of src/ that have its assembly.
    def sources
      /_avr\.h\z/
    end

    # The claims' functions with the sources of a tree.
    def of(image, folder, tree = '.')
      of_file(CHIPS.fetch(image), "#{FOLDER}/assembly/avr.c", folder, tree)
    end

    def program(folder)
      "#{folder}/avr.elf"
    end

    def of_file(chip, file, folder, tree = '.')
      program = program(folder)
      said('avr-gcc', "-mmcu=#{chip}", '-std=gnu99', '-O2', '-w', "-I#{tree}/include", "-I#{tree}/src", '-nostartfiles',
           file, '-o', program)
      text = said('avr-objdump', '-d', program)
      new(text.scan(LINE).map { |row| disassembled(*row) },
          text.scan(/^(\h+) <(\w+)>:$/).to_h { |at, name| [name, at.hex] })
    end

    # [name, translation] of a program with a function for each example.
    def examples(folder)
      bodies = EXAMPLES.flat_map { |texts, names| names.product(texts).map { |name, text| [name, format(text, name)] } }
      lines = bodies.each_with_index.map { |(name, body), at| ".global #{name}_#{at}\n#{name}_#{at}:\n#{body}\nldi r24, 1\n1: ret\n" }
      File.write("#{folder}/examples.s", lines.join)
      of_file('atmega328p', "#{folder}/examples.s", folder)
    end

    private

    # objdump says where a relative branch leads behind a semicolon.
    def disassembled(address, code, name, operands, target)
      operands = operands.to_s.split(/,\s*/)
      operands[-1] = target if target && operands.last.start_with?('.')
      Disassembled.new(address.hex, code.split.size, name, operands)
    end
  end

  # Of bytes from the lowest one on.
  def place(text, index)
    "cpu->r[#{operand(text).to_i + index}]"
  end

  # What `kept` must know of a claim.
  def places(_claim)
    ''
  end

  private

  def operand(text)
    text.delete_prefix('r')
  end
end

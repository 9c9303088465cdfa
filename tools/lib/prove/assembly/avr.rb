# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'elf'

# What an AVR's instructions do to the registers of test/proof/assembly/avr.h.
class AvrTranslation < ElfTranslation
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
  TOOLS = 'avr'
  OPTIONS = { 'avr' => %w[-mmcu=atmega328p], 'avr_tiny' => %w[-mmcu=attiny85] }.freeze # with a multiplier and without
  WITH_ALL = 'avr'
  HEAD = ''
  FUNCTION = ".global %<name>s\n"
  FOLLOWER = 'ldi r24, 1'
  LAST = 'ret'

  # The files of src/ that have its assembly.
  def self.sources
    /_avr\.h\z/
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

  # From the next instruction on, or an address.
  def target(one)
    distance = one.operands.last[/\A\.([-+]\d+)\z/, 1]
    distance ? one.address + 2 + distance.to_i : super
  end
end

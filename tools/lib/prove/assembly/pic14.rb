# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'pic'

# What a mid-range PIC's instructions do to the memory of test/proof/assembly/pic14.h.
class Pic14Translation < PicTranslation
  # Of those with a file register and where the result goes.
  VALUES = {
    'addwf' => 'added(cpu, get(cpu, $1), W, 0)', 'subwf' => 'subtracted(cpu, get(cpu, $1), W)', 'andwf' => 'zero(cpu, get(cpu, $1) & W)',
    'iorwf' => 'zero(cpu, get(cpu, $1) | W)', 'xorwf' => 'zero(cpu, get(cpu, $1) ^ W)', 'comf' => 'zero(cpu, (uint8_t)~get(cpu, $1))',
    'movf' => 'zero(cpu, get(cpu, $1))', 'incf' => 'zero(cpu, (uint8_t)(get(cpu, $1) + 1u))',
    'decf' => 'zero(cpu, (uint8_t)(get(cpu, $1) - 1u))', 'rlf' => 'moved_left(cpu, get(cpu, $1))',
    'rrf' => 'moved_right(cpu, get(cpu, $1))', 'swapf' => '(uint8_t)(get(cpu, $1) << 4 | get(cpu, $1) >> 4)'
  }.freeze
  STATEMENTS = {
    **VALUES.transform_values { |value| "store(cpu, $1, $2, #{value});" },
    'clrf' => 'put(cpu, $1, zero(cpu, 0));', 'clrw' => 'W = zero(cpu, 0);', 'movwf' => 'put(cpu, $1, W);',
    'bcf' => 'put(cpu, $1, get(cpu, $1) & (uint8_t)~(1u << $2));', 'bsf' => 'put(cpu, $1, get(cpu, $1) | (uint8_t)(1u << $2));',
    'movlw' => 'W = $1;', 'addlw' => 'W = added(cpu, W, $1, 0);', 'sublw' => 'W = subtracted(cpu, $1, W);',
    'andlw' => 'W = zero(cpu, W & $1);', 'iorlw' => 'W = zero(cpu, W | $1);', 'xorlw' => 'W = zero(cpu, W ^ $1);', 'nop' => ''
  }.freeze
  SKIPS = {
    'btfsc' => '(get(cpu, $1) >> $2 & 1u) == 0u', 'btfss' => '(get(cpu, $1) >> $2 & 1u) != 0u',
    'incfsz' => 'stepped(cpu, $1, $2, 1) == 0u', 'decfsz' => 'stepped(cpu, $1, $2, 0xFF) == 0u'
  }.freeze
  BRANCHES = {}.freeze
  # Of the first 2048 words, where the assembly is linked and PCLATH is not needed.
  JUMPS = %w[goto].freeze
  CALLS = %w[call].freeze
  RETURNS = { 'return' => '', 'retlw' => 'W = $1;' }.freeze
  MODEL = 'pic14.h'
  NAME = 'a PIC16'
  FAMILY = 'pic14'
  CHIP = 'pic16f684'
  UNIT = 1
  REGISTERS = {}.freeze
  NEXT = "\nmovlw 0x5A" # is left out, or not
  EXAMPLES = {
    ['%s 0x70, w', '%s 0x71, f'] => VALUES.keys, ['%s 0x72'] => %w[clrf movwf], ['%s'] => %w[clrw nop],
    ['%s 0x70, 0', '%s 0x73, 7', '%s 3, 0'] => %w[bcf bsf], ['%s 0xA7', '%s 0x7F'] => %w[movlw addlw sublw andlw iorlw xorlw],
    ["%s 0x70, 3#{NEXT}", "%s 3, 2#{NEXT}"] => %w[btfsc btfss], ["%s 0x70, w#{NEXT}", "%s 0x72, f#{NEXT}"] => %w[incfsz decfsz],
    ["%s past#{NEXT}"] => JUMPS, ['%s nothing'] => CALLS, ['call nothing'] => RETURNS.keys
  }.freeze

  class << self
    def images
      %w[pic14]
    end

    def sources
      /_pic14\.c\z/
    end

    def options(_image)
      []
    end
  end

  # W is no register that has an address.
  def place(text, index)
    text == 'W' ? 'cpu->w' : super
  end

  # SDCC's arguments, STK00 and so on, have no section in the map.
  def places(_claim)
    at = @data.select { |name, _| name.match?(/\ASTK\d\d\z/) }.values
    "static int may_change(uint16_t address)\n{\n    return (address >= #{at.min}) && (address <= #{at.max});\n}\n"
  end

  private

  def target(one)
    Integer(one.operands.first)
  end
end

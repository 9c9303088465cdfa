# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'pic'

# What a PIC18's instructions do to the memory of test/proof/assembly/pic18.h.
class Pic18Translation < PicTranslation
  # Of those with a file register, where the result goes, and a bank.
  VALUES = {
    'addwf' => 'added(cpu, get(cpu, f), W, 0)', 'addwfc' => 'added(cpu, get(cpu, f), W, STATUS & 1u)',
    'subwf' => 'subtracted(cpu, get(cpu, f), W, 1)', 'subwfb' => 'subtracted(cpu, get(cpu, f), W, STATUS & 1u)',
    'subfwb' => 'subtracted(cpu, W, get(cpu, f), STATUS & 1u)', 'andwf' => 'zero_and_sign(cpu, get(cpu, f) & W)',
    'iorwf' => 'zero_and_sign(cpu, get(cpu, f) | W)', 'xorwf' => 'zero_and_sign(cpu, get(cpu, f) ^ W)', 'comf' => 'zero_and_sign(cpu, (uint8_t)~get(cpu, f))',
    'movf' => 'zero_and_sign(cpu, get(cpu, f))', 'incf' => 'added(cpu, get(cpu, f), 1, 0)', 'decf' => 'added(cpu, get(cpu, f), 0xFF, 0)',
    'rlcf' => 'moved_left(cpu, get(cpu, f), STATUS & 1u)', 'rrcf' => 'moved_right(cpu, get(cpu, f), STATUS & 1u)',
    'rlncf' => 'zero_and_sign(cpu, (uint8_t)(get(cpu, f) << 1 | get(cpu, f) >> 7))', 'rrncf' => 'zero_and_sign(cpu, (uint8_t)(get(cpu, f) >> 1 | get(cpu, f) << 7))',
    'swapf' => '(uint8_t)(get(cpu, f) << 4 | get(cpu, f) >> 4)'
  }.freeze
  STATEMENTS = {
    **VALUES.transform_values { |value| "{ const uint16_t f = where(cpu, $1, $3); store(cpu, f, $2, #{value}); }" },
    'clrf' => 'put(cpu, where(cpu, $1, $2), 0); flags(cpu, FLAG_Z, FLAG_Z);',
    'setf' => 'put(cpu, where(cpu, $1, $2), 0xFF);',
    'movwf' => 'put(cpu, where(cpu, $1, $2), W);',
    'negf' => '{ const uint16_t f = where(cpu, $1, $2); put(cpu, f, subtracted(cpu, 0, get(cpu, f), 1)); }',
    'mulwf' => 'multiplied(cpu, get(cpu, where(cpu, $1, $2)), W);',
    'bcf' => '{ const uint16_t f = where(cpu, $1, $3); put(cpu, f, get(cpu, f) & (uint8_t)~(1u << $2)); }',
    'bsf' => '{ const uint16_t f = where(cpu, $1, $3); put(cpu, f, get(cpu, f) | (uint8_t)(1u << $2)); }',
    'movff' => '{ const uint8_t value = get(cpu, pointed(cpu, $1)); put(cpu, pointed(cpu, $2), value); }',
    'movlw' => 'W = $1;', 'addlw' => 'W = added(cpu, W, $1, 0);', 'sublw' => 'W = subtracted(cpu, $1, W, 1);',
    'andlw' => 'W = zero_and_sign(cpu, W & $1);', 'iorlw' => 'W = zero_and_sign(cpu, W | $1);',
    'xorlw' => 'W = zero_and_sign(cpu, W ^ $1);', 'mullw' => 'multiplied(cpu, $1, W);',
    'movlb' => 'BSR = $1;', 'lfsr' => 'point(cpu, $2);', 'nop' => ''
  }.freeze
  SKIPS = {
    'btfsc' => '(get(cpu, where(cpu, $1, $3)) >> $2 & 1u) == 0u', 'btfss' => '(get(cpu, where(cpu, $1, $3)) >> $2 & 1u) != 0u',
    'tstfsz' => 'get(cpu, where(cpu, $1, $2)) == 0u', 'cpfsgt' => 'get(cpu, where(cpu, $1, $2)) > W', 'cpfslt' => 'get(cpu, where(cpu, $1, $2)) < W',
    'cpfseq' => 'get(cpu, where(cpu, $1, $2)) == W',
    'incfsz' => 'stepped(cpu, where(cpu, $1, $3), $2, 1) == 0u', 'decfsz' => 'stepped(cpu, where(cpu, $1, $3), $2, 0xFF) == 0u',
    'infsnz' => 'stepped(cpu, where(cpu, $1, $3), $2, 1) != 0u'
  }.freeze
  BRANCHES = {
    'bc' => 'STATUS & FLAG_C', 'bnc' => '!(STATUS & FLAG_C)', 'bz' => 'STATUS & FLAG_Z', 'bnz' => '!(STATUS & FLAG_Z)',
    'bn' => 'STATUS & FLAG_N', 'bnn' => '!(STATUS & FLAG_N)'
  }.freeze
  JUMPS = %w[bra goto].freeze
  CALLS = %w[rcall call].freeze
  RETURNS = { 'return' => '', 'retlw' => 'W = $1;' }.freeze
  MODEL = 'pic18.h'
  NAME = 'a PIC18'
  FAMILY = 'pic18'
  CHIP = 'pic18f4520'
  UNIT = 2
  REGISTERS = { 'W' => 0xFE8, 'PRODL' => 0xFF3, 'PRODH' => 0xFF4 }.freeze
  NEXT = "\nmovlw 0x5A" # is left out, or not
  EXAMPLES = { # with FSR0 at 0x224
    ['%s 0x20, w, a', '%s 0x21, f, a', '%s 0x23, f, b'] => VALUES.keys,
    ['%s 0x20, a', '%s 0x24, b'] => %w[clrf setf movwf negf mulwf],
    ['%s 0x20, 0, a', '%s 0x23, 7, b', '%s 0xFD8, 0, a'] => %w[bcf bsf],
    ['%s 0x20, 0x221', '%s 0xFEE, 0x21', '%s 0xFF3, 0x22'] => %w[movff],
    ['%s 0xA7', '%s 0x7F'] => %w[movlw addlw sublw andlw iorlw xorlw mullw],
    ['%s 0'] => %w[movlb], ['%s 0, 0x221'] => %w[lfsr], ['%s'] => %w[nop],
    ["%s 0x20, 3, a#{NEXT}", "%s 0xFE8, 7, a#{NEXT}", "%s 0xFEE, 0, a#{NEXT}"] => %w[btfsc btfss],
    ["%s 0x20, a#{NEXT}", "%s 0xFEE, a\nmovff 0x20, 0x21"] => %w[tstfsz cpfsgt cpfslt cpfseq],
    ["%s 0x20, w, a#{NEXT}", "%s 0x22, f, b#{NEXT}"] => %w[incfsz decfsz infsnz],
    ["%s past#{NEXT}"] => [*BRANCHES.keys, *JUMPS], ['%s nothing'] => CALLS, ['call nothing'] => RETURNS.keys,
    ["movlw 2\nmovf 0xFEB, w, a", "movlw 0xFD\nmovf 0xFEB, w, a", 'movf 0xFEE, w, a'] => %w[movf]
  }.freeze
  # An object of AN937 that is pointed at, in access RAM, and elsewhere.
  OBJECT = '-DFIXPID_AN937_OBJECT=motor'
  OPTIONS = {
    'pic18' => [], 'pic18_access' => [OBJECT, '-DFIXPID_AN937_PLACE=__at(0x20)'], 'pic18_object' => [OBJECT, '-DFIXPID_AN937_PLACE=__at(0x200)']
  }.freeze

  class << self
    def images
      OPTIONS.keys
    end

    def sources
      /_pic18\.c\z/
    end

    def options(image)
      OPTIONS.fetch(image)
    end
  end

  private

  # `call 0x39c, 0x0`
  def target(one)
    Integer(one.operands.first)
  end

  # `lfsr 0x0, 0x200`
  def filled(table, one)
    one.name == 'lfsr' && one.operands.first.to_i(16) != 0 and raise Unknown, format('only FSR0 is known, at 0x%04x', one.address)
    super
  end
end

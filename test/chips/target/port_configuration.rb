# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# port_configuration.rb CHIP HEX: what the configuration words in a firmware set,
# by the names that gputils has for them. Prints each setting of which a port
# makes a promise; fails where one is not as promised.
require_relative '../../../tools/lib/build/gputils'

PIC16 = { 'FOSC' => 'INTOSCIO', 'WDTE' => 'ON', 'PWRTE' => 'ON', 'MCLRE' => 'ON', 'BOREN' => 'ON', 'IESO' => 'OFF',
          'FCMEN' => 'OFF' }.freeze
PIC18 = { 'FCMEN' => 'OFF', 'IESO' => 'OFF', 'STVREN' => 'ON', 'LVP' => 'OFF', 'DEBUG' => 'OFF' }.freeze
PROMISED = {
  'pic16f684' => PIC16,
  'pic18f4520' => PIC18.merge('OSC' => 'HSPLL', 'PWRT' => 'ON', 'BOREN' => 'SBORDIS', 'BORV' => '0', 'WDT' => 'ON',
                              'WDTPS' => '8', 'MCLRE' => 'ON', 'PBADEN' => 'OFF', 'CCP2MX' => 'PORTC',
                              'XINST' => 'OFF'),
  'pic18f26k22' => PIC18.merge('FOSC' => 'HSMP', 'PLLCFG' => 'ON', 'PWRTEN' => 'ON', 'BOREN' => 'SBORDIS',
                               'BORV' => '285', 'WDTEN' => 'ON', 'WDTPS' => '8', 'MCLRE' => 'EXTMCLR',
                               'PBADEN' => 'OFF', 'XINST' => 'OFF'),
  'pic18f4431' => PIC18.merge('OSC' => 'HSPLL', 'PWRTEN' => 'ON', 'BOREN' => 'ON', 'BORV' => '45', 'WDTEN' => 'ON',
                              'WDPS' => '8', 'MCLRE' => 'ON')
}.freeze

# The bytes of an Intel HEX file by address.
def bytes(path)
  high = 0
  File.readlines(path).each_with_object({}) do |line, memory|
    count, address, type, *data = [line.strip.delete_prefix(':')].pack('H*').unpack('CnCC*')
    high = (data[0] << 8) + data[1] if type == 4
    data.first(count).each_with_index { |byte, i| memory[(high << 16) + address + i] = byte } if type.zero?
  end
end

# A chip's settings: by field its place, "2L" of a PIC18, and the values.
def fields(chip)
  pattern = chip.start_with?('pic18') ? /^_(\w+?)_(\w+)_(\d[LH])\s+EQU\s+H'(\h+)'/ : /^_(\w+?)_(\w+)()\s+EQU\s+H'(\h{4})'/
  File.foreach("#{Gputils.folder('header')}/p#{chip.delete_prefix('pic')}.inc", encoding: 'BINARY')
      .each_with_object(Hash.new { |all, key| all[key] = {} }) do |line, all|
    field, setting, place, value = line.match(pattern)&.captures
    all[[field, place]][setting] = value.hex if field
  end
end

# The byte of a PIC18 or the word of a PIC16.
def configured(memory, place)
  return memory.fetch(2 * 0x2007) | (memory.fetch((2 * 0x2007) + 1) << 8) if place.empty?

  memory.fetch(0x300000 + (2 * (place.to_i - 1)) + (place.end_with?('H') ? 1 : 0))
end

# The first name of the setting whose bits are the value's, among those that
# any two settings do not share.
def setting(values, value)
  mask = values.values.reduce(0) { |bits, other| bits | (other ^ values.values.first) }
  values.key(values.values.find { |other| ((other ^ value) & mask).zero? })
end

chip, hex = ARGV
memory = bytes(hex)
known = fields(chip)
wrong = PROMISED.fetch(chip).filter_map do |field, promised|
  (_, place), values = known.find { |(name, _), all| name == field && all.key?(promised) }
  next "gputils knows no #{field} = #{promised}" unless values

  found = setting(values, configured(memory, place))
  puts "#{field} #{found}"
  "#{field} is #{found}, not #{promised}" unless values[found] == values[promised]
end
puts wrong.map { |what| "configuration: #{what}" }
exit wrong.empty?

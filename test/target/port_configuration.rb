# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# port_configuration.rb CHIP HEX: what the configuration words in a firmware set,
# by the names that gputils has for them. Prints the settings that docs/ports.md
# is about; fails where one is not what a port promises.
chip, hex = ARGV

# Settings by field; the first of several places is the installed one.
PROMISED = {
  'pic16f684' => { 'FOSC' => 'INTOSCIO', 'WDTE' => 'ON', 'PWRTE' => 'ON', 'MCLRE' => 'ON', 'BOREN' => 'ON',
                   'IESO' => 'OFF', 'FCMEN' => 'OFF' },
  'pic18f4520' => { 'OSC' => 'HSPLL', 'FCMEN' => 'OFF', 'IESO' => 'OFF', 'PWRT' => 'ON', 'BOREN' => 'SBORDIS',
                    'BORV' => '0', 'WDT' => 'ON', 'WDTPS' => '8', 'MCLRE' => 'ON', 'PBADEN' => 'OFF',
                    'CCP2MX' => 'PORTC', 'STVREN' => 'ON', 'LVP' => 'OFF', 'XINST' => 'OFF', 'DEBUG' => 'OFF' }
}.freeze
HEADER = Dir.glob("{/usr,/usr/local}/share/gputils/header/p#{chip.delete_prefix('pic')}.inc").first or
  abort 'configuration: gputils has no header of this chip'

# The bytes of an Intel HEX file by address.
def bytes(path)
  high = 0
  File.readlines(path).each_with_object({}) do |line, memory|
    count, address, type, *data = [line.strip.delete_prefix(':')].pack('H*').unpack('CnCC*')
    high = (data[0] << 8) + data[1] if type == 4
    data.first(count).each_with_index { |byte, i| memory[(high << 16) + address + i] = byte } if type.zero?
  end
end

# { field => { setting => value } }: `_BOREN_ON_2L EQU H'FB'`.
def options(lines, pic18)
  pattern = pic18 ? /^_(\w+?)_(\w+)_(\d[LH])\s+EQU\s+H'(\h+)'/ : /^_(\w+?)_(\w+)()\s+EQU\s+H'(\h{4})'/
  lines.each_with_object(Hash.new { |all, key| all[key] = {} }) do |line, all|
    field, setting, place, value = line.match(pattern)&.captures
    all[[field, place]][setting] = value.hex if field
  end
end

lines = File.readlines(HEADER, encoding: 'BINARY')
memory = bytes(hex)
pic18 = chip.start_with?('pic18')
all = options(lines, pic18)
wrong = PROMISED.fetch(chip).filter_map do |name, promised|
  (field, place), settings = all.find { |(known, _), values| known == name && values.key?(promised) }
  next "gputils knows no #{name} = #{promised}" unless field

  address = pic18 ? 0x300000 + (2 * (place.to_i - 1)) + (place[-1] == 'H' ? 1 : 0) : 2 * 0x2007
  value = pic18 ? memory.fetch(address) : memory.fetch(address) | (memory.fetch(address + 1) << 8)
  mask = settings.values.reduce(0) { |bits, other| bits | (other ^ settings.values.first) }
  found = settings.key(settings.values.find { |other| ((other ^ value) & mask).zero? })
  puts "#{name} #{found}"
  "#{name} is #{found}, not #{promised}" if settings[found] != settings[promised]
end
puts wrong.map { |what| "configuration: #{what}" }
exit wrong.empty?

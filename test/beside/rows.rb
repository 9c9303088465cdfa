# SPDX-License-Identifier: MIT
# Prints the rows of a recorded file as tables in C, one for each column that
# is given to a call: ruby rows.rb FILE.csv [COLUMN:TYPE]... Without columns they
# are those that test/beside gives to the file's module.
COLUMNS = {
  slew: %w[event:uint8_t rise_q16:uint32_t fall_q16:uint32_t seed:int16_t target:int16_t],
  tpo: %w[event:uint8_t full:int16_t window:uint16_t minimum_on:uint16_t minimum_off:uint16_t duty:int16_t],
  gains: %w[kp_milli:uint32_t ki_milli:uint32_t kd_milli:uint32_t rate_milli:uint32_t filter:uint8_t]
}.freeze
path, *columns = ARGV
columns = COLUMNS.fetch(File.basename(path, '.csv').to_sym) if columns.empty?
head, *rows = File.readlines(path, chomp: true).map { |line| line.split(',') }
puts '// Made by rows.rb: do not edit.', '#include <stdint.h>', "#define ROWS #{rows.size}u"
puts '#ifdef __AVR__ // its RAM has no room for them', '#define IN_FLASH __flash', '#else', '#define IN_FLASH', '#endif'
columns.each do |column|
  name, type = column.split(':')
  at = head.index(name) or abort "#{path} has no column #{name}"
  suffix = type == 'uint32_t' ? 'u' : ''
  values = rows.map { |row| Integer(row[at], 10) }
  lines = values.map { |value| "#{value == -32_768 ? '(-32767 - 1)' : value}#{suffix}" }.each_slice(10)
  puts "static const IN_FLASH #{type} rows_#{name}[ROWS] = {", lines.map { |line| "#{line.join(', ')}," }, '};'
end

# SPDX-License-Identifier: MIT
# Prints the rows of a module's recorded file as tables in C, one for each column
# that its entry of tools/lib/modules.rb names: ruby rows.rb MODULE.csv
require_relative '../../../tools/lib/modules'

path = ARGV.fetch(0)
columns = Modules::ALL.fetch(File.basename(path, '.csv'))[:rows]
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

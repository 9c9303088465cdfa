# SPDX-License-Identifier: MIT
# Prints the rows of a module's recorded file as tables in C, one for each column
# that its entry of tools/lib/modules.rb names. Columns that many rows share, its `shared`,
# are tables of what differs, and `rows_shared` says which is a row's: ruby rows.rb MODULE.csv or
# PART.csv, with a number: of the first rows only.
require_relative '../../../tools/lib/modules'
require_relative '../../support/recorded'

# C has no literal for these.
LEAST = { -32_768 => '(-32767 - 1)', -2_147_483_648 => '(-2147483647 - 1)' }.freeze

# A table in C of a column, whose name has its type behind it.
def table(column, values, size)
  name, type = column.split(':')
  suffix = type == 'uint32_t' ? 'u' : ''
  lines = values.map { |value| "#{LEAST.fetch(value, value)}#{suffix}" }.each_slice(10)
  puts "static const IN_FLASH #{type} rows_#{name}[#{size}] = {", lines.map { |line| "#{line.join(', ')}," }, '};'
end

# Of fields that are pieces `value*times`, one table for all rows; `_from` says where those of
# a row begin. An R, which stands for a call of reset, is a piece of no times.
def pieces(name, fields)
  each = fields.map { |field| field.split.map { |piece| piece == 'R' ? [0, 0] : piece.split('*').map { |number| Integer(number, 10) } } }
  values, times = each.flatten(1).map { |value, count = 1| [value, count] }.transpose
  table("#{name}_value:int16_t", values, values.size)
  table("#{name}_times:uint16_t", times, times.size)
  from = each.map(&:size).reduce([0]) { |sums, size| sums << (sums.last + size) }
  table("#{name}_from:uint16_t", from, from.size)
end

path = ARGV.fetch(0)
entry = Modules.entry(File.basename(path, '.csv'))
recorded = Recorded.new(path)
count = ARGV[1] ? Integer(ARGV[1]) : recorded.rows.size
values = ->(column) { recorded.numbers(column[/\w+/]).first(count) }
puts '// Made by rows.rb: do not edit.', '#include <stdint.h>', "#define ROWS #{count}u"
puts '#ifdef __AVR__ // its RAM has no room for them', '#define IN_FLASH __flash', '#else', '#define IN_FLASH', '#endif'
entry[:pieces]&.each { |name| pieces(name, recorded.by_name.first(count).map { |row| row.fetch(name) }) }
entry[:rows].each { |column| table(column, values.call(column), 'ROWS') }
if entry[:shared]
  each = entry[:shared].map(&values).transpose
  some = each.uniq
  entry[:shared].zip(some.transpose) { |column, of_some| table(column, of_some, of_some.size) }
  which = each.map(&some.each_with_index.to_h)
  abort "#{path}: more than 256 of them are shared" if which.max > 255
  table('shared:uint8_t', which, 'ROWS')
end

# SPDX-License-Identifier: MIT
# Prints a C file that implements test/support/vectors.h over flash tables made
# of recorded files: ruby vectors_table.rb FILE.csv...

# Each column takes the smallest type that holds it: [C type, range, read, size].
TYPES = [['uint8_t', 0..255, 'byte', 1], ['int8_t', -128..127, 'byte', 1],
         ['int16_t', -32_768..32_767, 'word', 2],
         ['int32_t', -2**31..2**31 - 1, 'dword', 4]].freeze

def columns_of(path)
  rows = File.readlines(path, chomp: true).drop(1).map do |line|
    line.strip.split(',').map { |number| Integer(number, 10) }
  end
  rows.transpose.map do |column|
    [TYPES.find { |_, range| column.minmax.all? { |value| range.cover?(value) } }, column]
  end
end

files = ARGV.to_h { |path| [File.basename(path, '.csv'), columns_of(path)] }

puts '// Made by vectors_table.rb: do not edit.'
puts '#include <avr/pgmspace.h>', '#include <string.h>', '#include "vectors.h"'
files.each do |name, columns|
  columns.each_with_index do |((type), column), index|
    puts "static const #{type} #{name}_#{index}[] PROGMEM = {", "#{column.join(',')}};"
  end
  puts "static void #{name}(uint32_t row, int32_t *columns)", '{'
  columns.each_with_index do |((type, _, read, size), _), index|
    puts "columns[#{index}] = (#{type})pgm_read_#{read}_far(" \
         "pgm_get_far_address(#{name}_#{index}) + #{size} * row);"
  end
  puts '}'
end
puts 'static void (*get)(uint32_t row, int32_t *columns);'
puts 'static uint32_t row, rows;'
puts 'void vectors_open(const char *name)', '{', 'row = 0;'
files.each do |name, columns|
  puts "if (strcmp(name, \"#{name}\") == 0) { get = #{name}; rows = #{columns[0][1].size}; }"
end
puts '}'
puts 'bool vectors_next(int32_t columns[VECTORS_COLUMNS_MAX])', '{'
puts 'if (row == rows) { return false; }', 'get(row, columns);', 'row++;', 'return true;', '}'

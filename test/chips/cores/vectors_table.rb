# SPDX-License-Identifier: MIT
# Prints a C file that implements test/support/vectors.h over flash tables made
# of recorded files: ruby vectors_table.rb FILE.csv...
require_relative '../../support/recorded'

# Each column takes the smallest type that holds it: [C type, range, read, size].
TYPES = [['uint8_t', 0..255, 'byte', 1], ['int8_t', -128..127, 'byte', 1],
         ['int16_t', -32_768..32_767, 'word', 2],
         ['int32_t', -2**31..2**31 - 1, 'dword', 4],
         ['uint32_t', 0..2**32 - 1, 'dword', 4]].freeze

# A column: where its runs of equal values begin (nil: each row is one), and
# the values.
Column = Struct.new(:type, :read, :size, :starts, :values)

def column_of(values)
  type, _, read, size = TYPES.find { |_, range| values.minmax.all? { |value| range.cover?(value) } }
  starts = values.each_index.select { |row| row.zero? || values[row] != values[row - 1] }
  return Column.new(type, read, size, nil, values) if (size + 2) * starts.size >= size * values.size

  Column.new(type, read, size, starts, values.values_at(*starts))
end

# No test reads the firmware's own cycles, the last columns of its files.
def columns_of(path)
  recorded = Recorded.new(path)
  names = path.end_with?('_firmware.csv') ? recorded.names.first(12) : recorded.names
  [recorded.rows.size, names.map { |name| column_of(recorded.numbers(name)) }]
end

def flash(type, read, size, table, index)
  "(#{type})pgm_read_#{read}_far(pgm_get_far_address(#{table}) + #{size} * (uint32_t)(#{index}))"
end

files = ARGV.to_h { |path| [File.basename(path, '.csv'), columns_of(path)] }

puts '// Made by vectors_table.rb: do not edit.'
puts <<~'C'
  #include <string.h>
  #include "vectors.h"
  #ifdef __AVR__
  #include <avr/pgmspace.h>
  #else // flash is plain memory
  #define PROGMEM
  #define pgm_get_far_address(object) ((uintptr_t) & (object)[0])
  #define pgm_read_byte_far(address) (*(const uint8_t *)(address))
  #define pgm_read_word_far(address) (*(const uint16_t *)(address))
  #define pgm_read_dword_far(address) (*(const uint32_t *)(address))
  #endif
C
puts 'static uint16_t row, rows, run[VECTORS_COLUMNS_MAX];'
files.each do |name, (_, columns)|
  columns.each_with_index do |column, index|
    table = "#{name}_#{index}"
    puts "static const #{column.type} #{table}[] PROGMEM = {", "#{column.values.join(',')}};"
    puts "static const uint16_t #{table}_starts[] PROGMEM = {", "#{column.starts.join(',')}, 65535};" if column.starts
  end
  puts "static void #{name}(int32_t *columns)", '{'
  columns.each_with_index do |column, index|
    table = "#{name}_#{index}"
    at = column.starts ? "run[#{index}]" : 'row'
    puts "if (row >= #{flash('uint16_t', 'word', 2, "#{table}_starts", "#{at} + 1u")}) { #{at}++; }" if column.starts
    puts "columns[#{index}] = (int32_t)#{flash(column.type, column.read, column.size, table, at)};"
  end
  puts '}'
end
puts 'static void (*get)(int32_t *columns);'
files.each do |name, (count, _)|
  puts "void vectors_open_#{name}(void);", "void vectors_open_#{name}(void)", '{'
  puts 'row = 0;', 'memset(run, 0, sizeof run);', "get = #{name};", "rows = #{count};", '}'
end
puts 'void vectors_open(const char *name)', '{'
files.each_key { |name| puts "if (strcmp(name, \"#{name}\") == 0) { vectors_open_#{name}(); }" }
puts '}'
puts 'bool vectors_next(int32_t columns[VECTORS_COLUMNS_MAX])', '{'
puts 'if (row == rows) { return false; }', 'get(columns);', 'row++;', 'return true;', '}'

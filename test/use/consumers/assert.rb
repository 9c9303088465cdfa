# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Prints the calls of assert.c, in C that is C++, too: each function of the headers in
# this folder once for each pointer that it takes. A wrong pointer is a null pointer, or,
# where a controller is the program's one, another controller.
HEADERS = Dir["#{ARGV.fetch(0)}/fixpid_*.h"].sort.freeze
TEXT = HEADERS.map { |path| File.read(path).gsub(%r{//.*}, '') }.join.freeze

# [function, the type of each argument], without what says where it lives, and without
# those that only an AVR has.
FUNCTIONS = TEXT.gsub(/^#.*(?:\\\n.*)*/, '').scan(/^\w[\w ]*\b(fixpid_\w+)(?<!_P)\(([^;{)]*)\);/).map do |name, arguments|
  [name, arguments.split(',').map { |one| one.end_with?('[]') ? 'bytes *' : one[/\A\s*(?:FIXPID_DATA )?(?:const )?((?:struct )?\w+ \*?)/, 1] }]
end.freeze

PROTOTYPES = ['#include <stdbool.h>', '#include <stddef.h>', '#ifdef __cplusplus', 'extern "C" {', '#endif', 'extern const char *const calls[];',
              'void call(int number, bool wrong);', '#ifdef __cplusplus', '}', '#endif'].freeze

STRUCTS = FUNCTIONS.flat_map(&:last).map { |type| type[/struct fixpid_(\w+) \*/, 1] }.compact.uniq.freeze

def pointer(type, number, at)
  name = type[/struct fixpid_(\w+)/, 1] or return number == at ? 'wrong ? NULL : bytes' : 'bytes'
  number == at ? "wrong ? WRONG_#{name} : &#{name}" : "&#{name}"
end

calls = FUNCTIONS.flat_map do |function, types|
  types.each_index.select { |at| types[at].end_with?('*') }.map do |at|
    "#{function}(#{types.map.with_index { |type, number| type.end_with?('*') ? pointer(type, number, at) : '1' }.join(', ')})"
  end
end

puts HEADERS.map { |path| "#include \"#{File.basename(path)}\"" }, PROTOTYPES
STRUCTS.each do |name|
  object = "FIXPID_#{name.upcase}_OBJECT"
  puts "struct fixpid_#{name} #{name};"
  puts "#ifdef #{object}", "static struct fixpid_#{name} second_#{name};", "#define WRONG_#{name} (&second_#{name})", '#else' if TEXT.include?(object)
  puts "#define WRONG_#{name} NULL"
  puts '#endif' if TEXT.include?(object)
end
puts 'static uint8_t bytes[64];', 'void call(int number, bool wrong)', '{', '    switch (number) {'
calls.each_with_index { |text, number| puts "    case #{number}: (void)#{text}; break;" }
puts '    default: break;', '    }', '}', 'const char *const calls[] = {', calls.map { |text| "    \"#{text}\"," }, '    NULL};'

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The interface as it is recorded in interface.csv: each function, each constant's
# value, each structure's size and its members' places on an ATmega, a Cortex-M and a
# PC. docs/installing.md promises when it may change. With --update it is recorded anew.
# A header that says a structure's size says this one.
require 'fileutils'
require 'open3'

PROJECT = File.expand_path('../../..', __dir__)
RECORD = "#{__dir__}/interface.csv"
COLUMNS = "header,kind,name,atmega328p,cortex_m0,pc\n"
FOLDER = "#{PROJECT}/build/interface"
CHIPS = { 'avr-gcc' => ['S<', %w[-mmcu=atmega328p]], 'arm-none-eabi-gcc' => ['L<', %w[-mcpu=cortex-m0 -mthumb -ffreestanding]],
          'gcc' => ['L<', []] }.freeze

HEADERS = Dir.chdir(PROJECT) { Dir['include/*.h'].sort.to_h { |path| [File.basename(path), File.read(path).gsub(%r{//.*}, '')] } }.freeze

# [structure, its members] of a header.
def structures(text)
  text.scan(/^struct (fixpid_\w+) \{(.*?)^\};/m).map do |name, body|
    [name, body.scan(/(\w+)(?:\[\w+\])?;/).flatten]
  end
end

# [what, C expression] that a compiler has to tell.
def measures(text)
  structures(text).flat_map do |name, members|
    [["struct,#{name}", "sizeof(struct #{name})"]] + members.map { |member| ["member,#{name}.#{member}", "offsetof(struct #{name}, #{member})"] }
  end
end

def constants(text)
  names = text.scan(/^#define (FIXPID_\w+) \d/) + text.scan(/^ +(FIXPID_\w+)(?: = \w+)?,?\s*$/)
  names.flatten.uniq.grep_v(/_VERSION_/).map { |name| ["constant,#{name}", "(unsigned long)(#{name})"] }
end

def functions(text)
  text.scan(/^(?:FIXPID_INLINE )?((?:bool|void|u?int\d+_t)\s+fixpid_\w+\([^;{]*\))(?:;| *\n\{)/).flatten.map { |function| "function,\"#{function.gsub(/\s+/, ' ')}\"" }
end

# The numbers that a compiler has for these expressions: in a constant of the object.
def told(compiler, pack, options, expressions)
  includes = HEADERS.keys.map { |header| "#include \"#{header}\"\n" }.join
  type = { 'S<' => 'unsigned short', 'L<' => 'unsigned int' }.fetch(pack)
  source = "#include <stddef.h>\n#include <stdint.h>\n#{includes}const #{type} told[] = {\n#{expressions.map { |text| "(#{type})(#{text})" }.join(",\n")}};\n"
  File.write("#{FOLDER}/told.c", source)
  run(compiler, *options, "-I#{PROJECT}/include", '-c', "#{FOLDER}/told.c", '-o', "#{FOLDER}/told.o")
  objcopy = compiler == 'gcc' ? 'objcopy' : compiler.sub('gcc', 'objcopy')
  run(objcopy, '-O', 'binary', '-j', '.rodata', "#{FOLDER}/told.o", "#{FOLDER}/told.bin")
  numbers = File.binread("#{FOLDER}/told.bin").unpack("#{pack}*")
  numbers.size == expressions.size or abort "FAILED #{compiler} tells #{numbers.size} of #{expressions.size} numbers"
  numbers
end

def run(*command)
  output, status = Open3.capture2e(*command)
  status.success? or abort "FAILED #{command.join(' ')}\n#{output}"
end

# A row for each, with what the three compilers say; of a constant, with what a PC's does.
def interface
  rows = HEADERS.flat_map do |header, text|
    places = measures(text)
    values = constants(text)
    columns = CHIPS.map { |compiler, (pack, options)| places.empty? ? [] : told(compiler, pack, options, places.map(&:last)) }
    sizes = places.map(&:first).zip(*columns).map { |row| row.join(',') }
    numbers = values.empty? ? [] : values.map(&:first).zip(told('gcc', 'L<', [], values.map(&:last))).map { |name, value| "#{name},,,#{value}" }
    [*sizes, *numbers, *functions(text).map { |function| "#{function},,," }].map { |row| "#{header},#{row}\n" }
  end
  COLUMNS + rows.join
end

# Where the words above a structure say its size, they say that of each of the three.
def missaid(rows)
  Dir["#{PROJECT}/include/*.h"].sort.flat_map do |path|
    File.read(path).scan(%r{((?:^//.*\n)+)struct (fixpid_\w+) \{}).filter_map do |words, name|
      said = words.gsub(%r{\s*// ?}, ' ').scan(/(\d+) (?:bytes|where)/).flatten
      sizes = rows[/,struct,#{name},(.*)/, 1].split(',').uniq
      "size: #{File.basename(path)} says #{said.join(' and ')} bytes of #{name}, not #{sizes.join(' and ')}" unless [[], sizes].include?(said)
    end
  end
end

FileUtils.mkdir_p(FOLDER)
found = interface
File.write(RECORD, found) if ARGV == ['--update']
recorded = File.read(RECORD)
(recorded.lines - found.lines).each { |line| puts "gone: #{line}" }
(found.lines - recorded.lines).each { |line| puts "new: #{line}" }
puts 'ruby test/use/packages/interface.rb --update records it' if found != recorded
wrong = missaid(found)
puts wrong
exit(found == recorded && wrong.empty? ? 0 : 1)

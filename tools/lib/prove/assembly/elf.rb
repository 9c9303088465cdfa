# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../../../bound/bound'
require_relative 'translation'

# What an AVR and an ARM have alike: a program that gcc links, and objdump's text of it.
# Beside the tables each has
#
#   TOOLS     how the names of its compiler and its tools begin
#   OPTIONS   image => the compiler's for its chip
#   WITH_ALL  the image whose chip has all instructions
#   EXAMPLES  texts => names of the instructions that are compared with the simulator in them
#   HEAD      what stands before all examples
#   FUNCTION  what the function of one begins with, %<name>s for its name
#   FOLLOWER  an instruction behind each, which may be left out or come to, before 1:
#   LAST      one that returns
class ElfTranslation < Translation
  class << self
    def images
      self::OPTIONS.keys
    end

    # The claims' functions with the sources of a tree.
    def of(image, folder, tree = '.')
      of_file(image, "#{FOLDER}/assembly/#{File.basename(self::MODEL, '.h')}.c", folder, tree)
    end

    def program(folder)
      "#{folder}/#{File.basename(self::MODEL, '.h')}.elf"
    end

    # [name, translation] of a program with a function for each example.
    def examples(folder)
      bodies = self::EXAMPLES.flat_map { |texts, names| names.product(texts).map { |name, text| [name, format(text, name)] } }
      functions = bodies.each_with_index.map do |(name, body), at|
        format("#{self::FUNCTION}%<name>s:\n%<body>s\n#{self::FOLLOWER}\n1: #{self::LAST}\n", name: "#{name}_#{at}", body: body)
      end
      File.write("#{folder}/examples.s", self::HEAD + functions.join)
      of_file(self::WITH_ALL, "#{folder}/examples.s", folder)
    end

    private

    def of_file(image, file, folder, tree = '.')
      program = program(folder)
      said("#{self::TOOLS}-gcc", *self::OPTIONS.fetch(image), '-std=gnu99', '-O2', '-w', "-I#{tree}/include", "-I#{tree}/src", '-nostdlib',
           file, '-lgcc', '-o', program)
      text = said("#{self::TOOLS}-objdump", '-d', '-z', '-w', program)
      new(text.scan(Bound::OBJDUMP_LINE).map { |row| disassembled(*row) }, text.scan(/^(\h+) <(\w+)>:$/).to_h { |at, name| [name, at.hex] })
    end

    def disassembled(address, code, name, operands)
      Disassembled.new(address.hex, code.delete(' ').size / 2, name, operands.to_s.strip.split(/,\s*/))
    end
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'translation'

# What PICs have alike: a program that SDCC and gputils link, gpdasm's text of it, and the
# linker's map of what stands where.
class PicTranslation < Translation
  LINE = /^(\h+):  \h{4}(?:  (\w\S*)(?:[ \t]+(\S.*?))?)?\s*$/.freeze
  SYMBOL = /^\s*_?(\w+)\s+0x(\h+)\s+(program|data)\s+(?:extern|static)\s/.freeze
  SECTION = /^\s*\S+\s+udata\S*\s+0x(\h+)\s+data\s+0x(\h+)/.freeze
  COMPILE = %w[c++ -std=c++17 -D_PIC18 -Isim/chip -Isim/gpsim/shim].freeze
  SIMULATOR = %w[test/proof/assembly/gpsim.cc sim/gpsim/chip.cc -lgpsim].freeze
  SUPPORT = %w[-Iport/pic].freeze

  class << self
    def program(folder)
      "#{folder}/pic.cod"
    end

    def of(image, folder, tree = '.')
      of_files(["-I#{tree}/include", "-I#{tree}/src", *options(image), "#{FOLDER}/assembly/pic.c",
                *Dir["#{tree}/src/*/*_#{self::FAMILY}.c"].sort], folder)
    end

    # With a function for each example, and one that calls them all.
    def examples(folder)
      bodies = self::EXAMPLES.flat_map { |texts, names| names.product(texts) }
                             .each_with_index.map { |(name, body), at| ["#{name}_#{at}", format(body, name).gsub('past', "past#{at}")] }
      texts = bodies.map { |name, body| example(name, body.lines(chomp: true)) }
      calls = bodies.map { |name, _| "\tclrwdt\n\tcall #{name}\n" }
      File.write("#{folder}/examples.asm", "\tprocessor #{self::CHIP.delete_prefix('pic')}\nexamples code\n" \
                                           "\tglobal _examples\n_examples:\n#{calls.join}\treturn\n#{texts.join}nothing:\n\tretlw 0x33\n\tend\n")
      of_files(['-DEXAMPLES', "#{FOLDER}/assembly/pic.c", "#{folder}/examples.asm"], folder)
    end

    private

    def of_files(arguments, folder)
      image = program(folder).delete_suffix('.cod')
      said('tools/lib/build/build_pic', self::CHIP, image, *SUPPORT, "-Iport/pic/#{self::CHIP}", *arguments)
      map = File.read("#{image}.map")
      symbols = map.scan(SYMBOL).group_by(&:last).transform_values { |some| some.to_h { |name, at, _| [name, at.hex] } }
      translated = new(disassembled(said('gpdasm', "-p#{self::CHIP.delete_prefix('pic')}", "#{image}.hex")), symbols.fetch('program'))
      translated.remember(symbols.fetch('data', {}), map.scan(SECTION).map { |at, bytes| (at.hex...(at.hex + bytes.hex)) })
    end

    def example(name, body)
      "\tglobal #{name}\n\tglobal #{name}_end\n#{name}:\n#{body.map { |line| "\t#{line}\n" }.join}" \
        "past#{name[/\d+\z/]}:\n#{name}_end:\n\treturn\n"
    end

    # A line without a name is the second word of the instruction before.
    def disassembled(text)
      text.scan(LINE).each_with_object([]) do |(address, name, operands), all|
        next all.last.bytes *= 2 if name.nil?

        all << Disassembled.new(address.hex, self::UNIT, name, operands.to_s.split(/,\s*/))
      end
    end
  end

  # What the linker has put where.
  def remember(data, sections)
    @data = data
    @sections = sections
    self
  end

  # Of bytes from the lowest one on: a register's, those of a symbol, or one of those that
  # are named from the highest to the lowest.
  def place(text, index)
    names = text.split(':')
    return place(names.reverse.fetch(index), 0) if names.size > 1


    format('cpu->memory[PLACE(0x%03xu)]', address(text) + index)
  end

  # Where the claim's operands and results are, whole sections of the linker.
  def places(claim)
    named = (claim.operands + claim.results).flat_map { |one| one.place.split(':') } - self.class::REGISTERS.keys
    at = named.map { |text| address(text) }
    ranges = @sections.select { |range| at.any? { |one| range.cover?(one) } }
    tests = ranges.map { |range| format('((address >= 0x%03x) && (address < 0x%03x))', range.begin, range.end) }
    "static int may_change(uint16_t address)\n{\n    return #{tests.empty? ? '0' : tests.join(' || ')};\n}\n"
  end

  private

  # NAME, NAME+3 or a number.
  def address(text)
    name, offset = text.split('+')
    return self.class::REGISTERS.fetch(name) if self.class::REGISTERS.key?(name)

    (name.match?(/\A0x/) ? name.hex : @data.fetch(name) { raise Unknown, "the map has no #{name}" }) + offset.to_i
  end
end

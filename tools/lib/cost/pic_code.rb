# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'code'

# A PIC's firmware, from Intel hex and the linker's map.
class PicCode < Code
  SECTION = /^\s*(\S+)\s+(?:code|idata|romdata|udata)\s+0x(\h+)\s+(program|data)\s+0x(\h+)\s*$/.freeze
  # Not SDCC's labels, and not the marks of tools/lib/one_bank.
  SYMBOL = /^\s*(?!_?\d+_DS_|one_bank_)_?(\w+)\s+0x(\h+)\s+program\s+\S+\s/.freeze

  # In `place`, program or data; sizes are in bytes.
  Section = Struct.new(:name, :address, :place, :bytes)

  attr_reader :sections

  def initialize(path)
    @path = path
    @sections = PicCode.sections("#{path}.map")
    super(File.read("#{path}.map").scan(SYMBOL).to_h { |name, address| [name, address.hex] }.merge(static_functions))
    @bytes = read_hex("#{path}.hex")
  end

  # The core of a chip, pic16f684 or gpsim's p16f684; nil for another, such as the
  # small ones whose number begins with 5.
  def self.of(chip)
    case chip.sub(/\Ap(ic)?/, '')
    when /\A18/ then Pic18Code
    when /\A1[26][a-z]+5/ then nil
    when /\A1[26][a-z]+1\d{3}/ then Pic14EnhancedCode
    when /\A(12|16[a-z]+\d{2,3}[a-z]?\z)/ then Pic14Code
    end
  end

  def self.sections(map)
    File.read(map).scan(SECTION).map { |name, at, place, bytes| Section.new(name, at.hex, place, bytes.hex) }
  end

  # Of the functions that these addresses belong to, in the chip's units.
  def size_of(addresses)
    found = program.select { |one| addresses.any? { |at| range(one).cover?(at) } }
    found.sum { |one| units(one) }
  end

  # Without the application's own function, and without configuration words.
  def library_flash
    program.reject { |one| one.name.end_with?('__main') || one.address >= self.class::FLASH }.sum { |one| units(one) }
  end

  # Bytes of RAM that are taken: sections may overlap, and registers of the chip
  # are sections too.
  def ram_bytes
    @sections.select { |one| one.place == 'data' }
             .flat_map { |one| (one.address...(one.address + one.bytes)).to_a }
             .uniq.count { |at| self.class::RAM.any? { |range| range.cover?(at) } }
  end

  # Of a variable, from the assembly of the sources.
  def object_size(name)
    Dir["#{@path}.d/*.asm"].each do |file|
      size = File.read(file)[/^_#{name}\s+res\s+(\d+)/, 1]
      return size.to_i if size
    end
    raise Failure, "no object #{name}"
  end

  private

  def static_functions
    program.map { |one| [one.name[/\AS_\w+?__(\S+)/, 1], one.address] }.select(&:first).to_h
  end

  def program
    @sections.select { |one| one.place == 'program' }
  end

  def range(section)
    (section.address...(section.address + units(section)))
  end

  # By byte address.
  def read_hex(path)
    bytes = {}
    high = 0
    File.foreach(path) do |line|
      count, address, type, data = line.strip.match(/\A:(\h\h)(\h{4})(\h\h)(\h*)\h\h\z/).captures
      high = data.hex << 16 if type == '04'
      next unless type == '00'

      (0...count.hex).each { |at| bytes[high + address.hex + at] = data[2 * at, 2].hex }
    end
    bytes
  end

  def word_at_byte(address)
    low = @bytes[address] or missing(address, 'erased flash')
    low | (@bytes.fetch(address + 1) << 8)
  end
end

# A mid-range PIC, of whose code 2048 words are followed: addresses are words.
class Pic14Code < PicCode
  FLASH = 0x2000
  RAM = [0x20..0x7F, 0xA0..0xEF, 0x110..0x16F, 0x190..0x1EF].freeze # of four banks
  DECF = 0x0380
  DECFSZ = 0x0B80
  MOVWF = 0x0080
  TESTS_ZERO = [0x1903, 0x1D03].freeze # BTFSC or BTFSS STATUS,Z

  # Of 2048 words, configuration words left out.
  def pages
    program.select { |one| one.address < 0x2000 }.map { |one| one.address / 2048 + 1 }.max
  end

  def decremented(at)
    word(at) & 0x7F if [DECF, DECFSZ].include?(word(at) & 0x3F80)
  end

  def writes?(at, counter)
    writes_file?(word(at)) && (word(at) & 0x7F) == counter
  end

  # MOVLW and MOVWF.
  def loaded(at, counter)
    return unless word(at) == (MOVWF | counter)

    before = word(at - 1)
    before & 0xFF if (before & 0x3F00) == 0x3000
  end

  def counts_to_zero?(at)
    (word(at) & 0x3F80) == DECFSZ || (1..2).any? { |after| TESTS_ZERO.include?(word(at + after)) }
  end

  def word(at)
    word_at_byte(2 * at) & 0x3FFF
  end

  def word?(at)
    @bytes.key?(2 * at)
  end

  private

  def units(section)
    section.bytes / 2
  end

  def decode(at)
    word = word_at_byte(2 * at) & 0x3FFF
    case word
    when 0x0008, 0x0009, 0x3400..0x37FF then Instruction.new([], nil, 2, 2) # RETURN, RETFIE, RETLW
    when 0x2000..0x27FF then Instruction.new([[at + 1, 2]], word & 0x7FF, nil, 2) # CALL
    when 0x2800..0x2FFF then Instruction.new([[word & 0x7FF, 2]], nil, nil, 2) # GOTO
    when 0x0B00..0x0BFF, 0x0F00..0x0FFF, 0x1800..0x1FFF # DECFSZ, INCFSZ, BTFSC, BTFSS
      Instruction.new([[at + 1, 1], [at + 2, 2]], nil, nil, 2)
    else
      return opaque('a computed GOTO') if writes_pcl?(word)

      Instruction.new([[at + 1, 1]], nil, nil, 2)
    end
  end

  def writes_pcl?(word)
    writes_file?(word) && (word & 0x7F) == 2
  end

  # A byte operation with its result in the file, or one on a bit.
  def writes_file?(word)
    (word < 0x1000 && (word & 0x80).nonzero?) || (0x1000..0x17FF).cover?(word)
  end
end

# An enhanced mid-range PIC, which has more banks and more instructions.
class Pic14EnhancedCode < Pic14Code
  FLASH = 0x8000
  RAM = [0x20..0x7F, *(1..25).map { |bank| (128 * bank + 0x20)..(128 * bank + 0x6F) }].freeze
  MORE_ON_FILES = [0x35, 0x36, 0x37, 0x3B, 0x3D].freeze # LSLF, LSRF, ASRF, SUBWFB, ADDWFC

  private

  def decode(at)
    case word(at)
    when 0x000A, 0x000B then opaque('a computed CALL or GOTO') # CALLW, BRW
    when 0x3200..0x33FF then Instruction.new([[branch(at), 2]], nil, nil, 2) # BRA
    when 0x3500..0x37FF then plain(at, 1, 1)
    else super
    end
  end

  # Nine bits with a sign.
  def branch(at)
    offset = word(at) & 0x1FF
    at + 1 + (offset > 0xFF ? offset - 0x200 : offset)
  end

  def writes_file?(word)
    super || (MORE_ON_FILES.include?(word >> 8) && (word & 0x80).nonzero?)
  end
end

# A PIC18.
class Pic18Code < PicCode
  FLASH = 65_536
  RAM = [0x000..0xF37].freeze # as far as any has it
  SKIPS = [0x2C..0x2F, 0x3C..0x3F, 0x48..0x4B, 0x4C..0x4F, 0x60..0x67, 0xA0..0xBF].freeze
  DECF = [0x06, 0x07].freeze
  DECFSZ = [0x2E, 0x2F].freeze
  MOVWF = [0x6E, 0x6F].freeze
  MOVLW = 0x0E
  ON_ZERO = [0xE0, 0xE1].freeze # BZ, BNZ

  def decremented(at)
    word_at_byte(at) & 0xFF if (DECF + DECFSZ).include?(word_at_byte(at) >> 8)
  end

  def writes?(at, counter)
    word = word_at_byte(at)
    return (word_at_byte(at + 2) & 0xFF) == counter if (word >> 12) == 0xC # MOVFF

    writes_file?(word >> 8) && (word & 0xFF) == counter
  end

  # MOVLW and MOVWF.
  def loaded(at, counter)
    word = word_at_byte(at)
    return unless MOVWF.include?(word >> 8) && (word & 0xFF) == counter

    before = word_at_byte(at - 2)
    before & 0xFF if (before >> 8) == MOVLW
  end

  def counts_to_zero?(at)
    DECFSZ.include?(word_at_byte(at) >> 8) || ON_ZERO.include?(word_at_byte(at + 2) >> 8)
  end

  private

  def units(section)
    section.bytes
  end

  def decode(at)
    word = word_at_byte(at)
    high = word >> 8
    return plain(at, 2, 2) if (0x0008..0x000F).cover?(word) # TBLRD, TBLWT
    return Instruction.new([], nil, 2, 2) if (0x0010..0x0013).cover?(word) || high == 0x0C
    return Instruction.new([], nil, nil, 2) if word == 0x00FF # RESET
    return skip(at) if SKIPS.any? { |range| range.cover?(high) }
    return opaque('a computed GOTO') if (word & 0x1FF) == 0xF9 && writes_file?(high)

    flow(at, word, high) || plain(at, 2, 1)
  end

  def flow(at, word, high)
    case high
    when 0xC0..0xCF, 0xEE then plain(at, 4, 2) # MOVFF, LFSR
    when 0xD0..0xD7 then Instruction.new([[relative(at, word, 11), 2]], nil, nil, 2)
    when 0xD8..0xDF then Instruction.new([[at + 2, 2]], relative(at, word, 11), nil, 2)
    when 0xE0..0xE7 then Instruction.new([[at + 2, 1], [relative(at, word, 8), 2]], nil, nil, 2)
    when 0xEC, 0xED then Instruction.new([[at + 4, 2]], target(at, word), nil, 4)
    when 0xEF then Instruction.new([[target(at, word), 2]], nil, nil, 4)
    end
  end

  def skip(at)
    following = word_at_byte(at + 2) >> 8
    two_words = (0xC0..0xCF).cover?(following) || (0xEC..0xEF).cover?(following)
    to = two_words ? [at + 6, 3] : [at + 4, 2]
    Instruction.new([[at + 2, 1], to], nil, nil, 2)
  end

  def relative(at, word, bits)
    offset = word & ((1 << bits) - 1)
    offset -= 1 << bits if offset >= 1 << (bits - 1)
    at + 2 + 2 * offset
  end

  def target(at, word)
    2 * ((word & 0xFF) | ((word_at_byte(at + 2) & 0xFFF) << 8))
  end

  # Byte operations with their result in the file, MOVWF and its like, and
  # operations on a bit.
  def writes_file?(high)
    return (high & 2).nonzero? if (0x04..0x07).cover?(high) || (0x10..0x5F).cover?(high)

    (0x68..0x9F).cover?(high)
  end
end

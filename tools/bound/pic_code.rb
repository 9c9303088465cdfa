# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'code'

# A PIC's firmware, from Intel hex and the linker's map.
class PicCode < Code
  SECTION = /^\s*(\S+)\s+(?:code|idata|romdata|udata)\s+0x(\h+)\s+(program|data)\s+0x(\h+)\s*$/.freeze
  # Not SDCC's labels, and not the marks of tools/lib/build/one_bank.
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

  # A vector with a handler has a section of its own, or is reached by no path.
  def interrupts
    paths = LongestPath.reached(self, [reset])
    self.class::VECTORS.select do |vector|
      own = program.any? { |one| one.address == vector }
      found = own || (@bytes.key?(vector * self.class::UNIT) && !paths.include?(vector))
      paths |= LongestPath.reached(self, [vector]) if found
      found
    end.map { |vector| [vector] }
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
  VECTORS = [4].freeze
  UNIT = 2 # bytes of an address
  LEVELS = 8
  RAM = [0x20..0x7F, 0xA0..0xEF, 0x110..0x16F, 0x190..0x1EF].freeze # of four banks
  DECF = 0x0380
  DECFSZ = 0x0B80
  MOVWF = 0x0080
  CLRF = 0x0180
  CLRW = 0x0100
  MOVF = 0x0800
  MOVLW = 0x3000
  BTFSC_Z = 0x1903
  BTFSS_Z = 0x1D03
  INDF = 0
  STATUS = 3
  INTCON = 0x0B
  BSF_GIE = 0x178B
  BANK_BITS = [5, 6].freeze

  def shown(depth)
    "#{depth.levels} levels"
  end

  def several_pages?
    pages.to_i > 1
  end

  # Of 2048 words, configuration words left out.
  def pages
    @pages ||= program.select { |one| one.address < 0x2000 }.map { |one| (one.address + units(one) - 1) / 2048 + 1 }.max
  end

  # Below 0x20 are the chip's registers. A name is a number within a bank: it
  # stands for the same register as long as no bank is selected.
  def decremented(at)
    word(at) & 0x7F if [DECF, DECFSZ].include?(word(at) & 0x3F80) && (word(at) & 0x7F) >= 0x20
  end

  def writes?(at, register)
    word = word(at)
    return writes_w?(word) if register == :w

    writes_through_pointer?(word) || selects_bank?(word) || (writes_file?(word) && (word & 0x7F) == register)
  end

  def loaded(at, register)
    word = word(at)
    if register == :w
      { MOVLW => word & 0xFF }[word & 0x3F00] || { CLRW => 0 }[word & 0x3F80]
    else
      { MOVWF | register => :w, CLRF | register => 0 }[word]
    end
  end

  # Behind DECF, and SDCC's MOVF of the same register, Z is of the counter.
  def at_zero(at, decrement, register)
    skips = (word(decrement) & 0x3F80) == DECFSZ
    return (at(at).edges.last.first if skips) if at == decrement

    test = decrement + 1
    test += 1 if (word(test) & 0x3F7F) == (MOVF | register)
    return if skips || at != test

    { BTFSC_Z => at(at).edges.first, BTFSS_Z => at(at).edges.last }[word(at)]&.first
  end

  # A computed GOTO of a switch enters the GOTOs behind it, one of assembly reads
  # flash: it enters a RETLW. SDCC names the sections of C S_.
  def leads(at)
    table = (at + 1..).take_while { |one| word?(one) && (0x2800..0x2FFF).cover?(word(one)) }
    table if table.any? || program.none? { |one| one.name.start_with?('S_') && range(one).cover?(at) }
  end

  # By its bit, or with a whole INTCON.
  def enables_interrupts?(at)
    word = word(at)
    word == BSF_GIE || (word < 0x1000 && writes_file?(word) && (word & 0x7F) == INTCON)
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
    when 0x0063 then Instruction.new([[at + 1, 1]], nil, nil, 2, nil, 'SLEEP')
    when 0x2000..0x2FFF then paged(at, word)
    when 0x0B00..0x0BFF, 0x0F00..0x0FFF, 0x1800..0x1FFF # DECFSZ, INCFSZ, BTFSC, BTFSS
      Instruction.new([[at + 1, 1], [at + 2, 2]], nil, nil, 2)
    else
      return opaque('a computed GOTO') if writes_pcl?(word)

      Instruction.new([[at + 1, 1]], nil, nil, 2)
    end
  end

  # CALL or GOTO, within the page.
  def paged(at, word)
    missing(at, 'code of several pages') if several_pages?
    to = word & 0x7FF
    word < 0x2800 ? Instruction.new([[at + 1, 2]], to, nil, 2) : Instruction.new([[to, 2]], nil, nil, 2)
  end

  def writes_pcl?(word)
    writes_file?(word) && (word & 0x7F) == 2
  end

  def writes_w?(word)
    word >= 0x3000 || ((0x0100..0x0FFF).cover?(word) && (word & 0x80).zero?)
  end

  def selects_bank?(word)
    writes_file?(word) && (word & 0x7F) == STATUS && (word < 0x1000 || BANK_BITS.include?((word >> 7) & 7))
  end

  def writes_through_pointer?(word)
    writes_file?(word) && (word & 0x7F) == INDF
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
  LEVELS = 16
  INDFS = [0, 1].freeze
  BSR = 8
  WREG = 9
  MOVIW = (0x0010..0x0017).freeze
  MOVLB = (0x0020..0x003F).freeze
  MOVWI = [0x0018..0x001F, 0x3F80..0x3FFF].freeze
  COMPUTED = [0x000A, 0x000B].freeze # CALLW, BRW
  MORE_ON_FILES = [0x35, 0x36, 0x37, 0x3B, 0x3D].freeze # LSLF, LSRF, ASRF, SUBWFB, ADDWFC

  def leads(at)
    super unless COMPUTED.include?(word(at))
  end

  private

  def decode(at)
    case word(at)
    when *COMPUTED then opaque('a computed CALL or GOTO')
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

  def writes_w?(word)
    super || MOVIW.cover?(word) || (writes_file?(word) && [WREG, *INDFS].include?(word & 0x7F))
  end

  def selects_bank?(word)
    MOVLB.cover?(word) || (writes_file?(word) && (word & 0x7F) == BSR)
  end

  def writes_through_pointer?(word)
    MOVWI.any? { |range| range.cover?(word) } || (writes_file?(word) && INDFS.include?(word & 0x7F))
  end

  def writes_file?(word)
    super || (MORE_ON_FILES.include?(word >> 8) && (word & 0x80).nonzero?)
  end
end

# A PIC18.
class Pic18Code < PicCode
  FLASH = 65_536
  VECTORS = [0x08, 0x18].freeze
  UNIT = 1
  LEVELS = 31
  RAM = [0x000..0xF37].freeze # as far as any has it
  SKIPS = [0x2C..0x2F, 0x3C..0x3F, 0x48..0x4B, 0x4C..0x4F, 0x60..0x67, 0xA0..0xBF].freeze
  DECF = [0x06, 0x07].freeze
  DECFSZ = [0x2E, 0x2F].freeze
  MOVWF = 0x6E
  CLRF = 0x6A
  MOVF = 0x50
  MOVLW = 0x0E
  MOVLB = 0x01
  BZ = 0xE0
  BNZ = 0xE1
  WREG = 0xE8
  BSR = 0xE0
  # INDF, POSTINC, POSTDEC, PREINC and PLUSW of the three pointers.
  INDIRECT = [0xEB..0xEF, 0xE3..0xE7, 0xDB..0xDF].flat_map(&:to_a).freeze
  PCL = 0xFF9
  INTCON = 0xFF2
  BSF_GIE = [0x8EF2, 0x8CF2].freeze # GIEH and GIEL
  RETURN_STACK = (0xFFC..0xFFF).freeze # STKPTR and the top of the stack
  UNSEEN = { 0x0005 => 'PUSH', 0x0006 => 'POP', 0x0014 => 'CALLW' }.freeze
  EXTENDED = (0xE8..0xEB).freeze
  FAST_RETURNS = [0x0011, 0x0013].freeze # they restore WREG, STATUS and BSR

  def shown(depth)
    "#{depth.levels} levels, #{depth.bytes} bytes"
  end

  # A name is a number within a bank and the access bit: with that bit set it
  # stands for the same register as long as no bank is selected. From 0x60 it may be
  # one of the chip's.
  def decremented(at)
    word = word_at_byte(at)
    [word & 0xFF, (word >> 8) & 1] if (DECF + DECFSZ).include?(word >> 8) && (word & 0xFF) < 0x60
  end

  # One of the same number in another bank may be the same.
  def writes?(at, register)
    word = word_at_byte(at)
    return writes_w?(at, word) if register == :w

    number, banked = register
    changed = [number, *INDIRECT, *(BSR if banked == 1)]
    changed.include?(file_written(at)) || (banked == 1 && (word >> 8 == MOVLB || FAST_RETURNS.include?(word)))
  end

  def loaded(at, register)
    word = word_at_byte(at)
    return (word & 0xFF if word >> 8 == MOVLW) if register == :w

    number, banked = register
    { (MOVWF | banked) << 8 | number => :w, (CLRF | banked) << 8 | number => 0 }[word]
  end

  # As on a PIC16.
  def at_zero(at, decrement, register)
    skips = DECFSZ.include?(word_at_byte(decrement) >> 8)
    return (at(at).edges.last.first if skips) if at == decrement

    number, banked = register
    test = decrement + 2
    test += 2 if (word_at_byte(test) & 0xFDFF) == ((MOVF | banked) << 8 | number)
    return if skips || at != test

    { BNZ => at(at).edges.first, BZ => at(at).edges.last }[word_at_byte(at) >> 8]&.first
  end

  # By FSR1, the pointer of SDCC: POSTDEC1 pushes, PREINC1 and POSTINC1 pop, and
  # ADDWF to FSR1L pops as many as WREG says.
  PUSHED = { 0xFE5 => 1, 0xFE4 => -1, 0xFE6 => -1 }.freeze
  POINTER = [0xFE1, 0xFE2].freeze
  GOTO = 0xEF
  ADDWF_FSR1L = 0x26E1
  LFSR_1 = 0xEE1

  def pushed(at)
    word = word_at_byte(at)
    return :w if word == ADDWF_FSR1L

    read, written = accessed(at, word)
    PUSHED.fetch(read, 0) + ((word >> 12) == 0xC ? PUSHED.fetch(written, 0) : 0) # MOVFF
  end

  # SDCC's writing through a pointer takes an argument from the stack, but not if the
  # pointer leads to flash, where nothing can be written.
  def left
    (1..4).to_h { |bytes| ["_gptrput#{bytes}", -1] }
  end

  def sets_stack(at)
    word = word_at_byte(at)
    return [] if word >> 4 == LFSR_1

    missing(at, 'the stack pointer is set') if word != ADDWF_FSR1L && POINTER.include?(accessed(at, word)[1])
  end

  # Of a switch.
  def leads(at)
    Enumerator.produce(at + 2) { |one| one + 4 }.take_while { |one| @bytes.key?(one) && word_at_byte(one) >> 8 == GOTO }
              .then { |all| all unless all.empty? }
  end

  # As on a PIC16; RETFIE does it where it ends.
  def enables_interrupts?(at)
    word = word_at_byte(at)
    return false unless accessed(at, word)[1] == INTCON

    !(0x80..0x9F).cover?(word >> 8) || BSF_GIE.include?(word)
  end

  private

  # Of the chip's own registers, the address that is read and the one that is
  # written.
  def accessed(at, word)
    return [word & 0xFFF, word_at_byte(at + 2) & 0xFFF] if (word >> 12) == 0xC
    return [] unless file_operation?(word >> 8) && (word & 0x100).zero? && (word & 0xFF) >= 0x80

    address = 0xF00 | (word & 0xFF)
    [address, (address if writes_file?(word >> 8))]
  end

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
    written = accessed(at, word)[1]
    return opaque('a computed GOTO') if written == PCL
    return opaque('a changed return address') if RETURN_STACK.cover?(written)
    return waits(at, 2, 'SLEEP') if word == 0x0003
    return opaque(UNSEEN[word]) if UNSEEN.key?(word)
    return opaque('an extended instruction') if EXTENDED.cover?(high)

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

  def writes_w?(at, word)
    high = word >> 8
    return true if (0x08..0x0F).cover?(high) || word == 0x0007 || FAST_RETURNS.include?(word) # DAW

    byte_operation?(high) && (high & 2).zero? || [WREG, *INDIRECT].include?(file_written(at))
  end

  # The number within its bank of the register that it writes, of MOVFF too.
  def file_written(at)
    word = word_at_byte(at)
    return word_at_byte(at + 2) & 0xFF if (word >> 12) == 0xC

    word & 0xFF if writes_file?(word >> 8)
  end

  def file_operation?(high)
    (0x02..0x07).cover?(high) || (0x10..0xBF).cover?(high)
  end

  def byte_operation?(high)
    (0x04..0x07).cover?(high) || (0x10..0x5F).cover?(high)
  end

  # Byte operations with their result in the file, MOVWF and its like, and
  # operations on a bit.
  def writes_file?(high)
    return (high & 2).nonzero? if byte_operation?(high)

    (0x68..0x9F).cover?(high)
  end
end

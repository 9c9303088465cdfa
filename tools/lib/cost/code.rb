# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# An instruction as the longest path needs it: where it may go next and what
# that costs, the function that it calls before, and the cost if it returns.
Instruction = Struct.new(:edges, :call, :return_cost, :bytes)

# Linked code: instructions by address and functions by name.
class Code
  class Failure < StandardError; end

  attr_reader :functions

  def initialize(functions)
    @functions = functions
    @decoded = {}
  end

  def at(address)
    @decoded[address] ||= decode(address)
  end

  def entry(function)
    @functions[function] or raise Failure, "no function #{function}"
  end

  # The function that an address belongs to.
  def name(address)
    found = @functions.select { |_, start| start <= address }.max_by { |_, start| start }
    found ? found[0] : format('%05x', address)
  end

  # For loops that count down: what an instruction decrements, whether it
  # writes that, the constant that it loads into it (of two instructions, for a
  # PIC), and whether the loop goes on while the counter is not 0 after the
  # decrement at this address.
  def decremented(_address)
    nil
  end

  private

  def plain(at, bytes, cost)
    Instruction.new([[at + bytes, cost]], nil, nil, bytes)
  end

  def unknown(address, what)
    raise Failure, format('%<name>s: no path through %<what>s at %<address>05x',
                          name: name(address), what: what, address: address)
  end
end

# A PIC's firmware, from Intel hex and the linker's map.
class PicCode < Code
  SECTION = /^\s*(\S+)\s+(?:code|idata|romdata|udata)\s+0x(\h+)\s+(program|data)\s+0x(\h+)\s*$/.freeze
  SYMBOL = /^\s*(?!_?\d+_DS_)_?(\w+)\s+0x(\h+)\s+program\s+\S+\s/.freeze

  # In `place`, program or data; sizes are in bytes.
  Section = Struct.new(:name, :address, :place, :bytes)

  attr_reader :sections

  def initialize(path)
    @path = path
    map = File.read("#{path}.map")
    @sections = map.scan(SECTION).map { |name, at, place, bytes| Section.new(name, at.hex, place, bytes.hex) }
    super(map.scan(SYMBOL).to_h { |name, address| [name, address.hex] }.merge(static_functions))
    @bytes = read_hex("#{path}.hex")
  end

  # Of the functions that these addresses belong to, in the chip's units.
  def size_of(addresses)
    found = program.select { |one| addresses.any? { |at| range(one).cover?(at) } }
    found.sum { |one| units(one) }
  end

  # What this firmware has more than another one, without the application's own
  # functions.
  def flash_beyond(other, application)
    library_flash(application) - other.library_flash('bare_nothing')
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

  protected

  def library_flash(application)
    program.reject { |one| one.name.start_with?("S_#{application}__") || one.address >= self.class::FLASH }
           .sum { |one| units(one) }
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
    low = @bytes[address] or unknown(address, 'erased flash')
    low | (@bytes.fetch(address + 1) << 8)
  end
end

# A mid-range PIC with at most 2048 words: addresses are words.
class Pic14Code < PicCode
  FLASH = 2048
  RAM = [0x20..0x7F, 0xA0..0xBF].freeze

  private

  def units(section)
    section.bytes
  end

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
      unknown(at, 'a computed GOTO') if writes_pcl?(word)
      Instruction.new([[at + 1, 1]], nil, nil, 2)
    end
  end

  def word(at)
    word_at_byte(2 * at) & 0x3FFF
  end

  def writes_pcl?(word)
    writes_file?(word) && (word & 0x7F) == 2
  end

  # A byte operation with its result in the file, or one on a bit.
  def writes_file?(word)
    (word < 0x1000 && (word & 0x80).nonzero?) || (0x1000..0x17FF).cover?(word)
  end

  public

  DECF = 0x0380
  DECFSZ = 0x0B80
  MOVWF = 0x0080
  TESTS_ZERO = [0x1903, 0x1D03].freeze # BTFSC or BTFSS STATUS,Z

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
    before & 0xFF if (before & 0x3C00) == 0x3000
  end

  def counts_to_zero?(at)
    (word(at) & 0x3F80) == DECFSZ || (1..2).any? { |after| TESTS_ZERO.include?(word(at + after)) }
  end
end

# A PIC18.
class Pic18Code < PicCode
  FLASH = 32_768
  RAM = [0x000..0x5FF].freeze
  SKIPS = [0x2C..0x2F, 0x3C..0x3F, 0x48..0x4B, 0x4C..0x4F, 0x60..0x67, 0xA0..0xBF].freeze

  private

  def units(section)
    section.bytes
  end

  def decode(at)
    word = word_at_byte(at)
    high = word >> 8
    return plain(at, 2, 2) if (0x0008..0x000F).cover?(word) # TBLRD, TBLWT
    return Instruction.new([], nil, 2, 2) if (0x0010..0x0013).cover?(word) || high == 0x0C
    return skip(at) if SKIPS.any? { |range| range.cover?(high) }

    unknown(at, 'a computed GOTO') if (word & 0x1FF) == 0xF9 && writes_file?(high)
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
    two_words = [0xC, 0xF].include?(word_at_byte(at + 2) >> 12) || [0xEC, 0xED, 0xEE, 0xEF].include?(word_at_byte(at + 2) >> 8)
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

  # MOVWF, and byte and bit operations whose result goes to the file.
  def writes_file?(high)
    [0x6A, 0x6C, 0x6E].include?(high) || ((0x10..0x5F).cover?(high) && (high & 2).nonzero?) || (0x70..0x9F).cover?(high)
  end
end

# What objdump and nm say of an ELF file.
class ElfCode < Code
  LINE = /^\s*(\h+):\t([\h ]+?)\s*\t(\S+)(?:\t([^;@<\n]*))?/.freeze

  def initialize(path, tools)
    @tools = tools
    @symbols = `#{tools}-nm -S #{path}`.scan(/^(\h+) (?:(\h+) )?\w (\S+)$/)
                                       .to_h { |address, bytes, name| [name, [address.hex, bytes.to_s.hex]] }
    super(@symbols.select { |_, (_, bytes)| bytes.positive? }.transform_values { |address, _| address & mask })
    @lines = {}
    `#{tools}-objdump -d -w #{path}`.scan(LINE) do |address, raw, mnemonic, operands|
      @lines[address.hex] = [raw.delete(' ').size / 2, mnemonic, operands.to_s.strip]
    end
  end

  def symbol(name)
    @symbols.fetch(name) { raise Failure, "no symbol #{name}" }.first
  end

  def object_size(name)
    @symbols.fetch(name) { raise Failure, "no object #{name}" }.last
  end

  # Of the functions that these addresses belong to, with their constants.
  def size_of(addresses)
    addresses.map { |at| name(at) }.uniq.sum { |name| @symbols.fetch(name).last }
  end

  # Of all that these functions reach: what a linker keeps of it.
  def linked(longest, names)
    size_of(names.flat_map { |name| longest.function(entry(name)).addresses }.uniq)
  end

  # RAM of object files that is nobody's object.
  def static_bytes(objects)
    `#{@tools}-size #{objects.join(' ')}`.lines.drop(1).sum { |line| line.split[1, 2].sum(&:to_i) }
  end

  private

  def line(at)
    @lines[at] or unknown(at, 'what is no instruction')
  end

  def mask
    -1
  end
end

# An ATmega: cycles as in its data sheet, with a program counter of two bytes.
class AvrCode < ElfCode
  TWO = %w[lds sts ld ldd st std push pop mul muls mulsu fmul fmuls fmulsu adiw sbiw sbi cbi].freeze
  SKIPS = %w[cpse sbrc sbrs sbic sbis].freeze

  NO_TARGET = /\A(st|std|sts|push|out|cp|cpc|cpi|cpse|tst|sbr[cs]|sbi[cs]|br..|rjmp|jmp|rcall|call|ret|nop)\z/.freeze

  def initialize(path)
    super(path, 'avr')
  end

  def decremented(at)
    _, mnemonic, operands = line(at)
    operands[/\Ar\d+/] if mnemonic == 'dec'
  end

  def writes?(at, counter)
    _, mnemonic, operands = line(at)
    return false if mnemonic.match?(NO_TARGET)
    return %w[r0 r1].include?(counter) if mnemonic.match?(/mul/)

    target = operands[/\Ar(\d+)/, 1].to_i
    wide = mnemonic.match?(/\A(movw|adiw|sbiw)\z/) ? 1 : 0
    (target..target + wide).cover?(counter[1..-1].to_i)
  end

  def loaded(at, counter)
    _, mnemonic, operands = line(at)
    operands[/0x\h+/].hex if mnemonic == 'ldi' && operands.start_with?("#{counter},")
  end

  def counts_to_zero?(at)
    line(at + line(at)[0])[1] == 'brne'
  end

  private

  def decode(at)
    bytes, mnemonic, operands = line(at)
    case mnemonic
    when 'ret', 'reti' then Instruction.new([], nil, 4, bytes)
    when 'call', 'rcall' then Instruction.new([[at + bytes, mnemonic == 'call' ? 4 : 3]], target(at, operands), nil, bytes)
    when 'jmp', 'rjmp' then Instruction.new([[target(at, operands), mnemonic == 'jmp' ? 3 : 2]], nil, nil, bytes)
    when /\Abr/ then Instruction.new([[at + bytes, 1], [target(at, operands), 2]], nil, nil, bytes)
    when *SKIPS then skip(at, bytes)
    when /call|jmp|spm|sleep/ then unknown(at, mnemonic)
    else plain(at, bytes, cycles(mnemonic))
    end
  end

  def cycles(mnemonic)
    return 3 if mnemonic.end_with?('lpm')

    TWO.include?(mnemonic) ? 2 : 1
  end

  def skip(at, bytes)
    words = line(at + bytes)[0] / 2
    Instruction.new([[at + bytes, 1], [at + bytes + 2 * words, 1 + words]], nil, nil, bytes)
  end

  def target(at, operands)
    return operands.hex if operands.start_with?('0x')

    at + 2 + Integer(operands[/\A\.([-+]\d+)/, 1], 10)
  end
end

# A Cortex-M: each instruction costs one.
class ArmCode < ElfCode
  def initialize(path)
    super(path, 'arm-none-eabi')
  end

  # Bytes that a function and its callees push at most.
  def stack(entry, path)
    pushed = path.function(entry).addresses.group_by { |at| name(at) }
    pushed.transform_values! { |addresses| addresses.sum { |at| pushed_by(*line(at)) } }
    deepest(entry, pushed, path)
  end

  private

  def mask
    ~1
  end

  def decode(at)
    bytes, mnemonic, operands = line(at)
    mnemonic = mnemonic.sub(/\.[nw]\z/, '')
    case mnemonic
    when 'bl' then Instruction.new([[at + bytes, 1]], operands.hex, nil, bytes)
    when 'b' then Instruction.new([[operands.hex, 1]], nil, nil, bytes)
    when /\Acbn?z\z/ then Instruction.new([[at + bytes, 1], [operands[/\h+\z/].hex, 1]], nil, nil, bytes)
    when /\Ab(?:eq|ne|cs|cc|mi|pl|vs|vc|hi|ls|ge|lt|gt|le)\z/
      Instruction.new([[at + bytes, 1], [operands.hex, 1]], nil, nil, bytes)
    else
      returning(at, bytes, mnemonic, operands)
    end
  end

  # A return may be conditional in an IT block.
  def returning(at, bytes, mnemonic, operands)
    return plain(at, bytes, 1) unless operands.match?(/\bpc\b/) || mnemonic.match?(/\Ab(l?x|tb|th)/) || operands == 'lr'

    leaves = mnemonic.match?(/\A(bx|pop|ldmia|ldr)(..)?\z/) && (operands == 'lr' || operands.match?(/pc\}|\Apc, \[sp\]/))
    return plain(at, bytes, 1) if mnemonic.match?(/\A(add|adr|ldr|mov|push)/) && !operands.match?(/\Apc|\{.*pc/)

    unknown(at, "#{mnemonic} #{operands}") unless leaves
    on = mnemonic.match?(/\A(bx|pop|ldmia|ldr)..\z/) && mnemonic != 'ldmia' ? [[at + bytes, 1]] : []
    Instruction.new(on, nil, 1, bytes)
  end

  def pushed_by(_bytes, mnemonic, operands)
    case mnemonic
    when /\Apush|\Astmdb/ then 4 * registers(operands)
    when /\Asub/ then operands.match?(/\Asp, (?:sp, )?#/) ? operands[/#(\d+)/, 1].to_i : 0
    when /\Astr/ then operands[/\[sp, #-(\d+)\]!/, 1].to_i
    else 0
    end
  end

  def registers(operands)
    operands[/\{(.*)\}/, 1].split(', ').sum do |item|
      first, last = item.split('-').map { |register| register.delete('r').to_i }
      last ? last - first + 1 : 1
    end
  end

  def deepest(entry, pushed, path)
    own = name(entry)
    callees = path.function(entry).addresses.select { |at| name(at) == own }.map { |at| at(at).call }.compact.uniq
    pushed.fetch(own, 0) + (callees.map { |callee| deepest(callee, pushed, path) }.max || 0)
  end
end

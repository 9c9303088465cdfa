# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'code'
require_relative 'timing'

# What objdump says of an ELF file.
class ElfCode < Code
  # Of what a table has, its own and files' names are marked by a d.
  SYMBOL = /^(\h+) .{5}[^d]. (?!\*UND\*)\S+\t(\h+) (?:\.hidden )?(?!\$)(\S+)$/.freeze
  LINE = /^\s*(\h+):\t([\h ]+?)\s*\t(\S+)(?:\t([^;@<\n]*))?/.freeze

  def initialize(path, tools)
    @tools = tools
    said = `#{tools}-objdump -t -d -z -w #{path}`
    @symbols = named_apart(said.scan(SYMBOL))
    super(@symbols.select { |_, (_, bytes)| bytes.positive? }.transform_values { |address, _| address & mask })
    @lines = {}
    said.scan(LINE) do |address, raw, mnemonic, operands|
      @lines[address.hex] = [raw.delete(' ').size / 2, mnemonic, operands.to_s.strip]
    end
  end

  # The same instructions, which cost what another timing says.
  def timed(timing)
    dup.tap { |other| other.timing = timing }
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

  # RAM of object files that is nobody's object.
  def static_bytes(objects)
    `#{@tools}-size #{objects.join(' ')}`.lines.drop(1).sum { |line| line.split[1, 2].sum(&:to_i) }
  end

  protected

  attr_writer :timing

  private

  def initialize_copy(other)
    super
    @decoded = {}
  end

  # Each source may have a static function of one name: all but the first get a number.
  def named_apart(lines)
    lines.group_by(&:last).flat_map do |name, like|
      like.each_with_index.map do |(address, bytes, _), i|
        [i.zero? ? name : "#{name}~#{i + 1}", [address.hex, bytes.hex]]
      end
    end.to_h
  end

  def line(at)
    @lines[at] or missing(at, 'no instruction')
  end

  def mask
    -1
  end
end

# An ATmega: cycles as in its data sheet, with a program counter of two bytes.
class AvrCode < ElfCode
  TWO = %w[lds sts ld ldd st std push pop mul muls mulsu fmul fmuls fmulsu adiw sbiw sbi cbi].freeze
  SKIPS = %w[cpse sbrc sbrs sbic sbis].freeze

  NO_TARGET = /\A(st|std|sts|push|out|cp|cpc|cpi|cpse|tst|sbr[cs]|sb[ic][cs]?|cbi|br..|rjmp|jmp|rcall|call|ret|nop)\z/.freeze
  # The registers are in data memory, too: a pointer may lead there.
  STORES = /\A(st|std|xch|la[cst])\z/.freeze
  POINTER = /\A0x(?:3[de]|005[de]),/i.freeze
  MOVED = /-([XYZ])|([XYZ])\+(?!\d)/.freeze
  POINTERS = { 'X' => [26, 27], 'Y' => [28, 29], 'Z' => [30, 31] }.freeze

  def initialize(path)
    super(path, 'avr')
  end

  def decremented(at)
    _, mnemonic, operands = line(at)
    operands[/\Ar\d+/] if mnemonic == 'dec'
  end

  # The stack is taken to be elsewhere.
  def writes?(at, register)
    _, mnemonic, operands = line(at)
    return true if mnemonic.match?(STORES)

    targets(mnemonic, operands).include?(register[1..-1].to_i)
  end

  def loaded(at, register)
    _, mnemonic, operands = line(at)
    operands[/0x\h+/].hex if mnemonic == 'ldi' && operands.start_with?("#{register},")
  end

  def at_zero(at, decrement, _register)
    return unless at == decrement + line(decrement)[0]

    { 'brne' => at(at).edges.first, 'breq' => at(at).edges.last }[line(at)[1]]&.first
  end

  # RCALL to the next instruction makes room.
  def pushed(at)
    bytes, mnemonic, operands = line(at)
    case mnemonic
    when 'push' then 1
    when 'pop' then -1
    when 'rcall' then target(at, operands) == at + bytes ? 2 : 0
    else 0
    end
  end

  def sets_stack(at)
    _, mnemonic, operands = line(at)
    [operands[/r\d+/]] if %w[out sts].include?(mnemonic) && operands.match?(POINTER)
  end

  def frame?(registers)
    registers.all? { |register| %w[r28 r29].include?(register) }
  end

  # Y, which a function finds again behind each call.
  def frame(at, height, frame)
    bytes, mnemonic, operands = line(at)
    case "#{mnemonic} #{operands}"
    when /\Ain r28, 0x3d/ then height
    when /\Ain r29, 0x3e/, /\Asbci r29,/ then frame
    when /\A(adiw|sbiw|subi) r28, (0x\h+)/ then frame && frame + room(at + bytes, $1, $2.hex)
    else frame unless targets(mnemonic, operands).any? { |register| POINTERS['Y'].include?(register) }
    end
  end

  def enables_interrupts?(at)
    line(at)[1] == 'sei'
  end

  # avr-libc's names of handlers.
  def interrupts
    handlers = @functions.select { |name, _| name.match?(/\A__vector_\d+\z/) }.values
    handlers.empty? ? [] : [handlers]
  end

  def return_bytes
    2
  end

  private

  def decode(at)
    bytes, mnemonic, operands = line(at)
    return plain(at, bytes, 3) if mnemonic == 'rcall' && target(at, operands) == at + bytes

    case mnemonic
    when 'ret', 'reti' then Instruction.new([], nil, 4, bytes)
    when 'call', 'rcall' then Instruction.new([[at + bytes, mnemonic == 'call' ? 4 : 3]], target(at, operands), nil, bytes)
    when 'jmp', 'rjmp' then Instruction.new([[target(at, operands), mnemonic == 'jmp' ? 3 : 2]], nil, nil, bytes)
    when /\Abr/ then Instruction.new([[at + bytes, 1], [target(at, operands), 2]], nil, nil, bytes)
    when *SKIPS then skip(at, bytes)
    when 'sleep' then waits(at, bytes, mnemonic)
    when /call|jmp|spm/ then opaque(mnemonic)
    else plain(at, bytes, cycles(mnemonic))
    end
  end

  # The numbers of the registers that it writes.
  # What Y is moved by, downwards; `subi` and `sbci` do it together.
  def room(following, mnemonic, low)
    return { 'adiw' => -low, 'sbiw' => low }.fetch(mnemonic) unless mnemonic == 'subi'

    _, second, operands = line(following)
    raise Code::Failure, format('half of a frame at %05x', following) unless second == 'sbci' && operands.start_with?('r29,')

    high = operands[/0x\h+/].hex
    ((high << 8 | low) ^ 0x8000) - 0x8000
  end

  def targets(mnemonic, operands)
    moved = POINTERS.fetch(operands[MOVED].to_s[/[XYZ]/], [])
    return moved + [0, 1] if mnemonic.include?('mul')
    return [operands.hex] if mnemonic == 'sts'
    return moved if mnemonic.match?(NO_TARGET)

    target = operands[/\Ar(\d+)/, 1].to_i
    moved + (mnemonic.match?(/\A(movw|adiw|sbiw)\z/) ? [target, target + 1] : [target])
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

# A Cortex-M: each instruction costs one, or what a core's timing says.
class ArmCode < ElfCode
  POINTER_CHANGES = /\A(?:sp\b|\{.*\bsp\b)|\bsp!|\[sp\], |\[sp, [^\]]*\]!/.freeze

  def initialize(path, timing = Timing::INSTRUCTIONS)
    super(path, 'arm-none-eabi')
    @timing = timing
  end

  # The return address is in a register, until it is pushed.
  def pushed(at)
    _, mnemonic, operands = read(at)
    return 0 unless mnemonic.match?(/\A(?:push|pop)/) || (operands.match?(POINTER_CHANGES) && !mnemonic.match?(/\Acm[pn]/))

    moved(mnemonic, operands) or missing(at, "the stack pointer changes by what is not known (#{mnemonic} #{operands})")
  end

  private

  def mask
    ~1
  end

  def read(at)
    bytes, mnemonic, operands = line(at)
    [bytes, mnemonic.sub(/\.[nw]\z/, ''), operands]
  end

  def decode(at)
    bytes, mnemonic, operands = read(at)
    case mnemonic
    when 'bl' then Instruction.new([[at + bytes, leaving(at)]], operands.hex, nil, bytes)
    when 'b' then Instruction.new([[operands.hex, leaving(at)]], nil, nil, bytes)
    when /\Acbn?z\z/, /\Ab(?:eq|ne|cs|cc|mi|pl|vs|vc|hi|ls|ge|lt|gt|le)\z/
      Instruction.new([[at + bytes, staying(at)], [operands[/\h+\z/].hex, leaving(at)]], nil, nil, bytes)
    else
      returning(at, bytes, mnemonic, operands)
    end
  end

  # A return may be conditional in an IT block.
  def returning(at, bytes, mnemonic, operands)
    return plain(at, bytes, staying(at)) unless operands.match?(/\bpc\b/) || mnemonic.match?(/\Ab(l?x|tb|th)/) || operands == 'lr'

    leaves = mnemonic.match?(/\A(bx|pop|ldmia|ldr)(..)?\z/) && (operands == 'lr' || operands.match?(/pc\}|\Apc, \[sp\]/))
    return plain(at, bytes, staying(at)) if mnemonic.match?(/\A(add|adr|ldr|mov|push)/) && !operands.match?(/\Apc|\{.*pc/)

    return opaque("#{mnemonic} #{operands}") unless leaves

    on = mnemonic.match?(/\A(bx|pop|ldmia|ldr)..\z/) && mnemonic != 'ldmia' ? [[at + bytes, 1]] : []
    Instruction.new(on, nil, leaving(at), bytes)
  end

  def staying(at)
    _, mnemonic, operands = read(at)
    @timing.staying(mnemonic, operands) or missing(at, "no timing of #{mnemonic} #{operands}")
  end

  def leaving(at)
    _, mnemonic, operands = read(at)
    @timing.leaving(mnemonic, operands) or missing(at, "no timing of #{mnemonic} #{operands}")
  end

  # A condition may stand behind a pop that returns, and behind nothing else.
  def moved(mnemonic, operands)
    case "#{mnemonic} #{operands}"
    when /\Apush |\Astmdb sp!/ then 4 * Timing::CortexM.listed(operands)
    when /\Apop |\Aldmia sp!|\A(?:pop|ldmia)..(?: sp!,)? \{.*pc\}/ then -4 * Timing::CortexM.listed(operands)
    when /\Astrd? [^\[]+\[sp, #-(\d+)\]!/ then $1.to_i
    when /\Aldrd? [^\[]+\[sp\], #(\d+)/, /\Aldr.. pc, \[sp\], #(\d+)/ then -$1.to_i
    when /\Asubw? sp, (?:sp, )?#(\d+)/ then $1.to_i
    when /\Aaddw? sp, (?:sp, )?#(\d+)/ then -$1.to_i
    end
  end
end

# A RISC-V: each instruction costs one, or what a core's timing says.
class RiscvCode < ElfCode
  WRAP = 2**32

  def initialize(path, timing = Timing::INSTRUCTIONS)
    super(path, 'riscv64-unknown-elf')
    @timing = timing
  end

  # A product by shift and add: a turn for each bit of a factor.
  def turns
    { '__mulsi3' => 32 }
  end

  def decremented(at)
    _, mnemonic, operands = line(at)
    operands[/\A(\w+),\1,-1\b/, 1] if mnemonic == 'add'
  end

  def writes?(at, register)
    _, mnemonic, operands = line(at)
    !mnemonic.match?(STORE_OR_JUMP) && operands.start_with?("#{register},")
  end

  def loaded(at, register)
    _, mnemonic, operands = line(at)
    operands[/\A#{register},(-?\d+)/, 1].to_i % WRAP if mnemonic == 'li'
  end

  # Nothing else writes it, so the test may stand behind the turn's others.
  def at_zero(at, _decrement, register)
    _, mnemonic, operands = line(at)
    return unless operands.start_with?("#{register},")

    { 'bnez' => at(at).edges.first, 'beqz' => at(at).edges.last }[mnemonic]&.first
  end

  # The return address is in a register, until it is stored.
  def pushed(at)
    _, mnemonic, operands = line(at)
    return 0 unless writes?(at, 'sp')

    bytes = operands[/\Asp,sp,(-?\d+)\z/, 1] if mnemonic == 'add'
    bytes ? -bytes.to_i : missing(at, "the stack pointer changes by what is not known (#{mnemonic} #{operands})")
  end

  STORE_OR_JUMP = /\A(?:s[bhw]|b\w+|j|ret)\z/.freeze

  private

  def decode(at)
    bytes, mnemonic, operands = line(at)
    case mnemonic
    when 'ret' then Instruction.new([], nil, leaving(at), bytes)
    when 'jal' then Instruction.new([jump(at, at + bytes)], target(operands), nil, bytes)
    when 'j' then Instruction.new([jump(at, target(operands))], nil, nil, bytes)
    when /\Ab/ then Instruction.new([[at + bytes, staying(at)], jump(at, target(operands))], nil, nil, bytes)
    when /\Aj|\Ae(?:break|call)\z/ then opaque("#{mnemonic} #{operands}")
    else plain(at, bytes, staying(at))
    end
  end

  def jump(at, to)
    [to, leaving(at) + (line(to)[0] == 4 && (to % 4) != 0 ? @timing.unaligned : 0)]
  end

  def staying(at)
    _, mnemonic, operands = line(at)
    @timing.staying(mnemonic, operands) or missing(at, "no timing of #{mnemonic} #{operands}")
  end

  def leaving(at)
    _, mnemonic, operands = line(at)
    @timing.leaving(mnemonic, operands) or missing(at, "no timing of #{mnemonic} #{operands}")
  end

  # Without a register before it, that is not the return address's.
  def target(operands)
    operands[/(?:\A|,)(\h{8})\z/, 1].hex
  end
end

# With 16 registers, which QEMU does not refuse to exceed.
class Rv32eCode < RiscvCode
  BEYOND = /\b(?:a[67]|s[2-9]|s1[01]|t[3-6])\b/.freeze

  private

  def decode(at)
    missing(at, 'a register that RV32E has not') if line(at).last.match?(BEYOND)
    super
  end
end

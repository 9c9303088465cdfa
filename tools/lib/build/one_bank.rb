# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# one_bank.rb FIRMWARE: whether files that know one bank (see tools/lib/build/one_bank)
# are right in FIRMWARE.map and FIRMWARE.hex: all that they use lies in bank 0 or
# in what all banks share, and on every path bank 0 is selected where they use it.
# Exit status: 0 they are, 1 they are not.
require_relative '../../bound/bound'

# A line of the linker's table of symbols.
LinkedSymbol = Struct.new(:name, :address, :location, :storage, :file)

# The linker's map.
class LinkedMap
  # The name of a file may have spaces.
  LINE = /^\s*(\S+)\s+0x(\h+)\s+(program|data)\s+(extern|static)\s+(\S.*?)\s*$/.freeze
  MARK = 'one_bank_file'
  USES = 'one_bank_uses'

  attr_reader :symbols

  def initialize(path)
    @symbols = File.read(path).scan(LINE).map { |name, at, *rest| LinkedSymbol.new(name, at.hex, *rest) }.uniq
  end

  # Those that know one bank.
  def files
    @files ||= @symbols.select { |one| one.name == MARK }.map(&:file).uniq
  end

  # What these files define or use in data memory: [symbol, user].
  def used
    data = @symbols.select { |one| one.location == 'data' }
    own = data.select { |one| files.include?(one.file) }.map { |one| [one, one.file] }
    uses = @symbols.select { |one| one.name.start_with?(USES) && files.include?(one.file) }
    own + uses.flat_map do |use|
      data.select { |one| one.storage == 'extern' && one.name == use.name.delete_prefix(USES) }.map { |one| [one, use.file] }
    end
  end

  def functions
    @symbols.select { |one| one.location == 'program' && !one.name.start_with?(MARK, USES) && !one.name.match?(/\A_?\d+_DS_\z/) }
  end
end

# All paths through the firmware, each instruction with each bank in which it may
# be reached. A reset selects bank 0; an interrupt and a call from elsewhere come
# in any.
class Banks
  BANKS = [0, 1].freeze
  RESET = 0
  INTERRUPT = 4
  STATUS = 3
  SHARED = [0x00, 0x02, 0x03, 0x04, 0x0A, 0x0B, *0x70..0x7F].freeze
  CLRF_STATUS = 0x0183
  BCF_RP0 = 0x1283
  BSF_RP0 = 0x1683

  # In a file with one bank: where bank 1 may be selected, and since when.
  attr_reader :wrong

  def initialize(code, map)
    @code = code
    @map = map
    @ours = ranges
    @exits = {}
    @reached = {}
    @wrong = {}
    follow
  end

  private

  # The code of the files with one bank.
  def ranges
    starts = @map.functions.select { |one| @map.files.include?(one.file) }.map(&:address)
    @code.sections.select { |one| one.place == 'program' && starts.include?(one.address) }
         .map { |one| one.address...(one.address + one.bytes / 2) }
  end

  def follow
    exits(RESET, 0, 'a reset')
    entries = @map.functions.select { |one| @map.files.include?(one.file) }
    start = entries.select { |one| one.storage == 'extern' }.map(&:address)
    start << INTERRUPT if @code.sections.any? { |one| one.place == 'program' && one.address == INTERRUPT }
    start.product(BANKS).each { |at, bank| exits(at, bank, 'a call from elsewhere') }
    # What only a pointer reaches.
    rest = @ours.map(&:begin).reject { |at| @reached.key?(at) }
    rest.product(BANKS).each { |at, bank| exits(at, bank, 'a call through a pointer') }
  end

  # The banks in which a function returns, which is entered in this one.
  def exits(entry, bank, cause)
    found = @exits[[entry, bank]]
    raise Bound::Failure, "#{@code.name(entry)} calls itself" if found == :open
    return found if found

    @exits[[entry, bank]] = :open
    @exits[[entry, bank]] = explore(entry, bank, cause)
  end

  def explore(entry, bank, cause)
    outs = []
    seen = {}
    todo = [[entry, bank, cause]]
    while (at, now, since = todo.pop)
      next if seen.key?([at, now])

      seen[[at, now]] = @reached[at] = true
      judge(at, now, since)
      after(at, now, since).each do |bank_after, cause_after|
        outs << bank_after if returns?(at)
        following(at).each { |to| todo << [to, bank_after, cause_after] }
      end
    end
    outs.uniq
  end

  def judge(at, bank, since)
    return if bank.zero? || !ours?(at)

    file = file_register(@code.word(at))
    @wrong[at] ||= since if file && !SHARED.include?(file)
  end

  def ours?(at)
    @ours.any? { |range| range.cover?(at) }
  end

  # Byte operations on a file register, and operations on a bit.
  def file_register(word)
    word & 0x7F if (0x0080..0x00FF).cover?(word) || (0x0180..0x1FFF).cover?(word)
  end

  def returns?(at)
    instruction = @code.at(at)
    !instruction.return_cost.nil? || !instruction.opaque.nil?
  end

  # A computed GOTO leaves the function, or enters a table of GOTOs behind it.
  def following(at)
    return @code.at(at).edges.map(&:first) unless @code.at(at).opaque

    (at + 1..).take_while { |one| @code.word?(one) && (0x2800..0x2FFF).cover?(@code.word(one)) }
  end

  # Each bank that may be selected after an instruction, and since when.
  def after(at, bank, since)
    instruction = @code.at(at)
    if instruction.call
      name = @code.name(instruction.call)
      return exits(instruction.call, bank, "a call by #{@code.name(at)}").map { |one| [one, "the return of #{name}"] }
    end
    selected(at, bank).map { |one| [one, one == bank ? since : "an instruction of #{@code.name(at)}"] }
  end

  def selected(at, bank)
    case word = @code.word(at)
    when CLRF_STATUS, BCF_RP0 then [0]
    when BSF_RP0 then [1]
    else
      whole_status = word < 0x1000 && (word & 0xFF) == (0x80 | STATUS)
      return BANKS if whole_status || (@code.at(at).opaque && c?(at))

      [bank]
    end
  end

  # A computed GOTO of C may call a function through a pointer, one of assembly
  # reads flash. SDCC names the sections of C so.
  def c?(at)
    @code.sections.any? { |one| one.name.start_with?('S_') && (one.address...(one.address + one.bytes / 2)).cover?(at) }
  end
end

path = ARGV.fetch(0)
map = LinkedMap.new("#{path}.map")
abort "one_bank: no file of #{path} knows one bank" if map.files.empty?

outside = map.used.reject { |symbol, _| symbol.address < 0x80 || (symbol.address & 0x7F) >= 0x70 }
outside.each do |symbol, file|
  warn format('one_bank: %<file>s knows bank 0, and %<name>s is at 0x%<at>02X',
              file: file.sub(/\.asm\z/, ''), name: symbol.name.sub(/\A_/, ''), at: symbol.address)
end
begin
  code = Bound.code('pic16f684', path)
  wrong = Banks.new(code, map).wrong
rescue Bound::Failure => e
  abort "one_bank: #{e.message}"
end
wrong.group_by { |at, since| [code.name(at), since] }.each do |(name, since), places|
  warn format('one_bank: %<name>s uses bank 0 at 0x%<at>03X, where bank 1 may be selected since %<since>s',
              name: name, at: places.first.first, since: since)
end
exit(outside.empty? && wrong.empty?)

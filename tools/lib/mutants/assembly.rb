# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Breaks the assembly of src/ instruction by instruction: each one left out, taken
# for its twin, with the other destination, with a number one off. The chips'
# simulators must answer otherwise than the host to the rows of test/target/arith.c,
# or a break must stand in test/mutants/assembly.txt with the reason why it changes
# nothing. build/test/assembly.txt says of each break who noticed it, as it goes.
# Called by tools/test assembly, after test/target/run arith, with SDCC in the
# environment; with names of files only those are broken.
require 'fileutils'
require 'open3'
require_relative 'breaks'
require_relative 'excuses'

module Instructions
  TWINS = [%w[addwf subwf], %w[addwfc addwf], %w[subwfb subwf], %w[btfsc btfss], %w[bcf bsf], %w[rrf rlf], %w[rrcf rlcf],
           %w[rrncf rlncf], %w[incf decf], %w[incfsz decfsz], %w[infsnz incfsz], %w[andwf iorwf], %w[xorwf iorwf],
           %w[andlw iorlw], %w[xorlw andlw], %w[addlw sublw], %w[comf movf], %w[negf comf], %w[clrf setf], %w[swapf movf],
           %w[bz bnz], %w[bc bnc], %w[bn bnn], %w[cpfslt cpfsgt],
           %w[add sub], %w[adc add], %w[sbc sub], %w[sbci subi], %w[brvc brvs], %w[brcc brcs], %w[breq brne], %w[brpl brmi],
           %w[sbrc sbrs], %w[lsl lsr], %w[rol lsl], %w[ror lsr], %w[asr lsr], %w[mulsu mul], %w[muls mul], %w[fmul mul], %w[and or],
           %w[andi ori], %w[eor or], %w[com neg], %w[inc dec], %w[bst bld], %w[swap com]].freeze
  OTHERS = %w[tstfsz movwf movf movff movlw movlb mulwf mullw lfsr call rcall goto bra return retlw retfie nop pagesel banksel clrw
              sublw addlw mov movw clr ldi mul tst cp cpc cpi rjmp ret push pop ld st ldd std lds sts in out].freeze
  MNEMONICS = (TWINS.flatten + OTHERS).uniq.freeze
  # Of a word in a string or of a line between __asm and __endasm.
  WORD = /(?<name>#{MNEMONICS.join('|')})\b(?<operands>(?:[ \t]+[^;\n"\\]*)?)/.freeze
  NUMBER = /(?<![\w.%$#])(?:0x\h+|\d+)(?![\w.])/.freeze

  class << self
    def breaks(file, text = File.read(file))
      places(text).flat_map do |place, name, operands|
        changes(name, operands).map do |name_now, operands_now|
          from = (name + operands).rstrip
          to = (name_now + operands_now).rstrip
          broken = text[0...place] + to + text[(place + from.size)..]
          Mutant.new(file, text[0...place].count("\n") + 1, place, from.squeeze(' '), to.squeeze(' '), broken)
        end
      end
    end

    # [where, mnemonic, operands] of each instruction.
    def places(text)
      inside = false
      position = 0
      text.lines.flat_map do |line|
        starts = position
        position += line.size
        inside = line.match?(/__asm\s*$/) || (inside && !line.include?('__endasm'))
        parts = inside ? [[0, line[/\A[^;\n]*/]]] : strings(line)
        unknown = inside && line[/\A\s+([a-z]\w*)/, 1]
        unknown && !MNEMONICS.include?(unknown) and abort "FAILED what does #{unknown} do?"
        parts.flat_map { |offset, part| words(part).map { |at, name, operands| [starts + offset + at, name, operands] } }
      end
    end

    private

    def strings(line)
      return [] if line.match?(%r{\A\s*(?://|#include)}) || !line.include?('"')

      line.to_enum(:scan, /"((?:[^"\\]|\\.)*)"/).map { [Regexp.last_match.begin(1), Regexp.last_match[1]] }
          .select { |_, part| part.match?(/\A(?:[\w]+:)?(?:\\[nt]|\s)*(?:#{MNEMONICS.join('|')})\b|\\n/) }
    end

    # An instruction begins a line, or follows a label or a \n or \t.
    def words(part)
      part.to_enum(:scan, WORD).map do
        match = Regexp.last_match
        before = part[0...match.begin(0)]
        [match.begin(0), match[:name], match[:operands]] if before.match?(/(?:\A|\\n|\\t|\n|:)\s*\z/)
      end.compact
    end

    def changes(name, operands)
      left_out = name == 'nop' ? [] : [['nop', '']]
      left_out + twins(name).map { |twin| [twin, operands] } + destinations(operands).map { |other| [name, other] } +
        numbers(operands).map { |other| [name, other] }
    end

    def twins(name)
      TWINS.select { |pair| pair.include?(name) }.map { |pair| (pair - [name]).first }.first(2)
    end

    # Into W or into the file.
    def destinations(operands)
      return [] unless operands.match?(/,\s*[wf]\b/)

      [operands.sub(/,(\s*)([wf])\b/) { ",#{$1}#{$2 == 'w' ? 'f' : 'w'}" }]
    end

    # A bit or a constant; the place of a byte is not one.
    def numbers(operands)
      found = operands.to_enum(:scan, NUMBER).map { Regexp.last_match }.reject { |match| operands[0...match.begin(0)].match?(/\+\s*\z/) }
      found.flat_map do |match|
        value = Integer(match[0])
        [value + 1, value - 1].reject(&:negative?).map { |other| operands[0...match.begin(0)] + other.to_s + match.post_match }
      end
    end
  end
end

# A chip's program with a broken source, and what it answers: in a folder of its
# own, for two may be asked at a time.
class Board
  EVERY_BIT = %w[-DFIXPID_AN964_TERM_LIMIT=255 -DFIXPID_AN964_8BIT_TERM_LIMIT=127].freeze

  def self.of(file, folder)
    file.start_with?('src/avr/') ? Avr.new(file, folder) : Pic.new(file, folder)
  end

  def initialize(file, folder)
    @file = file
    @folder = folder
    @source = "#{folder}/src"
    FileUtils.rm_rf(folder)
    FileUtils.mkdir_p(folder)
    FileUtils.cp_r('src', @source)
  end

  # In the first way that does: :refused, :endless, :different; or nil if every
  # answer is right.
  def notice(text)
    File.write("#{@source}/#{@file.delete_prefix('src/')}", text)
    ways.each do |way|
      return :refused unless build(way)
      # Of what is the same instruction for instruction there is nothing to ask.
      next if File.binread(code) == @whole[way]

      found = answers
      return found if found
    end
    nil
  end

  # The file as it is, first; and what it answers, if that is to be asked.
  def learn(asked)
    @whole = ways.to_h do |way|
      build_whole(way) or abort "FAILED #{@file} cannot be built"
      asked && answers and abort "FAILED #{@file}: the unbroken one is noticed"
      [way, File.binread(code)]
    end
  end

  private

  def build_whole(way)
    build(way)
  end

  def built?(*command)
    _, status = Open3.capture2e(*command)
    status.success?
  end
end

class Pic < Board
  TRAPS = { 'pic14' => [], 'pic18' => ['test/target/traps.asm'] }.freeze # SDCC ends a function of a PIC16 itself
  SECONDS_MOST = 60 # of a processor's time; the longest whole run takes 10
  # What an object at a fixed address in access RAM has of its own.
  PLACED = %w[-DFIXPID_AN937_PLACE=__at(0x20) -DFIXPID_AN937_SIGNALS_PLACE=__at(0x38)].freeze

  def initialize(file, folder)
    super
    @controller, family = file.match(%r{fixpid_(\w+)_(pic1[48])\.c\z}).captures
    @traps = TRAPS.fetch(family)
    @chip = { 'pic14' => 'pic16f684', 'pic18' => 'pic18f4520' }.fetch(family)
    @image = "#{folder}/#{@controller}"
    @own = file.delete_prefix('src/')
  end

  private

  # AN937 has other instructions for an object in access RAM, and for one that is
  # pointed at.
  def ways
    object = ["-DFIXPID_#{@controller.upcase}_OBJECT=#{@controller}_controller"]
    @controller == 'an937' ? [object, object + PLACED, []] : [object]
  end

  def build(way)
    board = "port/pic/#{@chip}"
    built?('tools/lib/build_pic', @chip, @image, '-Iinclude', '-Itest/target', '-Iport', '-Iport/pic', "-I#{board}",
           "-DREPLY=#{@controller}_arith", *way, *EVERY_BIT, "-I#{@source}", *others(way), "#{@source}/#{@own}", *@traps)
  end

  # What asks stays as it is. (A PIC16's is compiled with the bank of all.)
  def build_whole(way)
    build(way) or return false
    return true if @chip == 'pic16f684'

    kept = "#{@folder}/others#{ways.index(way)}"
    FileUtils.mkdir_p(kept)
    objects = others(way).map { |file| "#{@image}.d/#{File.basename(file, '.*')}.o" }
    FileUtils.cp(objects, kept)
    @others[way] = objects.map { |object| "#{kept}/#{File.basename(object)}" }
    true
  end

  def others(way)
    @others ||= {}
    @others[way] || ['test/target/driver_main.c', 'test/target/arith.c', "test/target/arith_#{@controller}.c"]
  end

  def code
    "#{@image}.hex"
  end

  # Some rows first: they notice nearly all.
  def answers
    rows(5) || rows(1)
  end

  def rows(apart)
    output, status = Open3.capture2e('build/target/digests', "#{@image}.cod", @controller, apart.to_s, 'short',
                                     rlimit_cpu: [SECONDS_MOST, SECONDS_MOST + 1])
    return :endless if status.termsig == Signal.list['XCPU'] || output.include?('no answer')

    output.match?(/ different 0$/) ? nil : :different
  end
end

class Avr < Board
  SECONDS_MOST = 30 # from one line to the next; the longest takes 3
  FLAGS = %w[-std=gnu99 -w -Iinclude -Itest/support -Itest/target].freeze

  def initialize(file, folder)
    super
    controller = file[/fixpid_(\w+)_avr/, 1]
    @own = "test/target/arith_#{controller}.c" # has the header
    @others = [main(controller), 'test/avr/avr_stdio.c', *Dir['test/target/arith*.c'] - ['test/target/arith_main.c', @own]]
  end

  private

  # The rows of the file's own controller.
  def main(controller)
    text = File.readlines('test/target/arith_main.c').reject do |line|
      line.match?(/^    (?:all_rows|add_row|print_digest)\("?\w/) && !line.match?(/\b#{controller}(?:_arith)?\b/)
    end
    File.write("#{@folder}/main.c", text.join)
    "#{@folder}/main.c"
  end

  # What a function leaves in its registers is another one's with each.
  def ways
    [%w[-O2], %w[-Os -flto], %w[-O0]]
  end

  def build(way)
    objects = others(way) or return false
    built?(*compiler(way), "-I#{@source}", @own, *objects, '-o', program) && built?('avr-objcopy', '-O', 'binary', program, code)
  end

  def compiler(way)
    ['avr-gcc', '-mmcu=atmega2560', *FLAGS, *way, *EVERY_BIT]
  end

  # What has no assembly of this file is compiled once.
  def others(way)
    @objects ||= {}
    @objects[way] ||= @others.map do |file|
      object = "#{@folder}/#{File.basename(file, '.c')}#{ways.index(way)}.o"
      built?(*compiler(way), '-Isrc', '-c', file, '-o', object) or return nil
      object
    end
  end

  def program
    "#{@folder}/arith.elf"
  end

  def code
    "#{@folder}/arith.bin"
  end

  def expected
    @expected ||= begin
      host = "#{@folder}/arith.host"
      built?('gcc', *FLAGS, '-O2', '-Itest/target/shim', *EVERY_BIT, '-Isrc',
             *@others - ['test/avr/avr_stdio.c'], @own, '-o', host) or
        abort 'FAILED the host has no answers'
      Open3.capture2(host).first.lines
    end
  end

  # It is stopped at the first line that is another one, or does not come.
  def answers
    found = nil
    Open3.popen2e('test/avr/run', program, 'atmega2560', pgroup: true) do |input, output, process|
      input.close
      expected.each do |line|
        found = :endless unless IO.select([output], nil, nil, SECONDS_MOST)
        found ||= :different unless output.gets == line
        break if found
      end
      Process.kill('KILL', -process.pid) if found
    end
    found
  rescue Errno::ESRCH
    found
  end
end

# All breaks of a file, by two boards.
class Broken
  ROOT = 'build/assembly'
  WORKERS = 2

  def initialize(file, excuses, report)
    @file = file
    @excuses = excuses
    @report = report
    @text = File.read(file)
    @breaks = Instructions.breaks(file, @text)
  end

  def judge
    caught = results
    survivors = @breaks.reject { |mutant| caught[mutant] }.map { |mutant| keys.fetch(mutant) }
    unexplained = survivors.reject { |key| @excuses.cover?(key) }
    stale = @excuses.stale(@file, survivors)
    held = unexplained.empty? && stale.empty?
    ends = caught.values.tally
    ends.default = 0
    puts "#{held ? 'ok' : 'FAILED'} #{@file}: #{@breaks.size} breaks of #{Instructions.places(@text).size} instructions, " \
         "#{ends[:different]} answer otherwise, #{ends[:endless]} do not end, #{ends[:refused]} are refused, " \
         "#{survivors.size} change nothing"
    puts unexplained.map { |key| "Nobody notices: #{key}" }, stale.map { |key| "No longer true: #{key}" }
    held
  end

  private

  def keys
    @keys ||= Excuses.keys(@breaks, @text)
  end

  def results
    queue = Queue.new
    @breaks.each { |mutant| queue << mutant }
    queue.close
    found = {}
    lock = Mutex.new
    workers = (0...WORKERS).map do |worker|
      Thread.new do
        board = Board.of(@file, "#{ROOT}/#{worker}")
        board.learn(worker.zero?)
        while (mutant = queue.pop)
          noticed = board.notice(mutant.source)
          lock.synchronize { found[mutant] = tell(mutant, noticed) }
        end
      end
    end
    workers.each(&:join)
    found
  end

  def tell(mutant, noticed)
    @report.puts "#{keys.fetch(mutant)}: #{noticed || 'nobody'}"
    @report.flush
    noticed
  end
end

if $PROGRAM_NAME == __FILE__
  $stdout.sync = true
  Thread.abort_on_exception = true
  excuses = Excuses.new('test/mutants/assembly.txt')
  files = Dir['src/{avr,pic14,pic18}/*.[ch]'].sort.reject { |file| Instructions.places(File.read(file)).empty? }
  files.empty? and abort 'FAILED no assembly to break'
  strangers = excuses.strangers(files)
  puts strangers.map { |key| "FAILED test/mutants/assembly.txt names what is not broken: #{key}" }
  FileUtils.mkdir_p('build/test')
  report = File.open('build/test/assembly.txt', 'w')
  good = (ARGV.empty? ? files : files & ARGV).map { |file| Broken.new(file, excuses, report).judge }
  exit(good.all? && strangers.empty? ? 0 : 1)
end

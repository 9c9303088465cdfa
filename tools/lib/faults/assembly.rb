# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Breaks the assembly of src/ in each way of instructions.rb, one at a time. The chips'
# simulators must answer otherwise than the host to the rows of test/chips/target/arith.c,
# or a break must stand in test/tools/mutants/assembly.txt with the reason why it changes
# nothing. build/test/assembly.txt says of each break who noticed it, as it goes.
# Called by tools/test assembly, after test/chips/target/run arith, with SDCC in the
# environment; with names of files only those are broken.
require 'fileutils'
require 'open3'
require_relative 'equivalents'
require_relative 'instructions'

# A chip's program with a broken source, and what it answers: in a folder of its
# own, for two may be asked at a time.
class Board
  EVERY_BIT = %w[-DFIXPID_AN964_TERM_LIMIT=255 -DFIXPID_AN964_8BIT_TERM_LIMIT=127].freeze

  def self.of(file, folder)
    { /_avr\.h\z/ => Avr, /_arm\.h\z/ => Arm, // => Pic }.find { |name, _| name.match?(file) }.last.new(file, folder)
  end

  def initialize(file, folder)
    @file = file
    @folder = folder
    @source = "#{folder}/src"
    FileUtils.rm_rf(folder)
    FileUtils.mkdir_p(folder)
    FileUtils.cp_r(%w[include src], folder)
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
  TRAPS = { 'pic14' => [], 'pic18' => ['test/chips/target/traps.asm'] }.freeze # SDCC ends a function of a PIC16 itself
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
  # pointed at, wherever it is.
  def ways
    object = ["-DFIXPID_#{@controller.upcase}_OBJECT=#{@controller}_controller"]
    @controller == 'an937' ? [object, object + PLACED, %w[-DFIXPID_AN937_PLACE=__at(0x200)]] : [object]
  end

  def build(way)
    board = "port/pic/#{@chip}"
    built?('tools/lib/build/build_pic', @chip, @image, '-Iinclude', '-Itest/chips/target', '-Iport', '-Iport/pic', "-I#{board}",
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
    @others[way] || ['test/chips/target/driver_main.c', 'test/chips/target/arith.c', "test/chips/target/arith_#{@controller}.c"]
  end

  def code
    "#{@image}.hex"
  end

  # Some rows first: they notice nearly all.
  def answers
    rows(5) || rows(1)
  end

  def rows(apart)
    output, status = Open3.capture2e('build/target/digests.gpsim', "#{@image}.cod", @controller, apart.to_s, 'short',
                                     rlimit_cpu: [SECONDS_MOST, SECONDS_MOST + 1])
    return :endless if status.termsig == Signal.list['XCPU'] || output.include?('no answer')

    output.match?(/ different 0$/) ? nil : :different
  end
end

# A chip whose program can print: its compiler and what it takes last, its harness, and its
# simulator.
class Printing < Board
  SECONDS_MOST = 30 # from one line to the next; the longest takes 3
  FLAGS = %w[-std=gnu99 -w -Iinclude -Itest/support -Itest/chips/target].freeze
  MAIN = 'test/chips/target/arith_main.c'

  def initialize(file, folder)
    super
    controller = file[/fixpid_(\w+)_(?:arm|avr)/, 1].sub('signed', 'pid') # who has its sums and products
    @own = "test/chips/target/arith_#{controller}.c" # has the header
    @asked = [main(controller), *Dir['test/chips/target/arith*.c'] - [MAIN, @own]]
  end

  private

  # The rows of the file's own controller.
  def main(controller)
    text = File.readlines(MAIN).reject do |line|
      line.match?(/^    (?:all_rows|add_row|print_digest)\("?\w/) && !line.match?(/\b#{controller}(?:_arith)?\b/)
    end
    File.write("#{@folder}/main.c", text.join)
    "#{@folder}/main.c"
  end

  def build(way)
    objects = others(way) or return false
    built?(*compiler(way), "-I#{@source}", @own, *objects, *self.class::LAST, '-o', program) &&
      built?(self.class::COMPILER.first.sub(/gcc\z/, 'objcopy'), '-O', 'binary', program, code)
  end

  def compiler(way)
    [*self.class::COMPILER, *FLAGS, *way, *EVERY_BIT]
  end

  # What has no assembly of this file is compiled once.
  def others(way)
    @objects ||= {}
    @objects[way] ||= [*@asked, *self.class::HARNESS].map do |file|
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
      built?('gcc', *FLAGS, '-O2', '-Itest/chips/target/shim', *EVERY_BIT, '-Isrc', *@asked, @own, '-o', host) or
        abort 'FAILED the host has no answers'
      Open3.capture2(host).first.lines
    end
  end

  # It is stopped at the first line that is another one, or does not come.
  def answers
    found = nil
    Open3.popen2e(*simulator, pgroup: true) do |input, output, process|
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

class Avr < Printing
  COMPILER = %w[avr-gcc -mmcu=atmega2560].freeze
  HARNESS = %w[test/chips/avr/avr_stdio.c].freeze
  LAST = [].freeze

  private

  # What a function leaves in its registers is another one's with each.
  def ways
    [%w[-O2], %w[-Os -flto], %w[-O0]]
  end

  def simulator
    ['test/chips/avr/run', program, 'atmega2560']
  end
end

# Thumb of the first generation: the other functions are instructions that the compiler knows.
class Arm < Printing
  COMPILER = %w[arm-none-eabi-gcc -mcpu=cortex-m0 -mthumb -ffreestanding -Itest/chips/target/qemu -Itest/chips/target/shim].freeze
  HARNESS = %w[test/chips/target/arm/start.c test/chips/target/qemu/runtime.c].freeze
  LAST = %w[-nostdlib -T test/chips/target/arm/flash.ld -lgcc].freeze

  private

  def ways
    [%w[-O2], %w[-Os], %w[-O0]]
  end

  def simulator
    ['qemu-system-arm', '-M', 'microbit', '-nographic', '-semihosting', '-kernel', program]
  end
end

# All breaks of a file, by two boards.
class Broken
  ROOT = 'build/assembly'
  WORKERS = 2

  def initialize(file, equivalents, report)
    @file = file
    @equivalents = equivalents
    @report = report
    @text = File.read(file)
    @breaks = Instructions.breaks(file, @text)
  end

  def judge
    caught = results
    survivors = @breaks.reject { |mutant| caught[mutant] }.map { |mutant| keys.fetch(mutant) }
    unexplained = survivors.reject { |key| @equivalents.cover?(key) }
    stale = @equivalents.stale(@file, survivors)
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
    @keys ||= EquivalentMutants.keys(@breaks, @text)
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
  equivalents = EquivalentMutants.new('test/tools/mutants/assembly.txt')
  files = Instructions.files
  files.empty? and abort 'FAILED no assembly to break'
  strangers = equivalents.strangers(files)
  puts strangers.map { |key| "FAILED test/tools/mutants/assembly.txt names what is not broken: #{key}" }
  FileUtils.mkdir_p('build/test')
  report = File.open('build/test/assembly.txt', 'w')
  good = (ARGV.empty? ? files : files & ARGV).map { |file| Broken.new(file, equivalents, report).judge }
  exit(good.all? && strangers.empty? ? 0 : 1)
end

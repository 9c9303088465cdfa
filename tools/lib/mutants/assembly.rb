# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Breaks the assembly of src/ instruction by instruction: each one left out, taken
# for its twin, with the other destination, with a number one off. The chips'
# simulators must answer otherwise than the host to the rows of test/target/arith.c,
# or a break must stand in test/mutants/assembly.txt with the reason why it changes
# nothing. Called by tools/test assembly, after test/target/run arith, with SDCC in
# the environment; with names of files only those are broken. It takes hours.
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

# A chip's program with a broken source, and what it answers.
class Board
  ROOT = 'build/assembly'
  SECONDS_MOST = 60 # of a processor's time; the longest whole run takes 10
  EVERY_BIT = %w[-DFIXPID_AN964_TERM_LIMIT=255 -DFIXPID_AN964_8BIT_TERM_LIMIT=127].freeze

  def self.of(file)
    file.start_with?('src/avr/') ? Avr.new(file) : Pic.new(file)
  end

  def initialize(file)
    @file = file
    @source = "#{ROOT}/src"
    FileUtils.mkdir_p(ROOT)
    @whole = File.read(file)
  end

  # :refused, :endless, :different, or nil if every answer is right.
  def notice(text)
    FileUtils.rm_rf(@source)
    FileUtils.cp_r(%w[include src], ROOT)
    File.write("#{@source}/#{@file.delete_prefix('src/')}", text)
    ways.each do |way|
      return :refused unless build(way)

      found = answers
      return found if found
    end
    nil
  end

  private

  def built?(*command)
    _, status = Open3.capture2e(*command)
    status.success?
  end
end

class Pic < Board
  def initialize(file)
    super
    @controller, family = file.match(%r{fixpid_(\w+)_(pic1[48])\.c\z}).captures
    @chip = { 'pic14' => 'pic16f684', 'pic18' => 'pic18f4520' }.fetch(family)
    @image = "#{ROOT}/#{@controller}-#{@chip}"
    @own = file.delete_prefix('src/')
  end

  private

  def ways
    [nil]
  end

  def build(_way)
    board = "port/pic/#{@chip}"
    built?('tools/lib/build_pic', @chip, @image, '-Iinclude', '-Itest/target', '-Iport', '-Iport/pic', "-I#{board}",
            "-DREPLY=#{@controller}_arith", "-DFIXPID_#{@controller.upcase}_OBJECT=#{@controller}_controller", *EVERY_BIT,
            "-I#{@source}", 'test/target/driver_main.c', 'test/target/arith.c', "test/target/arith_#{@controller}.c",
            "#{@source}/#{@own}")
  end

  # Some rows first: they notice nearly all.
  def answers
    rows(61) || rows(1)
  end

  def rows(apart)
    output, status = Open3.capture2e('build/target/digests', "#{@image}.cod", @controller, apart.to_s,
                                     rlimit_cpu: [SECONDS_MOST, SECONDS_MOST + 1])
    return :endless if status.termsig == Signal.list['XCPU']

    output.match?(/ different 0$/) ? nil : :different
  end
end

class Avr < Board
  PROGRAM = "#{ROOT}/arith.elf"
  FLAGS = %w[-std=gnu99 -w -Iinclude -Itest/support -Itest/target].freeze

  def initialize(file)
    super
    @sources = [main(file[/fixpid_(\w+)_avr/, 1]), *Dir['test/target/arith*.c'] - ['test/target/arith_main.c']]
  end

  private

  # The rows of the file's own controller.
  def main(controller)
    text = File.readlines('test/target/arith_main.c').reject do |line|
      line.match?(/^    (?:all_rows|add_row|print_digest)\("?\w/) && !line.match?(/\b#{controller}(?:_arith)?\b/)
    end
    File.write("#{ROOT}/main.c", text.join)
    "#{ROOT}/main.c"
  end

  # What a function leaves in its registers is another one's with each.
  def ways
    [%w[-O2], %w[-Os -flto], %w[-O0]]
  end

  def build(way)
    built?('avr-gcc', '-mmcu=atmega2560', *FLAGS, *way, *EVERY_BIT, "-I#{@source}", *@sources, 'test/avr/avr_stdio.c', '-o', PROGRAM)
  end

  def expected
    @expected ||= begin
      host = "#{ROOT}/arith.host"
      built?('gcc', *FLAGS, '-O2', '-Itest/target/shim', *EVERY_BIT, '-Isrc', *@sources, '-o', host) or
        abort 'FAILED the host has no answers'
      Open3.capture2(host).first.lines
    end
  end

  # It is stopped at the first line that is another one.
  def answers
    lines = 0
    Open3.popen2e('test/avr/run', PROGRAM, 'atmega2560', pgroup: true) do |input, output, process|
      input.close
      good = expected.all? { |line| IO.select([output], nil, nil, SECONDS_MOST) && output.gets == line && lines += 1 }
      Process.kill('KILL', -process.pid) unless good
    end
    lines == expected.size ? nil : :different
  rescue Errno::ESRCH
    :different
  end
end

if $PROGRAM_NAME == __FILE__
  $stdout.sync = true
  excuses = Excuses.new('test/mutants/assembly.txt')
  files = Dir['src/{avr,pic14,pic18}/*.[ch]'].sort.reject { |file| Instructions.places(File.read(file)).empty? }
  files.empty? and abort 'FAILED no assembly to break'
  chosen = ARGV.empty? ? files : files & ARGV
  FileUtils.mkdir_p('build/test')
  report = File.open('build/test/assembly.txt', 'w')
  good = chosen.map do |file|
    board = Board.of(file)
    board.notice(File.read(file)).nil? or abort "FAILED #{file}: the unbroken one is noticed"
    breaks = Instructions.breaks(file)
    keys = Excuses.keys(breaks, File.read(file))
    caught = breaks.to_h do |mutant|
      found = board.notice(mutant.source)
      report.puts "#{mutant}: #{found || 'nobody'}"
      report.flush
      [mutant, found]
    end
    survivors = breaks.reject { |mutant| caught[mutant] }.map { |mutant| keys.fetch(mutant) }
    unexplained = survivors.reject { |key| excuses.cover?(key) }
    stale = excuses.stale(file, survivors)
    ends = caught.values.tally
    held = unexplained.empty? && stale.empty?
    puts "#{held ? 'ok' : 'FAILED'} #{file}: #{breaks.size} breaks of #{Instructions.places(File.read(file)).size} instructions, " \
         "#{ends[:different].to_i} answer otherwise, #{ends[:endless].to_i} do not end, #{ends[:refused].to_i} are refused, " \
         "#{survivors.size} change nothing"
    puts unexplained.map { |key| "Nobody notices: #{key}" }, stale.map { |key| "No longer true: #{key}" }
    held
  end
  exit(good.all? ? 0 : 1)
end

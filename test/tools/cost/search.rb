# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The search for the worst step, on this machine: needles that it must find within
# the steps of a routine run, sequences that are kept, and for each controller no
# less than random corners find. Prints `ok` or `FAILED` for each:
#
#   ruby test/tools/cost/search.rb [NAME]... | --failed | --list
require_relative '../gates/gate'
%w[host subjects meters].each { |name| require "#{PROJECT}/tools/lib/measure/#{name}" }
Host.setup(PROJECT)

STEPS = SEARCH.first
SEEDS = (1..20).freeze
FOUND_LEAST = 5 # of the seeds
CHANCE_MOST = 1 # of the seeds
KNOWN = 1000 # what a step costs that is to be found: MOST of needles.c

# needles.c with a table of sequences, and the controllers in a form.
class Needles
  FORMS = { wide: [], narrow: %w[-D_PIC14 -DFIXPID_NO_ASSEMBLY] }.freeze
  INCLUDES = [*Harness::INCLUDES].freeze
  STEPS_WRAPPED = CONTROLLERS.map { |one| "-Wl,--wrap=#{one.function('step')}" }.uniq.freeze
  FOLDER = "#{PROJECT}/build/cost/needles"

  # `kept` is a folder with tables, or nil if nothing is kept.
  def initialize(name, kept, form = :wide)
    @path = "#{FOLDER}/#{name}-#{form}"
    @kept = kept
    @form = form
  end

  # The line of this name, by its words; 'different' of all lines.
  def run(controller, cost, seed, steps = STEPS)
    build
    text, = Host.run(@path, controller, cost, steps.to_s, seed.to_s)
    lines = text.scan(/^(rows|random|kept|search|corners) (.*)$/).to_h do |line, words|
      [line, words.scan(/(\w+) (\d+)/).to_h { |key, value| [key, value.to_i] }]
    end
    raise Host::Failure, text if lines.size != 5

    lines
  end

  private

  def build
    return if @built

    FileUtils.mkdir_p("#{FOLDER}/#{@form}")
    table = "#{@path}-kept.c"
    File.write(table, @kept ? Kept.table(@kept) : "#include <stddef.h>\n#include \"sequence.h\"\nconst struct kept kept_sequences[] = {{NULL, NULL, {.count = 0}}};\n")
    Host.output('gcc', '-std=c99', '-O2', *Harness::WARNINGS, *INCLUDES, 'test/tools/cost/needles.c', table,
                *Needles.harness, *Needles.controllers(@form), *STEPS_WRAPPED, '-o', @path)
    @built = true
  end

  class << self
    def harness
      @harness ||= begin
        drivers = CONTROLLERS.map { |one| "test/chips/target/driver_#{one.name}.c" }.uniq
        [*Harness::SHARED, 'test/support/vectors.c', *drivers].map { |file| compile(file, '', '-O2') }
      end
    end

    def controllers(form)
      sources = CONTROLLERS.flat_map { |one| Dir.glob("src/#{one.name}/*.c", base: PROJECT) }.uniq.sort
      (@controllers ||= {})[form] ||= sources.map { |file| compile(file, form, '-O1', '-fsanitize-coverage=trace-pc', *FORMS.fetch(form)) }
    end

    def compile(file, folder, *options)
      "#{FOLDER}/#{folder}/#{File.basename(file, '.c')}.o".tap do |object|
        Host.output('gcc', '-std=c99', *Harness::WARNINGS, *INCLUDES, *options, '-c', file, '-o', object)
      end
    end
  end
end

# ---- Needles ----

nothing = Needles.new('nothing', nil)
%w[gains corners saturations plains].each do |needle|
  runs = nil
  found = -> { runs ||= SEEDS.map { |seed| nothing.run('pid', needle, seed) } }
  Gate.expect("#{needle} are found", -> { found.call.count { |lines| lines['search']['most'] == KNOWN } }, FOUND_LEAST..SEEDS.size)
  Gate.expect("#{needle} are hardly at random corners", -> { found.call.count { |lines| lines['corners']['most'] == KNOWN } }, ..CHANCE_MOST)
end
Gate.expect('the same with each run', -> { (1..2).map { nothing.run('pid', 'gains', 7)['search'] }.uniq.size }, 1)
Gate.expect('another seed is another search', -> { (1..2).map { |seed| nothing.run('pid', 'gains', seed)['search']['total'] }.uniq.size }, 2)

# ---- What is kept ----

HEADS = %w[an937 an964 an964_8bit pid].to_h { |name| [name, File.readlines("#{PROJECT}/#{Kept::FOLDER}/#{name}.csv").first] }.freeze

# A folder with these lines of a controller's table.
def tables(lines = '', controller: 'pid', head: HEADS[controller])
  Dir.mktmpdir do |folder|
    HEADS.each { |name, usual| File.write("#{folder}/#{name}.csv", name == controller ? head + lines : usual) }
    yield folder
  end
end

def with_kept(name, lines, &block)
  -> { tables(lines) { |folder| block.call(Needles.new(name, folder)) } }
end

NEEDLE = <<~CSV
  pid-atmega328p-O2,1,init,12345,0,23456,0,-1,1,0,0,256,0,,,0,0,,,
  pid-atmega328p-O2,1,,,,,,,,,,,,,,-13579,24681,,,
CSV
Gate.expect('nothing is known', -> { nothing.run('pid', 'known', 1)['search']['most'] }, KNOWN / 2)
Gate.expect('what is kept is found', with_kept('known', NEEDLE) { |needles| needles.run('pid', 'known', 1)['kept']['most'] }, KNOWN)
Gate.expect('the search goes on from it', with_kept('known', NEEDLE) { |needles| needles.run('pid', 'known', 1)['search']['most'] }, KNOWN)

# Steps that were the dearest of an ATmega328P at -O2 and at -Os without features, and of
# an ATtiny85, before the search found them.
DEAR = <<~CSV
  pid-atmega328p-O2,1,init set_feedforward,17482,1641643673,30331,2,11051,28260,-9413,20479,176,192,25474,,-12148,66,,,
  pid-atmega328p-O2,1,,,,,,,,,,,,,,1619,-24183,,,
  pid-atmega328p-O2,1,set_gains,12096,10507293,15067,7,,,,,,,,,-28772,29342,,,
  pid_typical-atmega328p-Os,1,init,256,0,1,0,-32768,32767,-1,0,256,0,,,-257,-256,,,
  pid_typical-atmega328p-Os,1,,,,,,,,,,,,,,255,-257,,,
  pid_typical-atmega328p-Os,1,,,,,,,,,,,,,,-256,-257,,,
  pid_typical-atmega328p-Os,1,,,,,,,,,,,,,,-256,256,,,
  pid-attiny85-O2,1,init,0,0,32242,7,0,1,-1,0,255,192,,,0,32763,,,
  pid-attiny85-O2,1,,,,,,,,,,,,,,0,0,,,
  pid-attiny85-O2,1,,,,,,,,,,,,,,32766,-22442,,,
  pid-attiny85-O2,1,set_gains,32767,2147385344,24575,7,,,,,,,,,31743,31743,,,
CSV
Gate.expect('dear steps answer as the definition', with_kept('dear', DEAR) { |needles| needles.run('pid', 'blocks', 1)['kept'].values_at('steps', 'different') }, ->(found) { found == [11, 0] })
Gate.expect('a wrong answer is noticed', with_kept('dear', DEAR) { |needles| needles.run('pid', 'wrong', 1)['kept']['different'] }, 2)

# ---- What cannot be read ----

def refusal(lines, **other)
  -> { tables(lines, **other) { |folder| Kept.table(folder) && 'it was read' } }
end

def refused(what, wanted, lines, **other)
  Gate.expect("#{what} is refused", lambda do
    refusal(lines, **other).call
  rescue Host::Failure => e
    e.message
  end, wanted)
end

one, two = NEEDLE.lines
refused('a row that is not in the table', /pid\.csv:2: no row is called pid-z80-O2/, one.sub('atmega328p', 'z80'))
refused('a cell too many', /pid\.csv:3: 21 cells, not 20/, one + two.sub(',24681', ',24681,0'))
refused('a number that is none', /pid\.csv:2: kp_q8 is 12x/, one.sub('12345', '12x'))
refused('a seventh step', /pid\.csv:8: .* more steps than 6/, one + two * 6)
Gate.expect('a number that no question has is refused', lambda do
  tables(one.sub("\n", ",1\n"), head: HEADS['pid'].sub("\n", ",kp_q4\n")) { |folder| Needles.new('column', folder).run('pid', 'known', 1) }
rescue Host::Failure => e
  e.message
end, /kp_q4/)

# ---- Beside random corners ----

Needles::FORMS.each_key do |form|
  kept = Needles.new('kept', Kept::FOLDER, form)
  CONTROLLERS.map(&:name).uniq.each do |controller|
    Gate.expect("#{controller}, #{form}: random corners find no more", lambda do
      runs = (1..5).map { |seed| kept.run(controller, 'blocks', seed) }
      runs.map { |lines| lines['corners']['most'] - [lines['kept'], lines['search']].map { |line| line['most'] }.max }.max
    end, ..0)
  end
end
Gate.finish

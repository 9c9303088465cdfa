# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What tools/cost says of tables that are not what was measured, and of figures beyond
# their limits; which limits it lowers and raises. Prints `ok` or
# `FAILED` for each case:
#
#   ruby test/tools/cost/changes.rb [NAME]... | --failed | --list
require 'ostruct'
require_relative '../gates/gate'

%w[subjects documents documented daily limits since].each { |name| require "#{PROJECT}/tools/lib/measure/#{name}" }

ROWS = [['', 'chip', 'built', 'worst', 'stack'], ['AN937', 'PIC18F4520', 'object', 410, '3 levels, 12 bytes'],
        ['AN937', 'Cortex-M0', '-O2', 60, '8 bytes']].freeze

def changes(text)
  Dir.mktmpdir do |folder|
    path = "#{folder}/cost.md"
    File.write(path, "# Cost\n<!-- steps:begin -->\n#{text}<!-- steps:end -->\n")
    Document.new(path).replace('steps', ROWS)
  end
rescue Host::Failure => e
  [e.message]
end

# A pattern is of the only thing that is said.
def expect(what, text, wanted)
  found = changes(text)
  Gate.expect(what, wanted.is_a?(Regexp) && found.size == 1 ? found.first : found, wanted)
end

same = Tables.markdown(ROWS)
expect('the same table', same, [])
expect('a cycle more', same.sub('410', '409'), /object, worst: 409 is documented, 410 measured, which is worse/)
expect('a row that is gone', "#{same}#{same.lines.last.sub('M0', 'M3')}", /Cortex-M3, -O2: gone/)

# What `--since` tells of two tables.
def since(before, after)
  Since.new({ 'steps' => before }, { 'steps' => after }).to_s
end

FILE = ROWS.map(&:to_csv).join.sub('""', 'controller').freeze
Gate.expect('since: a cycle more', since(FILE.sub('410', '409'), FILE), /^\| steps: AN937, PIC18F4520, object \| worst \| 409 \| 410 \| \+1 \|$/)
Gate.expect('since: what stayed is counted', since(FILE.sub('410', '409'), FILE), /^3 figures are/)

# What --daily leaves out is as documented.
Dir.chdir(PROJECT)
Host.setup(PROJECT)
DOCUMENTED = Documented.new
STEPS = Subject.all.to_h { |one| [one, DOCUMENTED.figures(one)] }.freeze
CALLED = ModuleSubject.all.to_h { |one| [one, DOCUMENTED.called(one)] }.freeze
PLAIN_C = Subject.all.select(&:has_plain_c?).to_h { |one| [one, DOCUMENTED.plain_c(one)] }.freeze
TABLES = { 'cost_steps' => -> { Tables.steps(STEPS) }, 'cost_modules' => -> { Tables.modules(CALLED) },
           'cost_ratios' => -> { Tables.ratios(STEPS, PLAIN_C) } }.freeze
TABLES.each do |name, rows|
  Gate.expect("documented figures give the table #{name}", -> { DataTables.difference(name, rows.call) }, nil)
end

def documented(tables, &block)
  block.call(Documented.new(tables))
rescue Host::Failure => e
  e.message
end

LEFT_OUT = Subject.all.find { |one| one.key == 'pid-cortex-m0-Os' }
LOST = { 'cost_steps' => DataTables.read('cost_steps').reject { |row| row.take(3) == %w[PID Cortex-M0 -Os] } }.freeze
Gate.expect('a row that is left out, and lost', documented(LOST) { |page| page.figures(LEFT_OUT) },
            /no row of PID, Cortex-M0, -Os in cost_steps/)

DAILY = (Subject.all - Daily.left_out).freeze
%i[avr arm riscv].each do |kind|
  Gate.expect("each controller is measured daily on #{kind}", CONTROLLERS.map(&:id) - DAILY.select { |one| one.chip.kind == kind }.map { |one| one.controller.id },
              [Daily::PLAIN])
end
Gate.expect('and on each PIC those of it', DAILY.select { |one| one.chip.kind == :pic }.map { |one| [one.chip.flash, one.controller.id] },
            [%w[words an964], %w[words an964_8bit], %w[bytes an937], %w[bytes an964], %w[bytes an964_8bit], %w[bytes pid_typical], %w[bytes pid]])
Gate.expect('each module is measured daily', ModuleSubject.all.map { |one| one.called.id } - (ModuleSubject.all - Daily.modules_left_out).map { |one| one.called.id }, [])
Gate.expect('a limit exceeded', Limit.new('', 410, 411, '').kept?, false)
Gate.expect('a limit far above its figure', Limit.new('', 413, 400, 'cycles').then { |one| [one.good?, one.wrong] }.inspect, /false.*400 cycles, and 413 cycles.*--tighten/)

# Of these lines, with a bound of 300 and a flash of 500 of two rows: what the block gives,
# and the lines then.
def limits(*lines, left_out: [])
  rows = Subject.all.select { |one| one.controller.id == 'pid' && one.chip.name == 'atmega328p' }
  measured = rows.to_h { |one| [one, OpenStruct.new(bound: 300, most: 286, needed: 500)] }
  Dir.mktmpdir do |folder|
    File.write("#{folder}/limits.csv", ['row,figure,limit,reason', *lines].map { |line| "#{line}\n" }.join)
    given = yield Limits.new(measured, {}, {}, "#{folder}/limits.csv", left_out: left_out)
    [given, File.readlines("#{folder}/limits.csv", chomp: true).drop(1)]
  end
rescue Host::Failure => e
  e.message
end

FULL = ['pid-atmega328p-O2,bound,300,', 'pid-atmega328p-O2,flash with init,505,',
        'pid-atmega328p-Os,bound,303,', 'pid-atmega328p-Os,flash with init,500,'].freeze

# FULL with another limit, and a reason.
def other(at, limit, reason = '')
  FULL.dup.tap { |lines| lines[at] = lines[at].sub(/\d+,$/, "#{limit},#{reason}") }
end

def wrong(*lines)
  limits(*lines) { |all| all.all.reject(&:good?).map(&:what) }.first
end

Gate.expect('limits of all rows', wrong(*FULL), [])
Gate.expect('a row without a limit', wrong(*FULL[0, 3]), ['pid-atmega328p-Os, flash with init, of which there is no limit'])
Gate.expect('a figure beyond its limit', wrong(*other(2, 299)), ['pid-atmega328p-Os, bound'])
Gate.expect('a limit that is no promise', wrong(*other(2, 310)), ['pid-atmega328p-Os, bound'])
Gate.expect('a limit of no row', limits('pid-z80-O2,bound,1,') { nil }, /limits\.csv:2: no row is called pid-z80-O2/)
ATMEGA = Subject.all.select { |one| one.key == 'pid-atmega328p-O2' }.freeze
Gate.expect('limits of what is left out', limits(*FULL, left_out: ATMEGA) { |all| all.all.map(&:what).grep(/\Apid.*O2/) }.first, [])
Gate.expect('the largest bound among what is left out', limits(*FULL, left_out: Subject.all) { |all| all.all.map(&:what).join }.first,
            /\Abound by worst found, largest: PID, ATmega328P, -O.\z/)
Gate.expect('tightening lowers', limits(*other(2, 310)) { |all| all.tighten }, [['pid-atmega328p-Os, bound: 303'], FULL])
Gate.expect('tightening does not raise', limits(*other(2, 299)) { |all| all.tighten }, [[], other(2, 299)])
Gate.expect('loosening raises', limits(*other(2, 299)) { |all| all.loosen(%w[pid]) }, [['pid-atmega328p-Os, bound: 300'], other(2, 300)])
Gate.expect('loosening raises no others', limits(*other(2, 299)) { |all| all.loosen(%w[-O2]) }, [[], other(2, 299)])
Gate.finish

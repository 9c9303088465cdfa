# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What tools/demo reads must be numbers, and all of them, and each of its checks must notice
# what it is for. Prints `ok` or `FAILED` for each case:
#
#   ruby test/tools/demo/readers.rb [NAME]... | --failed | --list
require 'json'
require 'stringio'
require_relative '../gates/gate'
require "#{PROJECT}/tools/lib/demo"

HEAD = "time_s,angle\n"

def on_file(text)
  Dir.mktmpdir do |folder|
    path = "#{folder}/run.csv"
    File.write(path, text)
    yield path
  end
rescue Host::Failure => e
  e.message
end

def trace(text, &question)
  on_file(text) { |path| question ? Trace.new(path).instance_eval(&question) : Trace.new(path) && 'read' }
end

def table(text, size = 1, &question)
  on_file(text) { |path| question ? question.call(Loops.read(path, size)) : Loops.read(path, size) && 'read' }
end

# Whether a check of this passes.
def passes(relation, measured, limit)
  Report::Check.new('loop', 'what', relation, limit, measured, '').ok?
end

def report_of_nan
  Report.start('loop')
  Report.at_most('not a number', Float::NAN, 1.0)
  [Report.good?, JSON.parse(JSON.generate(Report.checks))[0]['measured'], Report.outcome('loop')]
end

# What a report says after the block, of a loop that measured 116 before.
def regression(name, *known)
  Dir.mktmpdir do |folder|
    FileUtils.mkdir_p("#{folder}/test/tools/demo")
    File.write("#{folder}/#{Regression::FILE}", ["# head\n", *known].join)
    Regression.setup(folder)
    Report.checks.clear
    Report.start(name)
    yield
    Report.finish(name)
    Report.good?
  end
rescue Host::Failure => e
  e.message
end

# What is printed meanwhile.
def printed
  before, $stdout = $stdout, StringIO.new
  yield
  $stdout.string
ensure
  $stdout = before
end

def renewed
  Dir.mktmpdir do |folder|
    FileUtils.mkdir_p("#{folder}/test/tools/demo")
    File.write("#{folder}/#{Regression::FILE}", "# head\na | x | 1\na | y | 2\nb | z | 3\n")
    Regression.setup(folder)
    Regression.of('a', 'x', 4)
    said = printed { Regression.renew(['a']) }
    [said.lines.first(2).sort, File.readlines("#{folder}/#{Regression::FILE}").last(2)]
  end
end

# Rows of the study, one for each of these Ms: 0 has no gains, -1 is not stable.
def study_of(*sensitivities, rule: 'PI safe', outside: 0)
  Study.rows(["family;rule;status;reason;possible;lasts;outside;ms;slower\n",
              *sensitivities.map { |ms| "batch;#{rule};2;0;1;28;#{outside};#{ms};1.5\n" }])
rescue Study::Failure => e
  e.message
end

# The checks that fail of plants which all have this Ms by this rule, and 1.4 by the
# others.
def study_checks(sensitivity, wrong, **changes)
  all = Study::DESIGNS.map { |rule| study_of(*[rule == wrong ? sensitivity : 1.4] * 3, rule: rule, **changes) }.reduce(:+)
  Report.start('study')
  before = Report.checks.size
  check_study('seed', all)
  check_robust(all)
  Report.checks.drop(before).reject(&:ok?).map(&:what).join('; ')
end

# The checks that fail of two heaters, of which one may need less output.
def heater_checks(*sensitivities)
  lines = %w[0;1;6 0;2;2 1;1;2].zip(sensitivities).map { |row, ms| "kettle;PI safe;#{row};1.0;#{ms}\n" }
  Report.start('heaters')
  before = Report.checks.size
  check_heaters(Study.rows(["family;rule;plant;part;status;minutes;ms\n", *lines]), 1, 2)
  Report.checks.drop(before).reject(&:ok?).map(&:what).join('; ')
end

BEFORE = "loop | settled | 116\n"
EVEN = "#{HEAD}0,1\n1,1\n2,1\n3,1\n"
# A run of a loop that must be back in 2 s; nothing is wrong with it until `changes`.
FAULT = { loop: 'x', kind: 'hang', number: 0, bit: 0, channel: 0, value: 0.032, at_s: 1, for_s: 0, resets: 1,
          drive_low: 0, drive_high: 9, asked_low: 0, asked_high: 9, worst: 1, error: 0, back_s: 1.5,
          off_s: 0.1, off_first_s: 0.1, off_after_s: 0.033, least: 0, most: 1, alarm_s: 0, alarms: 0, end: 'back' }.freeze
FAULT_TEST = FaultRules.new(tick_s: 1e-3, watchdog_s: 32e-3, duties: 0..9, back: 2.0, lasting: 0.0, blind: 2e-3,
                            guard: GuardRules.new(unit: 'C', seen_s: 1.0, near_s: 2.0, reach: 0.0..9.0))

# The same of one that stays broken, of as many rows as there must be.
STAYS = FAULT.merge(kind: 'stays_off', value: 0, alarm_s: 0.5, alarms: 1).freeze

def stays(changes = {}, what = 'no drive', rows = STAYING_TURNS)
  row = STAYS.merge(changes)
  on_file("#{row.keys.join(',')}\n#{"#{row.values.join(',')}\n" * rows}") do |path|
    runs = FaultRuns.read('x', FAULT_TEST, [path]).like(*STAYING_FAULTS.fetch(what))
    Report.start('fault')
    before = Report.checks.size
    check_staying(what, runs, runs)
    Report.checks.drop(before).reject(&:ok?).map(&:what).join('; ')
  end
end

# What is said of it: all well, or the checks that failed.
def fault(changes = {}, count = 1)
  row = FAULT.merge(changes)
  on_file("#{row.keys.join(',')}\n#{row.values.join(',')}\n") do |path|
    Report.start('fault')
    before = Report.checks.size
    FaultRuns.read('x', FAULT_TEST, [path]).check(count, false)
    Report.checks.drop(before).reject(&:ok?).map(&:what).join('; ')
  end
end

Gate.expect('a run', trace("#{HEAD}0,-1.5e0\n1,0.5\n") { peak('angle') }, 1.5)
Gate.expect('not a number', trace("#{HEAD}0,1\n1,nan\n"), /line 3: not 2 numbers/)
Gate.expect('a row that is missing', trace(EVEN.sub("1,1\n", '')), /misses a row before 2/)
Gate.expect('a run that breaks off', on_file(EVEN) { |path| Trace.new(path, 5.0) }, /ends at 3.0, not at 5.0/)
Gate.expect('a stretch that the run does not reach', trace(EVEN) { mean('angle', 2.0, 60.0) }, /no rows from 2.0 to 60.0/)
Gate.expect('a table', table("plant;iae\noven;-1\n") { |rows| rows[0]['iae'] }, '-1')
Gate.expect('a table with no number in it', table("plant;iae\noven;-nan\n"), /oven;-nan/)
Gate.expect('a table without one row', table("plant;iae\noven;3\n", 2), /has 1 rows, not 2/)
Gate.expect('a cell that begins with a number', table("plant;iae\noven;3 s\n") { |rows| rows[0]['iae'].to_f }, /'3 s'/)
Gate.expect('a measurement that is no number', report_of_nan, [false, 'NaN', '1 of 1 checks FAILED'])
Gate.expect('beyond a limit', [passes(:<=, 1.01, 1.0), passes(:>=, 0.99, 1.0), passes(:==, 1, 2)], [false] * 3)
Gate.expect('nothing measured', [passes(:<=, nil, 1.0), passes(:==, nil, nil)], [false] * 2)
Gate.expect('plants with gains, and how good', study_of(0, 1.1, 1.5, 2.3, -1).then do |all|
  [all.gains, all.thin, all.unstable, all.robust_percent, all.thin_percent, all.ms(0.0), all.worst]
end, [4, 1, 1, 25.0, 50.0, 1.1, Float::INFINITY])
Gate.expect('an Ms that is no number', study_of('nan'), /"nan"/)
Gate.expect('good loops', study_checks(1.4, 'PI safe'), '')
Gate.expect('a word whose loops are not stable', study_checks(-1, 'PID calm'), 'seed, PID calm: unstable')
Gate.expect('a safe loop without a margin', study_checks(2.3, 'PI safe'),
            'seed, PI safe: Ms within 1.2 to 1.8; safe, of the loops: Ms above 2.2')
Gate.expect('a tuner that refuses all', study_checks(0, 'PI safe'), /plain families with gains/)
Gate.expect('heaters, one with less output', heater_checks(0, 1.5, 1.5), '')
Gate.expect('no gains with less output', heater_checks(0, 0, 1.5), 'heaters with gains, or with less output')
Gate.expect('a heater whose loop is not stable', heater_checks(0, 1.5, -1), /heaters: unstable/)
Gate.expect('an output outside its range', study_checks(1.4, 'PI safe', outside: 1), 'seed: outputs outside their range')
Gate.expect('a value as it was', regression('loop', BEFORE) { Report.unchanged('settled', 116) }, true)
Gate.expect('another value', regression('loop', BEFORE) { Report.unchanged('settled', 115) }, false)
Gate.expect('a value that is gone', regression('loop', BEFORE) { Report.at_most('other', 1, 2) }, false)
Gate.expect('a loop without a check', -> { regression('loop') { nil } }, false)
Gate.expect('values taken anew', renewed, [["a, x: 1 -> 4\n", "a, y: 2 -> gone\n"], ["a | x | 4\n", "b | z | 3\n"]])
Gate.expect('a fault that ended well', fault, '')
Gate.expect('a fault too few', fault({}, 2), 'faults tried')
Gate.expect('a fault that crashed the program', fault({ end: 'crashed' }), /crashed/)
Gate.expect('a drive beyond its limits', fault({ drive_low: -1, drive_high: 10 }), 'drive, least; drive, most')
Gate.expect('back too late', fault({ back_s: 2.1 }), 'the loop hangs: back in control after')
Gate.expect('off, but late', fault({ end: 'off', off_s: 2.1 }), 'the loop hangs: else off, the drive off after')
Gate.expect('not back', fault({ end: 'out' }), 'the loop hangs: out of control in the end')
Gate.expect('off too late', fault({ off_after_s: 0.0341 }), 'nothing works: off, later than the watchdog')
Gate.expect('a sensor that is noticed too late', fault({ kind: 'open', for_s: 1, off_first_s: 0.003 }), 'sensor at an end: off after')
Gate.expect('an alarm where nothing is broken', fault({ kind: 'none', alarms: 1 }), 'nothing: alarms of the guard')
Gate.expect('a fault with no number', fault({ worst: 'nan' }), /no number worst/)
Gate.expect('what stays broken, seen in time', stays, '')
Gate.expect('not seen', stays({ alarms: 0 }), /no drive: seen; /)
Gate.expect('seen too late', stays({ alarm_s: 1.1 }), 'no drive: seen after')
Gate.expect('an alarm before the fault', stays({ alarm_s: -0.1 }), 'no drive: alarms, none before it')
Gate.expect('a plant that got too far', stays({ least: -0.1, most: 9.1 }), 'no drive, the drive cut: least; no drive, the drive cut: most')
Gate.finish

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What tools/demo reads must be numbers, and all of them: a run that recorded none, or
# none at the time that a check is about, does not pass, nor does one that breaks off or
# misses a row. And what it prints at the end. Prints `ok` or `FAILED` for each case:
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

# The last line, where these pictures were drawn.
def told(loops, *pictures)
  Dir.mktmpdir do |folder|
    Host.setup(folder)
    pictures.each { |name| Gate.write("#{Host.folder}/#{name}.png", '') }
    Report.checks.clear
    printed { tell(loops, false) }.lines(chomp: true).last
  end
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

def batch_of(rows)
  Batch.new(Array.new(rows) { { 'tuner' => 'autotune', 'rule' => 'SIMC_PI', 'result' => '0', 'status' => Cell.new('3') } })
end

BEFORE = "loop | settled | 116\n"
EVEN = "#{HEAD}0,1\n1,1\n2,1\n3,1\n"
# A run of a loop that must be back in 2 s; nothing is wrong with it until `changes`.
FAULT = { loop: 'x', kind: 'hang', number: 0, bit: 0, channel: 0, value: 0.032, at_s: 1, for_s: 0, resets: 1,
          drive_low: 0, drive_high: 9, asked_low: 0, asked_high: 9, worst: 1, error: 0, back_s: 1.5,
          off_s: 0.1, off_first_s: 0.1, off_after_s: 0.033, end: 'back' }.freeze
FAULT_TEST = FaultRules.new(tick_s: 1e-3, watchdog_s: 32e-3, duties: 0..9, back: 2.0, lasting: 0.0, blind: 2e-3)

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
Gate.expect('infinity', trace("#{HEAD}0,-inf\n"), /line 2/)
Gate.expect('a line that breaks off', trace("#{HEAD}0,1\n1\n"), /line 3/)
Gate.expect('an empty cell', trace("#{HEAD}0,\n"), /line 2/)
Gate.expect('no rows', trace(HEAD), /no rows/)
Gate.expect('a row that is missing', trace(EVEN.sub("1,1\n", '')), /misses a row before 2/)
Gate.expect('the first row missing', trace(EVEN.sub("0,1\n", '')), /misses a row before 1/)
Gate.expect('a row twice', trace(EVEN.sub("1,1\n", "1,1\n1,1\n")), /misses a row/)
Gate.expect('a run that breaks off', on_file(EVEN) { |path| Trace.new(path, 5.0) }, /ends at 3.0, not at 5.0/)
Gate.expect('a run to its end', on_file(EVEN) { |path| Trace.new(path, 3.0) && 'read' }, 'read')
Gate.expect('a stretch that the run does not reach', trace(EVEN) { mean('angle', 2.0, 60.0) }, /no rows from 2.0 to 60.0/)
Gate.expect('an empty file', trace(''), /no rows/)
Gate.expect('no such column', trace("#{HEAD}0,1\n") { peak('speed') }, /no column speed/)
Gate.expect('peak of a time without rows', trace(EVEN) { peak('angle', 4.0, 5.0) }, /no rows from 4.0/)
Gate.expect('settling in a time without rows', trace("#{HEAD}0,1\n") { settling('angle', 1.0, 0.1, 5.0) }, /no rows/)
Gate.expect('a table', table("plant;iae\noven;3\n") { |rows| rows[0]['iae'] }, '3')
Gate.expect('a table with no number in it', table("plant;iae\noven;-nan\n"), /oven;-nan/)
Gate.expect('a table with "-" for a number', table("plant;iae\noven;-\n"), /oven;-/)
Gate.expect('a table with a negative number', table("plant;iae\noven;-1\n") { |rows| rows[0]['iae'] }, '-1')
Gate.expect('a row that breaks off', table("plant;iae\noven\n"), /: oven/)
Gate.expect('a table without rows', table("plant;iae\n"), /has 0 rows, not 1/)
Gate.expect('a table without one row', table("plant;iae\noven;3\n", 2), /has 1 rows, not 2/)
Gate.expect('an empty cell of a table', table("plant;iae\noven;\n") { |rows| rows[0]['iae'].to_i }, /not an integer/)
Gate.expect('a cell that begins with a number', table("plant;iae\noven;3 s\n") { |rows| rows[0]['iae'].to_f }, /'3 s'/)
Gate.expect('a table without the column', table("plant;iae\noven;3\n") { |rows| rows[0]['settled'] }, /no settled/)
Gate.expect('a measurement that is no number', report_of_nan, [false, 'NaN', '1 of 1 checks FAILED'])
Gate.expect('just at a limit', passes(:<=, 1.0, 1.0), true)
Gate.expect('beyond a limit', [passes(:<=, 1.01, 1.0), passes(:>=, 0.99, 1.0), passes(:==, 1, 2)], [false] * 3)
Gate.expect('infinity above a limit', passes(:>=, Float::INFINITY, 1.0), false)
Gate.expect('a limit that is no number', passes(:<=, 1.0, Float::NAN), false)
Gate.expect('nothing measured', [passes(:<=, nil, 1.0), passes(:==, nil, nil)], [false] * 2)
Gate.expect('a batch of no plants', batch_of(0).then { |batch| [batch.robust_percent, batch.done_percent] }, [nil, nil])
Gate.expect('a rule without plants', begin
  batch_of(1).only('relay', 'SIMC_PI')
rescue Host::Failure => e
  e.message
end, /no plant tuned/)
Gate.expect('no errors of no plants', Batch.quantile([], 0.5), nil)
Gate.expect('a value as it was', regression('loop', BEFORE) { Report.unchanged('settled', 116) }, true)
Gate.expect('another value', regression('loop', BEFORE) { Report.unchanged('settled', 115) }, false)
Gate.expect('a value that is new', regression('loop') { Report.unchanged('settled', 116) }, false)
Gate.expect('a value that is gone', regression('loop', BEFORE) { Report.at_most('other', 1, 2) }, false)
Gate.expect('a value twice', regression('loop', BEFORE, BEFORE) { nil }, /has twice/)
Gate.expect('a value without a number', regression('loop', "loop | settled\n") { nil }, /settled/)
Gate.expect('a loop without a check', -> { regression('loop') { nil } }, false)
Gate.expect('values taken anew', renewed, [["a, x: 1 -> 4\n", "a, y: 2 -> gone\n"], ["a | x | 4\n", "b | z | 3\n"]])
Gate.expect('a fault that ended well', fault, '')
Gate.expect('a fault too few', fault({}, 2), 'faults tried')
Gate.expect('a fault that crashed the program', fault({ end: 'crashed' }), /crashed/)
Gate.expect('a drive below its limits', fault({ drive_low: -1 }), 'drive, least')
Gate.expect('a drive above them', fault({ drive_high: 10 }), 'drive, most')
Gate.expect('back too late', fault({ back_s: 2.1 }), 'the loop hangs: back in control after')
Gate.expect('off instead', fault({ end: 'off' }), '')
Gate.expect('off, but late', fault({ end: 'off', off_s: 2.1 }), 'the loop hangs: else off, the drive off after')
Gate.expect('not back', fault({ end: 'out' }), 'the loop hangs: out of control in the end')
Gate.expect('off too late', fault({ off_after_s: 0.0341 }), 'nothing works: off, later than the watchdog')
Gate.expect('a late watchdog', fault({ kind: 'hangs', value: 0.05, off_after_s: 0.051 }), '')
Gate.expect('a sensor that is not noticed', fault({ kind: 'open', for_s: 1, off_first_s: -1 }), 'sensor at an end: off')
Gate.expect('one noticed too late', fault({ kind: 'open', for_s: 1, off_first_s: 0.003 }), 'sensor at an end: off after')
Gate.expect('one that is whole before it can be noticed', fault({ kind: 'open', for_s: 0.002, off_first_s: -1 }), '')
Gate.expect('a fault with no number', fault({ worst: 'nan' }), /no number worst/)
Gate.expect('a row of a fault that breaks off', fault({ end: "\n" }), /not a row of a fault/)
Gate.expect('dots while a loop takes long', -> { printed { with_dots(0.02) { sleep 0.2 } } }, /\A(\. ){2,10}\z/)
Gate.expect('none of a short loop', -> { printed { with_dots { nil } } }, '')
Gate.expect('the picture to look at first', -> { told(%w[oven thermostat], 'oven', 'thermostat') },
            'Look at build/demo/thermostat.png first; the numbers are in build/demo/results.json.')
Gate.expect('that of the only loop', -> { told(%w[oven], 'oven', 'thermostat') }, %r{^Look at build/demo/oven.png first})
Gate.expect('none where none was drawn', -> { told(%w[oven]) }, /\A\d+ checks held, 0 failed\.\z/)
Gate.finish

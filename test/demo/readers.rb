# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What tools/demo reads must be numbers: a run that recorded none, or none at the
# time that a check is about, does not pass. Prints `ok` or `FAILED` for each case.
require 'json'
require 'tmpdir'

root = File.expand_path('../..', __dir__)
require "#{root}/tools/lib/demo/host"
require "#{root}/tools/lib/demo/report"
require "#{root}/tools/lib/demo/loops"
require "#{root}/tools/lib/demo/plot"
require "#{root}/tools/lib/demo/faults"

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

def table(text, &question)
  on_file(text) { |path| question ? question.call(Loops.read(path)) : Loops.read(path) && 'read' }
end

def expect(what, found, wanted)
  good = wanted.is_a?(Regexp) ? found.to_s.match?(wanted) : found == wanted
  puts good ? "ok #{what}" : "FAILED #{what}: #{found}, not #{wanted}"
  good
end

def report_of_nan
  Report.start('loop')
  Report.at_most('not a number', Float::NAN, 1.0)
  [Report.good?, JSON.parse(JSON.generate(Report.checks))[0]['measured'], Report.outcome('loop')]
end

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
    Faults.read('x', FAULT_TEST, [path]).check(count, false)
    Report.checks.drop(before).reject(&:ok?).map(&:what).join('; ')
  end
end

good = [
  expect('a run', trace("#{HEAD}0,-1.5e0\n1,0.5\n") { peak('angle') }, 1.5),
  expect('not a number', trace("#{HEAD}0,1\n1,nan\n"), /line 3: not 2 numbers/),
  expect('infinity', trace("#{HEAD}0,-inf\n"), /line 2/),
  expect('a line that breaks off', trace("#{HEAD}0,1\n1\n"), /line 3/),
  expect('an empty cell', trace("#{HEAD}0,\n"), /line 2/),
  expect('no rows', trace(HEAD), /no rows/),
  expect('an empty file', trace(''), /no rows/),
  expect('no such column', trace("#{HEAD}0,1\n") { peak('speed') }, /no column speed/),
  expect('peak of a time without rows', trace("#{HEAD}0,1\n") { peak('angle', 1.0, 2.0) }, /no rows from 1.0/),
  expect('settling in a time without rows', trace("#{HEAD}0,1\n") { settling('angle', 1.0, 0.1, 5.0) }, /no rows/),
  expect('a table', table("plant;iae\noven;3\n") { |rows| rows[0]['iae'] }, '3'),
  expect('a table with no number in it', table("plant;iae\noven;-nan\n"), /oven;-nan/),
  expect('a row that breaks off', table("plant;iae\noven\n"), /: oven/),
  expect('a table without rows', table("plant;iae\n"), /no rows/),
  expect('a table without the column', table("plant;iae\noven;3\n") { |rows| rows[0]['settled'] }, /no settled/),
  expect('a measurement that is no number', report_of_nan, [false, 'NaN', '1 of 1 checks FAILED']),
  expect('a fault that ended well', fault, ''),
  expect('a fault too few', fault({}, 2), 'faults tried'),
  expect('a fault that crashed the program', fault({ end: 'crashed' }), /crashed/),
  expect('a drive below its limits', fault({ drive_low: -1 }), 'drive, least'),
  expect('a drive above them', fault({ drive_high: 10 }), 'drive, most'),
  expect('back too late', fault({ back_s: 2.1 }), 'the loop hangs: back in control after'),
  expect('off instead', fault({ end: 'off' }), ''),
  expect('off, but late', fault({ end: 'off', off_s: 2.1 }), 'the loop hangs: else off, the drive off after'),
  expect('not back', fault({ end: 'out' }), 'the loop hangs: out of control in the end'),
  expect('off too late', fault({ off_after_s: 0.0341 }), 'nothing works: off, later than the watchdog'),
  expect('a late watchdog', fault({ kind: 'hangs', value: 0.05, off_after_s: 0.051 }), ''),
  expect('a sensor that is not noticed', fault({ kind: 'open', off_first_s: -1 }), 'sensor at an end: off'),
  expect('one noticed too late', fault({ kind: 'open', off_first_s: 0.003 }), 'sensor at an end: off after'),
  expect('a fault with no number', fault({ worst: 'nan' }), /no number worst/),
  expect('a row of a fault that breaks off', fault({ end: "\n" }), /not a row of a fault/)
]
exit(good.all? ? 0 : 1)

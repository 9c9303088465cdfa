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
  expect('a table with "-" for a number', table("plant;iae\noven;-\n"), /oven;-/),
  expect('a table with a negative number', table("plant;iae\noven;-1\n") { |rows| rows[0]['iae'] }, '-1'),
  expect('a row that breaks off', table("plant;iae\noven\n"), /: oven/),
  expect('a table without rows', table("plant;iae\n"), /no rows/),
  expect('a table without the column', table("plant;iae\noven;3\n") { |rows| rows[0]['settled'] }, /no settled/),
  expect('a measurement that is no number', report_of_nan, [false, 'NaN', '1 of 1 checks FAILED'])
]
exit(good.all? ? 0 : 1)

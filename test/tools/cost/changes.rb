# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What tools/cost says of tables that are not what was measured, and of figures beyond
# their limits; which limits it lowers and raises. Prints `ok` or
# `FAILED` for each case:
#
#   ruby test/tools/cost/changes.rb [NAME]... | --failed | --list
require 'ostruct'
require_relative '../gates/gate'

module Host
  class Failure < StandardError; end
end

%w[subjects documents limits since].each { |name| require "#{PROJECT}/tools/lib/measure/#{name}" }

ROWS = [['', 'chip', 'built', 'worst', 'stack'], ['AN937', 'PIC18F4520', 'object', 410, '3 levels, 12 bytes'],
        ['AN937', 'Cortex-M0', '-O2', 60, '8 bytes']].freeze

def changes(text, left_out = [])
  Dir.mktmpdir do |folder|
    path = "#{folder}/cost.md"
    File.write(path, "# Cost\n<!-- steps:begin -->\n#{text}<!-- steps:end -->\n")
    Document.new(path).replace('steps', ROWS, left_out)
  end
rescue Host::Failure => e
  [e.message]
end

# A pattern is of the only thing that is said.
def expect(what, text, wanted, left_out = [])
  found = changes(text, left_out)
  Gate.expect(what, wanted.is_a?(Regexp) && found.size == 1 ? found.first : found, wanted)
end

same = Tables.markdown(ROWS)
expect('the same table', same, [])
expect('a cycle more', same.sub('410', '409'), /object, worst: 409 is documented, 410 measured, which is worse/)
expect('a cycle less', same.sub('410', '411'), /which is better/)
expect('a byte of two numbers', same.sub('12 bytes', '11 bytes'), /stack: .*which is worse/)
expect('a row that is new', same.lines[0..-2].join, /Cortex-M0, -O2: new/)
expect('a row that is gone', "#{same}#{same.lines.last.sub('M0', 'M3')}", /Cortex-M3, -O2: gone/)
expect('a row that is left out', "#{same}#{same.lines.last.sub('M0', 'M3')}", [], [%w[AN937 Cortex-M3 -O2]])
expect('a row like one that is left out', "#{same}#{same.lines.last.sub('-O2', '-Os')}", /Cortex-M0, -Os: gone/, [%w[AN937 Cortex-M0 -O3]])
expect('another order', (same.lines[0, 2] + same.lines[2, 2].reverse).join, /places/)
expect('no table', '', /new/)
# What `--since` tells of two pages.
def since(before, after)
  Since.new(*[before, after].map { |text| "<!-- steps:begin -->\n#{text}<!-- steps:end -->\n" }).to_s
end

Gate.expect('since: the same page', since(same, same), "No figure of `docs/cost.md` changed: 4 are as they were.\n")
Gate.expect('since: a cycle more', since(same.sub('410', '409'), same), /^\| steps: AN937, PIC18F4520, object \| worst \| 409 \| 410 \| \+1 \|$/)
Gate.expect('since: a byte less of two numbers', since(same.sub('12 bytes', '13 bytes'), same), /\| stack \| 3 levels, 13 bytes \| 3 levels, 12 bytes \| changed \|$/)
Gate.expect('since: a row that is new', since(same.lines[0..-2].join, same), /^\| steps: AN937, Cortex-M0, -O2 \| worst \| - \| 60 \| new \|$/)
Gate.expect('since: a row that is gone', since(same, same.lines[0..-2].join), /\| 60 \| - \| gone \|$/)
Gate.expect('since: what stayed is counted', since(same.sub('410', '409'), same), /^3 figures of/)
Gate.expect('docs/cost.md names the chips that --daily leaves out', File.read("#{PROJECT}/docs/cost.md")[/leaves out only\nthe steps on (.*?);/, 1].split(/, | and /),
            CHIPS.select(&:weekly).map(&:title))
Gate.expect('a limit kept', Limit.new('', 410, 410, '').kept?, true)
Gate.expect('a limit exceeded', Limit.new('', 410, 411, '').kept?, false)
Gate.expect('a limit of nothing', Limit.new('', 410, nil, '').kept?, false)
Gate.expect('a limit just above its figure', Limit.new('', 412, 400, '').good?, true)
Gate.expect('a limit far above its figure', Limit.new('', 413, 400, 'cycles').then { |one| [one.good?, one.wrong] }.inspect, /false.*400 cycles, and 413 cycles.*--tighten/)
Gate.expect('a limit far above its figure with a reason', Limit.new('', 500, 400, '', 'it will be').good?, true)

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
Gate.expect('a limit that is none, with a reason', wrong(*other(2, 310, 'soon')), [])
Gate.expect('a limit of no row', limits('pid-z80-O2,bound,1,') { nil }, /limits\.csv:2: no row is called pid-z80-O2/)
Gate.expect('a limit of what is left out', limits(*FULL, 'pid-z80-O2,bound,1,', left_out: %w[pid-z80-O2]) { |all| all.all.size }.first, 5)
Gate.expect('a limit of no figure', limits('pid-atmega328p-O2,beauty,1,') { nil }, /no figure is called beauty/)
Gate.expect('a limit without a number', limits('pid-atmega328p-O2,bound,few,') { nil }, /few is no limit/)
Gate.expect('tightening lowers', limits(*other(2, 310)) { |all| all.tighten }, [['pid-atmega328p-Os, bound: 303'], FULL])
Gate.expect('tightening does not raise', limits(*other(2, 299)) { |all| all.tighten }, [[], other(2, 299)])
Gate.expect('tightening keeps what has a reason', limits(*other(2, 310, 'soon')) { |all| all.tighten }, [[], other(2, 310, 'soon')])
Gate.expect('tightening adds', limits(*FULL[1, 3]) { |all| all.tighten }, [['pid-atmega328p-O2, bound: 303'], other(0, 303)])
Gate.expect('loosening raises', limits(*other(2, 299)) { |all| all.loosen(%w[pid]) }, [['pid-atmega328p-Os, bound: 300'], other(2, 300)])
Gate.expect('loosening raises no others', limits(*other(2, 299)) { |all| all.loosen(%w[-O2]) }, [[], other(2, 299)])
Gate.expect('loosening raises nothing that is kept', limits(*FULL) { |all| all.loosen(%w[pid]) }, [[], FULL])
Gate.finish

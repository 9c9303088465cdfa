# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What tools/cost says of tables that are not what was measured. Prints `ok` or
# `FAILED` for each case.
require 'tmpdir'

module Host
  class Failure < StandardError; end
end

root = File.expand_path('../../..', __dir__)
require "#{root}/tools/lib/measure/subjects"
require "#{root}/tools/lib/measure/documents"
require "#{root}/tools/lib/measure/limits"

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

def expect(what, found, wanted)
  good = wanted.is_a?(Regexp) ? found.size == 1 && found.first.match?(wanted) : found == wanted
  puts good ? "ok #{what}" : "FAILED #{what}: #{found}, not #{wanted}"
  good
end

same = Tables.markdown(ROWS)
good = [
  expect('the same table', changes(same), []),
  expect('a cycle more', changes(same.sub('410', '409')), /object, worst: 409 is documented, 410 measured, which is worse/),
  expect('a cycle less', changes(same.sub('410', '411')), /which is better/),
  expect('a byte of two numbers', changes(same.sub('12 bytes', '11 bytes')), /stack: .*which is worse/),
  expect('a row that is new', changes(same.lines[0..-2].join), /Cortex-M0, -O2: new/),
  expect('a row that is gone', changes("#{same}#{same.lines.last.sub('M0', 'M3')}"), /Cortex-M3, -O2: gone/),
  expect('another order', changes((same.lines[0, 2] + same.lines[2, 2].reverse).join), /places/),
  expect('no table', changes(''), /new/),
  expect('a limit kept', [Limit.new('', 410, 410, '').kept?], [true]),
  expect('a limit exceeded', [Limit.new('', 410, 411, '').kept?], [false]),
  expect('a limit of nothing', [Limit.new('', 410, nil, '').kept?], [false])
]
exit(good.all? ? 0 : 1)

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What tools/cost says of tables that are not what was measured. Prints `ok` or
# `FAILED` for each case:
#
#   ruby test/tools/cost/changes.rb [NAME]... | --failed | --list
require_relative '../gates/gate'

module Host
  class Failure < StandardError; end
end

%w[subjects documents limits].each { |name| require "#{PROJECT}/tools/lib/measure/#{name}" }

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
expect('a cycle less', same.sub('410', '411'), /which is better/)
expect('a byte of two numbers', same.sub('12 bytes', '11 bytes'), /stack: .*which is worse/)
expect('a row that is new', same.lines[0..-2].join, /Cortex-M0, -O2: new/)
expect('a row that is gone', "#{same}#{same.lines.last.sub('M0', 'M3')}", /Cortex-M3, -O2: gone/)
expect('another order', (same.lines[0, 2] + same.lines[2, 2].reverse).join, /places/)
expect('no table', '', /new/)
Gate.expect('a limit kept', Limit.new('', 410, 410, '').kept?, true)
Gate.expect('a limit exceeded', Limit.new('', 410, 411, '').kept?, false)
Gate.expect('a limit of nothing', Limit.new('', 410, nil, '').kept?, false)
Gate.finish

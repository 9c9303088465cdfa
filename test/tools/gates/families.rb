# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What test/chips/families says of a document when some tests were left out: the rows of
# what ran are judged, and all others stay. Prints `ok` or `FAILED` for each case:
#
#   ruby test/tools/gates/families.rb [NAME]... | --failed | --list
require_relative 'gate'
require "#{PROJECT}/test/chips/families/document"

TITLES = { 'an964' => 'AN964', 'pid' => 'PID' }.freeze
BOTH = %w[pointer object].freeze
STEPS_LONG = 20
Family = Struct.new(:name, :title, :modes, :refused, :costs_listed?)
FAMILIES = [Family.new('small', 'Small', { 'an964' => BOTH }, { 'pid' => [/no/, 'no: it is small'] }, true),
            Family.new('large', 'Large', { 'an964' => BOTH, 'pid' => %w[object] }, {}, true),
            Family.new('mute', 'Mute', { 'an964' => BOTH, 'pid' => BOTH }, {}, false)].freeze
Measured = Struct.new(:rows, :steps, :different, :mean, :worst, :flash, :ram)

def all
  keys = FAMILIES.flat_map { |one| one.modes.flat_map { |name, modes| modes.map { |mode| [one.name, name, mode] } } }
  keys.each_with_index.to_h { |key, at| [key, Measured.new(10, 20, 0, 100 + at, 200 + at, 300 + at, 7)] }
end

EMPTY = "<!-- families:begin -->\n<!-- families:end -->\n<!-- family-costs:begin -->\n<!-- family-costs:end -->\n"

# The block's value for a page with this text, and the text then.
def with(text)
  Dir.mktmpdir do |folder|
    path = "#{folder}/chips.md"
    File.write(path, text)
    value = yield path
    [value.sub(folder, ''), File.read(path)]
  end
rescue Host::Failure => e
  [e.message, text]
end

PAGE = with(EMPTY) { |path| Document.new(all, true, [], path).update }.last.freeze
LARGE = all.keys.select { |family, _, _| family == 'large' }.freeze

def check(text, long: false, left_out: [], results: all.except(*left_out))
  with(text) { |path| Document.new(results, long, left_out, path).check }.first
end

Gate.expect('the page', PAGE.lines.grep(/Large|Small|Mute/).size, 8)
Gate.expect('all that ran', check(PAGE, long: true), '/chips.md')
Gate.expect('what was left out', check(PAGE, left_out: LARGE), '/chips.md')
Gate.expect('a wrong figure of what was left out stays', check(PAGE.sub('304', '999'), left_out: LARGE), '/chips.md')
Gate.expect('a wrong figure of what ran', check(PAGE.sub('301', '999'), left_out: LARGE), /stale.*\n.*999/)
Gate.expect('a wrong cell of what ran', check(PAGE.sub('20 rows', '21 rows'), left_out: LARGE), /stale.*\n.*Small/)
Gate.expect('a worst step of what ran', check(PAGE.sub('| 201 |', '| 200 |'), left_out: LARGE), /stale.*\n.*200/)
Gate.expect('one mode that was left out', check(PAGE, left_out: LARGE.first(1)), '/chips.md')
Gate.expect('and a wrong figure of the other', check(PAGE.sub('303', '999'), left_out: LARGE.first(1)), /stale.*\n.*999/)
Gate.expect('a row that is lost of what was left out', check(PAGE.lines.grep_v(/^\| PID, Large/).join, left_out: LARGE),
            /no row of PID, Large, `object` in family-costs, which did not run/)
Gate.expect('no result of what was not left out', lambda do
  check(PAGE, results: all.except(*LARGE))
rescue KeyError => e
  e.message
end, /key not found/)
OTHER = PAGE.sub('304', '999').freeze
Gate.expect('an update loses no row', with(OTHER) { |path| Document.new(all.except(*LARGE), true, LARGE, path).update }.last, OTHER)
Gate.finish

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# once.rb SIGHT GOOD BAD COMMAND...: runs a command, or says what it said when it last
# passed with the same inputs: what is in its sight (sights.rb), its words, and the files
# that they name. It passed if it succeeded with at least one line like GOOD, and none
# like BAD or `skipped ...`. Each line like GOOD is a check; one with a number, `(\d+)`,
# is as many.
require 'open3'
require_relative '../remembered'
require_relative 'sights'

def checks_of(text, good)
  text.lines.sum do |line|
    found = good.match(line)
    found ? (found[1] || 1).to_i : 0
  end
end

sight, good, bad, *command = ARGV
good = Regexp.new(good)
bad = Regexp.new(bad)
named = command.map { |word| word.sub(/\A-[^=]*=/, '') }.select { |word| File.file?(word) }
status = nil
text = Remembered.new(sight, **Sights.of(sight)).of(command.join(' '), files: named, checks: ->(said) { checks_of(said, good) }) do
  output, ended = Open3.capture2e(*command)
  status = ended.exitstatus || 1
  print output
  lines = output.force_encoding('UTF-8').scrub
  passed = status.zero? && checks_of(lines, good).positive? && lines.lines.none? { |line| bad.match?(line) || line.start_with?('skipped ') }
  passed && output.valid_encoding? ? output : nil
end
print text unless status
exit status || 0

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# told.rb TALLY: the end of a tools/test. Forgets what is old, and says how many checks were
# remembered; their lines in the tally are tools/lib/remembered.rb's.
require_relative '../remembered'

UNITS = { 'day' => 86_400, 'hour' => 3600, 'minute' => 60 }.freeze

def age_of(seconds)
  unit, size = UNITS.find { |_, one| seconds >= 2 * one } || ['second', 1]
  count = seconds / size
  "#{count} #{unit}#{'s' unless count == 1} old"
end

Remembered.sweep
rows = File.readlines(ARGV.fetch(0), chomp: true).map { |line| line.split(' ', 3) }
exit if rows.empty?

sums = rows.group_by(&:last).sort.map { |what, of_it| "#{of_it.sum { |count, _| count.to_i }} #{what}" }
puts "remembered: #{sums.join(' and ')}, the oldest #{age_of(Time.now.to_i - rows.map { |_, at| at.to_i }.min)}; " \
     'all anew: tools/test --fresh'

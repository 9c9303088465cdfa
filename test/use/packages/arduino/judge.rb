# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Judges what a sketch printed for the serial plotter: after each change of the setpoint
# the reading overshoots by at most so many percent of the change, and has come within
# 2 percent, or a count, to stay, after at most so many steps.
#
#   ruby judge.rb FILE OVERSHOOT_PERCENT STEPS
file, overshoot_most, steps_most = ARGV
POINT = /\Asetpoint:(-?\d+),\w+:(-?\d+),/.freeze
points = File.readlines(file).map { |line| line[POINT] && line.match(POINT).captures.map(&:to_i) }.compact
segments = points.slice_when { |before, after| before.first != after.first }.select { |segment| segment.size > steps_most.to_i }
changes = segments.map do |segment|
  setpoint, start = segment.first
  way = setpoint - start
  next if way.abs < 50

  errors = segment.map { |_, reading| (reading - setpoint) * (way <=> 0) }
  band = [0.02 * way.abs, 1].max
  [100.0 * [errors.max, 0].max / way.abs, errors.rindex { |error| error.abs > band }.to_i + 1]
end.compact
abort 'no change of the setpoint to judge' if changes.empty?

puts(changes.map { |overshoot, steps| format('overshoot %.1f %%, settled after %d steps', overshoot, steps) })
exit(changes.all? { |overshoot, steps| overshoot <= overshoot_most.to_f && steps <= steps_most.to_i } ? 0 : 1)

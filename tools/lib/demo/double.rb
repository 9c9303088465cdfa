# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# fixpid_pid on five plants, beside its law in double precision.

# The most steps until a loop stays within 2 %: a controller must be sooner than
# a constant output, with which a lag needs ln 50 = 3.9 of its lags after the dead
# time, and two lags of 20 and 10 need 92 steps. An integrator never settles so:
# it may take two of its controller's reset times, 2 * 0.9 / 0.006.
SETTLED_LIMITS = {
  'lag 50, dead time 3' => 198,
  'lags 20 and 10' => 92,
  'integrator, dead time 4' => 300,
  'motor, lag 25, noise 2' => 98,
  'oven, lag 2000, dead time 40' => 7864
}.freeze

# In percent of the setpoint: half of the 2 % in which a loop counts as settled,
# so that none that overshoots looks settled while it does.
OVERSHOOT_LIMIT = 1.0

WHAT = { 'settled' => 'steps until it is settled', 'iae' => 'sum of errors',
         'iae_after' => 'sum of the last errors' }.freeze

def double
  plants = Loops.table('comparison', 2 * SETTLED_LIMITS.size).group_by { |row| row['plant'] }
  SETTLED_LIMITS.each_key { |plant| check_plant(plant, *plants.fetch(plant)) }
  Loops.table('agreement', SETTLED_LIMITS.size).each do |row|
    Report.at_most("#{row['plant']}: on the same readings, off the law by", row['difference'].to_f, row['allowed'].to_f, 'counts')
  end
end

# A loop may be 1 % worse than in double precision: one count of 8 bits is 0.4 %
# of a range, and both see the readings that their own outputs make. Sooner is no
# fault.
def check_plant(plant, ours, exact)
  overshoot = ours['overshoot'].to_f
  percent = WHAT.keys.to_h { |name| [name, 100.0 * (ours[name].to_f / exact[name].to_f - 1.0)] }
  Report.at_most("#{plant}: overshoot", overshoot, OVERSHOOT_LIMIT, '%')
  Report.at_most("#{plant}: #{WHAT['settled']}", ours['settled'].to_i, SETTLED_LIMITS.fetch(plant))
  tell_values(plant, ours)
  Report.at_most("#{plant}: overshoot, more than in double precision", overshoot - exact['overshoot'].to_f, 1.0, '%')
  Report.at_most("#{plant}: settles later than in double precision", percent['settled'], 1.0, '%')
  %w[iae iae_after].each do |name|
    Report.at_most("#{plant}: #{WHAT[name]}, off double precision by", percent[name].abs, 1.0, '%')
  end
end

# Of a row of a table.
def tell_values(what, row)
  Report.unchanged("#{what}: overshoot in 0.01 %", (100.0 * row['overshoot'].to_f).round)
  WHAT.each { |name, meaning| Report.unchanged("#{what}: #{meaning}", row[name].to_f.round) if row.key?(name) }
end

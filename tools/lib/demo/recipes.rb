# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The recipes of docs/recipes.md: each a program that runs a loop, what must be
# seen of it, and one picture of those that have something to show.
#
# What a recipe promises, its loop must show: within 2 % of the setpoint in half of
# the time until the next event, a twentieth beyond it at most, and what the recipe is
# about. Without the recipe it must be so much worse that a reader sees it in the
# picture, or the recipe is not worth its lines.
def recipes
  check_menu(Loops.read(Host.recipe('menu', 'recipes-menu.txt'), 5))
  check_behind_tpo(Loops.read(Host.print('behind_tpo', 'recipes-behind_tpo.txt', *BEHIND_TPO.map(&:to_s)), 2 * BEHIND_TPO[1]))
  draw_recipes(RECIPE_RUNS.to_h do |name, last|
    run = recipe(name, last)
    send("check_#{name}", run)
    [name, run]
  end)
end

# Recipes that record a run, and its last time.
RECIPE_RUNS = {
  'cascade' => 5999, 'two_rates' => 5.999, 'override' => 3999, 'ramp' => 599.9, 'ramp_soak' => 1199,
  'ssr' => 1799.9, 'from_cold' => 999, 'tune_ssr' => 1499, 'retune' => 4999, 'heat_cool' => 99_990, 'least_output' => 19_999,
  'angle' => 1.999, 'guard' => 1999.9, 'dead_band' => 3999, 'sensor_break' => 599.9,
  'scheduling' => 2999, 'interpolated' => 19_999, 'sample_time' => 1199.9, 'interrupt' => 999, 'freertos' => 999, 'zephyr' => 999,
  'converter' => 1999, 'back_from_limit' => 2999, 'spikes' => 1999.9
}.freeze

# What a step of the setpoint, or what comes after another event, must do: within 2 % of
# `target` after `within` and beyond it by `over` percent of it at most.
def check_step(what, run, column, target, from, to, within, over, unit = 'steps')
  values = run.values(column, from, to)
  rises = values.first < target
  beyond = rises ? values.max - target : target - values.min
  Report.at_most("#{what}: #{target} within 2 % after", run.settling(column, target, 0.02 * target.abs, from, to), within, unit)
  Report.at_most("#{what}: beyond #{target}", 100.0 * beyond / target.abs, over, '%')
end

# Its run, to `last` at least.
def recipe(name, last)
  Trace.new(Host.recipe(name, "recipes-#{name}.csv"), last)
end

# Steps of the largest change of a column between two rows of a stretch.
def largest_change(run, column, from, to)
  run.values(column, from, to).each_cons(2).map { |a, b| (b - a).abs }.max
end

# The supply is weak from step 2000 to 3500.
def check_cascade(run)
  peaks, settled = %w[with without].to_h { |which| [which, run.values(which, 3500).max] },
                   %w[with without].to_h { |which| [which, run.settling(which, 500.0, 10.0, 3500)] }
  peaks.each { |which, peak| Report.number("cascade_#{which}_peak", peak) }
  settled.each { |which, steps| Report.number("cascade_#{which}_settled", steps) }
  Report.at_most('cascade: peak after the weak supply', peaks['with'], 512, 'counts')
  Report.at_most('cascade: settled after', settled['with'], 300, 'steps')
  Report.at_least('cascade without tracking: peak', peaks['without'], 565, 'counts')
  Report.at_least('cascade without tracking: settled after', settled['without'], 640, 'steps')
end

# The filter is clogged from step 1000 to 2500.
def check_override(run)
  found = { 'with' => %w[pressure flow], 'without' => %w[pressure_without flow_without] }.transform_values do |columns|
    [run.values(columns[0], 1000, 2500).max, run.values(columns[1], 2500).max]
  end
  found.each do |which, (pressure, flow)|
    Report.number("override_#{which}_pressure", pressure)
    Report.number("override_#{which}_flow", flow)
  end
  Report.at_most('override: worst pressure of 700 allowed', found['with'][0], 712.0, 'counts')
  Report.at_least('override without tracking: worst pressure', found['without'][0], 850.0, 'counts')
  Report.at_most('override: peak of the flow afterwards, of 600', found['with'][1], 605.0, 'counts')
  Report.at_least('override without tracking: peak of the flow', found['without'][1], 750.0, 'counts')
  Report.at_most('override: 600 within 2 % after', run.settling('flow', 600.0, 12.0, 2500.0), 250.0, 'steps')
end

def check_ramp(run)
  Report.at_most('ramp: 600 within 2 % after the ramp', run.settling('with', 600.0, 12.0, 300.0), 15.0, 's')
  Report.at_most('ramp: peak of 600', run.values('with').max, 604.0)
  Report.at_least('and without ramp and tracking', run.values('without').max, 690.0)
  Report.at_most('ramp: fastest rise in a second',
                 run.values('with').each_slice(10).map(&:first).each_cons(2).map { |a, b| b - a }.max, 2.5, 'counts')
end

def check_ssr(run)
  check_step('SSR', run, 'value', 960.0, 0.0, 900.0, 115.0, 2.0, 's')
  on = run.values('on')
  settled = 900.0
  Report.at_most('SSR: mean of the temperature off its setpoint',
                 (run.mean('value', settled, 1800.0) - 960.0).abs, 1.0, 'counts')
  Report.at_most('SSR: ripple', run.swing('value', settled, 1800.0), 9.0, 'counts')
  Report.at_most('SSR: switchings an hour',
                 on.each_cons(2).count { |a, b| a != b } * 2, 1440)
  Report.at_least('SSR: shortest pulse', on.chunk_while { |a, b| a == b }.select { |c| c[0] == 1.0 }.map(&:size).min, 2, 'steps')
end

# Cold water comes in from 500 to 560 s.
def check_from_cold(run)
  over = run.times[run.values('tuning').index(0.0)]
  Report.number('from_cold_s', over)
  Report.at_most('from cold: the heat-up ends after', over, 90, 's')
  Report.at_most('from cold: beyond the setpoint of 73.0', run.values('value', 0.0, 500.0).max - 73.0, 0.4, 'degrees')
  Report.at_most('from cold: within 2 % after', run.settling('value', 73.0, 1.46, 0.0, 500.0), 215, 's')
  Report.at_most('from cold: cold water cools by', 73.0 - run.values('value', 500.0).min, 3.5, 'degrees')
  Report.at_most('from cold: and is forgotten within 2 % after', run.settling('value', 73.0, 1.46, 500.0), 190, 's')
  Report.exactly('from cold: alarms', run.values('flags', over + 1.0).count { |flags| flags.to_i.anybits?(0x3F) }, 0)
end

# The experiment measures from 38 percent on: what comes before finds the setpoint. Its
# swing is at most what was wanted. With its setpoint weight of 1 the controller
# overshoots a step by a quarter or so.
def check_tune_ssr(run)
  percent = run.values('percent')
  over = run.times[percent.index(100.0)]
  Report.number('tune_ssr_s', over)
  Report.at_most('tuning behind an SSR: the experiment ends after', over, 900, 's')
  Report.at_most('tuning behind an SSR: swing while it measures',
                 run.swing('value', run.times[percent.index { |done| done > 38.0 }], over), 340, 'counts')
  Report.at_most('tuning behind an SSR: 960 within 2 % after', run.settling('value', 960.0, 19.2, over, 1000.0), 100, 's')
  Report.at_most('tuning behind an SSR: ripple', run.swing('value', 900.0, 1000.0), 9.0, 'counts')
  Report.at_most('tuning behind an SSR: overshoot of 240 more', run.values('value', 1000.0).max - 1200.0, 72.0, 'counts')
  Report.at_most('tuning behind an SSR: 1200 within 2 % after', run.settling('value', 1200.0, 24.0, 1000.0), 120, 's')
end

BEHIND_TPO = [2004, 200].freeze # seed and plants

# A user who has a relay shall hardly be worse off than one who has a D/A converter:
# none of the loops without a margin, 19 of 20 get gains that would get them, and it
# takes no more than a tenth longer.
def check_behind_tpo(rows)
  found = %w[direct tpo].to_h { |way| [way, behind_tpo(rows.select { |row| row['way'] == way })] }
  direct, tpo = found.values
  found.each { |way, numbers| numbers.each { |name, number| Report.number("behind_tpo_#{way}_#{name}", number) } }
  Report.at_most('behind fixpid_tpo, 200 plants: Ms above 2.2', tpo['thin'], 0)
  Report.at_least('behind fixpid_tpo: plants with gains, of those with a direct output',
                  100.0 * tpo['gains'] / direct['gains'], 95.0, '%')
  { 'middle' => 'median', 'long' => '95 %' }.each do |name, what|
    Report.at_most("behind fixpid_tpo: length of the experiments over that with a direct output, #{what}",
                   tpo[name].to_f / direct[name], 1.1)
  end
end

NO_MARGIN = 2.2 # Ms of a loop that may oscillate if its plant changes a little

# Of experiments that are DONE the lengths.
def behind_tpo(rows)
  gains = rows.select { |row| row['result'] == '1' }.map { |row| row['ms'].to_f }
  lengths = rows.select { |row| row['status'].to_i == DONE }.map { |row| row['steps'].to_i }
  { 'plants' => rows.size, 'done' => lengths.size, 'gains' => gains.size, 'thin' => gains.count { |ms| ms > NO_MARGIN },
    'largest' => gains.max, 'middle' => lengths.sort[lengths.size / 2], 'long' => lengths.sort[lengths.size * 95 / 100] }
end

RETUNED_AT = 1000.0
RETUNE_LOADED_AT = 4000.0

# The experiments begin at step 1000; a load comes in one of them, from 1500 to 2600, and
# one for the found gains from 4000.
def check_retune(run)
  far = run.values('retuned', RETUNED_AT, RETUNE_LOADED_AT).map { |v| (v - 500.0).abs }.max
  errors = %w[retuned old].to_h { |which| [which, run.values(which, RETUNE_LOADED_AT).sum { |v| (v - 500.0).abs }] }
  Report.number('retune_far', far)
  errors.each { |which, sum| Report.number("retune_#{which}_errors", sum) }
  Report.at_most('retuning: farthest from the setpoint', far, 30.0, 'counts')
  Report.at_most('retuning: the loop comes back within 2 % after', run.settling('retuned', 500.0, 10.0, RETUNED_AT, RETUNE_LOADED_AT), 1500, 'steps')
  Report.at_most('retuning: sum of errors after a load, of that with the old gains', errors['retuned'] / errors['old'], 0.6)
  check_no_gains(run)
end

# The old controller is back as soon as the measurement is at its limit, and goes on
# from the output that it had: two steps later its integral has moved by some counts.
def check_no_gains(run)
  output = run.values('output_disturbed')
  ended = (1500...1800).find { |k| run.values('disturbed')[k - 1] < 380.0 } or raise Host::Failure, 'the load ends no experiment'
  Report.at_most('retuning without gains: the old controller goes on from its output, within',
                 (output[ended..(ended + 2)].last - output[999]).abs, 10.0, 'counts')
  Report.at_most('retuning without gains: the setpoint within 2 % after', run.settling('disturbed', 500.0, 10.0, 1500.0, 2600.0), 1000, 'steps')
end

# Changes of the valve once the process has settled.
def moves(run, column)
  run.values(column, 1000.0, 2000.0).each_cons(2).count { |a, b| a != b }
end

def check_dead_band(run)
  check_step('dead band', run, 'with', 600.0, 0.0, 2000.0, 300.0, 2.0)
  check_step('dead band', run, 'with', 400.0, 2000.0, 4000.0, 300.0, 2.0)
  Report.at_most('dead band: moves of the valve in 1000 steps', moves(run, 'valve'), 300)
  Report.at_least('and without', moves(run, 'valve_without'), 700)
  Report.at_most('dead band: offset', (run.mean('with', 1500.0, 2000.0) - 600.0).abs, 5.0, 'counts')
end

def check_scheduling(run)
  Report.at_most('scheduling: largest step of the output but at new setpoints',
                 largest_change(run, 'output', 1010, 1990), 60.0, 'counts')
  check_step('scheduling', run, 'value', 400.0, 0.0, 1000.0, 250.0, 5.0)
  # The price of no bump far from the setpoint: what P gave, the integral has to lose.
  check_step('scheduling', run, 'value', 800.0, 1000.0, 2000.0, 250.0, 18.0)
  check_step('scheduling, back', run, 'value', 400.0, 2000.0, 3000.0, 250.0, 5.0)
end

INTERPOLATED_GOALS = [800.0, 200.0, 950.0, 150.0].freeze # each 4000 s, after one of 100

# Between two setpoints the valve moves by what the level asks for, whatever the gains become.
# A valve that is fully open decides how soon the higher levels are reached.
def check_interpolated(run)
  INTERPOLATED_GOALS.each_with_index do |goal, i|
    from = 4000.0 * (i + 1)
    check_step('interpolated', run, 'value', goal, from, from + 4000.0, 2000.0, 1.0, 's')
    Report.at_most("interpolated: largest step of the valve after the one to #{goal.to_i}",
                   largest_change(run, 'output', from + 5, from + 4000.0), 80.0, 'counts')
  end
  { 'with' => ['value', 'output'], 'low' => %w[low output_low], 'high' => %w[high output_high] }.each do |which, (value, output)|
    Report.number("interpolated_#{which}_over", INTERPOLATED_GOALS.each_with_index.map do |goal, i|
      values = run.values(value, 4000.0 * (i + 1), 4000.0 * (i + 2))
      values.first < goal ? values.max - goal : goal - values.min
    end.max)
    Report.number("interpolated_#{which}_travel", run.values(output).each_cons(2).sum { |a, b| (b - a).abs })
  end
  numbers = Report.numbers['recipes']
  Report.at_least('gains of level 100: farthest beyond', numbers['interpolated_low_over'], 20.0, 'counts')
  Report.at_most('interpolated: travel of the valve, of that with the gains of level 1000',
                 numbers['interpolated_with_travel'] / numbers['interpolated_high_travel'], 0.25)
end

def check_sample_time(run)
  Report.at_most('sample time: the output changes at once by',
                 largest_change(run, 'output', 599.0, 601.0 - 0.95), 1.0, 'counts')
  { 0.0 => 600.0, 300.0 => 400.0, 600.0 => 600.0, 900.0 => 400.0 }.each do |from, target|
    check_step("sample time, from #{from.to_i} s", run, 'value', target, from, from + 300.0, 120.0, 20.0, 's')
  end
end

def check_menu(rows)
  good = { 'an empty EEPROM' => 0, 'kp of 200 typed' => 0, 'kp of 1.8 and ki of 0.6 typed' => 1,
           'after a reset' => 1, 'after a reset with a bit of the EEPROM lost' => 0 }
  rows.each do |row|
    Report.exactly("menu: #{row['what']}: good", row['good'].to_i, good.fetch(row['what']))
    Report.at_most("menu: #{row['what']}: settles after", row['settled'].to_i,
                   row['good'].to_i == 1 ? 150 : 1999, 'steps')
  end
end

def check_interrupt(run, what = 'interrupt')
  check_step(what, run, 'value', 600.0, 0.0, 500.0, 250.0, 5.0)
  check_step(what, run, 'value', 700.0, 500.0, 1000.0, 250.0, 5.0)
end

def check_freertos(run)
  check_interrupt(run, 'FreeRTOS')
end

def check_zephyr(run)
  check_interrupt(run, 'Zephyr')
end

def check_converter(run)
  check_step('converter', run, 'value', 45_000.0, 0.0, 1000.0, 400.0, 5.0)
  check_step('converter', run, 'value', 20_000.0, 1000.0, 2000.0, 400.0, 5.0)
end

def check_sensor_break(run)
  Report.at_most('sensor break: 600 within 2 % after', run.settling('value', 600.0, 12.0, 260.0), 170.0, 's')
  Report.exactly('sensor break: drive while it is broken', run.values('output', 200.0, 260.0).max, 0.0)
  Report.exactly('sensor break: drive in the second after', run.values('output', 260.0, 260.9).max, 0.0)
  Report.at_most('sensor break: largest step of the drive after', largest_change(run, 'output', 260.0, 599.0), 10.0, 'counts')
  Report.at_most('sensor break: overshoot after', run.values('value', 260.0).max - 600.0, 30.0, 'counts')
end

# RMS errors once it is warm, in degrees, by what the readings go through.
def check_spikes(run)
  errors = %w[calm plain filter with with_filter with_low].to_h do |column|
    values = run.values(column, 300.0)
    [column, Math.sqrt(values.sum { |v| (v - 320.0)**2 } / values.size)]
  end
  errors.each { |column, error| Report.number("spikes_#{column}_rms", error) }
  Report.at_most('spikes: error with the median', errors['with'], 0.1, 'degrees')
  Report.at_most('spikes: error with the median and a filter', errors['with_filter'], 0.1, 'degrees')
  Report.at_most('spikes: the same, the wild readings low', errors['with_low'], 0.1, 'degrees')
  Report.at_least('spikes: error without either', errors['plain'], 0.2, 'degrees')
  Report.at_least('spikes: error with the filter alone', errors['filter'], 2.0, 'degrees')
end

LIMIT_EVENT = 1500.0 # the setpoint changes, or the load goes away
LIMIT_RULES = { 'held' => '`fixpid_pid`', 'drift' => 'recipe, n', 'slow' => 'recipe, n + 1', 'clamped' => 'integral clamped' }.freeze
# The last setpoint of each.
LIMIT_SCENARIOS = { 'step' => 700.0, 'back_300' => 300.0, 'back_700' => 700.0, 'back_900' => 900.0, 'back_1000' => 1000.0,
                    'short' => 500.0, 'load' => 700.0, 'integrator' => 700.0, 'at_1000' => 600.0, 'at_1023' => 600.0 }.freeze
LIMIT_HARMS = %w[load integrator at_1000 at_1023].freeze # where holding the integral is better

# Steps until the loop stays within 2 % of the setpoint, and the sum of its errors.
def check_back_from_limit(run)
  sums = LIMIT_SCENARIOS.to_h do |scenario, target|
    [scenario, LIMIT_RULES.keys.to_h { |rule| [rule, limit_sum(run, scenario, rule, target)] }]
  end
  LIMIT_SCENARIOS.each_key { |scenario| check_limit_rules(scenario, sums[scenario]) }
  Report.at_least('short: sum of errors with n + 1, of that with n', sums['short']['slow'] / sums['short']['drift'], 1.5)
  Report.at_most('at_1023: sum of errors with n + 1, of that with n', sums['at_1023']['slow'] / sums['at_1023']['drift'], 0.7)
  { 'back_300' => [90, 134], 'back_700' => [21, 27], 'back_900' => [8, 27], 'back_1000' => [0, 39] }.each do |scenario, (drift, held)|
    Report.at_most("#{scenario}, recipe: within 2 % after", limit_steps(scenario, 'drift'), drift, 'steps')
    Report.exactly("#{scenario}, fixpid_pid: within 2 % after", limit_steps(scenario, 'held'), held, 'steps')
  end
end

# As it is told: the recipe is better, or not.
def check_limit_rules(scenario, sums)
  if LIMIT_HARMS.include?(scenario)
    Report.at_least("#{scenario}: sum of errors with the recipe, of that without", sums['drift'] / sums['held'], 1.1)
  else
    Report.at_most("#{scenario}: sum of errors with the recipe, of that without", sums['drift'] / sums['held'], 0.98)
  end
end

def limit_sum(run, scenario, rule, target)
  errors = run.values("#{scenario}_#{rule}", LIMIT_EVENT).map { |v| (v - target).abs }
  Report.number("limit_#{scenario}_#{rule}_settled", (errors.rindex { |error| error > 0.02 * target } || -1) + 1)
  Report.number("limit_#{scenario}_#{rule}_errors", errors.sum)
  errors.sum
end

def limit_steps(scenario, rule)
  Report.numbers['recipes']["limit_#{scenario}_#{rule}_settled"]
end

# The supply is weak from 2 s to 3.5 s.
def check_two_rates(run)
  peaks = %w[with without].to_h { |which| [which, run.values(which, 3.5).max] }
  settled = %w[with without].to_h { |which| [which, run.settling(which, 500.0, 10.0, 3.5)] }
  limited, last = run.values('limited'), run.values('last')
  numbers = { 'limited' => limited.count(&:positive?), 'last' => last.count(&:positive?) }
  peaks.each { |which, peak| numbers["#{which}_peak"] = peak }
  settled.each { |which, seconds| numbers["#{which}_settled"] = 1000.0 * seconds }
  numbers.each { |name, number| Report.number("two_rates_#{name}", number) }
  Report.at_most('two rates: 500 within 2 % after', run.settling('with', 500.0, 10.0, 0.0, 2.0), 0.15, 's')
  Report.at_most('two rates: peak after the weak supply', peaks['with'], 505.0, 'counts')
  Report.at_most('two rates: within 2 % after', settled['with'], 0.1, 's')
  Report.at_least('two rates without flags: peak', peaks['without'], 580.0, 'counts')
  Report.at_least('two rates: steps of ten in which the last flag hides that others were set',
                  limited.zip(last).count { |any, one| any.positive? && one.zero? }, 1)
end

# From one of the two to the other.
def changes_of_side(run, suffix, from, to)
  heat, cool = %w[heat cool].map { |name| run.values("#{name}#{suffix}", from, to) }
  sides = heat.zip(cool).filter_map { |hot, cold| hot.positive? ? 1 : (cold.positive? ? -1 : nil) }
  sides.each_cons(2).count { |a, b| a != b }
end

# Only heat from 80 000 s, only cool from 85 000, off from 90 000, both from 95 000. From 40 000
# to 80 000 the surroundings cross the setpoint 11 times.
def check_heat_cool(run)
  changes = { 'with' => '', 'without' => '_without' }.transform_values { |suffix| changes_of_side(run, suffix, 40_000.0, 80_000.0) }
  changes.each { |which, count| Report.number("heat_cool_#{which}_changes", count) }
  far = run.values('value', 3600.0, 80_000.0).map { |v| (v - 25.0).abs }
  Report.number('heat_cool_far', far.max)
  Report.exactly('heat and cool: steps in which one is on within 60 of the other', run.values('fights').sum, 0.0)
  Report.exactly('heat and cool: cooler while it only heats', run.values('cool', 80_000.0, 85_000.0).sum, 0.0)
  Report.exactly('heat and cool: heater while it only cools', run.values('heat', 85_000.0, 90_000.0).sum, 0.0)
  Report.exactly('heat and cool: both while it is off', run.values('heat', 90_000.0, 95_000.0).sum + run.values('cool', 90_000.0, 95_000.0).sum, 0.0)
  Report.at_most('heat and cool: farthest from 25 degrees', far.max, 2.0, 'degrees')
  Report.at_most('heat and cool: off again, on again: within 2 degrees after', run.settling('value', 25.0, 2.0, 95_000.0), 900.0, 's')
  Report.at_most('heat and cool: changes of side in a calm room', changes['with'], 12)
  Report.at_least('and without the gap', changes['without'], 50)
end

# More heat from 10 000 s.
def check_least_output(run)
  far = { 'with' => 'value', 'tracked' => 'tracked' }.transform_values { |column| run.values(column, 1000.0).map { |v| (v - 50.0).abs }.max }
  calm = run.values('value', 1000.0, 10_000.0).map { |v| (v - 50.0).abs }.max
  far.each { |which, degrees| Report.number("least_output_#{which}_far", degrees) }
  Report.number('least_output_calm', calm)
  Report.at_most('least output: farthest from 50 degrees at little heat', calm, 2.0, 'degrees')
  Report.at_most('least output: farthest when more comes', far['with'], 6.0, 'degrees')
  Report.at_most('least output: 50 degrees within 1 after', run.settling('value', 50.0, 1.0, 10_000.0), 180.0, 's')
  Report.at_least('least output, tracked: farthest', far['tracked'], 100.0, 'degrees')
  Report.at_most('least output: starts of the fan in an hour',
                 run.values('output', 1000.0, 10_000.0).each_cons(2).count { |a, b| a.zero? && b.positive? } * 0.4, 150)
end

SOAKS = { 150.0 => 90.0, 220.0 => 40.0 }.freeze # degrees and seconds

def check_ramp_soak(run)
  SOAKS.each do |degrees, seconds|
    near = %w[value value_without].map { |column| run.values(column).count { |v| (v - degrees).abs <= 8.0 } }
    near.zip(%w[with without]) { |count, which| Report.number("ramp_soak_#{which}_#{degrees.to_i}", count) }
    Report.at_least("ramp and soak: within 8 degrees of #{degrees.to_i} for", near[0], seconds, 's')
  end
  Report.at_most('ramp and soak: peak of 220', run.values('value').max, 222.0, 'degrees')
  Report.at_most('ramp and soak: farthest from the setpoint',
                 run.values('value').zip(run.values('setpoint')).map { |a, b| (a - b).abs }.max, 11.0, 'degrees')
  Report.at_most('ramp and soak: at 60 degrees, within 2, after', run.settling('value', 60.0, 2.0), 1100.0, 's')
  Report.at_most('ramp and soak without hold-back: peak of 220', run.values('value_without').max, 200.0, 'degrees')
end

def check_angle(run)
  Report.at_most('angle: -400 within 2 % of the step after', run.settling('value', -400.0, 16.0, 1.0, 2.0), 0.7, 's')
  Report.at_most('angle: beyond -400', 100.0 * (-400.0 - run.values('value', 1.0).min) / 800.0, 5.0, '%')
  Report.exactly('angle: outputs that differ at one of 4096 places', run.values('others').sum, 0.0)
  Report.at_least('angle with fixpid_pid_step: farthest', run.peak('without'), 60_000.0, 'counts')
end

# The sensor slips off at 400 s and is put back at 700 s; the relay stays on from 1200 s.
def check_guard(run)
  off = run.times.zip(run.values('output')).find { |time, output| time > 401.0 && output.zero? }.first - 400.0
  cut = run.times.zip(run.values('supply')).find { |_, supply| supply.zero? }.first - 1200.0
  { 'slipped' => [400.0, 1000.0], 'shut' => [1200.0, Float::INFINITY] }.each do |what, (from, to)|
    { 'with' => 'value', 'without' => 'without' }.each { |which, column| Report.number("guard_#{what}_#{which}", run.values(column, from, to).max) }
  end
  Report.number('guard_off_s', off)
  Report.number('guard_cut_s', cut)
  Report.at_most('guard: heater off after the sensor slipped', off, 40.0, 's')
  Report.exactly('guard: output until it is acknowledged', run.values('output', 400.0 + off, 700.0).max, 0.0)
  Report.at_most('guard: hottest of a setpoint of 60', run.values('value', 400.0, 1000.0).max, 80.0, 'degrees')
  Report.at_most('guard: acknowledged, 60 within 2 % after', run.settling('value', 60.0, 1.2, 700.0, 1200.0), 400.0, 's')
  Report.at_most('guard: supply cut after the relay stays on', cut, 60.0, 's')
  Report.at_most('guard: hottest then', run.values('value', 1200.0).max, 85.0, 'degrees')
  Report.at_least('without a guard: hottest', run.values('without').max, 110.0, 'degrees')
end

# A picture: measurements on the left axis; with `output` what drives them on the right one,
# which has the lowest third. `x` and `y` are ranges of what is drawn, `texts` the names
# beside the curves. It is as wide as a phone can show without making its letters small.
def recipe_picture(name, title, curves, x, y, labels, texts, output = nil)
  room = y[1] - y[0]
  low = output ? y[0] - 0.5 * room : y[0] - 0.05 * room
  plot = Plot.new(recipe_name(name), title, width: 540, height: 270,
                  margins: { left: 0.135, right: output ? 0.885 : 0.965, top: 0.885, bottom: 0.17 })
  plot.panel(0, 0, curves + (output ? [output.curve] : []),
             ["set xrange [#{x.join(':')}]", "set ytics (#{recipe_ticks(*y).join(', ')})", "set yrange [#{low}:#{y[1] + 0.05 * room}]",
              "set xlabel '#{labels[0]}' offset 0,0.4", "set ylabel '#{labels[1]}' offset 1.3,0",
              *texts, *(output ? output.axis : [])])
  plot.draw
end

# Of its picture.
def recipe_name(recipe)
  "recipes-#{recipe.tr('_', '-')}"
end

# Some even numbers from low to high, none of which is of the output's part.
def recipe_ticks(low, high)
  power = 10.0**Math.log10((high - low) / 4.0).floor
  step = [1, 2, 5, 10].map { |one| one * power }.find { |one| one >= (high - low) / 5.0 }
  ((low / step).ceil..(high / step).floor).map { |i| (i * step).then { |at| at == at.round ? at.round : at.round(3) } }
end

OutputAxis = Struct.new(:run, :column, :low, :high, :label, :text) do
  def curve
    "#{Plot.curve(run, column, Plot::OUTPUT, width: 1.0)} axes x1y2"
  end

  # Zero and the ends have a mark; its name stands at `text`, in its own numbers.
  def axis
    room = high - low
    ["set y2range [#{low - 0.1 * room}:#{low + 4.0 * room}]", 'set border 11',
     "set y2tics (#{[low, 0, high].uniq.join(', ')}) out scale 0.6", "set y2label '#{label}' offset -1.2,0",
     Plot.text(label.sub(/,.*/, ''), text[0], "second #{text[1]}", Plot::OUTPUT)]
  end
end

# A stretch of time in which something is otherwise.
def recipe_stretch(number, from, to)
  "set object #{number} rectangle from #{from}, graph 0 to #{to}, graph 1 behind fillcolor '#{Plot::AREA}' fillstyle solid noborder"
end

STEPS_COUNTS = ['steps', 'counts'].freeze
SECONDS_COUNTS = ['time, s', 'counts'].freeze
SECONDS_DEGREES = ['time, s', 'temperature, °C'].freeze

def draw_recipes(runs)
  RECIPE_PICTURES.each { |name| send("draw_#{name}", runs.fetch(name)) }
end

RECIPE_PICTURES = %w[cascade two_rates override ramp ramp_soak ssr from_cold tune_ssr retune heat_cool least_output
                     angle guard dead_band sensor_break spikes back_from_limit scheduling interpolated].freeze

def with_and_without(run)
  [Plot.curve(run, 'without', Plot::WITHOUT), Plot.curve(run, 'with', Plot::MEASUREMENT), Plot.setpoint(run)]
end

# And what is drawn below them.
def value_and_setpoint(run, *below)
  [*below, Plot.curve(run, 'value', Plot::MEASUREMENT), Plot.setpoint(run)]
end

def without_text(x, y, words = 'without')
  Plot.text(words, x, y, Plot::WITHOUT)
end

def with_text(words, x, y)
  Plot.text(words, x, y, Plot::MEASUREMENT)
end

def setpoint_text(x, y)
  Plot.text('setpoint', x, y, Plot::SETPOINT)
end

def draw_cascade(run)
  recipe_picture('cascade', 'Cascade: the supply of the inner loop is weak', with_and_without(run),
                 [1500, 6000], [250, 580], STEPS_COUNTS,
                 [recipe_stretch(1, 2000, 3500), Plot.text('weak supply', 2750, 400, Plot::TEXT, 'center'), setpoint_text(1560, 520),
                  without_text(4080, 565, 'without tracking'), with_text('with tracking', 3870, 455)])
end

def draw_two_rates(run)
  recipe_picture('two_rates', 'Cascade at two rates: the supply is weak', with_and_without(run),
                 [1.5, 4.5], [440, 600], ['time, s', 'speed, counts'],
                 [recipe_stretch(1, 2, 3.5), Plot.text('weak supply', 2.75, 530, Plot::TEXT, 'center'), setpoint_text(1.54, 510),
                  without_text(3.68, 580, 'without tracking'), with_text('with tracking', 3.6, 470)])
end

def draw_override(run)
  recipe_picture('override', 'Override: the pressure is limited while a filter is clogged',
                 [Plot.curve(run, 'pressure_without', Plot::WITHOUT), Plot.curve(run, 'pressure', Plot::MEASUREMENT),
                  Plot.curve(run, 'flow', Plot::SECOND), Plot.setpoint(nil, '600'), "700 notitle linecolor '#{Plot::LIMIT}' dashtype 3"],
                 [0, 4000], [0, 880], STEPS_COUNTS,
                 [recipe_stretch(1, 1000, 2500), Plot.text('clogged', 1750, 90, Plot::TEXT, 'center'), without_text(1230, 830, 'pressure without tracking'),
                  Plot.text('limit', 3940, 745, Plot::LIMIT_TEXT, 'right'), setpoint_text(3130, 555), with_text('pressure', 1530, 635),
                  Plot.text('flow', 1530, 375, Plot::SECOND)])
end

def draw_ramp(run)
  recipe_picture('ramp', 'A ramp of the setpoint, and a slow valve', with_and_without(run),
                 [0, 450], [0, 720], SECONDS_COUNTS,
                 [without_text(95, 690, 'without ramp and tracking'), with_text('with both', 190, 330), setpoint_text(330, 555)])
end

def draw_ramp_soak(run)
  recipe_picture('ramp_soak', 'Ramp and soak that waits for the oven',
                 value_and_setpoint(run, Plot.curve(run, 'value_without', Plot::WITHOUT)),
                 [0, 1199], [20, 225], SECONDS_DEGREES,
                 [without_text(40, 200, 'without waiting'), with_text('temperature', 560, 185), setpoint_text(430, 118)])
end

def draw_ssr(run)
  recipe_picture('ssr', 'A heater behind a solid-state relay', value_and_setpoint(run),
                 [0, 300], [0, 1000], SECONDS_COUNTS, [with_text('temperature', 40, 650), setpoint_text(240, 885)],
                 OutputAxis.new(run, 'on', 0, 1, 'relay, on is 1', [10, 1.35]))
end

def draw_from_cold(run)
  tuned = run.times[run.values('tuning').index(0.0)]
  recipe_picture('from_cold', 'A boiler that tunes itself while it heats up', value_and_setpoint(run),
                 [0, 800], [0, 85], ['time, s', 'degrees above the room'],
                 [recipe_stretch(1, 0, tuned), recipe_stretch(2, 500, 560), Plot.text('tunes', 4, 40),
                  Plot.text('cold water', 530, 40, Plot::TEXT, 'center'), with_text('temperature', 150, 50), setpoint_text(10, 77)],
                 OutputAxis.new(run, "(column('output')/10)", 0, 100, 'output, %', [600, 60]))
end

def draw_tune_ssr(run)
  recipe_picture('tune_ssr', 'A heater tuned behind its solid-state relay',
                 value_and_setpoint(run),
                 [0, 1499], [0, 1350], SECONDS_COUNTS, [with_text('temperature', 300, 1260), setpoint_text(1150, 1110)],
                 OutputAxis.new(run, "(10*column('on'))", 0, 100, 'relay on, %', [750, 65]))
end

def draw_retune(run)
  recipe_picture('retune', 'Retuned in operation, then a load',
                 [Plot.curve(run, 'old', Plot::WITHOUT, width: 1.2), Plot.curve(run, 'retuned', Plot::MEASUREMENT), Plot.setpoint(nil, '500')],
                 [800, 5000], [435, 540], STEPS_COUNTS,
                 [with_text('the experiment', 1150, 532), with_text('new gains', 4150, 510),
                  without_text(4250, 452, 'old gains'), setpoint_text(2600, 505), Plot.text('load', 4000, 520, Plot::TEXT, 'center')])
end

def draw_heat_cool(run)
  recipe_picture('heat_cool', 'Heat and cool with a gap, in a calm room',
                 value_and_setpoint(run, Plot.curve(run, 'surroundings', Plot::DISTURBANCE), Plot.curve(run, 'value_without', Plot::WITHOUT, width: 1.0)),
                 [50_000, 60_000], [24, 26.1], SECONDS_DEGREES,
                 [Plot.text('surroundings', 52_900, 25.95, Plot::LIMIT_TEXT), without_text(50_950, 24.25), with_text('temperature', 53_000, 24.25),
                  "#{setpoint_text(57_050, 25.2)} boxed", 'set style textbox opaque noborder margins 0.3,0.2'],
                 OutputAxis.new(run, "(10*(column('heat')-column('cool')))", -100, 100, 'cool and heat, %', [50_100, 70]))
end

def draw_least_output(run)
  recipe_picture('least_output', 'The least output that turns the fan',
                 value_and_setpoint(run, Plot.curve(run, 'tracked', Plot::WITHOUT)),
                 [9000, 11_000], [40, 185], SECONDS_DEGREES,
                 [without_text(9050, 90, 'by fixpid\\_pid\\_track'), with_text('temperature', 10_480, 66), setpoint_text(9050, 62),
                  Plot.text('more heat', 9980, 150, Plot::TEXT, 'right'), "set arrow from 10000, graph 0 to 10000, graph 1 nohead dashtype 3 linecolor '#{Plot::DISTURBANCE}'"],
                 OutputAxis.new(run, "(column('output')/10)", 0, 100, 'fan, %', [9050, 50]))
end

def draw_angle(run)
  recipe_picture('angle', 'An angle across the end of its counts',
                 value_and_setpoint(run, Plot.curve(run, 'without', Plot::WITHOUT)),
                 [0, 2], [-600, 600], SECONDS_COUNTS,
                 [without_text(0.06, -500, 'by fixpid\\_pid\\_step'), with_text('angle', 0.14, 250), setpoint_text(1.03, 440)],
                 OutputAxis.new(run, "(column('output')/10)", -100, 100, 'drive, %', [0.4, 55]))
end

def draw_guard(run)
  recipe_picture('guard', 'Guard: a sensor off its place, then a relay shut',
                 value_and_setpoint(run, Plot.curve(run, 'without', Plot::WITHOUT), Plot.curve(run, 'reading', Plot::SECOND, width: 1.0)),
                 [300, 1999], [20, 125], SECONDS_DEGREES,
                 [recipe_stretch(1, 400, 700), recipe_stretch(2, 1200, 1999), Plot.text('sensor off', 550, -23, Plot::TEXT, 'center'),
                  Plot.text('relay shut', 1600, -23, Plot::TEXT, 'center'), without_text(790, 113), with_text('temperature', 1330, 70),
                  Plot.text('reading', 470, 10, Plot::SECOND), setpoint_text(930, 67)],
                 OutputAxis.new(run, "(column('output')/2.55)", 0, 100, 'output, %', [930, 60]))
end

def draw_dead_band(run)
  recipe_picture('dead_band', 'Dead band: the valve stands still',
                 [Plot.curve(run, 'valve_without', Plot::WITHOUT, width: 0.8), Plot.curve(run, 'with', Plot::MEASUREMENT, width: 3.0),
                  Plot.curve(run, 'valve', Plot::OUTPUT), Plot.setpoint(nil, '600')],
                 [1000, 1990], [592, 607], STEPS_COUNTS,
                 [without_text(1020, 606, 'valve without the band'), with_text('measurement and', 1020, 595.5), Plot.text('valve with it', 1340, 595.5, Plot::OUTPUT),
                  setpoint_text(1800, 606)])
end

def draw_sensor_break(run)
  recipe_picture('sensor_break', 'A broken sensor, and the drive off until it reads again',
                 value_and_setpoint(run, Plot.curve(run, 'reading', Plot::SECOND)),
                 [0, 599], [100, 1040], SECONDS_COUNTS,
                 [recipe_stretch(1, 200, 260), Plot.text('reading', 270, 960, Plot::SECOND), with_text('temperature', 325, 400), setpoint_text(10, 680)],
                 OutputAxis.new(run, "(column('output')/2.55)", 0, 100, 'drive, %', [30, 80]))
end

def draw_spikes(run)
  recipe_picture('spikes', 'One reading in a hundred is 473 degrees',
                 [Plot.curve(run, 'filter', Plot::WITHOUT), Plot.curve(run, 'with', Plot::MEASUREMENT), Plot.setpoint(nil, '320')],
                 [1000, 1100], [311, 332], SECONDS_DEGREES,
                 [without_text(1003, 330, 'derivative filter'), with_text('median of three', 1003, 313)])
end

def draw_back_from_limit(run)
  recipe_picture('back_from_limit', 'Back from a setpoint out of reach',
                 [Plot.curve(run, 'back_900_held', Plot::WITHOUT), Plot.curve(run, 'back_900_drift', Plot::MEASUREMENT),
                  Plot.setpoint(nil, '(x < 1500 ? 1100 : 900)')],
                 [1480, 1580], [850, 1110], STEPS_COUNTS,
                 [without_text(1530, 865, 'as it is'), with_text('with the recipe', 1508, 930), setpoint_text(1482, 1085)])
end

def draw_scheduling(run)
  recipe_picture('scheduling', 'Gains that change at 500, without a bump',
                 value_and_setpoint(run),
                 [0, 2999], [0, 950], STEPS_COUNTS, [with_text('measurement', 1130, 890), setpoint_text(400, 460)],
                 OutputAxis.new(run, "(column('output')/10)", 0, 100, 'output, %', [100, 70]))
end

def draw_interpolated(run)
  recipe_picture('interpolated', 'A cone-shaped tank, its gains by a table',
                 value_and_setpoint(run, Plot.curve(run, 'low', Plot::WITHOUT)),
                 [8000, 19_999], [100, 1080], ['time, s', 'level, counts'],
                 [without_text(12_700, 1035, 'gains of level 100'), with_text('by the level', 12_900, 600), setpoint_text(9400, 285)],
                 OutputAxis.new(run, "(column('output')/10)", 0, 100, 'valve, %', [8900, 75]))
end

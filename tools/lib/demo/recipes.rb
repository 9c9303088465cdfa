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
  check_cascade(cascade = recipe('cascade', 5999))
  check_override(override = recipe('override', 3999))
  check_ramp(ramp = recipe('ramp', 599.9))
  check_ssr(ssr = recipe('ssr', 1799.9))
  check_dead_band(dead_band = recipe('dead_band', 3999))
  check_scheduling(recipe('scheduling', 2999))
  check_sample_time(recipe('sample_time', 1199.9))
  check_menu(Loops.read(Host.recipe('menu', 'recipes-menu.txt'), 5))
  check_interrupt(recipe('interrupt', 999))
  check_converter(recipe('converter', 1999))
  check_sensor_break(sensor = recipe('sensor_break', 599.9))
  draw_recipes(cascade, override, ramp, ssr, dead_band, sensor)
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
  Report.at_most('ramp: peak of 600', run.values('with').max, 604.0)
  Report.at_least('and without ramp and tracking', run.values('without').max, 690.0)
  Report.at_most('ramp: fastest rise in a second',
                 run.values('with').each_slice(10).map(&:first).each_cons(2).map { |a, b| b - a }.max, 2.5, 'counts')
end

def check_ssr(run)
  on = run.values('on')
  settled = 900.0
  Report.at_most('SSR: mean of the temperature off its setpoint',
                 (run.mean('value', settled, 1800.0) - 960.0).abs, 1.0, 'counts')
  Report.at_most('SSR: ripple', run.swing('value', settled, 1800.0), 9.0, 'counts')
  Report.at_most('SSR: switchings an hour',
                 on.each_cons(2).count { |a, b| a != b } * 2, 1440)
  Report.at_least('SSR: shortest pulse', on.chunk_while { |a, b| a == b }.select { |c| c[0] == 1.0 }.map(&:size).min, 2, 'steps')
end

# Changes of the valve once the process has settled.
def moves(run, column)
  run.values(column, 1000.0, 2000.0).each_cons(2).count { |a, b| a != b }
end

def check_dead_band(run)
  Report.at_most('dead band: moves of the valve in 1000 steps', moves(run, 'valve'), 300)
  Report.at_least('and without', moves(run, 'valve_without'), 700)
  Report.at_most('dead band: offset', (run.mean('with', 1500.0, 2000.0) - 600.0).abs, 5.0, 'counts')
end

def check_scheduling(run)
  Report.at_most('scheduling: largest step of the output but at new setpoints',
                 largest_change(run, 'output', 1010, 1990), 60.0, 'counts')
  Report.at_most('scheduling: 800 within 2 % after', run.settling('value', 800.0, 16.0, 1000, 2000), 250.0, 'steps')
end

def check_sample_time(run)
  Report.at_most('sample time: the output changes at once by',
                 largest_change(run, 'output', 599.0, 601.0 - 0.95), 1.0, 'counts')
  { 300.0 => 400.0, 600.0 => 600.0, 900.0 => 400.0 }.each do |from, target|
    Report.at_most("sample time: #{target.to_i} at #{from.to_i} s within 2 % after",
                   run.settling('value', target, 8.0, from, from + 300.0), 120.0, 's')
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

def check_interrupt(run)
  Report.at_most('interrupt: 600 within 2 % after', run.settling('value', 600.0, 12.0, 0.0, 500.0), 250.0, 'steps')
  Report.at_most('interrupt: 700 within 2 % after', run.settling('value', 700.0, 14.0, 500.0), 250.0, 'steps')
end

def check_converter(run)
  Report.at_most('converter: 45000 within 2 % after', run.settling('value', 45_000.0, 900.0, 0.0, 1000.0), 400.0, 'steps')
  Report.at_most('converter: 20000 within 2 % after', run.settling('value', 20_000.0, 400.0, 1000.0), 400.0, 'steps')
end

def check_sensor_break(run)
  Report.exactly('sensor break: drive while it is broken', run.values('output', 200.0, 260.0).max, 0.0)
  Report.exactly('sensor break: drive in the second after', run.values('output', 260.0, 260.9).max, 0.0)
  Report.at_most('sensor break: largest step of the drive after', largest_change(run, 'output', 260.0, 599.0), 10.0, 'counts')
  Report.at_most('sensor break: overshoot after', run.values('value', 260.0).max - 600.0, 30.0, 'counts')
end

def recipe_panel(plot, row, column, title, curves, *settings)
  plot.panel(row, column, curves, ["set title '#{title}' font ',11' offset 0,-0.6", 'set key bottom right', *settings])
end

def draw_recipes(cascade, override, ramp, ssr, dead_band, sensor)
  plot = Plot.new('recipes', 'Recipes: what is built around a controller', height: 900, columns: [1.0, 1.0],
                                                                           rows: [1.0, 1.0, 1.0], gap_y: 0.075)
  compare(plot, 0, 0, 'cascade: weak supply from 2000 to 3500', cascade, %w[with without], 'set xrange [1500:6000]')
  recipe_panel(plot, 0, 1, 'override: filter clogged from 1000 to 2500',
               [Plot.curve(override, 'pressure_without', 'pressure without track', Plot::GREY),
                Plot.curve(override, 'pressure', 'pressure, at most 700', Plot::RED),
                Plot.curve(override, 'flow', 'flow, 600', Plot::BLUE)], 'set yrange [0:950]')
  compare(plot, 1, 0, 'ramp of the setpoint and a slow valve', ramp, %w[with without], 'set xrange [0:450]')
  recipe_panel(plot, 1, 1, 'heater behind a solid-state relay',
               [Plot.curve(ssr, 'value', 'temperature', Plot::RED), Plot.curve(ssr, 'duty', 'duty of 1000', Plot::GREY),
                Plot.curve(ssr, "(100*column('on'))", 'relay', Plot::BLUE, width: 0.8)], 'set xrange [0:300]', 'set yrange [-20:1450]', 'set key top right')
  recipe_panel(plot, 2, 0, 'dead band: the valve',
               [Plot.curve(dead_band, 'valve_without', 'without', Plot::GREY, width: 0.8),
                Plot.curve(dead_band, 'valve', 'with', Plot::BLUE)], 'set xrange [1000:1990]', 'set yrange [585:615]',
               "set xlabel 'steps'")
  recipe_panel(plot, 2, 1, 'broken sensor from 200 to 260 s',
               [Plot.curve(sensor, 'reading', 'reading', Plot::GREY), Plot.curve(sensor, 'value', 'temperature', Plot::RED),
                Plot.curve(sensor, 'output', 'drive', Plot::BLUE)], "set xlabel 'time, s'", 'set yrange [-20:1450]', 'set key top right')
  plot.draw
end

def compare(plot, row, column, title, run, columns, *settings)
  colors = [Plot::BLUE, Plot::GREY]
  recipe_panel(plot, row, column, title,
               columns.each_with_index.map { |name, i| Plot.curve(run, name, name, colors[i]) }.reverse, *settings)
end

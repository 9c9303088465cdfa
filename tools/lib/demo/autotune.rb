# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The experiment at 80 C, later 100 C and the door.
TUNE_SCENE = { seconds: 170, setpoint_at: 100, setpoint_then: 100, door_at: 140,
               door_for: 5 }.freeze
HOTTER_C = 100.0
HOTTER_AT_S = 100.0
TUNE_DOOR_S = 140.0
TUNE_DOOR_END_S = 145.0
TUNE_END_S = 170.0
HOTTER_BAND_C = 0.02 * 80.0 # of what it is above the air
# 60 K through 2.5 K/W is 24 W of 160.
HOLDING_COUNTS = 24.0 / 160.0 * 1023.0
RULES = { 'PI' => 'autotune', 'PID' => 'autotune_pid' }.freeze
# With a setpoint weight of 1; half of all plants overshoot by a quarter of the step.
TUNED_OVERSHOOT = { 'PI' => 10.0, 'PID' => 15.0 }.freeze
DONE = 2 # FIXPID_AUTOTUNE_DONE

# What a plant's loop with the found gains may overshoot, in percent of the
# setpoint: both rules are chosen for loops that hardly do. Where the plant
# integrates, a controller's integral has to be taken back after each setpoint, by an
# error of the other sign.
TUNED_PLANTS = {
  'lag 50, dead time 3' => 5.0, 'lags 20 and 10' => 5.0, 'lag 10, dead time 50' => 5.0,
  'integrator, dead time 4' => 15.0, 'servo: integrator, lag 20' => 15.0,
  'oven, lag 2000, dead time 40' => 5.0
}.freeze

def autotune
  runs = RULES.transform_values do |program|
    Host.run(program, program, every: 0.02, **TUNE_SCENE)
  end
  RULES.each { |rule, program| tell_gains(rule, Host.printed(program)) }
  check_experiment(runs['PI'])
  check_progress(Host.printed(RULES.fetch('PI')), taken_over_s(runs['PI']))
  runs.each { |rule, run| check_tuned(rule, run) }
  check_tuned_plants(Loops.table('autotune', 12))
  check_failed_experiments(Loops.table('failures', 5))
  draw_autotune(runs)
end

# kp_q8, ki_q24, kd_q8 and the filter, as the program printed them.
def found_gains(text)
  pattern = /^gains: kp_q8 (\d+), ki_q24 (\d+), kd_q8 (\d+), filter (\d+)$/
  pattern.match(text)&.captures&.map(&:to_i) or
    raise Host::Failure, "the autotuner's program printed no gains"
end

def tell_gains(rule, text)
  kp, ki, kd, filter = found_gains(text)
  gains = { 'kp' => kp / 256.0, 'ki_per_s' => ki * 10.0 / (1 << 24),
            'kd_s' => (kd << filter) / 2560.0, 'filter' => filter }
  gains.each { |name, value| Report.number("#{rule.downcase}_#{name}", value) }
  Report.note(format('%<rule>s: kp %<kp>.2f, ' \
                     'ki %<ki>.3f /s, kd %<kd>.2f s, filter %<filter>d',
                     rule: rule, kp: gains['kp'], ki: gains['ki_per_s'],
                     kd: gains['kd_s'], filter: filter))
  Report.at_least("#{rule}: gains found, kp", gains['kp'], 1.0 / 256.0)
end

# When the controller took over: its integral holds the seed.
def taken_over_s(run)
  row = run.times.zip(run.values('integral')).find { |_, value| value != 0.0 }
  row ? row[0] : raise(Host::Failure, 'the experiment did not end')
end

def check_experiment(run)
  over = taken_over_s(run)
  Report.number('experiment_s', over)
  Report.at_most('the experiment ends after', over, 90.0, 's')
  Report.at_most('and swings from side to side by',
                 run.swing('temperature_c', over - 10.0, over), 15.0, 'C')
end

# Nothing disturbs this oven: no cycle is thrown away, and the time that is left is
# known as well as cycles of one relay are as long as those of the next.
def check_progress(text, over)
  told = text.scan(/^progress: ([\d.]+) s, phase \d, (\d+) %(?:, ([\d.]+) s left)?/)
  percents = told.map { |_, percent, _| percent.to_i }
  ends = told.filter_map { |at, _, left| at.to_f + left.to_f if left }
  ends.empty? and raise Host::Failure, 'the program told no time that is left'
  Report.exactly('progress: percentages that fall', percents.each_cons(2).count { |a, b| b < a }, 0)
  Report.exactly('progress: at last', percents.last, 100, '%')
  Report.at_most('progress: the end comes as told, within', ends.map { |at| (at - over).abs }.max, 0.1 * over, 's')
  Report.exactly("the experiment's status and reason", text[/, 100 %, (.*)/, 1], "status #{DONE}, reason 0")
end

def check_tuned(rule, run)
  over = taken_over_s(run)
  hotter = run.values('temperature_c', HOTTER_AT_S, TUNE_DOOR_S)
  Report.at_most("#{rule}: first drive, off what holds the temperature by",
                 (run.values('drive_counts', over + 0.1, over + 0.15)[-1] -
                  HOLDING_COUNTS).abs, 10.0, 'counts')
  Report.at_most("#{rule}: 80 C held within 2 %, after",
                 settled(run, over, HOTTER_AT_S), 10.0, 's')
  Report.at_most("#{rule}: to 100 C, overshoot of the step",
                 (hotter.max - HOTTER_C) * 5.0, TUNED_OVERSHOOT.fetch(rule),
                 '%')
  Report.at_most("#{rule}: 100 C within 2 % after",
                 run.settling('temperature_c', HOTTER_C, HOTTER_BAND_C,
                              HOTTER_AT_S, TUNE_DOOR_S), 15.0, 's')
  Report.at_most("#{rule}: door shut, within 2 % after",
                 run.settling('temperature_c', HOTTER_C, HOTTER_BAND_C,
                              TUNE_DOOR_END_S, TUNE_END_S), 20.0, 's')
end

def check_tuned_plants(rows)
  Report.number('plants', rows)
  TUNED_PLANTS.keys.product(RULES.keys).each do |plant, rule|
    row = rows.find { |one| one['plant'] == plant && one['rule'] == rule } or
      raise Host::Failure, "no row of #{plant}, #{rule}"
    check_tuned_plant("#{plant}, #{rule}", row)
  end
end

# A loop that takes longer than the experiment that tuned it was not worth it.
def check_tuned_plant(what, row)
  Report.exactly("#{what}: experiment's status", row['status'].to_i, DONE)
  Report.at_most("#{what}: overshoot", row['overshoot'].to_f, TUNED_PLANTS.fetch(row['plant']), '%')
  Report.at_most("#{what}: settles within 2 % after", row['settled'].to_i, row['steps'].to_i, 'steps')
  tell_values(what, row)
end

def check_failed_experiments(rows)
  rows.each do |row|
    Report.exactly("#{row['what']}: experiment's status", row['status'].to_i,
                   row['expected'].to_i)
    Report.exactly("#{row['what']}: result refused", row['refused'].to_i, 1)
  end
end

TUNE_COLORS = { 'PI' => Plot::SECOND, 'PID' => Plot::MEASUREMENT }.freeze

def draw_autotune(runs)
  plot = Plot.new('autotune', 'An oven that finds its own gains, by a relay ' \
                              'experiment from power-on',
                  height: 620, rows: [1.5, 1.0],
                  margins: { top: 0.925, bottom: 0.095 })
  autotune_temperature(plot, runs)
  autotune_drive(plot, runs)
  plot.draw
end

def autotune_marks(over, top, named)
  area = "set object 1 rectangle from 0, graph 0 to #{over}, graph #{top} " \
         "behind fillcolor '#{Plot::AREA}' fillstyle solid noborder"
  door = "set object 2 rectangle from #{TUNE_DOOR_S}, graph 0 to " \
         "#{TUNE_DOOR_END_S}, graph #{top} behind fillcolor '#{Plot::AREA}' " \
         'fillstyle solid noborder'
  labels = [['relay experiment', over / 2.0],
            ['its gains', (over + HOTTER_AT_S) / 2.0],
            ['another setpoint', (HOTTER_AT_S + TUNE_DOOR_S) / 2.0],
            ['door open', (TUNE_DOOR_S + TUNE_DOOR_END_S) / 2.0]]
           .map { |text, at| "set label \"#{text}\" at #{at}, graph 0.06 center" }
  [area, door, *(named ? labels : [])]
end

def autotune_temperature(plot, runs)
  over = taken_over_s(runs['PI'])
  curves = [Plot.setpoint(runs['PI'], 'setpoint_c')]
  curves += runs.map do |rule, run|
    Plot.curve(run, 'temperature_c', TUNE_COLORS[rule])
  end
  above = runs['PI'].values('temperature_c', 0.0, over).max - OVEN_SET_C
  plot.panel(0, 0, curves,
             [*autotune_marks(over, 0.86, true), Plot.text("#{above.round} °C above the setpoint", 8.5, 124, Plot::MEASUREMENT),
              Plot.text('setpoint', 101, 84, Plot::SETPOINT), Plot.text('PID', 150, 113, TUNE_COLORS['PID']),
              Plot.text('PI', 146.5, 95, TUNE_COLORS['PI']),
              "set xrange [0:#{TUNE_END_S}]",
              "set format x ''", 'set yrange [10:145]', 'set ytics 20',
              *y_label(0, 'temperature, °C')])
end

def autotune_drive(plot, runs)
  over = taken_over_s(runs['PI'])
  curves = runs.map do |rule, run|
    Plot.curve(run, "(column('drive_counts')/10.23)", TUNE_COLORS[rule],
               width: 1.2)
  end
  plot.panel(1, 0, curves,
             [*autotune_marks(over, 0.83, false), "set xrange [0:#{TUNE_END_S}]",
              "set xlabel 'time, s'", 'set yrange [0:130]', 'set ytics 25',
              *y_label(0, 'drive, %')])
end

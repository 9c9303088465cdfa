# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# From cold to 80 C, later 100 C and the door.
TUNE_SCENE = { seconds: 85, setpoint_at: 40, setpoint_then: 100, door_at: 60,
               door_for: 5 }.freeze
HOTTER_C = 100.0
HOTTER_AT_S = 40.0
TUNE_DOOR_S = 60.0
TUNE_DOOR_END_S = 65.0
TUNE_END_S = 85.0
HOTTER_BAND_C = 0.02 * 80.0 # of what it is above the air
RULES = { 'PI' => 'autotune_pi', 'PID' => 'autotune' }.freeze
DONE = 2 # FIXPID_AUTOTUNE_DONE and FIXPID_REACTION_DONE

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
  runs.each_value { |run| check_heat_up(run) }
  check_progress(Host.printed(RULES.fetch('PID')))
  runs.each { |rule, run| check_tuned(rule, run) }
  check_tuned_plants(Loops.table('autotune', 12))
  check_failed_experiments(Loops.table('failures', 4))
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

# When the controller took over: before, it has no integral.
def taken_over_s(run)
  row = run.times.zip(run.values('integral')).find { |_, value| value != 0.0 }
  row ? row[0] : raise(Host::Failure, 'the heat-up did not end')
end

# It ends before what it stores brings the oven to what was set.
def check_heat_up(run)
  Report.number('heat_up_s', taken_over_s(run))
  Report.at_most('the heat-up ends after', taken_over_s(run), 10.0, 's')
  Report.at_most('and then the oven comes to', run.values('temperature_c', 0.0, HOTTER_AT_S).max, OVEN_SET_C + 0.3, 'C')
end

def check_progress(text)
  told = text.scan(/^progress: [\d.]+ s, (\d+) %, status (\d)/)
  Report.exactly('progress: at last', told.last[0].to_i, 100, '%')
  Report.exactly("the heat-up's status", told.last[1].to_i, DONE)
  Report.at_least('progress: how often it was told', told.size, 10)
end

def check_tuned(rule, run)
  over = taken_over_s(run)
  Report.at_most("#{rule}: 80 C within 2 %, after the heat-up", settled(run, over, HOTTER_AT_S), 30.0, 's')
  Report.at_most("#{rule}: to 100 C, overshoot of the step",
                 (run.values('temperature_c', HOTTER_AT_S, TUNE_DOOR_S).max - HOTTER_C) * 5.0, 2.0, '%')
  Report.at_most("#{rule}: 100 C within 2 % after",
                 run.settling('temperature_c', HOTTER_C, HOTTER_BAND_C, HOTTER_AT_S, TUNE_DOOR_S), 18.0, 's')
  Report.at_most("#{rule}: door shut, within 2 % after",
                 run.settling('temperature_c', HOTTER_C, HOTTER_BAND_C, TUNE_DOOR_END_S, TUNE_END_S), 16.0, 's')
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
  plot = Plot.new('autotune', 'An oven that finds its own gains in the first seconds after power-on',
                  height: 620, rows: [1.5, 1.0],
                  margins: { top: 0.925, bottom: 0.095 })
  autotune_temperature(plot, runs)
  autotune_drive(plot, runs)
  plot.draw
end

def autotune_marks(over, top, named)
  areas = [[1, 0, over], [2, TUNE_DOOR_S, TUNE_DOOR_END_S]].map do |number, from, to|
    "set object #{number} rectangle from #{from}, graph 0 to #{to}, graph #{top} " \
      "behind fillcolor '#{Plot::AREA}' fillstyle solid noborder"
  end
  labels = [['heat-up', over / 2.0],
            ['its gains', (over + HOTTER_AT_S) / 2.0],
            ['another setpoint', (HOTTER_AT_S + TUNE_DOOR_S) / 2.0],
            ['door open', (TUNE_DOOR_S + TUNE_DOOR_END_S) / 2.0]]
           .map { |text, at| "set label \"#{text}\" at #{at}, graph 0.06 center" }
  [*areas, *(named ? labels : [])]
end

def autotune_temperature(plot, runs)
  over = taken_over_s(runs['PI'])
  curves = [Plot.setpoint(runs['PI'], 'setpoint_c')]
  curves += runs.map do |rule, run|
    Plot.curve(run, 'temperature_c', TUNE_COLORS[rule])
  end
  plot.panel(0, 0, curves,
             [*autotune_marks(over, 0.86, true),
              Plot.text('setpoint', 0.5, 84, Plot::SETPOINT), Plot.text('PID', 12, 75, TUNE_COLORS['PID']),
              Plot.text('PI', 16, 61, TUNE_COLORS['PI']),
              "set xrange [0:#{TUNE_END_S}]",
              "set format x ''", 'set yrange [10:125]', 'set ytics 20',
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
              "set xlabel 'time, s'", 'set yrange [0:60]', 'set ytics 20',
              *y_label(0, 'drive, %')])
end

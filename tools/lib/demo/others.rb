# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What one missing feature does: fixpid_pid beside its own law in double
# precision, whole and without the feature.
Scene = Struct.new(:name, :title, :what, :column, :label, :x, :x_step, :y, :key)

SCENES = [
  Scene.new('windup', 'anti-windup', 'from cold', '', 'process, counts',
            [0, 400], 100, [0, 1050], 'bottom right'),
  Scene.new('sign_blind', 'anti-windup that sees the sign',
            'limit lowered at 300, setpoint 330 at 600', '', 'process, counts',
            [0, 900], 300, [0, 1050], 'top right'),
  Scene.new('clamped', 'integral beyond the output\'s range',
            'with a setpoint weight of 0.7', '', 'process, counts',
            [0, 9000], 3000, [0, 750], 'bottom right'),
  Scene.new('kick', 'derivative of the measurement',
            'setpoint 10 % higher at 300', '_output', 'output, counts',
            [280, 360], 20, [60, 290], 'top right'),
  Scene.new('eight_bits', 'integral gain of 24 fractional bits',
            'ki 0.0015 per step is 0 with 8 of them', '', 'process, counts',
            [0, 9000], 3000, [0, 750], 'bottom right'),
  Scene.new('no_seed', 'return from manual without a bump',
            'manual at 300, automatic at 450', '_output', 'output, counts',
            [280, 560], 50, [60, 330], 'top right')
].freeze

# What fixpid_pid may need: overshoot in percent of the setpoint, steps until it
# stays within 2 %, and the sums of the error's magnitude, on the first setpoint
# and on the last.
LOOP_LIMITS = {
  'lag 50, dead time 3' => [0.01, 116, 20_620, 3893],
  'lags 20 and 10' => [0.01, 77, 11_268, 7488],
  'integrator, dead time 4' => [0.41, 199, 24_099, 41_836],
  'motor, lag 25, noise 2' => [0.09, 52, 22_784, 6614],
  'oven, lag 2000, dead time 40' => [0.01, 5044, 644_660, 549_651]
}.freeze

WHAT = { 'settled' => 'steps until it is settled', 'iae' => 'sum of errors',
         'iae_after' => 'sum of the last errors' }.freeze

# The most that the output may change at once, and in a step of the next 20.
BUMP_LIMITS = {
  'ki x 4' => [0, 0], 'kp x 3' => [0, 0], 'gains back' => [0, 0],
  'to manual at the same output' => [0, 0],
  'to automatic, 189 counts off' => [0, 12],
  'seed with the same output' => [0, 0],
  'limits to 0..150, below the need' => [25, 25],
  'limits back to 0..255' => [59, 59]
}.freeze

def others
  five = Loops.table('five').group_by { |row| row['plant'] }
  five.each { |plant, rows| check_plant(plant, rows) }
  check_slow(Loops.table('slow'))
  Loops.table('agreement').each { |row| check_agreement(row) }
  check_bumps(Loops.table('bumps'))
  check_drift(Loops.table('drift'))
  scenes = SCENES.to_h { |scene| [scene.name, Loops.scene(scene.name)] }
  check_scenes(scenes)
  draw_others(scenes)
end

def check_plant(plant, rows)
  Report.number(plant, rows)
  ours, law = rows
  overshoot, *limits = LOOP_LIMITS.fetch(plant)
  Report.at_most("#{plant}: overshoot", ours['overshoot'].to_f, overshoot, '%')
  WHAT.zip(limits).each do |(name, meaning), limit|
    Report.at_most("#{plant}: #{meaning}", ours[name].to_f.ceil, limit)
  end
  check_precision(plant, ours, law)
end

# Sooner than in double precision is no fault.
def check_precision(plant, ours, law)
  percent = WHAT.keys.to_h do |name|
    [name, 100.0 * (ours[name].to_f / law[name].to_f - 1.0)]
  end
  Report.at_most("#{plant}: overshoot, more than in double precision",
                 ours['overshoot'].to_f - law['overshoot'].to_f, 1.0, '%')
  Report.at_most("#{plant}: settles later than in double precision",
                 percent['settled'], 1.0, '%')
  %w[iae iae_after].each do |name|
    Report.at_most("#{plant}: #{WHAT[name]}, off double precision by",
                   percent[name].abs, 1.0, '%')
  end
end

# Sum of errors by that of an integral that is clamped, with one that is far too
# slow and with one that is not.
CLAMPED_LIMITS = { 'lag 3000, reset time 10000' => 1.45, 'lag 3000, reset time 3000' => 1.08 }.freeze

def check_slow(rows)
  Report.number('slow', rows)
  rows.group_by { |row| row['plant'] }.each do |plant, own|
    ours, law, *, clamped = own.map { |row| row['iae'].to_f }
    Report.at_most("#{plant}: sum of errors, off double precision by", 100.0 * (ours / law - 1.0).abs, 1.0, '%')
    Report.at_most("#{plant}: sum of errors, by that of a clamped integral", ours / clamped, CLAMPED_LIMITS.fetch(plant))
  end
end

def check_agreement(row)
  Report.at_most("#{row['plant']}: on the same readings, off the law by",
                 row['difference'].to_f, row['allowed'].to_f, 'counts')
end

def check_bumps(rows)
  Report.number('bumps', rows)
  rows.each do |row|
    jump, largest = BUMP_LIMITS[row['event']]
    next unless jump

    Report.at_most("#{row['event']}: bump",
                   (row['first'].to_i - row['before'].to_i).abs, jump, 'counts')
    Report.at_most("#{row['event']}: largest step after it",
                   row['largest'].to_i, largest, 'counts')
  end
  others = rows.to_h { |row| [row['event'], row['first'].to_i] }
  Report.at_most('wound up, limits lowered: stays at the limit for',
                 others.fetch('lowered limit left after'), 1, 'steps')
  Report.at_most('setpoint step of 100 at kp 1, kd 2: the output rises by',
                 others.fetch('setpoint step of 100'), 101, 'counts')
end

def check_drift(rows)
  Report.number('drift', rows)
  rows.each do |row|
    what = "ki #{row['ki_q24']} / 2^24, error #{row['error']}, 10^6 steps"
    Report.exactly("#{what}: integral", row['after_q16'].to_i,
                   row['exact_q16'].to_i)
    Report.exactly("#{what} and back: integral", row['back_q16'].to_i, 0)
  end
end

def largest(run, column, from = 0)
  run.values(column, from).max
end

# The law without a feature must do what the picture says of it, and fixpid_pid
# must not.
def check_scenes(scenes)
  scenes.each do |name, run|
    difference = %w[fixpid law].map { |who| run.values(who) }.transpose
                               .map { |a, b| (a - b).abs }.max
    Report.at_most("#{name}: fixpid_pid and the whole law differ by",
                   difference, 1.0, 'counts')
  end
  check_processes(scenes)
  check_outputs(scenes)
end

def check_processes(scenes)
  { 'fixpid' => :at_most, 'without' => :at_least }.each do |who, relation|
    rise = largest(scenes['windup'], who) - 700.0
    Report.public_send(relation, "windup: #{who}, overshoot", rise,
                       who == 'fixpid' ? 1.0 : 150.0, 'counts')
    { 'sign_blind' => [330.0, 850, 900], 'clamped' => [600.0, 8000, 9000],
      'eight_bits' => [600.0, 8000, 9000] }
      .each do |name, (setpoint, from, to)|
        off = (scenes[name].mean(who, from, to) - setpoint).abs
        Report.public_send(relation, "#{name}: #{who}, remaining error", off,
                           who == 'fixpid' ? 4.0 : 30.0, 'counts')
      end
  end
end

# The output's change at one step.
def jump(run, who, step)
  before, after = run.values("#{who}_output", step - 1, step + 1)
  (after - before).abs
end

def check_outputs(scenes)
  { 'kick' => 300, 'no_seed' => 450 }.each do |name, step|
    run = scenes[name]
    Report.at_most("#{name}: fixpid, jump of the output",
                   jump(run, 'fixpid', step), name == 'kick' ? 62.0 : 0.0,
                   'counts')
    Report.at_least("#{name}: without, jump of the output",
                    jump(run, 'without', step), 115.0, 'counts')
  end
end

def draw_others(scenes)
  plot = Plot.new('others', 'What each feature is good for: fixpid\\\\_pid, and ' \
                            'the same law without it',
                  width: 1000, height: 680, columns: [1.0, 1.0, 1.0],
                  rows: [1.0, 1.0], gap_x: 0.085, gap_y: 0.15,
                  margins: { left: 0.07, right: 0.975, top: 0.86,
                             bottom: 0.085 })
  SCENES.each_with_index do |scene, i|
    scene_panel(plot, i / 3, i % 3, scene, scenes[scene.name])
  end
  plot.draw
end

def step_curve(run, column, color, style = 'linewidth 1.6')
  "'#{run.path}' using 'step':'#{column}' with lines linecolor '#{color}' " \
    "#{style} notitle"
end

DASHED = 'linewidth 1.2 dashtype 2'

# fixpid is drawn over the other and named before it.
def scene_panel(plot, row, column, scene, run)
  curves = [step_curve(run, "without#{scene.column}", Plot::RED),
            step_curve(run, "fixpid#{scene.column}", Plot::BLUE),
            Plot.entry('fixpid', Plot::BLUE), Plot.entry('without', Plot::RED)]
  if scene.column.empty?
    curves.unshift(step_curve(run, 'setpoint', Plot::BLACK, DASHED),
                   Plot.entry('setpoint', Plot::BLACK, DASHED))
  end
  plot.panel(row, column, curves,
             ["set title \"{/:Bold #{scene.title}}\\n#{scene.what}\"",
              "set xrange [#{scene.x.join(':')}]",
              "set yrange [#{scene.y.join(':')}]", "set xtics #{scene.x_step}",
              "set key #{scene.key} vertical width 0",
              "set ylabel '#{scene.label}' offset 0.7,0",
              *(row == 1 ? ["set xlabel 'step'"] : [])])
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# AN964's tuning steps on the simulated pendulum, let go 2 degrees off with a
# true reference and a full supply.
Stage = Struct.new(:name, :steps, :title, :kp, :ki, :kd, :shove) do
  def setting
    "KP #{kp}, KI #{ki}, KD #{kd}"
  end
end

STAGES = [
  Stage.new('zero', '1 to 4', 'all zero: it falls, the base rests', 0, 0, 0, 0),
  Stage.new('kp_low', '5', 'KP too small: the base chases', 200, 0, 0, 0),
  Stage.new('kp', '6', 'KP: a little oscillation', 480, 0, 0, 0),
  Stage.new('ki', '7', 'KI: upright, and its swing grows', 480, 96, 0, 0),
  Stage.new('kd', '8 and 9', 'KD: the overshoot is gone', 480, 96, 400, 0),
  Stage.new('tuned', 'after', 'KP up by a quarter, and a shove', 600, 96, 400, 6)
].freeze
TRIP_DEGREES = 20.0
TUNING_S = 12.0

def tuning
  runs = STAGES.to_h do |stage|
    [stage.name, Host.run('pendulum', "tuning-#{stage.name}",
                          kp: stage.kp, ki: stage.ki, kd: stage.kd,
                          shove: stage.shove, release: 2, reference: 0,
                          supply_fall: 0, seconds: TUNING_S)]
  end
  stage_numbers(runs)
  check_falling_stages(runs)
  check_balanced_stages(runs)
  draw_tuning(runs)
end

# When the angle first left +-20 degrees, or nil.
def fallen_s(run)
  run.times.zip(run.values('angle_degrees'))
     .find { |_, angle| angle.abs > TRIP_DEGREES }&.first
end

def stage_numbers(runs)
  runs.each do |name, run|
    upright = fallen_s(run) || TUNING_S
    Report.number("#{name}_upright_s", upright)
    Report.number("#{name}_base_m", run.peak('base_m', 0.0, upright))
    Report.number("#{name}_reversals", run.reversals('base_m_s', 0.0, upright))
    Report.number("#{name}_swing_degrees",
                  upright < TUNING_S ? nil : last_swing(run))
  end
end

def last_swing(run)
  run.swing('angle_degrees', TUNING_S / 2.0, TUNING_S)
end

def check_falling_stages(runs)
  Report.at_most('all zero: it falls after', fallen_s(runs['zero']) || TUNING_S,
                 1.0, 's')
  Report.at_most('all zero: the base moves by', runs['zero'].peak('base_m'),
                 0.0, 'm')
  low = runs['kp_low']
  Report.at_most('KP 200: the base chases, and it falls after',
                 fallen_s(low) || TUNING_S, 3.0, 's')
  Report.at_most('KP 200: reversals of the base',
                 low.reversals('base_m_s', 0.0, fallen_s(low) || TUNING_S), 0)
  kp = runs['kp']
  Report.at_least('KP 480: reversals of the base',
                  kp.reversals('base_m_s', 0.0, fallen_s(kp) || TUNING_S), 2)
end

def check_balanced_stages(runs)
  Report.at_least('KI 96: upright for', fallen_s(runs['ki']) || TUNING_S,
                  TUNING_S, 's')
  Report.at_least('KI 96: swings from side to side by', last_swing(runs['ki']),
                  4.0, 'degrees')
  early, late = [[2.0, 5.0], [9.0, TUNING_S]].map { |from, to| runs['ki'].swing('angle_degrees', from, to) }
  Report.at_least('KI 96: the swing of the last seconds, times that of the first', late / early, 1.2)
  Report.at_most('KD 400: the swing is down to', last_swing(runs['kd']), 1.5,
                 'degrees')
  Report.at_most('KP 600, shoved: back within 1 degree after',
                 runs['tuned'].settling('angle_degrees', 0.0, 1.0, 5.0), 2.0,
                 's')
end

def draw_tuning(runs)
  plot = Plot.new('tuning', 'AN964: the note\'s tuning steps, one by one',
                  width: 1000, height: 640, columns: [1.0, 1.0, 1.0],
                  rows: [1.0, 1.0], gap_x: 0.03, gap_y: 0.13,
                  margins: { left: 0.07, right: 0.93, top: 0.86,
                             bottom: 0.085 })
  STAGES.each_with_index do |stage, i|
    stage_panel(plot, i / 3, i % 3, stage, runs[stage.name])
  end
  plot.draw
end

# Where the names of the two curves stand, on the left axis.
NAMES_AT = { 'zero' => [[0.9, 15], [5, 2.5]], 'kp_low' => [[2.2, 15], [5, 10]], 'kp' => [[8.3, 12], [3.6, 5]],
             'ki' => [[5, 6.5], [5, -6.5]], 'kd' => [[5, 3.5], [8, -4]], 'tuned' => [[8, -4], [8, 6]] }.freeze

# Angle on the left and base on the right, each in its color and with one scale
# for all panels.
def stage_panel(plot, row, column, stage, run)
  curves = [Plot.curve(run, 'angle_degrees', Plot::MEASUREMENT, every: 4),
            "#{Plot.curve(run, 'base_m', Plot::SECOND, every: 4)} " \
            'axes x1y2']
  angle, base = NAMES_AT.fetch(stage.name)
  plot.panel(row, column, curves,
             ["set title \"{/:Bold #{stage.setting}}\\n#{stage.title}\"",
              'set xrange [0:12]', 'set yrange [-24:24]',
              'set y2range [-2.4:2.4]', 'set border 11',
              Plot.text('angle', *angle, Plot::MEASUREMENT), Plot.text('base', *base, Plot::SECOND),
              *(row == 1 ? ["set xlabel 'time, s'"] : []),
              *stage_axes(column)])
end

def stage_axes(column)
  left_color, right_color = [Plot::MEASUREMENT, Plot::SECOND].map { |color| "textcolor '#{color}'" }
  left = column.zero?
  right = column == 2
  ["set ytics 10 #{left_color} #{"format ''" unless left}",
   "set y2tics 1 out scale 0.6 #{right_color} #{"format ''" unless right}",
   *(left ? ["set ylabel 'angle, degrees' #{left_color}"] : []),
   *(right ? ["set y2label 'base at, m' #{right_color}"] : [])]
end

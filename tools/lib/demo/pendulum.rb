# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The potentiometers, as tools/demo tuning finds them, with KP turned up by
# half. Multiples of 8, so that both forms have exactly the same gains.
POTENTIOMETERS = { kp: 600, ki: 96, kd: 400 }.freeze
LIMIT_DEGREES = 1.0
TERMS = %w[proportional integral derivative].freeze
SHOVE_S = 5.0
END_S = 60.0

def pendulum(name, form, other_reference)
  run = Host.run(name, name, **POTENTIOMETERS)
  without = Host.run("#{name}_no_offset", "#{name}-no_offset", **POTENTIOMETERS)
  other = Host.run(name, "#{name}-other_reference", **POTENTIOMETERS,
                   reference: other_reference)
  check_balance(run)
  check_base(run, without, other, other_reference)
  check_integration(name, run)
  draw_pendulum(name, form, run, without)
end

def check_balance(run)
  angle = 'angle_degrees'
  Report.at_most('released at 8: angle from 3 s to the shove',
                 run.peak(angle, 3.0, SHOVE_S), LIMIT_DEGREES, 'degrees')
  Report.at_most('shoved at 5 s: back within 1 degree after',
                 run.settling(angle, 0.0, LIMIT_DEGREES, SHOVE_S, END_S), 2.0,
                 's')
  Report.at_most('supply falls by 25 %: angle from 7 to 60 s',
                 run.peak(angle, 7.0), LIMIT_DEGREES, 'degrees')
  Report.number('shove_peak_degrees', run.peak(angle, SHOVE_S, 7.0))
  Report.number('supply_end_percent', run.values('supply_percent').last)
end

def check_base(run, without, other, other_reference)
  Report.at_most('base from its start, reference 0.3 degrees off',
                 run.peak('base_m'), 5.0, 'm')
  Report.at_most("base, reference #{other_reference} degrees off",
                 other.peak('base_m'), 5.0, 'm')
  Report.at_most('its angle from 7 to 60 s',
                 other.peak('angle_degrees', 7.0), LIMIT_DEGREES, 'degrees')
  Report.at_least('without the drift offset the base runs away',
                  without.peak('base_m'), 20.0, 'm')
end

# The same noise and calls with half the step. Later than this, one conversion
# that falls on the other side of a count parts the two runs.
def check_integration(name, run)
  half = Host.run(name, "#{name}-half_step", plant_step: 0.125e-3,
                                             **POTENTIOMETERS)
  difference = largest_difference(run, half, 'angle_degrees', 4.0)
  Report.at_most('half the integrator\'s step changes 4 s of angle by',
                 difference, 0.001, 'degrees')
end

# Left: release and shove. Right: the falling supply.
def draw_pendulum(name, form, run, without)
  values = POTENTIOMETERS.values
  plot = Plot.new(name, "Inverted pendulum, #{form}: KP #{values[0]}, " \
                        "KI #{values[1]}, KD #{values[2]}",
                  height: 860, columns: [1.0, 1.0], rows: [1.5, 1.1, 1.1, 1.1])
  [[0, 8, 2], [8, 60, 8]].each_with_index do |(from, to, every), column|
    pendulum_panels(plot, column, run, without, every,
                    ["set xrange [#{from}:#{to}]"],
                    range_with_headroom(run, TERMS, from, to))
  end
  plot.draw
end

def pendulum_panels(plot, column, run, without, every, x_range, terms_range)
  angle_panel(plot, column, run, every, x_range)
  terms_panel(plot, 1, column, run, every, [*x_range, terms_range])
  drive_panel(plot, 2, column, run, every, x_range, 256)
  base_panel(plot, column, run, without, every, x_range)
end

def y_label(column, text)
  column.zero? ? ["set ylabel \"#{text}\""] : []
end

def angle_panel(plot, column, run, every, x_range)
  curves = [Plot.curve(run, 'angle_degrees', Plot::MEASUREMENT,
                       every: every),
            Plot.setpoint(nil, '0'),
            "1 notitle linecolor '#{Plot::LIMIT}' dashtype 3",
            "-1 notitle linecolor '#{Plot::LIMIT}' dashtype 3"]
  labels = [["set title 'release at 8 degrees, shove at 5 s'"],
            ["set title 'supply falls by 25 % from 10 to 30 s, KP follows'"]][column]
  range = ['set yrange [-6:9]', 'set yrange [-2:2]'][column]
  texts = [[Plot.text('angle', 0.75, -3.2, Plot::MEASUREMENT), Plot.text('limit', 3.2, 1.7, Plot::LIMIT_TEXT)],
           [Plot.text('angle', 19, -1.25, Plot::MEASUREMENT), Plot.text('limit', 19, 1.2, Plot::LIMIT_TEXT),
            Plot.text('setpoint', 50, 0.6, Plot::SETPOINT)]][column]
  plot.panel(0, column, curves,
             [*x_range, *labels, *texts, "set format x ''", range,
              *y_label(column, 'angle, degrees')])
end

def terms_panel(plot, row, column, run, every, ranges)
  # Heights as parts of the panel's: the terms of 8 x 8 bits are smaller.
  places = [[[0.15, 0.82], [0.5, 0.6], [0.35, 0.1]], [[19, 0.9], [23, 0.9], [27, 0.9]]][column].map { |x, y| [x, "graph #{y}"] }
  plot.panel(row, column, Plot.terms(run, every: every, span: [8.0, 52.0][column]),
             [*ranges, *Plot.terms_text(*places), "set format x ''", *y_label(column, 'terms, counts')])
end

def drive_panel(plot, row, column, run, every, x_range, full)
  curves = [Plot.curve(run, "(column('drive_counts')*100.0/#{full})", Plot::OUTPUT, every: every, width: 1.2)]
  texts = [Plot.text('drive', [3.2, 19][column], 32, Plot::OUTPUT)]
  if run.values('time_s').last > 30.0 && column == 1
    curves << Plot.curve(run, 'supply_percent', Plot::DISTURBANCE,
                         every: every)
    texts << Plot.text('supply', 19, 105, Plot::LIMIT_TEXT)
  end
  plot.panel(row, column, curves,
             [*x_range, *texts, "set format x ''", 'set yrange [-50:150]',
              'set ytics -50,50,100', *y_label(column, 'drive, %')])
end

BASE_AXIS = [["set ytics 0.5", "set yrange [-1.6:0.6]"],
             ["set ytics 25", "set yrange [-120:40]"]].freeze

def base_panel(plot, column, run, without, every, x_range)
  curves = [Plot.curve(without, 'base_m', Plot::WITHOUT, every: every),
            Plot.curve(run, 'base_m', Plot::MEASUREMENT, every: every)]
  texts = [[Plot.text('base', 3.2, 0.12, Plot::MEASUREMENT), Plot.text('without the drift offset', 0.5, -1.1, Plot::WITHOUT)],
           [Plot.text('base', 50, 13, Plot::MEASUREMENT), Plot.text('without the drift offset', 18, -75, Plot::WITHOUT)]][column]
  plot.panel(3, column, curves,
             [*x_range, *texts, "set xlabel 'time, s'", *BASE_AXIS[column],
              *y_label(column, 'base at, m')])
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

LOAD_S = 0.7
LOAD_END_S = 0.95
MOTOR_SET_RAD_S = 360.0
KI_START = 80 / 16.0
KI_RUNNING = 144 / 16.0

def motor
  run = Host.run('motor', 'motor')
  without = Host.run('motor_no_limit', 'motor-no_limit')
  check_start(run, without)
  check_schedule(run)
  check_load(run)
  check_motor_integration(run)
  draw_motor(run, without)
end

def percent_of_set(speed)
  speed * 100.0 / MOTOR_SET_RAD_S
end

def overshoot(run)
  percent_of_set(run.values('speed_rad_s', 0.0, 0.25).max) - 100.0
end

def off_speed(run, from, to)
  run.values('speed_rad_s', from, to)
     .map { |v| percent_of_set(v - MOTOR_SET_RAD_S).abs }.max
end

def reached(run)
  run.settling('speed_rad_s', MOTOR_SET_RAD_S, 0.02 * MOTOR_SET_RAD_S, 0.0,
               0.25)
end

def check_start(run, without)
  Report.at_most('96/80/16: speed within 2 % after', reached(run), 0.15, 's')
  Report.at_most('overshoot, limit 4000', overshoot(run), 20.0, '%')
  Report.at_least('overshoot without a limit', overshoot(without),
                  1.5 * overshoot(run), '%')
  Report.at_least('without a limit: speed within 2 % after', reached(without),
                  1.5 * reached(run), 's')
end

# The trace shows the gain as the ratio of the I term and its sum.
def gain_change(run)
  rows = run.times.zip(run.values('integral'), run.values('accumulated_error'))
  row = rows.find { |_, i, sum| sum.abs > 20.0 && i / sum > KI_RUNNING - 0.1 }
  row ? row[0] : raise(Host::Failure, 'the gain schedule did not happen')
end

def check_schedule(run)
  at = gain_change(run)
  Report.number('gain_change_s', at)
  before, after = run.values('accumulated_error', at - 0.0015, at + 0.0005)
  Report.at_most('ki 80 to 144: step of the accumulated error',
                 (after - before).abs, 80.0, 'counts')
  Report.at_most('ki 80 to 144: speed leaves its set value by',
                 off_speed(run, at - 0.001, at + 0.1), 5.0, '%')
  Report.at_most('and is back within 1 % after',
                 run.settling('speed_rad_s', MOTOR_SET_RAD_S,
                              0.01 * MOTOR_SET_RAD_S, at, LOAD_S), 0.1, 's')
end

def check_load(run)
  Report.at_most('load step: speed leaves its set value by',
                 off_speed(run, LOAD_S, LOAD_END_S), 2.0, '%')
  Report.at_most('load step: lasting error of the speed',
                 (percent_of_set(run.mean('speed_rad_s', 0.85, LOAD_END_S)) -
                  100.0).abs, 0.3, '%')
  Report.at_least('load step: the drive rises by',
                  (run.mean('drive_counts', 0.85, LOAD_END_S) -
                   run.mean('drive_counts', 0.6, LOAD_S)) / 10.23, 5.0, '%')
end

def check_motor_integration(run)
  half = Host.run('motor', 'motor-half_step', plant_step: 10e-6)
  difference = largest_difference(run, half, 'speed_rad_s')
  Report.at_most('half the integrator\'s step changes the speed by', difference,
                 0.01, 'rad/s')
end

def draw_motor(run, without)
  plot = Plot.new('motor', 'Motor speed, AN937: 96/80/16, ki 144 in flight',
                  columns: [1.0, 1.0], rows: [1.5, 1.1, 1.1])
  [[0.0, 0.2, 'power-on, with and without the anti-windup limit'],
   [0.2, 1.2, 'ki 80 to 144, load on and off']]
    .each_with_index do |(from, to, title), column|
      motor_panels(plot, column, run, without, from, to, title)
    end
  plot.draw
end

def motor_panels(plot, column, run, without, from, to, title)
  x_range = ["set xrange [#{from}:#{to}]"]
  speed_panel(plot, column, run, without, [*x_range, "set title '#{title}'"])
  motor_terms_panel(plot, column, run, to - from,
                    [*x_range, range_with_headroom(run, TERMS, from, to)])
  motor_drive_panel(plot, column, run, without, x_range)
end

def speed_panel(plot, column, run, without, settings)
  curves = [Plot.curve(run, 'speed_rad_s', Plot::MEASUREMENT),
            Plot.setpoint(run, 'setpoint_rad_s')]
  curves << Plot.curve(without, 'speed_rad_s', Plot::WITHOUT) if column.zero?
  texts = [[Plot.text('without the limit', 0.105, 450, Plot::WITHOUT), Plot.text('speed, with the limit', 0.054, 315, Plot::MEASUREMENT),
            Plot.text('setpoint', 0.002, 385, Plot::SETPOINT)],
           [Plot.text('speed', 0.45, 362.5, Plot::MEASUREMENT)]][column]
  range = ['set yrange [0:600]', 'set yrange [350:372]'][column]
  plot.panel(0, column, curves,
             [*settings, *texts, "set format x ''", range,
              *y_label(column, 'speed, rad/s')])
end

def motor_terms_panel(plot, column, run, span, x_range)
  places = [[[0.019, 10500], [0.01, 22500], [0.01, -2200]], [[0.45, 170], [0.45, 1020], [0.45, -190]]][column]
  plot.panel(1, column, Plot.terms(run, span: span),
             [*x_range, *Plot.terms_text(*places), "set format x ''", 'set ytics format "%g"',
              *y_label(column, 'terms, duty counts')])
end

def motor_drive_panel(plot, column, run, without, x_range)
  curves = [Plot.curve(run, "(column('drive_counts')/10.23)", Plot::OUTPUT, width: 1.2)]
  if column.zero?
    curves << Plot.curve(without, "(column('drive_counts')/10.23)", Plot::WITHOUT, width: 1.2)
  end
  texts = [[Plot.text('drive', 0.067, 60, Plot::OUTPUT), Plot.text('without the limit', 0.107, -85, Plot::WITHOUT)],
           [Plot.text('drive', 0.45, 97, Plot::OUTPUT)]][column]
  plot.panel(2, column, curves,
             [*x_range, *texts, "set xlabel 'time, s'", 'set yrange [-115:155]',
              'set ytics -100,50,100', *y_label(column, 'drive, %')])
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

P_GAINS = [16, 32, 64, 96].freeze
OVEN_SET_C = 80.0
OVEN_STEP_C = 60.0
BAND_C = 0.02 * OVEN_STEP_C

# Before anything happens to it.
def run_oven(program, name, **scenario)
  Host.run(program, name, every: 0.02, seconds: 30, **scenario)
end

def oven
  p_only = P_GAINS.to_h do |kp|
    [kp, run_oven("oven_p_#{kp}", "oven-p_#{kp}")]
  end
  pi = run_oven('oven_pi', 'oven-pi')
  pid = run_oven('oven', 'oven')
  check_p_only(p_only)
  check_pi_and_pid(pi, pid)
  wire = check_oven_wire
  check_oven_integration(pid)
  draw_oven(p_only, pi, pid, wire['open'])
end

def offset_c(run)
  OVEN_SET_C - run.mean('temperature_c', 25.0, 30.0)
end

def oven_settling(run, to = Float::INFINITY)
  run.settling('temperature_c', OVEN_SET_C, BAND_C, 0.0, to)
end

def oven_overshoot(run)
  (run.values('temperature_c').max - OVEN_SET_C) * 100.0 / OVEN_STEP_C
end

def check_p_only(p_only)
  p_only.each do |kp, run|
    Report.at_least("P only, kp #{kp}: settles with an offset", offset_c(run),
                    BAND_C, 'C')
    Report.at_most("P only, kp #{kp}: swing over the last 5 s",
                   run.swing('temperature_c', 25.0, 30.0), 1.0, 'C')
  end
end

def check_pi_and_pid(pi, pid)
  { 'PI' => pi, 'PID' => pid }.each do |name, run|
    Report.at_most("#{name}: remaining offset", offset_c(run).abs, 0.5, 'C')
    Report.at_most("#{name}: overshoot", oven_overshoot(run), 5.0, '%')
    Report.number("#{name.downcase}_settling_s", oven_settling(run))
  end
  Report.at_most('PI: settles within 2 % after', oven_settling(pi), 15.0, 's')
  Report.at_most('PID: settles within 2 % after (0.6 of PI)',
                 oven_settling(pid), 0.6 * oven_settling(pi), 's')
end

# The sensor's wire of the hot oven breaks: see thermostat.rb. The alarm is acknowledged
# when the setpoint is up again.
OVEN_WIRE_FROM_S = 15.0
OVEN_WIRE_TO_S = 25.0
OVEN_DOWN_S = 27.0
OVEN_UP_S = 28.0
OVEN_WIRE_END_S = 50.0

def check_oven_wire
  WIRE_ENDS.to_h do |how, reads|
    run = Host.run('oven', "oven-wire_#{reads.to_i}",
                   every: 0.02, seconds: OVEN_WIRE_END_S, wire_at: OVEN_WIRE_FROM_S,
                   wire_for: OVEN_WIRE_TO_S - OVEN_WIRE_FROM_S, wire_reads: reads,
                   down_at: OVEN_DOWN_S, down_for: OVEN_UP_S - OVEN_DOWN_S)
    check_wire(run, how, OVEN_WIRE_FROM_S, OVEN_UP_S, 0.02)
    Report.at_most("wire #{how}, acknowledged: overshoot",
                   overshoot_percent(run, OVEN_UP_S, OVEN_WIRE_END_S), 5.0, '%')
    Report.at_most("wire #{how}, acknowledged: settles within 2 % after",
                   settled(run, OVEN_UP_S, OVEN_WIRE_END_S), 15.0, 's')
    [how, run]
  end
end

def check_oven_integration(pid)
  half = run_oven('oven', 'oven-half_step', plant_step: 0.5e-3)
  difference = largest_difference(pid, half, 'temperature_c')
  Report.at_most('half the integrator\'s step changes the temperature by',
                 difference, 0.001, 'C')
end

# The note's three figures with what is inside, and what happens without a sensor.
def draw_oven(p_only, pi, pid, wire)
  plot = Plot.new('oven', 'Oven, AN937: P only, PI and PID', width: 1330,
                  columns: [1.0, 1.0, 1.0, 1.0], rows: [1.6, 1.1, 1.1],
                  gap_x: 0.03)
  temperature_panel(plot, 0, 'P only: an offset stays (Figure 5)',
                    p_only_curves(p_only), [*p_only_texts(p_only), Plot.text('setpoint', 9, 86, Plot::SETPOINT)])
  { 1 => ['PI 48/3/0: no offset (Figure 6)', pi],
    2 => ['PID 136/6/205: sooner (Figure 7)', pid] }
    .each do |column, (title, run)|
      settled = format('within 2 %% after %.1f s', oven_settling(run))
      temperature_panel(plot, column, title, [Plot.curve(run, 'temperature_c', Plot::MEASUREMENT)],
                        [Plot.text(settled, 5.5, 68, Plot::MEASUREMENT), Plot.text('setpoint', 9, 86, Plot::SETPOINT)])
    end
  temperature_panel(plot, 3, "PID: the wire breaks, acknowledged at #{OVEN_UP_S.round} s",
                    [Plot.curve(wire, 'temperature_c', Plot::MEASUREMENT)],
                    [Plot.text('temperature', 32, 60, Plot::MEASUREMENT)])
  [p_only[64], pi, pid, wire].each_with_index do |run, column|
    oven_terms_panel(plot, column, run)
    oven_drive_panel(plot, column, run)
  end
  plot.draw
end

# The last column is longer, and the wire is broken where it is grey.
def oven_time(column)
  return ['set xrange [0:15]'] if column < 3

  ["set xrange [0:#{OVEN_WIRE_END_S}]",
   grey(1, Stretch.new(OVEN_WIRE_FROM_S, OVEN_WIRE_TO_S), 1)]
end

# One scale for a row of panels: only the first shows its numbers.
def shared_y(column, text)
  column.zero? ? y_label(column, text) : ["set format y ''"]
end

def p_only_curves(p_only)
  p_only.values.zip(Plot::FAMILY).map do |run, color|
    Plot.curve(run, 'temperature_c', color)
  end
end

def p_only_texts(p_only)
  p_only.zip(Plot::FAMILY).map do |(kp, run), color|
    beside = color == Plot::FAMILY.last ? 4 : -4.5 # the last two curves are near each other
    Plot.text("kp #{kp}", 14.8, run.values('temperature_c', 14.0, 15.0).last + beside, color, 'right')
  end
end

def temperature_panel(plot, column, title, curves, texts)
  plot.panel(0, column, [*curves, Plot.setpoint(nil, OVEN_SET_C)],
             [*oven_time(column), *texts, "set title '#{title}'", "set format x ''",
              'set yrange [0:100]',
              *shared_y(column, 'temperature, °C')])
end

# Where the names of P, I and D stand, by column.
OVEN_TERMS = [[[1.7, 3600], [4.5, -700], [6.5, -700]], [[1.6, 3000], [9, 2100], [6.5, -1000]],
              [[1.4, 7200], [6, 2200], [1.1, 11500]], [[4.0, 7200], [6, 2200], [3.0, 11500]]].freeze

def oven_terms_panel(plot, column, run)
  plot.panel(1, column, Plot.terms(run),
             [*oven_time(column), *Plot.terms_text(*OVEN_TERMS[column]), "set format x ''", 'set yrange [-4000:15000]',
              'set ytics 4000', *(column.zero? ? [Plot.text('with kp 64', 8, 12000)] : []),
              *shared_y(column, 'terms, counts')])
end

def oven_drive_panel(plot, column, run)
  curves = [Plot.curve(run, "(column('drive_counts')/10.23)", Plot::OUTPUT, width: 1.2)]
  plot.panel(2, column, curves,
             [*oven_time(column), Plot.text('drive', [9, 9, 9, 38][column], 24, Plot::OUTPUT), "set xlabel 'time, s'", 'set yrange [0:110]',
              'set ytics 25', *shared_y(column, 'drive, %')])
end

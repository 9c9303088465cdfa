# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The picture of README.md: a step, and the way back from a setpoint that is out of reach,
# with fixpid_pid and without an anti-windup.
def anti_windup
  figures = Loops.read(Host.print('anti_windup', 'anti_windup.txt', 'figures'), 2).to_h { |row| [row['controller'], row] }
  Report.at_most('overshoot of a step to 700', figures['with']['overshoot'].to_f, 1.0, 'counts')
  Report.at_most('back from a limit after', figures['with']['back'].to_i, 30, 'steps')
  Report.at_least('without anti-windup: overshoot', figures['without']['overshoot'].to_f, 150.0, 'counts')
  Report.at_least('without anti-windup: back after', figures['without']['back'].to_i, 300, 'steps')
  draw_anti_windup(Trace.new(Host.print('anti_windup', 'anti_windup.csv'), 2699))
end

LIMIT_ENDS = 2000 # of the run, at this step

def draw_anti_windup(run)
  plot = Plot.new('anti_windup', 'One loop: with the anti-windup of fixpid, and without any',
                  width: 840, height: 440, columns: [1.0, 1.4], rows: [1.7, 1.0], margins: { top: 0.85, bottom: 0.12 })
  [[0, 350, 'a step change from 0 to 700'], [LIMIT_ENDS - 100, LIMIT_ENDS + 600, 'back to 700 from a setpoint out of reach']]
    .each_with_index do |(from, to, title), column|
      range = "set xrange [#{from}:#{to}]"
      measurement_panel(plot, column, run, [range, "set title '#{title}'", "set xtics 100 format ''"])
      output_panel(plot, column, run, [range, "set xtics (#{ticks(from, to)})"])
    end
  plot.draw
end

# Counted from where the setpoint moves.
def ticks(from, to)
  zero = from.zero? ? 0 : LIMIT_ENDS
  (from..to).step(100).map { |step| "'#{step - zero}' #{step}" }.join(', ')
end

def measurement_panel(plot, column, run, settings)
  curves = [Plot.curve(run, 'without', Plot::WITHOUT), Plot.curve(run, 'with', Plot::MEASUREMENT, width: 2.2), Plot.setpoint(run)]
  texts = [[Plot.text('without', 130, 930, Plot::WITHOUT), Plot.text('with', 75, 600, Plot::MEASUREMENT), Plot.text('setpoint', 5, 765, Plot::SETPOINT)],
           [Plot.text('without', LIMIT_ENDS + 150, 1085, Plot::WITHOUT), Plot.text('with', LIMIT_ENDS + 35, 780, Plot::MEASUREMENT)]][column]
  plot.panel(0, column, curves, [*settings, *texts, 'set yrange [0:1180]', *y_label(column, 'measurement, counts')])
end

def output_panel(plot, column, run, settings)
  curves = [Plot.curve(run, 'output_without', Plot::WITHOUT), Plot.curve(run, 'output', Plot::OUTPUT)]
  texts = [[Plot.text('without', 125, 235, Plot::WITHOUT), Plot.text('with', 65, 130, Plot::OUTPUT)],
           [Plot.text('without', LIMIT_ENDS + 150, 225, Plot::WITHOUT), Plot.text('with', LIMIT_ENDS + 35, 110, Plot::OUTPUT)]][column]
  plot.panel(1, column, curves, [*settings, *texts, "set xlabel 'steps'", 'set yrange [0:280]', 'set ytics 0,100,200', *y_label(column, 'output, counts')])
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The scenario of sim/world/world_oven.c, in seconds.
Stretch = Struct.new(:from, :to, :title)

MANUAL = Stretch.new(20.0, 35.0, 'manual, 10 %')
LOW_POWER = Stretch.new(55.0, 70.0, 'limit 12.5 %')
DOOR = Stretch.new(90.0, 95.0, 'door open')
BREAK = Stretch.new(110.0, 117.0, 'wire broken')
OFF = Stretch.new(124.0, 131.0, 'selector at off') # acknowledges the alarm
THERMOSTAT_END_S = 145.0
KEEP_WARM = 102
LOW_LIMIT = 127
SEEN_S = 0.35 # a turn of the selector counts when it is read twice

def run_thermostat(name, **scenario)
  Host.run('thermostat', name, every: 0.02, seconds: THERMOSTAT_END_S, wire_at: BREAK.from,
                               wire_for: BREAK.to - BREAK.from, off_at: OFF.from,
                               off_for: OFF.to - OFF.from, **scenario)
end

def thermostat
  run = run_thermostat('thermostat')
  check_warming(run)
  check_manual(run)
  check_low_power(run)
  check_door(run)
  check_thermostat_wire
  check_thermostat_integration(run)
  draw_thermostat(run)
end

def settled(run, from, to)
  run.settling('temperature_c', OVEN_SET_C, BAND_C, from, to)
end

def overshoot_percent(run, from, to)
  (run.values('temperature_c', from, to).max - OVEN_SET_C) * 100.0 / OVEN_STEP_C
end

def check_warming(run)
  Report.at_most('from cold: overshoot',
                 overshoot_percent(run, 0.0, MANUAL.from), 0.5, '%')
  Report.at_most('from cold: settles within 2 % after',
                 settled(run, 0.0, MANUAL.from), 6.0, 's')
  Report.at_most('from cold: remaining offset',
                 (OVEN_SET_C - run.mean('temperature_c', 15.0, 20.0)).abs, 0.1,
                 'C')
end

# The drive may go on from the error alone: in a period of 0.1 s, ki times it.
def check_manual(run, to = LOW_POWER.from)
  by_hand = run.values('drive_counts', MANUAL.from + SEEN_S, MANUAL.to)
  Report.at_most('manual: the drive leaves its 10 % by',
                 by_hand.map { |v| (v - KEEP_WARM).abs }.max, 0.0, 'counts')
  Report.at_least('manual: the temperature falls by',
                  OVEN_SET_C - run.values('temperature_c', MANUAL.from,
                                          MANUAL.to).last, 15.0, 'C')
  Report.at_most('back to automatic: largest step of the drive in 1 s',
                 largest_step(run, 'drive_counts', MANUAL.to, MANUAL.to + 1.0),
                 0.025 * 1023.0, 'counts')
  Report.at_most('back to automatic: overshoot',
                 overshoot_percent(run, MANUAL.to, to), 0.5, '%')
  Report.at_most('back to automatic: settles within 2 % after',
                 settled(run, MANUAL.to, to), 10.0, 's')
end

def largest_step(run, column, from, to)
  run.values(column, from, to).each_cons(2).map { |a, b| (b - a).abs }.max
end

# Once the controller is set up anew in these ten seconds, with the integral that the
# lower limit allows: it comes back without the overshoot of one that waits, and later.
def check_low_power(run)
  limited = run.values('drive_counts', LOW_POWER.from + SEEN_S, LOW_POWER.to)
  Report.at_most('limit lowered: the drive, at once', limited.max,
                 LOW_LIMIT, 'counts')
  Report.at_least('limit lowered: the temperature falls by',
                  OVEN_SET_C - run.values('temperature_c', LOW_POWER.from,
                                          LOW_POWER.to).last, 5.0, 'C')
  Report.at_most('limit raised: overshoot',
                 overshoot_percent(run, LOW_POWER.to, DOOR.from), 5.0, '%')
  Report.at_most('limit raised: settles within 2 % after',
                 settled(run, LOW_POWER.to, DOOR.from), 8.0, 's')
end

def check_door(run)
  low = run.values('temperature_c', DOOR.from, BREAK.from).min
  Report.number('door_dip_c', OVEN_SET_C - low)
  Report.at_most('door open: the temperature falls by', OVEN_SET_C - low, 10.0,
                 'C')
  Report.at_most('door shut: settles within 2 % after',
                 settled(run, DOOR.to, BREAK.from), 7.0, 's')
end

# The sensor's wire of an oven that is hot: open, it reads full scale, and at
# ground 0. A resistor pulls it up, so an open one also reads hot.
WIRE = Stretch.new(22.0, 27.0, 'wire broken')
WIRE_ENDS = { 'open' => 1.0, 'at ground' => 0.0 }.freeze

WIRE_OFF = Stretch.new(29.0, 30.0)

def check_thermostat_wire
  never = { manual_at: 3600, low_power_at: 3600, door_at: 3600 }
  WIRE_ENDS.each do |how, reads|
    run = Host.run('thermostat', "thermostat-wire_#{reads.to_i}",
                   every: 0.02, seconds: 45, wire_at: WIRE.from,
                   wire_for: WIRE.to - WIRE.from, wire_reads: reads, off_at: WIRE_OFF.from,
                   off_for: WIRE_OFF.to - WIRE_OFF.from, **never)
    check_wire(run, how, WIRE.from, WIRE_OFF.to, 0.12)
    Report.at_most("wire #{how}: the temperature rises by",
                   run.values('temperature_c', WIRE.from, WIRE.to).max - OVEN_SET_C, 0.5, 'C')
    Report.at_most("wire #{how}, acknowledged: overshoot",
                   overshoot_percent(run, WIRE_OFF.to, 45.0), 0.5, '%')
    Report.at_most("wire #{how}, acknowledged: settles within 2 % after",
                   settled(run, WIRE_OFF.to, 45.0), 10.0, 's')
  end
end

# The drive is off `after` seconds after the wire broke, until the alarm is acknowledged.
def check_wire(run, how, from, to, after)
  Report.at_most("wire #{how}: the drive, #{after} s later",
                 run.values('drive_counts', from + after, to).max,
                 0.0, 'counts')
  Report.at_least("wire #{how}: the temperature falls by",
                  OVEN_SET_C - run.values('temperature_c', from, to).last,
                  15.0, 'C')
end

def check_thermostat_integration(run)
  half = run_thermostat('thermostat-half_step', plant_step: 0.5e-3)
  Report.at_most('half the integrator\'s step changes the temperature by',
                 largest_difference(run, half, 'temperature_c'), 0.001, 'C')
end

def draw_thermostat(run)
  plot = Plot.new('thermostat', 'An oven held at 80 °C: from cold, by hand, on less power, ' \
                                'with the door open, without its sensor',
                  height: 720, rows: [1.6, 1.0, 1.0], gap_y: 0.04,
                  margins: { top: 0.935, bottom: 0.08 })
  thermostat_temperature(plot, run)
  thermostat_drive(plot, run)
  thermostat_terms(plot, run)
  plot.draw
end

# What happens in each stretch of time, said in the topmost panel.
THERMOSTAT_STORY = [
  [0.0, 'from cold:', 'no overshoot'],
  [MANUAL.from, 'by hand,', '10 %'],
  [MANUAL.to, 'automatic again:', 'no bump'],
  [LOW_POWER.from, 'power limited', 'to 12.5 %'],
  [LOW_POWER.to, 'full power:', 'no windup'],
  [DOOR.from, 'door', 'open'],
  [DOOR.to, 'door', 'shut'],
  [BREAK.from, 'wire', 'broken'],
  [BREAK.to, 'alarm', 'stays'],
  [OFF.from, 'at', 'off'],
  [OFF.to, 'automatic', 'again'],
  [THERMOSTAT_END_S]
].freeze

# What the person does, as grey stretches.
def stretches(top)
  [MANUAL, LOW_POWER, DOOR, BREAK, OFF].each_with_index.map { |stretch, i| grey(i + 1, stretch, top) }
end

def grey(number, stretch, top)
  "set object #{number} rectangle from #{stretch.from}, graph 0 to " \
    "#{stretch.to}, graph #{top} behind fillcolor '#{Plot::AREA}' fillstyle " \
    'solid noborder'
end

def story
  THERMOSTAT_STORY.each_cons(2).map do |(from, *words), (to)|
    "set label \"#{words.join('\\n')}\" at #{(from + to) / 2.0}, graph 0.13 center"
  end
end

def thermostat_temperature(plot, run)
  plot.panel(0, 0,
             [Plot.curve(run, 'temperature_c', Plot::MEASUREMENT,
                         width: 2.2),
              Plot.setpoint(run, 'setpoint_c')],
             [*stretches(1), *story, Plot.text('temperature', 3.2, 60, Plot::MEASUREMENT),
              Plot.text('setpoint', 3.2, 87, Plot::SETPOINT), "set xrange [0:#{THERMOSTAT_END_S}]", "set format x ''",
              'set yrange [0:110]', 'set ytics 20', *y_label(0, 'temperature, °C')])
end

def thermostat_drive(plot, run)
  limit = "(column('selector') == 3 ? 12.5 : 100)"
  plot.panel(1, 0,
             [Plot.curve(run, "(column('drive_counts')/10.23)", Plot::OUTPUT),
              Plot.curve(run, limit, Plot::LIMIT, style: 'dashtype 3',
                                                       width: 1.2)],
             [*stretches(1), Plot.text('drive', 6, 30, Plot::OUTPUT), Plot.text('limit', 6, 111, Plot::LIMIT_TEXT),
              "set xrange [0:#{THERMOSTAT_END_S}]", "set format x ''",
              'set yrange [0:130]', 'set ytics 50', *y_label(0, 'drive, %')])
end

def thermostat_terms(plot, run)
  plot.panel(2, 0, Plot.terms(run, scale: 100.0 / 1023.0, span: THERMOSTAT_END_S),
             [*stretches(1), *Plot.terms_text([6, -37], [6, 78], [6, 14]), "set xrange [0:#{THERMOSTAT_END_S}]", "set xlabel 'time, s'",
              'set yrange [-90:110]', 'set ytics 50', *y_label(0, 'P, I and D, %')])
end

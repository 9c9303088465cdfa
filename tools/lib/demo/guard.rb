# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# fixpid_guard beside machines that are whole and should raise no alarm, and beside the same
# when they break for good. Whoever gets a false alarm takes the guard out, and whoever gets
# none when the oven burns need not have built it in.
require_relative 'extent'
require_relative 'machines'

GUARD_SEED = 1
GUARD_STEPS = 20_000
GUARD_MACHINES = Extent.share(30, 5) # of each kind
GUARD_BROKEN = Extent.share(12, 6)
GUARD_KINDS = MACHINE_KINDS - 1      # all but the unstable one

# What a guard is set by, and percent of the machines on which it may raise an alarm.
GUARD_RULES = { 'autotune' => ['a model of `fixpid_autotune`', 6.4], 'reaction' => ['a model of `fixpid_reaction`', 6.4],
                'rule' => ['no model', 6.0], 'twenty' => ['a model, with 20 bands for all', nil],
                'reach_0' => ['a model, `reach_min` and `reach_max` 0', nil],
                'reach_rest' => ['a model, `reach_min` 3 % of the scale above the reading at rest', nil] }.freeze
# Others' rules, for heaters only.
GUARD_PEERS = { 'marlin' => 'Marlin', 'klipper' => 'Klipper' }.freeze
GUARD_FLAGS = { 'NOT_RISING' => 0x01, 'NOT_FALLING' => 0x02, 'FROZEN' => 0x04, 'OSCILLATING' => 0x08,
                'SENSOR_LOW' => 0x10, 'SENSOR_HIGH' => 0x20 }.freeze

# Those which burn things or leave the loop without control: each is seen on nearly every
# machine. A motor that stands at its place needs no drive: two of them do nothing to it.
GUARD_ALWAYS = %w[open short fallen stuck_low stuck_high drive_on drive_off sign].freeze
GUARD_NEEDS_DRIVE = %w[drive_off sign].freeze
GUARD_FAULTS = { 'open' => 'sensor open: reads full scale', 'short' => 'sensor shorted: reads 0',
                 'fallen' => 'sensor fallen off', 'stuck_low' => 'sensor stuck 10 % of its range below the setpoint',
                 'stuck_high' => 'sensor stuck 3 % above', 'drive_on' => 'drive always on', 'drive_off' => 'no drive',
                 'sign' => 'sign turned round', 'stuck_2' => 'sensor stuck 2 counts below',
                 'stuck_at' => 'sensor stuck at the setpoint', 'stuck_noisy' => 'sensor stuck 0.5 % below, with noise',
                 'drift' => 'sensor drifts slowly to 30 % below', 'half' => 'drive at half' }.freeze

# A machine is far over beyond a fifth of the sensor's range above its setpoint.
GUARD_FAR = 20.0
GUARD_INTEGRATORS = ['motor position'].freeze
GUARD_CLASSES = {
  'L up to T / 4' => ->(row) { !GUARD_INTEGRATORS.include?(row['kind']) && row['dead'].to_f <= 0.25 },
  'L longer' => ->(row) { !GUARD_INTEGRATORS.include?(row['kind']) && row['dead'].to_f > 0.25 },
  'integrating' => ->(row) { GUARD_INTEGRATORS.include?(row['kind']) }
}.freeze

# The boiler of the quick start, and the same read more often by a sensor with noise:
# the program's arguments, and the hottest that each fault may get it to with the guard,
# a degree above what was measured when the limit was set.
BOILERS = { 'quick start' => %w[1 0], 'ten steps a second, noise 0.1 C' => %w[10 1] }.freeze
BOILER_FAULTS = { 'stuck_3' => 'sensor stuck 0.3 C low', 'stuck_100' => 'sensor stuck 10 C low',
                  'fallen' => 'sensor fallen off', 'shorted' => 'sensor shorted: reads 0',
                  'open' => 'sensor open: reads 200 C', 'shut' => 'relay shut for good', 'sign' => 'sign turned round',
                  'burnt' => 'heater burnt out' }.freeze
BOILER_HOTTEST = { 'quick start' => [88, 86, 86, 82, 61, 87, 91, 61],
                   'ten steps a second, noise 0.1 C' => [62, 83, 79, 64, 62, 82, 82, 62] }.freeze
BOILER_BROKEN_S = 60.0
BOILER_SECONDS = 419.0
BOILER_HARMLESS = %w[open burnt].freeze # it cools down by itself

def guard
  check_whole
  check_broken
  boilers = BOILERS.to_h { |title, words| [title, Trace.new(Host.print('boiler', "guard-boiler-#{words[0]}.csv", *words), BOILER_SECONDS)] }
  boilers.each { |title, boiler| check_boiler(title, boiler) }
  draw_boiler(boilers.values.first)
end

def healthy_rows(name, share)
  Loops.read(Host.print('healthy', "guard-#{name}.txt", *[GUARD_SEED, GUARD_MACHINES, GUARD_STEPS, share].map(&:to_s)),
             GUARD_MACHINES * GUARD_KINDS)
end

# A machine may have no guard.
def broken_rows
  path = Host.print('broken', 'guard-faults.txt', GUARD_SEED.to_s, GUARD_BROKEN.to_s)
  Loops.read(path, File.readlines(path).size - 1)
end

def check_whole
  rows = healthy_rows('healthy', 1.0)
  hasty = healthy_rows('hasty', 0.5) if Extent.whole?
  GUARD_RULES.each do |rule, (title, most)|
    there = with_guard(rows, rule)
    alarms = alarmed(there, rule)
    Report.at_most("whole machines, #{title}: with an alarm", 100.0 * alarms / there.size, Extent.whole? ? most : 12.0, '%') if most
    next unless Extent.whole?

    Report.number("healthy #{rule}", { 'plants' => there.size, 'alarms' => alarms, 'hasty' => alarmed(with_guard(hasty, rule), rule),
                                       'flags' => GUARD_FLAGS.transform_values { |bit| there.count { |row| row[rule].to_i & bit != 0 } } })
  end
  GUARD_PEERS.each_key do |peer|
    there = with_guard(rows, peer)
    Report.number("healthy #{peer}", { 'plants' => there.size, 'alarms' => alarmed(there, peer) })
  end
end

# Where there is a guard by this rule.
def with_guard(rows, rule)
  rows.select { |row| row[rule].to_i >= 0 }
end

def alarmed(rows, rule)
  rows.count { |row| row[rule].to_i != 0 }
end

def check_broken
  rows = broken_rows
  Report.at_least('machines with a guard', rows.size, 0.95 * GUARD_BROKEN * GUARD_KINDS)
  GUARD_FAULTS.each do |fault, title|
    seen = rows.select { |row| row[fault].to_i >= 0 }
    if GUARD_ALWAYS.include?(fault)
      Report.at_most("#{title}: not seen", share_blind(rows, fault), 1.0, '%')
    elsif Extent.whole?
      Report.unchanged("#{title}: seen", seen.size)
    end
    times = seen.map { |row| row[fault].to_i / row['scale'].to_f }.sort
    Report.number(fault, { 'seen' => seen.size, 'times' => [0.5, 0.95].map { |part| times[((times.size - 1) * part).floor] },
                           'far' => GUARD_CLASSES.values.map { |of| far_over(rows.select(&of), fault) },
                           'heaters' => seen_on_heaters(rows, fault) })
  end
end

# Of the heaters, what the guard and others see, in percent, and the median time until then.
def seen_on_heaters(rows, fault)
  heaters = rows.select { |row| row['heater'] == '1' }
  [fault, *GUARD_PEERS.keys.map { |peer| "#{fault}_#{peer}" }].map do |column|
    times = heaters.reject { |row| row[column].to_i.negative? }.map { |row| row[column].to_i / row['scale'].to_f }.sort
    [100.0 * times.size / heaters.size, times[(times.size - 1) / 2]]
  end
end

# Percent without an alarm of the machines to which it does something.
def share_blind(rows, fault)
  hurt = GUARD_NEEDS_DRIVE.include?(fault) ? rows.reject { |row| GUARD_INTEGRATORS.include?(row['kind']) } : rows
  100.0 * hurt.count { |row| row[fault].to_i.negative? } / hurt.size
end

# How many are far over, if nobody acts and if the alarm cuts the supply.
def far_over(rows, fault)
  %w[without with].map { |way| rows.count { |row| row["#{fault}_#{way}"].to_f > GUARD_FAR } }
end

# Seconds from the fault to the alarm; nil: none.
def boiler_alarm(boiler, fault)
  first = boiler.values("#{fault}_alarms").index(&:positive?)
  first && boiler.times[first] - BOILER_BROKEN_S
end

def check_boiler(title, boiler)
  rows = BOILER_FAULTS.keys.zip(BOILER_HOTTEST.fetch(title)).to_h do |fault, limit|
    [fault, check_boiler_fault("boiler, #{title}, #{BOILER_FAULTS[fault]}", boiler, fault, limit)]
  end
  Report.number(title, rows)
end

def check_boiler_fault(what, boiler, fault, limit)
  alarm = boiler_alarm(boiler, fault)
  without, with = %w[without with].map { |way| boiler.peak("#{fault}_#{way}", BOILER_BROKEN_S) }
  Report.exactly("#{what}: alarms before", boiler.values("#{fault}_alarms", 0.0, BOILER_BROKEN_S).max, 0.0)
  Report.at_least("#{what}: alarm after", alarm, 0.0, 's')
  Report.at_most("#{what}: hottest with the guard", with, limit, 'C')
  Report.at_least("#{what}: hottest without", without, 120.0, 'C') unless BOILER_HARMLESS.include?(fault)
  { 'without' => without, 'with' => with, 'alarm' => alarm }
end

def draw_boiler(boiler)
  plot = Plot.new('guard', 'The boiler of the quick start, set to 60 °C, which breaks at 60 s', height: 1050, columns: [1.0, 1.0],
                                                                                                rows: [1.0] * 4, gap_x: 0.09, gap_y: 0.07,
                                                                                                margins: { top: 0.92, bottom: 0.06 })
  BOILER_FAULTS.keys.each_with_index { |fault, i| boiler_panel(plot, boiler, fault, i) }
  plot.draw
end

def boiler_panel(plot, boiler, fault, place)
  row, column = place.divmod(2)
  peaks = %w[without with].map { |way| format('%.1f °C', boiler.peak("#{fault}_#{way}", BOILER_BROKEN_S)) }
  alarm = boiler_alarm(boiler, fault)
  plot.panel(row, column,
             ["60 linecolor '#{Plot::SETPOINT}' dashtype 2 notitle", Plot.curve(boiler, "#{fault}_without", Plot::WITHOUT),
              Plot.curve(boiler, "#{fault}_with", Plot::MEASUREMENT)],
             ["set title '#{BOILER_FAULTS[fault]}' font ',11' offset 0,-0.6", 'set xrange [0:400]',
              'set yrange [0:140]', 'set ytics 40', "set ylabel 'boiler, °C'", "set xlabel 'time, s' offset 0,0.6",
              "set label 'without the guard: #{peaks[0]}' at 395, 131 right textcolor '#{Plot::WITHOUT}'",
              "set label 'with it: #{peaks[1]}, alarm after #{alarm ? format('%.0f s', alarm) : 'never'}' " \
              "at 395, 10 right textcolor '#{Plot::MEASUREMENT}'"])
end

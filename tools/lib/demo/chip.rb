# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The examples as firmware on simulated chips, each beside the host's run of
# the same scenario.
require_relative 'extent'

class Chip
  attr_reader :name, :example, :title, :chip, :host, :step, :step_ticks, :lines,
              :start_s

  TICK_S = 1e-3 # of the chips that do not control on each tick

  # The loop controls once in `step_ticks`, and the traces have a row for each
  # time: the longest pass of a row is the one that controls.
  def initialize(name, title, step, scenario, step_ticks: 1)
    @name = name
    @example = name[/^[a-z]+(_8bit)?/] # what follows is a chip
    @title = title
    @step = step
    @scenario = scenario
    @step_ticks = step_ticks
    @every = step_ticks * TICK_S if step_ticks > 1
  end

  def run_on_host
    @host = Host.run(@example, "chip-#{@name}_host", every: @every, **@scenario)
  end

  # With what the co-simulation says in its last lines.
  def run_on_chip
    csv, log = %w[csv txt].map { |kind| "#{Host.folder}/chip-#{@name}.#{kind}" }
    options = @scenario.flat_map { |key, value| ['--set', "#{key}=#{value}"] }
    options += ['--every', @every.to_s] if @every
    Host.execute({}, "#{Host.root}/build/gpsim/#{@name}",
                 firmware, '--csv', csv, '--meter', @step, *options, { out: log })
    @chip = Trace.new(csv, Host.seconds(@example, @scenario))
    @lines = File.read(log)
    @start_s = find(/^ready: ([\d.]+) s/)
  end

  # An AVR's is .elf.
  def firmware
    Dir["#{Host.root}/build/firmware/#{@name}.{cod,elf}"].first or
      raise Host::Failure, "no firmware of #{@name}"
  end

  def find(pattern)
    found = pattern.match(@lines) or
      raise Host::Failure, "the run of #{@name} did not say #{pattern}"
    found[1].to_f
  end

  def sizes
    @sizes ||= JSON.parse(File.read("#{Host.root}/build/firmware/sizes.json"))
                   .fetch(@name)
  end

  # [time, chip minus host], with the chip's time counted from `start` after
  # power-on, between its rows on the straight line.
  def differences(column, from, to, start = start_s)
    period = chip.times[1]
    values = chip.values(column)
    rows = host.times(from, to).zip(host.values(column, from, to))
    found = rows.map do |time, value|
      row, part = ((time + start) / period).divmod(1)
      low, high = values[row, 2]
      high && [time, low + part * (high - low) - value]
    end.compact
    # The chip starts later, so its run ends a little before the host's.
    found.size > 0.95 * rows.size or raise Host::Failure, "#{chip.path} ends early"
    found
  end
end

# The sensor's wire breaks, between two passes of a loop, and a person acknowledges the
# alarm when it is whole.
CHIP_OVEN_WIRE = Stretch.new(15.05, 17.05)
CHIP_OVEN_DOWN = Stretch.new(18.05, 19.05)
CHIP_THERMOSTAT_WIRE = Stretch.new(44.05, 48.05)
CHIP_THERMOSTAT_OFF = Stretch.new(49.05, 50.05)
OVEN_ON_CHIP = { seconds: 20, wire_at: CHIP_OVEN_WIRE.from, wire_for: 2,
                 down_at: CHIP_OVEN_DOWN.from, down_for: 1 }.freeze
THERMOSTAT_ON_CHIP = { seconds: 60, wire_at: CHIP_THERMOSTAT_WIRE.from, wire_for: 4,
                       off_at: CHIP_THERMOSTAT_OFF.from, off_for: 1 }.freeze

CHIPS = [
  Chip.new('pendulum', 'pendulum, AN964 on a PIC16F684', 'fixpid_an964_step',
           POTENTIOMETERS),
  Chip.new('pendulum_8bit', 'the same in 8 x 8 bits', 'fixpid_an964_8bit_step',
           POTENTIOMETERS),
  Chip.new('motor', 'motor, AN937 on a PIC18F4520', 'fixpid_an937_step', {}),
  Chip.new('oven', 'oven, AN937 on a PIC18F4520', 'fixpid_an937_step',
           OVEN_ON_CHIP),
  Chip.new('thermostat', 'thermostat on a PIC18F4520', 'fixpid_pid_step',
           THERMOSTAT_ON_CHIP, step_ticks: 100),
  Chip.new('autotune', 'oven by itself on a PIC18F4520', 'fixpid_pid_step',
           { seconds: 41 }, step_ticks: 100),
  Chip.new('experiment', 'relay experiment alone on a PIC18F4520', 'fixpid_autotune_step',
           { seconds: 85 }, step_ticks: 100),
  Chip.new('motor_pic18f26k22', 'motor, AN937 on a PIC18F26K22', 'fixpid_an937_step',
           {}),
  Chip.new('oven_pic18f26k22', 'oven, AN937 on a PIC18F26K22', 'fixpid_an937_step',
           OVEN_ON_CHIP),
  Chip.new('thermostat_pic18f26k22', 'thermostat on a PIC18F26K22', 'fixpid_pid_step',
           THERMOSTAT_ON_CHIP, step_ticks: 100),
  Chip.new('motor_atmega328p', 'motor, AN937 on an Arduino Uno', 'fixpid_an937_step',
           {}),
  Chip.new('oven_atmega328p', 'oven, AN937 on an Arduino Uno', 'fixpid_an937_step',
           OVEN_ON_CHIP),
  Chip.new('thermostat_atmega328p', 'thermostat on an Arduino Uno', 'fixpid_pid_step',
           THERMOSTAT_ON_CHIP, step_ticks: 100),
  Chip.new('autotune_atmega328p', 'oven by itself on an Arduino Uno', 'fixpid_pid_step',
           { seconds: 41 }, step_ticks: 100)
].freeze

# One of each kind.
CHIPS_OF_PART = %w[pendulum motor motor_atmega328p].freeze
CHIPS_RUN = CHIPS.select { |one| Extent.whole? || CHIPS_OF_PART.include?(one.name) }.freeze

# How far the chip may be off the host, by column, from one time to another. The
# motor's load comes when it comes, however long the chip took to start.
Agreement = Struct.new(:column, :unit, :from, :to, :most, :start) do
  def differences(one)
    one.differences(column, from, to, start || one.start_s)
  end

  def check(one, what = 'agrees with the host')
    Report.at_most("#{what} within",
                   differences(one).map { |_, off| off.abs }.max, most, unit)
  end
end

MOTOR_AGREES = [Agreement.new('speed_rad_s', 'rad/s', 0.0, 0.6, 10.0),
                Agreement.new('speed_rad_s', 'rad/s', 0.6, 1.2, 4.0, 0.0)].freeze
OVEN_AGREES = [Agreement.new('temperature_c', 'C', 0.0, 20.0, 0.05)].freeze
# When the alarm is acknowledged it begins anew, a period sooner or later.
THERMOSTAT_AGREES = [Agreement.new('temperature_c', 'C', 0.0, CHIP_THERMOSTAT_OFF.to, 0.1),
                     Agreement.new('temperature_c', 'C', CHIP_THERMOSTAT_OFF.to, 60.0, 0.5)].freeze
TUNED_AGREES = [Agreement.new('temperature_c', 'C', 0.0, 41.0, 0.1)].freeze
AGREEMENTS = {
  'pendulum' => [Agreement.new('angle_degrees', 'degrees', 0.0, 1.0, 0.15)],
  'pendulum_8bit' => [Agreement.new('angle_degrees', 'degrees', 0.0, 1.0, 0.15)],
  'motor' => MOTOR_AGREES,
  'oven' => OVEN_AGREES,
  'thermostat' => THERMOSTAT_AGREES,
  'autotune' => TUNED_AGREES,
  'experiment' => [Agreement.new('temperature_c', 'C', 0.0, 85.0, 0.1)],
  'motor_pic18f26k22' => MOTOR_AGREES,
  'oven_pic18f26k22' => OVEN_AGREES,
  'thermostat_pic18f26k22' => THERMOSTAT_AGREES,
  # Its loop comes round every quarter of a tick, in which a start gains 3 rad/s.
  'motor_atmega328p' => [Agreement.new('speed_rad_s', 'rad/s', 0.0, 0.6, 15.0),
                         Agreement.new('speed_rad_s', 'rad/s', 0.6, 1.2, 4.0, 0.0)],
  'oven_atmega328p' => OVEN_AGREES,
  'thermostat_atmega328p' => THERMOSTAT_AGREES,
  'autotune_atmega328p' => TUNED_AGREES
}.freeze

# To simulate, so they begin first.
LONGEST = %w[thermostat thermostat_pic18f26k22 experiment oven oven_pic18f26k22 thermostat_atmega328p
             oven_atmega328p autotune].freeze

def chip
  CHIPS_RUN.each(&:run_on_host)
  run_two_at_a_time(CHIPS_RUN.sort_by { |one| LONGEST.index(one.name) || LONGEST.size })
  CHIPS_RUN.each do |one|
    Report.start("chip #{one.name}")
    check_on_chip(one)
    check_resources(one)
  end
  draw_chips
  Report.note(*chip_table)
end

def run_two_at_a_time(chips)
  waiting = chips.dup
  Array.new(2) do
    Thread.new do
      Thread.current.report_on_exception = false
      while (one = waiting.shift)
        one.run_on_chip
      end
    end
  end.each(&:join)
end

def check_on_chip(one)
  case one.example
  when 'motor' then check_motor_on_chip(one)
  when 'oven' then check_oven_on_chip(one)
  when 'thermostat' then check_thermostat_on_chip(one)
  when 'autotune' then check_autotune_on_chip(one)
  when 'experiment' then check_experiment_on_chip(one)
  else check_pendulum_on_chip(one)
  end
end

# A transient is the same; what follows is a limit cycle around a count, in
# which the smallest difference grows: only sizes can be compared. On the
# chip it is larger, because its port makes no drive of 1 to 3 counts.
def check_pendulum_on_chip(one)
  run = one.chip
  check_balance(run)
  Report.at_most('base from its start', run.peak('base_m'), 5.0, 'm')
  AGREEMENTS[one.name][0].check(one, 'agrees with the host for 1 s')
  shoves = [run, one.host].map { |r| r.peak('angle_degrees', SHOVE_S, 6.0) }
  Report.at_most('largest angle of the shove agrees within',
                 (shoves[0] - shoves[1]).abs, 0.3, 'degrees')
  swings = [run, one.host].map { |r| effective(r, 'angle_degrees', 7.0) }
  Report.at_most('effective swing from 7 s agrees within',
                 (swings[0] - swings[1]).abs, 0.05, 'degrees')
end

def effective(run, column, from)
  values = run.values(column, from)
  Math.sqrt(values.sum { |v| v * v } / values.size)
end

# The chip is at its loop a moment after power-on, but the load comes when it
# comes.
def check_motor_on_chip(one)
  run = one.chip
  Report.at_most('speed within 2 % after', reached(run), 0.15, 's')
  Report.at_most('overshoot, limit 4000', overshoot(run), 20.0, '%')
  check_schedule(run)
  check_load(run)
  start, load = AGREEMENTS[one.name]
  start.check(one, 'start and schedule agree with the host')
  load.check(one, 'load agrees with the host')
end

def check_oven_on_chip(one)
  run = one.chip
  Report.at_most('remaining offset',
                 (OVEN_SET_C - run.mean('temperature_c', 10.0, 15.0)).abs,
                 0.5, 'C')
  Report.at_most('overshoot', oven_overshoot(run), 5.0, '%')
  Report.at_most('settles within 2 % after', oven_settling(run, 15.0),
                 1.1 * oven_settling(one.host, 15.0), 's')
  check_wire(run, 'open', CHIP_OVEN_WIRE.from, CHIP_OVEN_DOWN.to, 0.02)
  Report.at_least('acknowledged: the drive', run.values('drive_counts', CHIP_OVEN_DOWN.to + 0.1).min,
                  1.0, 'counts')
  AGREEMENTS[one.name][0].check(one)
end

def check_thermostat_on_chip(one)
  run = one.chip
  check_warming(run)
  check_manual(run, CHIP_THERMOSTAT_WIRE.from)
  limited = run.values('drive_counts', LOW_POWER.from + SEEN_S)
  Report.at_most('limit lowered: the drive, at once', limited.max, LOW_LIMIT,
                 'counts')
  check_wire(run, 'open', CHIP_THERMOSTAT_WIRE.from, CHIP_THERMOSTAT_OFF.to, 0.12)
  Report.at_least('acknowledged: the drive',
                  run.values('drive_counts', CHIP_THERMOSTAT_OFF.to + SEEN_S).max, 1.0, 'counts')
  before, after = AGREEMENTS[one.name]
  before.check(one)
  after.check(one, 'acknowledged: agrees with the host')
end

def check_autotune_on_chip(one)
  check_heat_up(one.chip)
  check_found_on_chip(one)
end

# This machine computes the gains, of the record in the chip's RAM.
def check_experiment_on_chip(one)
  Report.exactly('the heater is off in the end', one.chip.values('drive_counts', 84.0).max, 0.0)
  check_found_on_chip(one)
end

# The gains are as the reading was, to its noise.
def check_found_on_chip(one)
  gains = [one.lines, Host.printed("chip-#{one.name}_host")]
          .map { |text| found_gains(text).first(2) }
  %w[kp ki].zip(*gains).each do |name, found, on_host|
    Report.at_most("#{name}: agrees with the host within",
                   100.0 * (found.to_f / on_host - 1.0).abs, 3.0, '%')
  end
  AGREEMENTS[one.name][0].check(one)
end

def check_resources(one)
  sizes = one.sizes
  Report.at_most('flash', sizes['flash'], sizes['flash_size'],
                 sizes['flash_unit'])
  Report.at_most('RAM', sizes['ram'], sizes['ram_size'], 'bytes')
  share = one.find(/^share of a tick: worst ([\d.]+)/)
  if one.step_ticks > 1
    Report.at_most("worst pass of the loop, share of #{one.step_ticks} ticks",
                   share / one.step_ticks, 100.0, '%')
  else
    Report.at_most('worst pass of the loop, share of a tick', share, 100.0, '%')
  end
  { 'worst_step_cycles' => /^routine \S+ .* to (\d+) cycles/,
    'worst_pass_cycles' => /^loop: .* to (\d+) cycles/,
    'worst_interrupt_cycles' => /^interrupt .* to (\d+) cycles/,
    'return_stack' => /^return stack: (\d+)/,
    'times_real_time' => /, ([\d.]+) times real time/ }
    .each { |name, pattern| Report.number(name, one.find(pattern)) }
end

def chip_table
  head = ['firmware', 'flash', 'RAM', 'worst step', 'worst pass', 'of a tick',
          'interrupt', 'stack', 'real time']
  rows = CHIPS_RUN.map do |one|
    sizes = one.sizes
    numbers = Report.numbers["chip #{one.name}"]
    [one.name, "#{sizes['flash']} #{sizes['flash_unit']}",
     "#{sizes['ram']} bytes",
     *%w[step pass].map { |n| "#{numbers["worst_#{n}_cycles"].to_i} cycles" },
     format('%.1f %%', one.find(/^share of a tick: worst ([\d.]+)/)),
     "#{numbers['worst_interrupt_cycles'].to_i} cycles",
     one.lines[/^return stack: (\d+ \w+)/, 1],
     format('%.1f x', numbers['times_real_time'])]
  end
  widths = [head, *rows].transpose.map { |column| column.map(&:size).max }
  [head, *rows].map do |row|
    row.zip(widths).map { |text, w| text.ljust(w) }.join('  ').rstrip
  end
end

# One row for each firmware, and in it one dot for each stretch in which it is compared, the later
# one lower: the greatest difference as a part of the one that is allowed, the line at the right.
def draw_chips
  rows = CHIPS_RUN.each_with_index.flat_map do |one, i|
    parts = AGREEMENTS.fetch(one.name)
    parts.each_with_index.map { |part, k| [greatest(one, part), CHIPS_RUN.size - i + (parts.size - 1 - 2 * k) * 0.22, part] }
  end
  path = "#{Host.folder}/chip_differences.csv"
  Report.replace(path, rows.map { |most, row, part| "#{most / part.most},#{row},#{said(most, part)}\n" }.join)
  plot = Plot.new('chip', 'The same program on a simulated chip and on this machine: how far they ever differ',
                  width: 1000, height: 680, margins: { left: 0.30, right: 0.97, top: 0.90, bottom: 0.12 })
  plot.panel(0, 0, ["'#{path}' using 1:2 with points pointtype 7 pointsize 1.3 linecolor '#{Plot::MEASUREMENT}' notitle",
                    "'#{path}' using 1:2:3 with labels left offset 1.2,0 textcolor '#{Plot::TEXT}' notitle"], dots)
  plot.draw
end

def greatest(one, part)
  part.differences(one).map { |_, off| off.abs }.max
end

def said(most, part)
  format('%.2g of %g %s', most, part.most, part.unit == 'C' ? '°C' : part.unit)
end

def dots
  names = CHIPS_RUN.each_with_index.map { |one, i| "'#{one.title}' #{CHIPS_RUN.size - i}" }
  ["set ytics (#{names.join(', ')}) scale 0", "set yrange [0.3:#{CHIPS_RUN.size + 0.7}]", 'set xrange [0:1.25]',
   'set xtics 0.25', "set xlabel 'the greatest difference, as a part of what is allowed'",
   "set arrow from 1, graph 0 to 1, graph 1 nohead linecolor '#{Plot::LIMIT}' linewidth 1.6",
   "set label 'allowed' at 1, graph 1.02 center textcolor '#{Plot::TEXT}'"]
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The examples as firmware on simulated chips, each beside the host's run of
# the same scenario.
class Chip
  attr_reader :name, :title, :chip, :host, :step, :step_ticks, :lines, :start_s

  TICK_S = 1e-3 # of the chips that do not control on each tick

  # The loop controls once in `step_ticks`, and the traces have a row for each
  # time: the longest pass of a row is the one that controls.
  def initialize(name, title, step, scenario, step_ticks: 1)
    @name = name
    @title = title
    @step = step
    @scenario = scenario
    @step_ticks = step_ticks
    @every = step_ticks * TICK_S if step_ticks > 1
  end

  def run_on_host
    @host = Host.run(@name, "chip-#{@name}_host", every: @every, **@scenario)
  end

  # With what the co-simulation says in its last lines.
  def run_on_chip
    csv, log = %w[csv txt].map { |kind| "#{Host.folder}/chip-#{@name}.#{kind}" }
    options = @scenario.flat_map { |key, value| ['--set', "#{key}=#{value}"] }
    options += ['--every', @every.to_s] if @every
    Host.execute({}, "#{Host.root}/build/gpsim/#{@name}",
                 "#{Host.root}/build/firmware/#{@name}.cod", '--csv', csv,
                 '--meter', @step, *options, { out: log })
    @chip = Trace.new(csv)
    @lines = File.read(log)
    @start_s = find(/^ready: ([\d.]+) s/)
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

  # How far the two are apart, with the chip's time counted from `start` after
  # power-on, between its rows on the straight line.
  def distance(column, from, to, start = start_s)
    chip_times = chip.times
    period = chip_times[1]
    values = chip.values(column)
    rows = host.times(from, to).zip(host.values(column, from, to))
    found = rows.map do |time, value|
      row, part = ((time + start) / period).divmod(1)
      low, high = values[row, 2]
      high && (low + part * (high - low) - value).abs
    end.compact
    # The chip starts later, so its run ends a little before the host's.
    found.size > 0.95 * rows.size or raise Host::Failure, "#{chip.path} ends early"
    found.max
  end
end

CHIPS = [
  Chip.new('pendulum', 'AN964, 10 bits, on a PIC16F684', 'fixpid_an964_step',
           POTENTIOMETERS),
  Chip.new('pendulum_8bit', 'AN964, 8 x 8 bits, on a PIC16F684',
           'fixpid_an964_8bit_step', POTENTIOMETERS),
  Chip.new('motor', 'AN937, motor, on a PIC18F4520', 'fixpid_an937_step', {}),
  Chip.new('oven', 'AN937, oven, on a PIC18F4520', 'fixpid_an937_step',
           { seconds: 15 }),
  Chip.new('thermostat', 'thermostat, on a PIC18F4520', 'fixpid_pid_step',
           { seconds: 60 }, step_ticks: 100),
  Chip.new('autotune', 'autotuner, on a PIC18F4520', 'fixpid_pid_step',
           { seconds: 40 }, step_ticks: 100)
].freeze

# To simulate, so they begin first.
LONGEST = %w[thermostat autotune oven].freeze

def chip
  CHIPS.each(&:run_on_host)
  run_two_at_a_time(CHIPS.sort_by { |one| LONGEST.index(one.name) || 9 })
  CHIPS.each do |one|
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
  case one.name
  when 'motor' then check_motor_on_chip(one)
  when 'oven' then check_oven_on_chip(one)
  when 'thermostat' then check_thermostat_on_chip(one)
  when 'autotune' then check_autotune_on_chip(one)
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
  Report.at_most('agrees with the host for 1 s within',
                 one.distance('angle_degrees', 0.0, 1.0), 0.15, 'degrees')
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
  Report.at_most('start and schedule agree with the host within',
                 one.distance('speed_rad_s', 0.0, 0.6), 10.0, 'rad/s')
  Report.at_most('load agrees with the host within',
                 one.distance('speed_rad_s', 0.6, 1.2, 0.0), 4.0, 'rad/s')
end

def check_oven_on_chip(one)
  run = one.chip
  Report.at_most('remaining offset',
                 (OVEN_SET_C - run.mean('temperature_c', 10.0, 15.0)).abs,
                 0.5, 'C')
  Report.at_most('overshoot', oven_overshoot(run), 5.0, '%')
  Report.at_most('settles within 2 % after', oven_settling(run),
                 1.1 * oven_settling(one.host), 's')
  Report.at_most('agrees with the host within',
                 one.distance('temperature_c', 0.0, 15.0), 0.05, 'C')
end

def check_thermostat_on_chip(one)
  run = one.chip
  check_warming(run)
  check_manual(run)
  limited = run.values('drive_counts', LOW_POWER.from + SEEN_S)
  Report.at_most('limit lowered: the drive, at once', limited.max, LOW_LIMIT,
                 'counts')
  Report.at_most('agrees with the host within',
                 one.distance('temperature_c', 0.0, 60.0), 0.1, 'C')
end

# The gains are as the swing was, to its noise.
def check_autotune_on_chip(one)
  check_experiment(one.chip)
  gains = [one.lines, Host.printed('chip-autotune_host')]
          .map { |text| found_gains(text).first(3) }
  %w[kp ki kd].zip(*gains).each do |name, found, on_host|
    Report.at_most("#{name}: agrees with the host within",
                   100.0 * (found.to_f / on_host - 1.0).abs, 3.0, '%')
  end
  Report.at_most('agrees with the host within',
                 one.distance('temperature_c', 0.0, 40.0), 0.1, 'C')
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
    'return_stack_levels' => /^return stack: (\d+)/,
    'times_real_time' => /, ([\d.]+) times real time/ }
    .each { |name, pattern| Report.number(name, one.find(pattern)) }
end

def chip_table
  head = ['firmware', 'flash', 'RAM', 'worst step', 'worst pass', 'of a tick',
          'interrupt', 'stack', 'real time']
  rows = CHIPS.map do |one|
    sizes = one.sizes
    numbers = Report.numbers["chip #{one.name}"]
    [one.name, "#{sizes['flash']} #{sizes['flash_unit']}",
     "#{sizes['ram']} bytes",
     *%w[step pass].map { |n| "#{numbers["worst_#{n}_cycles"].to_i} cycles" },
     format('%.1f %%', one.find(/^share of a tick: worst ([\d.]+)/)),
     "#{numbers['worst_interrupt_cycles'].to_i} cycles",
     "#{numbers['return_stack_levels'].to_i} levels",
     format('%.1f x', numbers['times_real_time'])]
  end
  widths = [head, *rows].transpose.map { |column| column.map(&:size).max }
  [head, *rows].map do |row|
    row.zip(widths).map { |text, w| text.ljust(w) }.join('  ').rstrip
  end
end

Window = Struct.new(:title, :x, :y, :every)

PENDULUM_WINDOWS = [
  Window.new('release at 8 degrees, shove at 5 s', [0, 8], [-6, 9], 1),
  Window.new('supply falls by 25 % from 10 to 30 s', [8, 60], [-2, 2], 8)
].freeze

# What is drawn of each: a column, its label, and two windows on it.
VIEWS = {
  'pendulum' => ['angle_degrees', 'angle, degrees', PENDULUM_WINDOWS],
  'pendulum_8bit' => ['angle_degrees', 'angle, degrees', PENDULUM_WINDOWS],
  'motor' => ['speed_rad_s', 'speed, rad/s',
              [Window.new('power-on', [0, 0.2], [0, 500], 1),
               Window.new('ki 80 to 144, load on and off', [0.2, 1.2],
                          [350, 372], 1)]],
  'oven' => ['temperature_c', 'temperature, °C',
             [Window.new('power-on', [0, 5], [0, 110], 4),
              Window.new('settled', [5, 15], [79, 81], 4)]],
  'thermostat' => ['temperature_c', 'temperature, °C',
                   [Window.new('power-on', [0, 20], [10, 110], 1),
                    Window.new('manual, automatic, less power', [20, 60],
                               [55, 90], 1)]],
  'autotune' => ['temperature_c', 'temperature, °C',
                 [Window.new('relay experiment', [0, 20], [10, 110], 1),
                  Window.new('its end, and control', [20, 40], [70, 92], 1)]]
}.freeze

def draw_chips
  plot = Plot.new('chip', 'The same sources as firmware on simulated chips, ' \
                          'over the host\'s runs',
                  width: 1100, height: 400 * CHIPS.size, columns: [1.0, 1.0],
                  rows: [1.6, 0.8] * CHIPS.size, gap_x: 0.05, gap_y: 0.027,
                  margins: { right: 0.935, top: 0.962, bottom: 0.024 })
  CHIPS.each_with_index do |one, i|
    VIEWS.fetch(one.name)[2].each_with_index do |window, column|
      over_host_panel(plot, 2 * i, column, one, window)
      cycles_panel(plot, 2 * i + 1, column, one, window)
    end
  end
  plot.draw
end

HOST_COLOR = '#F2B38C' # light, as the chip is drawn over it

def over_host_panel(plot, row, column, one, window)
  name, label, = VIEWS.fetch(one.name)
  curves = [Plot.curve(one.host, name, 'host', HOST_COLOR, every: window.every,
                                                           width: 4.0),
            Plot.curve(one.chip, name, 'chip', Plot::BLUE, every: window.every,
                                                           width: 1.3)]
  title = column.zero? ? "{/:Bold #{one.title}}: " : ''
  plot.panel(row, column, curves,
             ["set title \"#{title}#{window.title}\" offset 0,-0.5",
              "set xrange [#{window.x.join(':')}]",
              "set yrange [#{window.y.join(':')}]", "set format x ''",
              *y_label(column, label)])
end

# A pass that took no time is one that has not ended yet.
CYCLES = "(column('pass_cycles') > 0 ? column('pass_cycles') : 1/0)"

def cycles_panel(plot, row, column, one, window)
  worst = one.find(/^loop: .* to (\d+) cycles/)
  share = one.find(/^share of a tick: worst ([\d.]+)/)
  top = 1.7 * worst
  curves = [Plot.curve(one.chip, CYCLES, 'pass of the loop',
                       Plot::PURPLE, every: window.every, width: 1.0),
            "#{worst} title 'worst' linecolor '#{Plot::GREY}' dashtype 3"]
  plot.panel(row, column, curves,
             ["set xrange [#{window.x.join(':')}]", "set yrange [0:#{top}]",
              "set y2range [0:#{top / worst * share}]", 'set key maxrows 1',
              *(row == 2 * CHIPS.size - 1 ? ["set xlabel 'time, s' offset 0,0.5"] : []),
              *cycles_axis(column, top > 8000.0 ? 5000 : 1000)])
end

# Cycles on the left and their share of a tick on the right of the picture.
def cycles_axis(column, step)
  return ["set ytics #{step}", "set ylabel 'cycles'"] if column.zero?

  ["set format y ''", "set ytics #{step}", 'set border 11',
   "set y2tics #{step / 100}", "set y2label '% of a tick'"]
end

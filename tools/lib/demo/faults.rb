# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The loops broken on purpose. A program runs each fault and prints a row of what
# came of it; here is what must, and the picture.
require_relative 'extent'

FAULT_KINDS = {
  'none' => 'nothing', 'flip' => 'a bit of the controller flips', 'reset' => 'a reset',
  'brown_out' => 'brown-out, then random RAM', 'hang' => 'the loop hangs',
  'hangs' => 'it hangs up to 8 times, the watchdog late', 'dead_timer' => 'no tick comes any more',
  'stuck' => 'sensor stuck', 'shorted' => 'sensor reads 0', 'open' => 'sensor reads full scale',
  'noisy' => 'sensor noisy', 'clipped' => 'sensor saturated',
  'input_low' => 'an input at 0', 'input_high' => 'an input at its other end',
  'input_moved' => 'an input moving', 'ticks_lost' => 'ticks lost',
  'ticks_doubled' => 'ticks doubled', 'ticks_late' => 'ticks late'
}.freeze

# What stays broken, with fixpid_guard beside the loop: the program's kind, and of a
# sensor at a level how far that is from the set point, of full scale.
STAYING_FAULTS = {
  'sensor stuck as it read' => ['stays_stuck'], 'sensor reads 0' => ['stays_level', -1.0],
  'sensor 20 % below the set point' => ['stays_level', -0.2], 'sensor 10 % below' => ['stays_level', -0.1],
  'sensor 3 % below' => ['stays_level', -0.03], 'sensor 1 % below' => ['stays_level', -0.01],
  'sensor at the set point' => ['stays_level', 0.0], 'sensor 1 % above' => ['stays_level', 0.01],
  'sensor 3 % above' => ['stays_level', 0.03], 'sensor 10 % above' => ['stays_level', 0.1],
  'sensor 20 % above' => ['stays_level', 0.2], 'sensor reads full scale' => ['stays_level', 1.0],
  'no drive' => ['stays_off'], 'drive always full' => ['stays_on'], 'sign turned round' => ['stays_turned']
}.freeze
STAYING_LEVELS = STAYING_FAULTS.values.count { |kind,| kind == 'stays_level' }
STAYING_TURNS = Extent.share(8, 8) # of each
FAULT_SHARE = 10 # one of so many is tried, unless all are
# Where it stands still at the set point or next to it, a sensor can be right.
STAYING_UNSEEN = ['sensor stuck as it read', 'sensor at the set point'].freeze
WATCHDOG_KINDS = %w[hang hangs dead_timer].freeze

# What must happen. `back`: in control again so many seconds after the end of the
# fault; `fallen`: or fallen, with the drive off so long after its beginning (nil:
# it cannot fall); `lasting`: of the flips, percent that may leave the loop out of
# control until the next reset, as they change what only `init` sets; `blind`: off
# so soon when the sensor reads an end for longer.
FaultRules = Struct.new(:runs, :long_runs, :tick_s, :watchdog_s, :duties, :back, :fallen, :lasting,
                        :blind, :inputs, :chip, :guard, keyword_init: true)
# Of the guard: the plant's unit, and what stays broken is seen after so many seconds,
# of a sensor 3 % or less beside the set point after `near_s`. Then the drive is cut,
# and the plant has been nowhere outside of `reach`.
GuardRules = Struct.new(:unit, :seen_s, :near_s, :reach, keyword_init: true)

FAULT_LOOPS = {
  'pendulum' => FaultRules.new(runs: 500, long_runs: 47_000, tick_s: 1.0 / 256, watchdog_s: 17e-3,
                               duties: -256..256, back: 1.5, fallen: 2.5, lasting: 0.0,
                               blind: 2.0 / 256, inputs: 'the gains'),
  'motor' => FaultRules.new(runs: 600, long_runs: 47_000, tick_s: 1e-3, watchdog_s: 32e-3,
                            duties: -1023..1023, back: 0.5, lasting: 1.0, blind: 25e-3,
                            inputs: 'the set point',
                            guard: GuardRules.new(unit: 'rad/s', seen_s: 0.024, near_s: 0.03, reach: -160.0..440.0)),
  'oven' => FaultRules.new(runs: 460, long_runs: 2000, tick_s: 1e-3, watchdog_s: 32e-3,
                           duties: 0..1023, back: 40.0, lasting: 0.0, blind: 2e-3,
                           inputs: 'the set point',
                           guard: GuardRules.new(unit: 'C', seen_s: 13.0, near_s: 65.0, reach: 19.0..340.0)),
  'thermostat' => FaultRules.new(runs: 600, long_runs: 4000, tick_s: 1e-3, watchdog_s: 32e-3,
                                 duties: 0..1023, back: 40.0, lasting: 0.0, blind: 102e-3,
                                 inputs: 'the set point, the selector',
                                 guard: GuardRules.new(unit: 'C', seen_s: 9.0, near_s: 27.0, reach: 19.0..265.0))
}.freeze

# What one run showed.
class FaultRun
  NUMBERS = %i[number bit channel value at_s for_s resets drive_low drive_high asked_low asked_high
               worst error back_s off_s off_first_s off_after_s least most alarm_s alarms].freeze
  attr_reader :kind, :end, *NUMBERS

  def initialize(path, names, line)
    cells = names.zip(line.chomp.split(',', -1)).to_h
    cells.size == NUMBERS.size + 3 && line.count(',') == names.size - 1 or
      raise Host::Failure, "#{path}: not a row of a fault: #{line}"
    @kind = cells['kind']
    @end = cells['end']
    NUMBERS.each do |name|
      value = Float(cells[name.to_s], exception: false)
      value&.finite? or raise Host::Failure, "#{path}: no number #{name}: #{line}"
      instance_variable_set("@#{name}", value)
    end
  end

  def alarmed?
    alarms.positive?
  end

  # The host's watchdog is late on purpose, a simulated chip's cannot be.
  def watchdog_s(rules)
    kind == 'hangs' && !rules.chip ? value : rules.watchdog_s
  end
end

# All runs of a loop.
class FaultRuns
  attr_reader :name, :rules, :runs

  def initialize(name, rules, runs)
    @name = name
    @rules = rules
    @runs = runs
  end

  def self.read(name, rules, paths)
    runs = paths.flat_map do |path|
      names, *rows = File.readlines(path)
      names = names.to_s.chomp.split(',')
      rows.map { |row| FaultRun.new(path, names, row) }
    end
    new(name, rules, runs)
  end

  def of(*kinds)
    FaultRuns.new(name, rules, runs.select { |run| kinds.include?(run.kind) })
  end

  # At this level, if it is one.
  def like(kind, level = 0.0)
    FaultRuns.new(name, rules, runs.select { |run| run.kind == kind && run.value == level })
  end

  # The least and the most that the plant has been.
  def reach
    [runs.map(&:least).min, runs.map(&:most).max]
  end

  def kinds
    FAULT_KINDS.keys.select { |kind| runs.any? { |run| run.kind == kind } }
  end

  def ended(how)
    runs.count { |run| run.end == how }
  end

  # Of those that ended so, the longest time; 0 if there is none.
  def longest(how, what)
    runs.select { |run| run.end == how }.map(&what).max || 0.0
  end

  # The drive was off so much later than the watchdog's time; nil: not tried.
  def late_s
    of(*WATCHDOG_KINDS).runs.map { |run| run.off_after_s - run.watchdog_s(rules) }.max
  end

  # `all_bits`: there are enough runs for each bit of the object.
  def check(count, all_bits)
    Report.exactly('faults tried', runs.size, count)
    Report.exactly('of which the program crashed or did not end', ended('crashed'), 0)
    check_drive
    bits = of('flip').runs.map(&:bit).uniq
    Report.exactly('bits of the object that flipped, all', bits.size, bits.max.to_i + 1) if all_bits
    kinds.each { |kind| check_kind(of(kind), FAULT_KINDS[kind]) }
    check_watchdog
    check_blind
    Report.exactly('nothing: alarms of the guard', of('none').alarmed, 0) if rules.guard
  end

  def alarmed
    runs.count(&:alarmed?)
  end

  private

  def check_drive
    Report.at_least('drive, least', runs.map(&:drive_low).min, rules.duties.first, 'counts')
    Report.at_most('drive, most', runs.map(&:drive_high).max, rules.duties.last, 'counts')
  end

  def check_kind(some, what)
    flips = some.kinds == ['flip']
    Report.at_most("#{what}: back in control after", some.longest('back', :back_s), rules.back, 's')
    off = rules.fallen ? 'fallen' : 'off'
    Report.at_most("#{what}: else #{off}, the drive off after", some.longest(off, :off_s),
                   rules.fallen || rules.back, 's')
    out = some.runs.size - some.ended('back') - some.ended(off)
    Report.at_most("#{what}: out of control in the end", 100.0 * out / some.runs.size,
                   flips ? rules.lasting : 0.0, '% of the runs')
  end

  def check_watchdog
    late = late_s or return
    Report.at_most('nothing works: off, later than the watchdog', late, 2.0 * rules.tick_s, 's')
  end

  def check_blind
    seen = of('shorted', 'open').runs.select { |run| run.for_s > rules.blind }.map(&:off_first_s)
    return if seen.empty?

    Report.at_least('sensor at an end: off', seen.min, 0.0, 's')
    Report.at_most('sensor at an end: off after', seen.max, rules.blind, 's')
  end
end

# Of a chip: the loop's rules, where the simulator has another watchdog, and the
# turns of all kinds and of the resets alone, each at another place of a pass.
ChipFaults = Struct.new(:example, :runs, :long_runs, :watchdog_s, keyword_init: true) do
  def rules
    usual = FAULT_LOOPS.fetch(example)
    FaultRules.new(**usual.to_h, watchdog_s: watchdog_s, chip: true)
  end
end
# gpsim's watchdog of a PIC18F4520 is 4.5 times slower than the chip's.
CHIP_FAULTS = {
  'pendulum' => ChipFaults.new(example: 'pendulum', runs: 36, long_runs: 1400, watchdog_s: 17.9e-3),
  'motor' => ChipFaults.new(example: 'motor', runs: 36, long_runs: 1400, watchdog_s: 4.5 * 32e-3),
  'motor_atmega328p' => ChipFaults.new(example: 'motor', runs: 36, long_runs: 1400, watchdog_s: 32e-3),
  'oven' => ChipFaults.new(example: 'oven', runs: 0, long_runs: 36, watchdog_s: 4.5 * 32e-3),
  'thermostat' => ChipFaults.new(example: 'thermostat', runs: 0, long_runs: 72, watchdog_s: 4.5 * 32e-3),
  'thermostat_atmega328p' => ChipFaults.new(example: 'thermostat', runs: 0, long_runs: 72, watchdog_s: 32e-3)
}.freeze
RESET_PLACES = 200 # of one pass, as in sim/faults/faults.c

def run_faults
  programs = "#{Host.root}/build/host-examples/examples"
  FAULT_LOOPS.each do |name, rules|
    count = Extent.long? ? rules.long_runs : rules.runs
    command = ["#{programs}/faults_#{name}", "#{programs}/faults_#{name}_application.so"]
    Report.start("faults #{name}")
    all = FaultRuns.read(name, rules, halves_of_faults("faults-#{name}", command, count, share: FAULT_SHARE))
    all.check(Extent.share(count, FAULT_SHARE), Extent.whole?)
    number_faults(all)
    draw_faults(all)
    run_staying(all, command) if rules.guard
  end
end

def run_faults_on_chips
  CHIP_FAULTS.each do |name, chip|
    count = Extent.long? ? chip.long_runs : chip.runs
    next if count.zero?

    firmware = Dir["#{Host.root}/build/firmware/#{name}.{cod,elf}"].first or
      raise Host::Failure, "no firmware of #{name}"
    command = ["#{Host.root}/build/gpsim/#{name}", firmware, '--faults', name]
    Report.start("faults_chip #{name}")
    paths = halves_of_faults("faults_chip-#{name}", command, count)
    places = Extent.long? && chip.example == name ? RESET_PLACES : 0
    paths += halves_of_faults("faults_chip-#{name}-reset", command, places, 'reset') if places.positive?
    all = FaultRuns.read(name, chip.rules, paths)
    all.check(count + places, false)
    check_places(all) if places.positive?
    number_faults(all)
  end
end

def check_places(all)
  Report.at_least('resets at different places of a pass', all.of('reset').runs.map(&:value).uniq.size,
                  RESET_PLACES)
end

# Two programs at a time, each with half of the faults, or with one of `share` from where its
# half begins.
def halves_of_faults(name, command, count, *kind, share: 1)
  half = (count + 1) / 2
  parts = [[0, half], [half, count - half]].map { |first, some| [first, Extent.share(some, share)] }
  threads = parts.each_with_index.map do |(first, some), i|
    path = "#{Host.folder}/#{name}.#{i}"
    Thread.new do
      Thread.current.report_on_exception = false
      Host.execute({}, *command, first.to_s, some.to_s, *kind, { out: path, err: "#{path}.err" })
      path
    end
  end
  threads.map(&:value)
end

# ---- What stays broken ----

# Each fault twice: an alarm changes nothing, or it cuts the drive.
def run_staying(all, command)
  without, with = [[], ['cut']].map do |word|
    paths = STAYING_FAULTS.values.map(&:first).uniq.flat_map do |kind|
      count = STAYING_TURNS * (kind == 'stays_level' ? STAYING_LEVELS : 1)
      halves_of_faults(["faults-#{all.name}", kind, *word].join('-'), command, count, kind, *word)
    end
    FaultRuns.read(all.name, all.rules, paths)
  end
  rows = STAYING_FAULTS.to_h { |what, fault| [what, check_staying(what, without.like(*fault), with.like(*fault))] }
  rows.each { |what, row| Report.unchanged("#{what}: seen; s; reach without, with", staying_text(row)) } if Extent.whole?
  Report.number('staying', rows)
end

def check_staying(what, without, with)
  seen = with.runs.select(&:alarmed?)
  row = { 'seen' => seen.size, 'after_s' => seen.map(&:alarm_s).max, 'without' => without.reach, 'with' => with.reach }
  Report.exactly("#{what}: tried, without and with the guard's cut", [without, with].map { |some| some.runs.size },
                 [STAYING_TURNS] * 2)
  check_seen(what, with, row) unless STAYING_UNSEEN.include?(what)
  Report.at_least("#{what}: alarms, none before it", seen.map(&:alarm_s).min || 0.0, 0.0, 's')
  row
end

def check_seen(what, with, row)
  rules = with.rules.guard
  Report.exactly("#{what}: seen", row['seen'], STAYING_TURNS)
  near = STAYING_FAULTS[what].last.then { |level| level.is_a?(Float) && level.abs <= 0.03 }
  Report.at_most("#{what}: seen after", row['after_s'], near ? rules.near_s : rules.seen_s, 's')
  Report.at_least("#{what}, the drive cut: least", row['with'].first, rules.reach.first, rules.unit)
  Report.at_most("#{what}, the drive cut: most", row['with'].last, rules.reach.last, rules.unit)
end

def staying_text(row)
  [row['seen'], row['after_s'] ? format('%.2g', row['after_s']) : '-',
   *%w[without with].map { |way| row[way].map(&:round).join('..') }].join('|')
end

# The numbers of the table.
def number_faults(all)
  rows = all.kinds.map do |kind|
    some = all.of(kind)
    { 'kind' => kind, 'runs' => some.runs.size, 'back' => some.ended('back'),
      'back_s' => some.longest('back', :back_s), 'off' => some.ended('off'),
      'fallen' => some.ended('fallen'),
      'off_s' => %w[fallen off].map { |how| some.longest(how, :off_s) }.max,
      'out' => some.ended('out'), 'worst' => some.runs.map(&:worst).max,
      'resets' => some.runs.map(&:resets).max.to_i }
  end
  Report.number('kinds', rows)
  Report.number('runs', all.runs.size)
  Report.number('low', all.runs.map(&:drive_low).min.to_i)
  Report.number('high', all.runs.map(&:drive_high).max.to_i)
  Report.number('late_s', all.late_s || 0.0)
end

# ---- The picture: a point for each run ----

FAULT_ENDS = { 'back' => ['back in control', Plot::MEASUREMENT, :back_s],
               'fallen' => ['fallen, drive off', Plot::SECOND, :off_s],
               'off' => ['off', Plot::SECOND, :off_s],
               'out' => ['out of control until the next reset', Plot::WITHOUT, :back_s] }.freeze
SHORTEST_S = 1e-3 # what is shorter is drawn here, as the axis is a logarithm's

def draw_faults(all)
  name = "faults-#{all.name}"
  plot = Plot.new(name, "#{all.name.capitalize}, #{all.runs.size} faults: when it was back or off",
                  width: 640, height: 540, margins: { left: 0.45, top: 0.92, bottom: 0.13 })
  plot.panel(0, 0, fault_points(all), [*fault_axes(all), *fault_texts(all)])
  plot.draw
end

def fault_points(all)
  places = fault_places(all)
  fault_ends(all).map do |how, (_, color)|
    path = "#{Host.folder}/faults-#{all.name}-#{how}.dat"
    lines = all.runs.select { |run| run.end == how }.map { |run| format('%.6g,%.4f', fault_time(run), places[run]) }
    Report.replace(path, "#{lines.join("\n")}\n")
    "'#{path}' using 1:2 with points pointtype 7 pointsize 0.4 linecolor '#{color}' notitle"
  end
end

def fault_ends(all)
  FAULT_ENDS.select { |how,| all.ended(how).positive? }
end

def fault_time(run)
  [run.public_send(FAULT_ENDS[run.end].last), SHORTEST_S].max
end

# What the points of an end are, beside those of the kind that has most of them: behind
# all of that kind, or where they come late before the first of that end.
def fault_texts(all)
  left = all.kinds
  fault_ends(all).map do |how, (title, color)|
    kind = how == 'back' ? 'none' : left.max_by { |one| all.of(one).ended(how) }
    left -= [kind]
    times, own = [all.of(kind).runs, all.of(kind).runs.select { |run| run.end == how }].map { |runs| runs.map { |run| fault_time(run) } }
    late = times.max > 0.1 * all.rules.back
    x = late ? own.min / 1.25 : times.max * 1.25
    Plot.text("#{title}: #{all.ended(how)}", x, all.kinds.reverse.index(kind), color, late ? 'right' : 'left')
  end
end

# Where each run is, from below: those of a kind are spread around its line.
def fault_places(all)
  all.kinds.reverse.each_with_index.flat_map do |kind, row|
    some = all.of(kind).runs
    some.each_with_index.map { |run, i| [run, row + 0.7 * ((i + 0.5) / some.size - 0.5)] }
  end.to_h
end

def fault_axes(all)
  kinds = all.kinds.reverse
  tics = kinds.each_with_index.map { |kind, i| "\"#{FAULT_KINDS[kind]}\" #{i}" }
  limits = [['back', all.rules.back, Plot::MEASUREMENT], ['off', all.rules.fallen, Plot::SECOND]]
  lines = limits.select { |_, at, _| at }.flat_map do |what, at, color|
    ["set arrow from #{at}, graph 0 to #{at}, graph 1 nohead dashtype 2 linecolor '#{color}'",
     "set label '#{what}' at #{at}, graph 0.985 right offset -0.5,0 textcolor '#{color}'"]
  end
  ['set logscale x', "set xrange [#{SHORTEST_S * 0.7}:#{all.rules.back * 3}]",
   "set yrange [-0.8:#{kinds.size - 0.3}]", "set ytics (#{tics.join(', ')})",
   "set xlabel \"seconds after the end of the fault; #{SHORTEST_S}: or less;\\ndashed: what is allowed\"", *lines]
end

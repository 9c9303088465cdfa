# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Both tuners on machines: 23 kinds by fixpid_autotune, what is heated or filled by
# fixpid_reaction, and what the documents advise where there are no gains.
MACHINE_KINDS = 23
HEATERS = ['furnace', '0.25 C', 'SSR', 'oven', 'tank', 'jitter', 'kettle', 'hot end'].freeze
HEATER_SEED = 20_261_128
BOILERS_TUNED = 40
MACHINES_EACH = 100 # of each kind and seed
HEATERS_EACH = 200

# Too few for a figure: none of their loops may be unstable.
def some_machines
  safe = study_rows('autotune', STUDY_SEEDS[0], 4, 'kinds').of('PI safe')
  Report.exactly('machines, PI safe: unstable', safe.unstable, 0)
  Report.at_least('machines with gains', safe.possible.gains_percent, 80.0, '%')
  Report.at_most('machines, PI safe: Ms of 95 %', safe.ms(0.95), 1.9)
  check_heaters(heater_rows(HEATER_SEED, 10), 60, 76)
  check_boilers
end

def all_machines(seeds)
  machines = seeds.map { |seed| study_rows('autotune', seed, MACHINES_EACH, 'kinds') }.reduce(:+)
  check_machines(machines.of('PI safe'))
  tell_machines(machines)
  heaters = heater_rows(HEATER_SEED, HEATERS_EACH)
  check_heaters(heaters, 1370, 1570)
  Report.at_most('heaters: minutes, in the middle', at_last(heaters.of('PI safe')).lasts(0.5, :minutes), 1.2)
  tell_heaters(heaters)
  tell_advice(seeds)
end

def check_machines(safe)
  Report.at_least('machines for which a PI of Ms 1.6 exists: with gains', safe.possible.gains_percent, 90.0, '%')
  Report.at_most('machines, PI safe: Ms above 2.2', safe.thin, 20)
  Report.exactly('machines, PI safe: unstable', safe.unstable, 0)
end

def heater_rows(seed, each)
  HEATERS.map { |kind| study_rows('reaction', seed, each, kind) }.reduce(:+)
end

# With full output, and with what was tried last: less of it after LIMIT.
def at_once(rows)
  Study::Rows.new(rows.select { |row| row.part == 1 })
end

def at_last(rows)
  Study::Rows.new(rows.group_by { |row| [row.family, row.plant, row.rule] }.values.map { |tried| tried.max_by(&:part) })
end

def check_heaters(rows, once, last)
  safe = rows.of('PI safe')
  Report.at_least('heaters with gains at once', at_once(safe).gains, once)
  Report.at_least('heaters with gains, or with less output', at_last(safe).gains, last)
  Report.at_most('heaters, PI safe: Ms above 2.2', safe.thin, 1)
  Report.at_most('heaters, PI safe: Ms of 95 %', safe.ms(0.95), 1.75)
  Report.exactly('heaters: unstable', rows.unstable, 0)
end

# The espresso boiler behind its SSR, whose relay's experiment never ends.
def check_boilers
  safe = study_rows('reaction', 1, BOILERS_TUNED, 'boiler').of('PI safe')
  Report.exactly('boilers with gains at once', at_once(safe).gains, BOILERS_TUNED)
  Report.at_most('boilers: largest Ms', safe.worst, 1.8)
end

def machine_numbers(rows, designs)
  designs.to_h { |design| [design, loop_numbers(rows.of(design)).merge('high' => Study.shown(rows.of(design).ms(0.95)))] }
end

def tell_machines(all)
  Report.number('machines', all.map(&:family).uniq.map do |kind|
    rows = all.family(kind)
    safe = rows.of('PI safe')
    { 'kind' => kind, 'plants' => safe.count, 'possible' => safe.possible.count, 'gains' => safe.gains,
      'periods' => safe.lasts(0.5, :periods), 'minutes' => safe.lasts(0.5, :minutes),
      'loops' => machine_numbers(rows, ['PI safe', 'PI quick', 'PID safe']) }
  end)
end

def tell_heaters(all)
  Report.number('heaters', [*HEATERS.map { |kind| [kind, all.family(kind)] }, ['all', all]].map do |kind, rows|
    last = at_last(rows)
    safe = last.of('PI safe')
    { 'kind' => kind, 'plants' => safe.count, 'once' => at_once(rows.of('PI safe')).gains, 'gains' => safe.gains,
      'minutes' => [0.5, 0.9].map { |share| safe.lasts(share, :minutes) },
      'loops' => machine_numbers(last, ['PI safe', 'PI quick', 'PID safe']) }
  end)
end

# Each piece of advice on the plants that it is for; not on what is unstable.
def tell_advice(seeds)
  rows = [[seeds[0], LONG_EACH, 'families'], [seeds[0], MACHINES_EACH, 'kinds']]
         .map { |seed, each, plants| study_rows('advice', seed, each, plants).but('unstable', 'unstable machine') }.reduce(:+)
  Report.number('advice', rows.group_by { |row| [row.status, row.reason, row.advice] }.sort.map do |(status, reason, advice), some|
    loops = Study::Rows.new(some)
    ended = Study::STATUSES[status]
    { 'ended' => ended == 'DONE' ? Study::REASONS[reason] : ended, 'advice' => advice, 'tried' => loops.count,
      'gains' => loops.gains, 'thin' => loops.thin, 'unstable' => loops.unstable }
  end)
end

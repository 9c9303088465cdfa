# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The tables of the documents, from the numbers that the loops reported.
module Tables
  LONG_STUDY = 'random_plants long'
  LOOPS_HEAD = ['rule', 'plants with gains', 'Ms 5 %', 'Ms 50 %', 'Ms 95 %', 'largest', 'Ms 1.2 to 1.8, %', 'above 2.2', 'unstable',
                'errors', 'lasts 50 %', 'lasts 90 %'].freeze
  SUMMARY_HEAD = ['rule', 'plants with gains', 'Ms 50 %', 'Ms 95 %', 'above 2.2', 'errors', 'lasts 50 %'].freeze
  MACHINE_RULES = ['PI safe', 'PI quick', 'PID safe'].freeze
  TRACKED = %w[without with].to_h { |which| [which, "#{which} `fixpid_pid_track`"] }.freeze

  SATURATIONS = {
    'step' => 'from rest to 700', 'back_300' => '1000 steps at 1100, back to 300', 'back_700' => 'the same, back to 700',
    'back_900' => 'the same, back to 900', 'back_1000' => 'the same, back to 1000', 'short' => 'from 300, 20 steps at 1100, then 500',
    'load' => 'at 700, a load for 1000 steps that is more than the actuator has, and goes away',
    'integrator' => 'integrator: from rest to 700', 'at_1000' => 'integrator: from 1000 to 600',
    'at_1023' => "integrator: from 1023, the sensor's end, to 600"
  }.freeze

  class << self
    def tuning
      table('step', 'KP', 'KI', 'KD', 'upright', 'base moves', 'base reverses',
            'swing at the end',
            STAGES.map { |stage| stage_row(stage, Report.numbers['tuning']) })
    end

    def found_gains
      table('rule', 'kp', 'ki, 1 / s', 'kd, s', 'derivative filter',
            RULES.keys.map do |rule|
              kp, ki, kd, filter = %w[kp ki_per_s kd_s filter].map do |name|
                Report.numbers['autotune']["#{rule.downcase}_#{name}"]
              end
              [rule, format('%.3f', kp), format('%.4f', ki),
               format('%.3f', kd), filter]
            end)
    end

    def autotune
      rows = Report.numbers['autotune']['plants'].map do |row|
        [row['plant'], row['steps'], *process(row), row['rule'], format('%.3f', row['kp']),
         format('%.5f', row['ki']), format('%.2f', row['kd']), format('%.1f', row['overshoot']), row['settled']]
      end
      rows('plant', 'steps of the experiment', 'T found', 'L found', 'rule', 'kp', 'ki per step', 'kd', 'overshoot, %',
           'settled after', rows)
    end

    def random_plants
      rows(*LOOPS_HEAD, design_rows('random_plants', 'designs'))
    end

    def at_once
      rows(*LOOPS_HEAD, design_rows('random_plants', 'at_once'))
    end

    # The same of more plants, when they were asked for.
    def study
      rows(*LOOPS_HEAD, design_rows(LONG_STUDY, 'designs'))
    end

    # A part of it for the page.
    def study_summary
      head, *all = study.map { |row| LOOPS_HEAD.zip(row).to_h.values_at(*SUMMARY_HEAD) }
      table(*head, all)
    end

    def study_families
      heads = Study::DESIGNS.flat_map { |rule| ["#{rule}: Ms 50 %", "#{rule}: largest", "#{rule}: above 2.2"] }
      rows('family', 'gains', 'lasts', *heads, Report.numbers[LONG_STUDY]['families'].map do |row|
        [row['family'], row['gains'], row['lasts']&.round, *row['loops'].values.flat_map { |loop| [*loop['ms'], loop['thin']] }]
      end)
    end

    # What README.md says of it: gains by the rule and the word to take first.
    def study_figures
      designs, heaters = Report.numbers[LONG_STUDY].values_at('designs', 'heaters')
      { 'heaters' => heaters.last['plants'], 'heated' => heaters.last['gains'],
        'tuned' => designs.find { |row| row['rule'] == 'PI safe' }['gains'], 'unstable' => designs.sum { |row| row['unstable'] } }
    end

    # What never happened has no column.
    def study_refusals
      families = Report.numbers[LONG_STUDY]['families']
      columns = { 'statuses' => Study::STATUSES - ['DONE'], 'reasons' => Study::REASONS - %w[NO_REASON NOT_DONE] }
                .flat_map { |kind, names| names.map { |name| [kind, name] } }
                .select { |kind, name| families.sum { |row| row[kind][name] }.positive? }
      rows = families.map { |row| [row['family'], row['gains'], *columns.map { |kind, name| row[kind][name] }] }
      rows('family', 'gains', *columns.map { |_, name| name }, [*rows, totals('all', rows)])
    end

    # What fixpid_autotune made of machines, and fixpid_reaction of those that are heated.
    def study_machines
      rows('machine', 'gains', 'a PI exists', *machine_heads, 'periods', 'minutes', Report.numbers[LONG_STUDY]['machines'].map do |row|
        [row['kind'], row['gains'], row['possible'], *machine_cells(row), row['periods'].round, short_minutes(row['minutes'])]
      end)
    end

    def study_heaters
      rows('machine', 'gains at once', 'or with less output', *machine_heads, 'minutes 50 %', 'minutes 90 %',
           Report.numbers[LONG_STUDY]['heaters'].map do |row|
             [row['kind'], row['once'], row['gains'], *machine_cells(row), *row['minutes'].map { |minutes| short_minutes(minutes) }]
           end)
    end

    def study_advice
      rows('status or reason', 'what was changed', 'tried', 'gains', 'above 2.2',
           Report.numbers[LONG_STUDY]['advice'].map do |row|
             ["`#{row['ended']}`", row['advice'], row['tried'], row['gains'], row['thin'] + row['unstable']]
           end)
    end

    # What came of the faults, a row for each kind and its numbers for each loop.
    def faults
      rows('fault', *FAULT_LOOPS.keys, FAULT_KINDS.map do |kind, what|
        [what, *FAULT_LOOPS.keys.map { |name| fault_cell(name, kind) }]
      end)
    end

    # What stays broken: when it is seen, and where the plant has been.
    def staying
      loops = FAULT_LOOPS.select { |_, rules| rules.guard }
      heads = loops.flat_map { |name, rules| ["#{name}: seen after", "#{rules.guard.unit}, without", 'the output cut'] }
      rows('it stays so', *heads, STAYING_FAULTS.keys.map do |what|
        [what, *loops.keys.flat_map { |name| staying_cells(Report.numbers["faults #{name}"]['staying'][what]) }]
      end)
    end

    def staying_limits
      table('loop', 'seen within', 'a sensor 1 or 3 % beside the setpoint within', 'where the plant stays, the output cut',
            FAULT_LOOPS.select { |_, rules| rules.guard }.map do |name, rules|
              guard = rules.guard
              [name, *[guard.seen_s, guard.near_s].map { |time| short_time(time) },
               "#{guard.reach.first.round} to #{guard.reach.last.round} #{guard.unit}"]
            end)
    end

    # What fixpid_guard sees of machines that break, and how many get far beyond their setpoint.
    def guard_sees
      far = GUARD_CLASSES.keys.map { |title| "#{title}: far over, without and with" }
      rows('it stays so', 'seen', 'after, in T + L: median, 95 %', *far, 'heaters: guard', *GUARD_PEERS.values, GUARD_FAULTS.map do |fault, title|
        row = Report.numbers['guard'][fault]
        [title, row['seen'], row['times'].map { |time| format('%.1f', time) }.join(', '),
         *row['far'].map { |without, with| without.zero? ? 'none' : "#{without}, #{with}" },
         *row['heaters'].map { |seen, time| seen.zero? ? 'never' : format('%.0f %%, %.2f', seen, time) }]
      end)
    end

    # How many whole machines raise an alarm.
    def guard_healthy
      rows('set by', 'machines', 'with an alarm', *GUARD_FLAGS.keys.map { |flag| "`#{flag}`" }, 'with half of the patience',
           GUARD_RULES.map do |rule, (title, _)|
             row = Report.numbers['guard']["healthy #{rule}"]
             [title, row['plants'], row['alarms'], *row['flags'].values, row['hasty']]
           end + GUARD_PEERS.map do |peer, title|
             row = Report.numbers['guard']["healthy #{peer}"]
             ["#{title}'s rule", row['plants'], row['alarms'], *['-'] * (GUARD_FLAGS.size + 1)]
           end)
    end

    # How hot the boiler of the quick start gets.
    def guard_boiler
      heads = BOILERS.flat_map { |title, _| ["#{title}: without", 'with the guard', 'alarm after'] }
      rows('from 60 s on', *heads, BOILER_FAULTS.map do |fault, title|
        cells = BOILERS.keys.flat_map do |boiler|
          row = Report.numbers['guard'][boiler][fault]
          [format('%.1f C', row['without']), format('%.1f C', row['with']), format('%.1f s', row['alarm'])]
        end
        [title, *cells]
      end)
    end

    # What must hold of them.
    def fault_limits
      table('loop', 'output', 'back in control within', 'or off', 'nothing works: off',
            'sensor at an end: off within', 'flips that may last', FAULT_LOOPS.map do |name, rules|
              [name, "#{rules.duties.first} to #{rules.duties.last}", "#{rules.back} s",
               rules.fallen ? "fallen, and off within #{rules.fallen} s" : "off within #{rules.back} s",
               format('%.1f ms: %d ms and two ticks', 1e3 * (rules.watchdog_s + 2.0 * rules.tick_s),
                      1e3 * rules.watchdog_s),
               format('%.1f ms', 1e3 * rules.blind),
               rules.lasting.zero? ? 'none' : "#{rules.lasting} %"]
            end)
    end

    # Of each loop that was broken, on the host and on chips.
    def long_faults
      loops = Report.numbers.select { |name, numbers| name.start_with?('faults') && numbers['kinds'] }
      rows('loop', 'runs', 'back in control', 'fallen and off', 'off', 'out of control until a reset',
           'longest until back', 'output', 'off after the watchdog\'s time', loops.map do |name, numbers|
             kinds = numbers['kinds']
             [name.sub('faults_chip', 'chip,').sub('faults', 'host,'), numbers['runs'],
              *%w[back fallen off out].map { |how| kinds.sum { |row| row[how] } },
              format('%.2f s', kinds.map { |row| row['back_s'] }.max),
              "#{numbers['low']} to #{numbers['high']}", format('%.2f ms', 1e3 * numbers['late_s'])]
           end)
    end

    # Of each chip, what came of the bits that flipped in each place.
    def fault_places
      rows('a bit flips in', 'flips', 'back in time, by itself', 'back in time, after a reset', 'off in time', 'out of control',
           'the simulator stopped', 'output beyond its limits', FaultPlaces::CHIPS.flat_map do |name, title|
             Report.numbers["faults_places #{name}"]['places'].map do |place, row|
               ["#{title}: #{FaultPlaces::NAMES.fetch(place)}", *row.values_at('runs', 'back', 'reset', 'off', 'out', 'stopped', 'beyond')]
             end
           end)
    end

    def cascade
      table('cascade', 'peak of 500 after the weak supply', 'within 2 % after, steps',
            recipe_rows('%.0f', %w[cascade_NAME_peak cascade_NAME_settled], TRACKED))
    end

    def override
      table('override', 'worst pressure, 700 allowed', 'peak of the flow afterwards, of 600',
            recipe_rows('%.0f', %w[override_NAME_pressure override_NAME_flow], TRACKED))
    end

    def two_rates
      numbers = Report.numbers['recipes']
      rows = recipe_rows('%.0f', %w[two_rates_NAME_peak two_rates_NAME_settled], 'without' => 'without flags', 'with' => 'flags collected')
      table('two rates', 'peak of 500 after the weak supply', 'within 2 % after, ms', rows) +
        "\nIn #{numbers['two_rates_limited']} outer steps the inner loop was at its limit, " \
        "in #{numbers['two_rates_last']} of them in the last of the ten, too.\n"
    end

    def heat_cool
      table('heat and cool', 'changes between heat and cool while the room crosses the setpoint 11 times',
            recipe_rows('%d', %w[heat_cool_NAME_changes], 'without' => 'without a gap', 'with' => 'with a gap'))
    end

    def least_output
      table('the controller is', 'farthest from 50 degrees',
            recipe_rows('%.1f', %w[least_output_NAME_far], 'tracked' => 'told what the fan got', 'with' => 'not told'))
    end

    def ramp_soak
      names = SOAKS.keys.map { |degrees| "ramp_soak_NAME_#{degrees.to_i}" }
      table('ramp and soak', *SOAKS.map { |degrees, seconds| "within 8 degrees of #{degrees.to_i}, #{seconds.to_i} s wanted" },
            recipe_rows('%d', names, 'without' => 'without waiting', 'with' => 'waiting'))
    end

    def guard
      table('setpoint 60 degrees', 'hottest without a guard', 'with',
            recipe_rows('%.0f', %w[guard_NAME_without guard_NAME_with], 'slipped' => 'the sensor slips off', 'shut' => 'the relay stays on'))
    end

    def interpolated
      table('gains', 'farthest beyond a setpoint, of 1000', 'travel of the valve',
            recipe_rows('%.0f', %w[interpolated_NAME_over interpolated_NAME_travel],
                        'low' => 'of level 100', 'high' => 'of level 1000', 'with' => 'by the level'))
    end

    def spikes
      table('readings and controller', 'error, rms, degrees',
            recipe_rows('%.2f', %w[spikes_NAME_rms],
                        'calm' => 'none is wild, derivative filter 3', 'plain' => 'no filter', 'filter' => 'derivative filter 3',
                        'with' => 'median of three', 'with_filter' => 'median of three, derivative filter 3'))
    end

    def back_from_limit
      backs = LIMIT_SCENARIOS.keys.grep(/back/)
      table('steps until it stays within 2 %', *backs.map { |scenario| scenario.sub('_', ' to ') },
            recipe_rows('%d', backs.map { |scenario| "limit_#{scenario}_NAME_settled" }, LIMIT_RULES.reject { |rule, _| rule == 'clamped' }))
    end

    # Steps and sum of errors of each rule; the least sum is bold.
    def saturations
      numbers = Report.numbers['recipes']
      table('saturation', *LIMIT_RULES.values, SATURATIONS.map do |scenario, title|
        sums = LIMIT_RULES.keys.to_h { |rule| [rule, numbers["limit_#{scenario}_#{rule}_errors"].round] }
        [title, *sums.map do |rule, sum|
          cell = "#{numbers["limit_#{scenario}_#{rule}_settled"]} / #{sum}"
          sum == sums.values.min ? "**#{cell}**" : cell
        end]
      end)
    end

    def behind_tpo
      numbers = Report.numbers['recipes']
      rows = { 'direct' => 'direct', 'tpo' => '`fixpid_tpo`' }.map do |way, title|
        plants, gains, thin, largest, middle, long =
          %w[plants gains thin largest middle long].map { |what| numbers["behind_tpo_#{way}_#{what}"] }
        [title, "#{gains} of #{plants}", format('%.2f', largest), thin, middle, long]
      end
      table('output', 'plants with gains', 'largest Ms', 'above 2.2', 'steps of the experiment: 50 %', '95 %', rows)
    end

    def retune
      numbers = Report.numbers['recipes']
      far, new, old = %w[far retuned_errors old_errors].map { |what| format('%.0f', numbers["retune_#{what}"]) }
      table('gains', 'farthest from the setpoint of 500 while it tunes', 'sum of errors after a load',
            [['old', '-', old], ['new', far, new]])
    end

    private

    # Of a table of docs/data.
    def rows(*head, rows)
      [head, *rows]
    end

    def table(*head, rows)
      lines = [head, head.map { '---' }, *rows]
      lines.map { |row| "| #{row.join(' | ')} |\n" }.join
           .gsub(/^\| ---.*/) { |line| line.delete(' ') }
    end

    def design_rows(loop, what)
      Report.numbers[loop][what].map do |row|
        [row['rule'], row['gains'], *row['ms'], format('%.1f', row['robust']), row['thin'], row['unstable'],
         row['slower'] ? format('%.2f', row['slower']) : '',
         *row['lasts'].map { |times| times < 10 ? format('%.1f', times) : times.round.to_s }]
      end
    end

    def machine_heads
      MACHINE_RULES.flat_map { |rule| ["#{rule}: Ms 50 %", "#{rule}: 95 %", "#{rule}: largest", "#{rule}: above 2.2"] }
    end

    def machine_cells(row)
      row['loops'].values.flat_map { |loop| [loop['ms'][0], loop['high'], loop['ms'][1], loop['thin'] + loop['unstable']] }
    end

    def short_minutes(minutes)
      minutes < 10.0 ? format('%.1f', minutes) : minutes.round.to_s
    end

    def totals(title, rows)
      [title, *rows.map { |row| row.drop(1) }.transpose.map(&:sum)]
    end

    # Of one kind and loop: how many, and how long it took.
    def fault_cell(name, kind)
      row = Report.numbers["faults #{name}"]['kinds'].find { |one| one['kind'] == kind }
      parts = [["#{row['back']} back", row['back'], row['back_s']],
               ["#{row['fallen']} fallen", row['fallen'], row['off_s']],
               ["#{row['off']} off", row['off'], row['off_s']], ["#{row['out']} out", row['out'], nil]]
      parts.select { |_, count, _| count.positive? }
           .map { |text, _, most| most ? "#{text}, #{format('%.2f', most)} s" : text }.join('; ')
    end

    # A row for each of `titles`: numbers of the recipes, which have its name for NAME.
    def recipe_rows(form, numbers, titles)
      titles.map do |name, title|
        [title, *numbers.map { |number| format(form, Report.numbers['recipes'].fetch(number.sub('NAME', name))) }]
      end
    end

    def short_time(seconds)
      seconds < 1.0 ? format('%.1f ms', 1e3 * seconds) : format('%.1f s', seconds)
    end

    def staying_cells(row)
      seen = short_time(row['after_s']) if row['after_s']
      seen = [seen, "#{row['seen']} of #{STAYING_TURNS}"].compact.join(', ') if row['seen'] < STAYING_TURNS
      [seen, *%w[without with].map { |way| row[way].map(&:round).join(' to ') }]
    end

    # What the experiment found of a plant.
    def process(row)
      [row['t'].to_f.zero? ? '-' : format('%.1f', row['t']), format('%.1f', row['l'])]
    end

    def stage_row(stage, numbers)
      upright, base, reversals, swing =
        %w[upright_s base_m reversals swing_degrees]
        .map { |what| numbers["#{stage.name}_#{what}"] }
      [stage.steps, stage.kp, stage.ki, stage.kd,
       upright < TUNING_S ? format('%.2f s', upright) : 'to the end',
       format('%.2f m', base), times(reversals),
       swing ? format('%.1f degrees', swing) : 'fallen']
    end

    def times(count)
      { 0 => 'never', 1 => 'once' }.fetch(count, "#{count} times")
    end
  end
end

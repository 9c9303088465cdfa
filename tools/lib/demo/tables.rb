# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The tables of the documents, from the numbers that the loops reported.
module Tables
  LONG_STUDY = 'random_plants long'
  LOOPS_HEAD = ['rule', 'plants with gains', 'Ms 5 %', 'Ms 50 %', 'Ms 95 %', 'largest', 'Ms 1.2 to 1.8, %', 'above 2.2', 'unstable',
                'errors', 'lasts 50 %', 'lasts 90 %'].freeze
  SUMMARY_HEAD = ['rule', 'plants with gains', 'Ms 50 %', 'Ms 95 %', 'above 2.2', 'errors', 'lasts 50 %'].freeze
  MACHINE_RULES = ['PI safe', 'PI quick', 'PID safe'].freeze

  # What a recipe gains: the names of both numbers, and their form.
  RECIPE_GAINS = {
    'cascade: peak after the weak supply, of 500' => %w[cascade_without_peak cascade_with_peak %.0f],
    'cascade: steps until within 2 %' => %w[cascade_without_settled cascade_with_settled %.0f],
    'two rates: peak after the weak supply, of 500' => %w[two_rates_without_peak two_rates_with_peak %.0f],
    'two rates: ms until within 2 %' => %w[two_rates_without_settled two_rates_with_settled %.0f],
    'override: worst pressure, 700 allowed' => %w[override_without_pressure override_with_pressure %.0f],
    'override: peak of the flow afterwards, of 600' => %w[override_without_flow override_with_flow %.0f],
    **%w[300 700 900 1000].flat_map do |to|
      { '' => 'drift', ', with n + 1' => 'slow' }.map do |how, rule|
        ["back from a limit, to #{to}#{how}: steps until within 2 %",
         ["limit_back_#{to}_held_settled", "limit_back_#{to}_#{rule}_settled", '%d']]
      end
    end.to_h,
    'ramp and soak: s within 8 degrees of 150, 90 wanted' => %w[ramp_soak_without_150 ramp_soak_with_150 %d],
    'ramp and soak: s within 8 degrees of 220, 40 wanted' => %w[ramp_soak_without_220 ramp_soak_with_220 %d],
    'heat and cool: changes between them, of 11 needed' => %w[heat_cool_without_changes heat_cool_with_changes %d],
    'behind an SSR: plants with gains, of 200' => %w[behind_tpo_direct_gains behind_tpo_tpo_gains %d],
    'behind an SSR: largest Ms' => %w[behind_tpo_direct_largest behind_tpo_tpo_largest %.2f],
    'behind an SSR: Ms above 2.2' => %w[behind_tpo_direct_thin behind_tpo_tpo_thin %d],
    'behind an SSR: steps of the experiment, 50 %' => %w[behind_tpo_direct_middle behind_tpo_tpo_middle %d],
    'behind an SSR: steps of the experiment, 95 %' => %w[behind_tpo_direct_long behind_tpo_tpo_long %d],
    'retune: farthest from the setpoint of 500 while it tunes' => [nil, 'retune_far', '%.0f'],
    'retune: sum of errors after a load' => %w[retune_old_errors retune_retuned_errors %.0f],
    'least output: farthest from 50 degrees, told and not told' => %w[least_output_tracked_far least_output_with_far %.1f],
    'interpolated: counts beyond a setpoint, gains of level 100' => %w[interpolated_low_over interpolated_with_over %.0f],
    'interpolated: counts beyond a setpoint, gains of level 1000' => %w[interpolated_high_over interpolated_with_over %.0f],
    'interpolated: travel of the valve, gains of level 100' => %w[interpolated_low_travel interpolated_with_travel %.0f],
    'interpolated: travel of the valve, gains of level 1000' => %w[interpolated_high_travel interpolated_with_travel %.0f],
    'wild readings: error, rms, degrees' => %w[spikes_plain_rms spikes_with_rms %.2f],
    'wild readings, derivative filter 3: error, rms, degrees' => %w[spikes_filter_rms spikes_with_filter_rms %.2f],
    'no wild readings, derivative filter 3: error, rms, degrees' => ['spikes_calm_rms', nil, '%.2f'],
    'guard: hottest of 60 degrees, the sensor slips off' => %w[guard_slipped_without guard_slipped_with %.0f],
    'guard: hottest of 60 degrees, the relay stays on' => %w[guard_shut_without guard_shut_with %.0f]
  }.freeze

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

    def recipes
      rows('measured', 'without', 'with', RECIPE_GAINS.map do |title, (without, with, form)|
        [title, *[without, with].map { |name| name ? format(form, Report.numbers['recipes'].fetch(name)) : '' }]
      end)
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

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The tuners on random plants of 22 families and machines of 23 kinds: how good the gains are
# that they find.
require_relative 'extent'
require_relative 'machines'
require_relative 'study'

STUDY_SEEDS = [31, 77].freeze
STUDY_EACH = 60 # of each family and seed
STUDY_PLANTS = STUDY_EACH * Study::FAMILIES.size
# Other seeds and far more plants: tools/demo --long random_plants.
LONG_SEEDS = [71_203, 90_437].freeze
LONG_EACH = 500
LONG_PLANTS = LONG_EACH * Study::FAMILIES.size

# A part of the answer of these comes at once, which the families of the study do not
# have.
AT_ONCE = 'at once'
AT_ONCE_PLANTS = 300

# Lags with and without dead time, integrators and servos: what the header says that
# it serves.
PLAIN = ['lag-dominant', 'balanced', 'dead-time', 'equal lags', 'integrator', 'servo', 'integrator and lag', 'batch',
         'two lags', 'servo and lag', 'servo without delay'].freeze

# What no PI is good for, and what a heat-up tunes better.
WEAK = %w[unstable heater].freeze

# Of a study of the program: autotune, reaction or advice.
def study_rows(study, seed, each, plants = 'families')
  name = "random_plants-#{[study, seed, plants].join('-').tr(' ', '-')}.txt"
  rows = Study.rows(File.readlines(Host.print('random_plants', name, study, seed.to_s, each.to_s, plants)))
  rows.count.positive? or raise Host::Failure, "#{name} has no rows"
  rows
rescue Study::Failure => e
  raise Host::Failure, "#{name}: #{e.message}"
end

def random_plants
  all = study(STUDY_SEEDS, STUDY_EACH)
  keep_study(all)
  tell_at_once
  draw_random_plants(all)
  some_machines
  return unless Extent.long?

  Report.start('random_plants long')
  check_families(study(LONG_SEEDS, LONG_EACH))
  all_machines(LONG_SEEDS)
end

# What the autotuner did on plants of all seeds.
def study(seeds, each)
  drawn = seeds.to_h { |seed| [seed, study_rows('autotune', seed, each)] }
  drawn.each do |seed, all|
    Report.exactly("seed #{seed}: rows", all.count, each * Study::FAMILIES.size * Study::DESIGNS.size)
    check_study("seed #{seed}", all)
  end
  drawn.values.reduce(:+).tap do |all|
    check_robust(all)
    tell_study(all)
  end
end

# Whoever takes the gains of a word unseen must have a loop that is stable, and with
# the default word nearly always one with a margin.
def check_study(seed, all)
  loops = Study::DESIGNS.to_h { |design| [design, all.of(design)] }
  loops.each { |design, rows| Report.exactly("#{seed}, #{design}: unstable", rows.unstable, 0) }
  Report.at_least("#{seed}, PI safe: Ms within 1.2 to 1.8", loops['PI safe'].robust_percent, 95.0, '%')
  Report.at_least("#{seed}, PID safe: Ms within 1.2 to 1.8", loops['PID safe'].robust_percent, 95.0, '%')
  check_conduct(seed, loops['PI safe'])
end

# Of the long study.
def check_families(all)
  safe = all.of('PI safe')
  Report.at_least("without #{WEAK.join(' and ')}: plants with gains", safe.but(*WEAK).gains_percent, 96.0, '%')
  Report.at_most('PI safe: Ms above 2.2', safe.thin, 22)
end

# A tuner that refuses all is safe and useless.
def check_conduct(seed, safe)
  plain = Study::Rows.new(safe.select { |row| PLAIN.include?(row.family) })
  Report.at_least("#{seed}: plain families with gains", 100.0 * plain.gains / plain.count, 93.0, '%')
  Report.at_most("#{seed}: experiments last, median, in L + T", safe.lasts(0.5), 32.0)
  Report.exactly("#{seed}: outputs outside their range", safe.outside, 0)
  Report.exactly("#{seed}: experiments without an end", safe.ended('RUNNING'), 0)
end

# Too few for each seed alone.
def check_robust(all)
  safe = all.of('PI safe') + all.of('PID safe')
  Report.at_most('safe, of the loops: Ms above 2.2', safe.thin_percent, 0.1, '%')
end

# What nobody requires.
def keep_study(all)
  Study::DESIGNS.each do |design|
    rows = all.of(design)
    Report.unchanged("#{design}: plants with gains", rows.gains)
    Report.unchanged("#{design}: Ms above 2.2", rows.thin)
    Report.unchanged("#{design}: Ms in the middle, in 0.01", (100.0 * rows.ms(0.5)).round)
  end
end

# The rows of the tables of docs/tuners.md.
def tell_study(all)
  Report.number('plants', all.of('PI safe').count)
  Report.number('designs', design_rows(all))
  Report.number('families', Study::FAMILIES.map { |name, title| family_numbers(all, name, title) })
end

def design_rows(all)
  Study::DESIGNS.map do |rule|
    rows = all.of(rule)
    { 'rule' => rule, 'gains' => rows.gains, 'ms' => shown_ms(rows, 0.05, 0.5, 0.95, 1.0),
      'robust' => rows.robust_percent, 'thin' => rows.thin, 'unstable' => rows.unstable,
      'slower' => rows.slower(0.5), 'lasts' => [0.5, 0.9].map { |share| rows.lasts(share) } }
  end
end

def shown_ms(rows, *shares)
  shares.map { |share| Study.shown(rows.ms(share)) }
end

def family_numbers(all, name, title)
  designs = Study::DESIGNS.to_h { |design| [design, all.of(design).family(name)] }
  safe = designs['PI safe']
  { 'family' => title, 'plants' => safe.count, 'gains' => safe.gains, 'lasts' => safe.lasts(0.5),
    'statuses' => Study::STATUSES.to_h { |status| [status, safe.ended(status)] },
    'reasons' => Study::REASONS.to_h { |reason| [reason, safe.refused(reason)] },
    'loops' => designs.transform_values { |rows| loop_numbers(rows) } }
end

def loop_numbers(rows)
  { 'ms' => shown_ms(rows, 0.5, 1.0), 'thin' => rows.thin, 'unstable' => rows.unstable }
end

def tell_at_once
  Report.number('at_once', design_rows(study_rows('autotune', STUDY_SEEDS[0], AT_ONCE_PLANTS, AT_ONCE)))
end

# What the picture has.
DRAWN_RULES = ['PI safe', 'PI quick', 'PID safe'].freeze
MS_DRAWN = 10.0 # what is beyond is drawn there
MS_EDGE = 26.0  # of the panel: room for a number
NO_GAINS = { 'the experiment failed' => Plot::LIMIT, 'refused after it' => Plot::OUTPUT }.freeze

def draw_random_plants(all)
  safe = all.of('PI safe')
  plot = Plot.new('random_plants', "#{safe.count} random plants of #{Study::FAMILIES.size} families, " \
                                   'and the gains that fixpid\\\\_autotune finds',
                  width: 960, height: 860, columns: [0.72, 1.0, 1.0, 1.0], gap_x: 0.012,
                  margins: { left: 0.262, right: 0.99, top: 0.845, bottom: 0.14 })
  refusal_panel(plot, safe)
  DRAWN_RULES.each_with_index { |rule, i| sensitivity_panel(plot, i + 1, all.of(rule), rule) }
  plot.draw
end

def study_csv(name, rows)
  path = "#{Host.folder}/random_plants-#{name}.csv"
  File.write(path, rows.map { |row| "#{row.join(',')}\n" }.join)
  path
end

# A bar from one column to another one, in the row of the first.
def study_bar(path, from, to, width, color)
  "'#{path}' using #{from}:1:#{to}:(0) with vectors nohead linewidth #{width} linecolor '#{color}' notitle"
end

def study_dots(path, column, style)
  "'#{path}' using #{column}:1 with points #{style} linecolor '#{Plot::TEXT}' notitle"
end

def study_numbers(path, place, text, style)
  "'#{path}' using (#{place}):1:(#{text}) with labels #{style} notitle"
end

# The families from above to below, in all panels.
def study_rows_axis(names)
  tics = Study::FAMILIES.values.each_with_index.map { |title, i| "'#{names ? title.sub('%', '%%') : ''}' #{i}" }
  ["set yrange [#{Study::FAMILIES.size - 0.4}:-0.6]", "set ytics scale 0 (#{tics.join(', ')})", 'set key off',
   'unset grid', "set grid xtics linecolor '#dddddd' linetype 1 linewidth 0.7"]
end

def refusal_panel(plot, safe)
  rows = Study::FAMILIES.keys.each_with_index.map do |name, i|
    some = safe.family(name)
    failed = 100.0 * (some.count - some.ended('DONE')) / some.count
    [i, failed, 100.0 * (some.count - some.gains) / some.count]
  end
  path = study_csv('refusals', rows)
  failed, refused = NO_GAINS.values
  plot.panel(0, 0, [study_bar(path, '(0)', 2, 7, failed), study_bar(path, 2, '($3-$2)', 7, refused),
                    study_numbers(path, '$3+2', "sprintf('%.0f', $3)", 'left')],
             [*study_rows_axis(true), 'set xrange [0:125]', 'set xtics (0, 50, 100)', "set xlabel 'of the plants, %'",
              "set title \"{/:Bold fixpid\\\\_autotune}\\nno gains for\\n \"", *study_legend])
end

# Below the panels.
def study_legend
  right = { 'the loops with these gains, Ms:' => 'the largest factor by which a loop makes a disturbance greater',
            'bar: 5 to 95 % of the loops' => 'square: the middle one; circle: the worst stable one, or beyond 10',
            'number: unstable loops, %' => 'green: a good margin; red: close to oscillation' }
  left = [*NO_GAINS, ['L: dead time, T: lag', Plot::TEXT]]
  left.each_with_index.map { |(title, color), i| legend(title, 0.012, i, color) } +
    right.each_with_index.flat_map { |texts, i| texts.zip([0.262, 0.51]).map { |text, x| legend(text, x, i) } }
end

def legend(title, x, line, color = Plot::TEXT)
  "set label '#{title}' at screen #{x}, screen #{(0.066 - 0.022 * line).round(3)} textcolor '#{color}'"
end

def sensitivity_panel(plot, column, all, title)
  rows = Study::FAMILIES.keys.each_with_index.map { |name, i| [i, *sensitivity_row(all.family(name))] }
  path = study_csv("ms-#{column}", rows)
  curves = [study_bar(path, 2, '($4-$2)', 6, Plot::MEASUREMENT.sub('#', '#90')),
            study_dots(path, 3, 'pointtype 5 pointsize 0.7'), study_dots(path, 5, 'pointtype 6 pointsize 0.6'),
            study_numbers(path, MS_EDGE * 0.93, "$6 > 0 ? sprintf('%.0f %%', $6) : ''",
                          "right textcolor '#{Plot::WITHOUT}'")]
  lasts = format('%.1f', all.lasts(0.5)).sub(/\A(\d\d)\.\d\z/, '\1')
  gains = (100.0 * all.gains / all.count).round
  heading = "set title \"{/:Bold #{title}}\\ngains for #{gains} %\\nlasts #{lasts} (L + T)\""
  plot.panel(0, column, curves, [*study_rows_axis(false), *sensitivity_marks, heading])
end

# 5, 50 and 95 %, the worst stable one, and percent that are unstable.
def sensitivity_row(some)
  low, middle, high = [0.05, 0.5, 0.95].map { |share| [some.ms(share), MS_DRAWN].min }
  worst = some.sensitivities.select(&:finite?).last || MS_DRAWN
  [low, middle, high, [worst, MS_DRAWN].min, 100.0 * some.unstable / some.gains]
end

def sensitivity_marks
  low, high = Study::ROBUST.minmax
  ['set logscale x', "set xrange [1:#{MS_EDGE}]",
   "set xtics ('1' 1, '2.2' #{Study::THIN}, '4' 4, '10' #{MS_DRAWN})",
   "set xlabel 'Ms, a factor'",
   "set object 1 rectangle from #{low}, graph 0 to #{high}, graph 1 behind " \
   "fillcolor '#DDF0E4' fillstyle solid noborder",
   "set object 2 rectangle from #{Study::THIN}, graph 0 to #{MS_DRAWN}, graph 1 behind " \
   "fillcolor '#F9E3DC' fillstyle solid noborder"]
end

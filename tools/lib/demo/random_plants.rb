# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Both autotuners on random plants: how good the gains are that they find. The
# program `random_plants` prints a row for each plant, tuner and rule.
BATCH_SEEDS = [31, 77].freeze
BATCH_PLANTS = 400
HOLDING_PERCENTS = [3, 10, 15, 50, 85, 95].freeze
HOLDING_PLANTS = 150
DANGERS = { 'servo' => 'position servos', 'dead time' => 'dead times' }.freeze
DANGER_PLANTS = 150
ALL_RULES = 9 # rows of a plant: a tuner and a rule in each

TUNERS = { 'autotune' => 'fixpid_autotune', 'relay' => 'fixpid_relay' }.freeze
BATCH_RULES = {
  'SIMC_PI' => 'SIMC PI', 'AMIGO_PI' => 'AMIGO PI', 'AMIGO_PID' => 'AMIGO PID',
  'TYREUS_LUYBEN_PI' => 'Tyreus-Luyben PI', 'TYREUS_LUYBEN_PID' => 'Tyreus-Luyben PID',
  'ZIEGLER_NICHOLS_PI' => 'Ziegler-Nichols PI', 'ZIEGLER_NICHOLS_PID' => 'Ziegler-Nichols PID'
}.freeze

ROBUST = (1.2..1.8).freeze # Ms of a loop with a margin that is not too calm
THIN = 2.2 # Ms of one with too little

# What one tuner and rule did on a batch.
class Batch
  attr_reader :rows, :results

  def initialize(rows)
    @rows = rows
    @results = rows.select { |row| row['result'] == '1' }
  end

  def only(tuner, rule)
    rows = @rows.select { |row| row['tuner'] == tuner && row['rule'] == rule }
    rows.empty? and raise Host::Failure, "no plant tuned by #{tuner}, #{rule}"
    Batch.new(rows)
  end

  def +(other)
    Batch.new(@rows + other.rows)
  end

  # Plants for which a tuner has gains by any rule.
  def served(tuner)
    @results.select { |row| row['tuner'] == tuner }.map { |row| row['plant'] }.uniq.size
  end

  def done
    @rows.count { |row| row['status'].to_i == DONE }
  end

  def done_percent
    percent(done, @rows.size)
  end

  def hanging
    @rows.count { |row| row['status'] == '1' }
  end

  def outside
    @rows.sum { |row| row['outside'].to_i }
  end

  def unstable
    @results.count { |row| row['iae'].to_f.negative? }
  end

  # Of loops that come to rest; the others have no such number.
  def sensitivities
    resting.map { |row| row['ms'].to_f }
  end

  def errors
    resting.map { |row| row['iae'].to_f }
  end

  def lasts
    @rows.select { |row| row['status'].to_i == DONE }.map { |row| row['lasts'].to_f }
  end

  def robust_percent
    percent(sensitivities.count { |ms| ROBUST.cover?(ms) }, @results.size)
  end

  def thin
    unstable + sensitivities.count { |ms| ms > THIN }
  end

  def thin_percent
    done.zero? ? 0.0 : percent(thin, done) # what is refused is not dangerous
  end

  def self.quantile(values, share)
    values.sort[(share * (values.size - 1)).round] unless values.empty?
  end

  private

  def resting
    @results.reject { |row| row['iae'].to_f.negative? }
  end

  def percent(part, whole)
    100.0 * part / whole unless whole.zero?
  end
end

# There are fewer rows where only the first rules of each tuner are asked for.
def batch(name, seed, plants, *arguments, rows: ALL_RULES)
  path = Host.print('random_plants', "random_plants-#{name}.txt", *[seed, plants, *arguments].map(&:to_s))
  Batch.new(Loops.read(path, plants * rows))
end

def random_plants
  drawn = BATCH_SEEDS.to_h { |seed| [seed, batch(seed, seed, BATCH_PLANTS)] }
  loaded = BATCH_SEEDS.to_h do |seed|
    [seed, batch("#{seed}-loaded", seed, BATCH_PLANTS, 'mixed', 1, 1, rows: 2)]
  end
  dangers = DANGERS.keys.to_h do |kind|
    [kind, batch(kind.tr(' ', '-'), BATCH_SEEDS[0], DANGER_PLANTS, kind)]
  end
  drawn.each { |seed, all| check_autotune(seed, all.only('autotune', 'SIMC_PI')) }
  loaded.each { |seed, all| check_loaded(seed, all.only('autotune', 'SIMC_PI')) }
  check_relay(drawn.transform_keys { |seed| "seed #{seed}" }, dangers)
  both = drawn.values.reduce(:+)
  tell_rules('rules', both)
  dangers.each { |kind, all| tell_rules(DANGERS.fetch(kind), all) }
  tell_holding
  draw_random_plants(both)
end

# Each seed alone, with the rule that the header calls the default. A user who
# takes it unseen must have a loop with a margin, 19 times of 20, and an experiment
# that ends well as often; its errors may be half as large again as those with the
# gains of a plant that is known.
def check_autotune(seed, batch)
  what = "seed #{seed}, SIMC PI"
  Report.at_least("#{what}: experiments DONE", batch.done_percent, 96.0, '%')
  Report.at_least("#{what}: Ms within 1.2 to 1.8", batch.robust_percent, 95.0, '%')
  Report.at_most("#{what}: Ms above 2.2", batch.thin, 2)
  Report.exactly("#{what}: unstable", batch.unstable, 0)
  Report.at_most("#{what}: sum of errors over the best, median",
                 Batch.quantile(batch.errors, 0.5), 1.05)
  Report.at_most("#{what}: and of 90 %", Batch.quantile(batch.errors, 0.9), 1.5)
  check_conduct(what, batch)
end

def check_loaded(seed, batch)
  what = "seed #{seed}, a load during each experiment"
  Report.at_least("#{what}: Ms within 1.2 to 1.8", batch.robust_percent, 90.0, '%')
  Report.exactly("#{what}: unstable", batch.unstable, 0)
  check_conduct(what, batch)
end

def check_conduct(what, batch)
  Report.exactly("#{what}: outputs outside their range", batch.outside, 0)
  Report.exactly("#{what}: experiments without an end", batch.hanging, 0)
end

# The relay may refuse what it cannot tune, and must refuse what is dangerous: by
# its status, or a rule of it by the result.
def check_relay(drawn, dangers)
  drawn.merge(dangers.transform_keys { |kind| DANGERS.fetch(kind) })
       .each do |name, all|
    %w[TYREUS_LUYBEN_PI TYREUS_LUYBEN_PID].each do |rule|
      found = all.only('relay', rule)
      what = "#{name}, relay, #{BATCH_RULES.fetch(rule)}"
      Report.exactly("#{what}: unstable", found.unstable, 0)
      Report.at_most("#{what}: Ms above 2.2, of those DONE", found.thin_percent, 2.0, '%')
      check_conduct(what, found)
    end
  end
  check_served(drawn)
end

# Not all that is safe may be refused, either: 3 plants of 5 have gains.
def check_served(drawn)
  drawn.each do |name, all|
    Report.at_least("#{name}, relay: plants with gains by a rule", all.served('relay'), 240)
  end
end

# The rows of a table in docs/tuning.md.
def tell_rules(name, all)
  pairs = all.rows.map { |row| row.values_at('tuner', 'rule') }.uniq
  Report.number(name, pairs.map { |tuner, rule| rule_numbers(all.only(tuner, rule), tuner, rule) })
end

def rule_numbers(found, tuner, rule)
  ms = found.sensitivities
  { 'tuner' => TUNERS.fetch(tuner), 'rule' => BATCH_RULES.fetch(rule),
    'done' => found.done, 'results' => found.results.size, 'of' => found.rows.size,
    'ms' => [0.05, 0.5, 0.95].map { |share| Batch.quantile(ms, share) },
    'robust' => found.robust_percent, 'thin' => found.thin, 'unstable' => found.unstable,
    'iae' => [0.5, 0.9].map { |share| Batch.quantile(found.errors, share) },
    'lasts' => [0.5, 0.9].map { |share| Batch.quantile(found.lasts, share) } }
end

def tell_holding
  rows = HOLDING_PERCENTS.map do |percent|
    all = batch("holding-#{percent}", BATCH_SEEDS[0], HOLDING_PLANTS, 'mixed', 0.25, 2,
                percent / 100.0, rows: 4)
    autotune = all.only('autotune', 'SIMC_PI')
    relay = all.only('relay', 'TYREUS_LUYBEN_PI') + all.only('relay', 'TYREUS_LUYBEN_PID')
    Report.exactly("held by #{percent} %, SIMC PI: unstable", autotune.unstable, 0)
    { 'percent' => percent, 'of' => HOLDING_PLANTS, 'autotune' => autotune.results.size,
      'robust' => autotune.robust_percent, 'thin' => autotune.thin,
      'relay' => relay.served('relay'), 'relay_thin' => relay.thin }
  end
  Report.number('holding', rows)
end

# What is beyond the picture is drawn at its edge.
MS_DRAWN = 3.0
ERRORS_DRAWN = (0.1..12.0).freeze
BATCH_PANELS = { 'relay' => 'TYREUS_LUYBEN_PI', 'autotune' => 'SIMC_PI' }.freeze
BATCH_COLORS = { 'relay' => Plot::RED, 'autotune' => Plot::BLUE }.freeze

def draw_random_plants(all)
  plot = Plot.new('random_plants', "#{BATCH_SEEDS.size * BATCH_PLANTS} random plants, each tuned by an " \
                            'experiment of its own: a dot is a plant',
                  height: 560, columns: [1.0, 1.0], gap_x: 0.05,
                  margins: { left: 0.075, top: 0.83, bottom: 0.11 })
  BATCH_PANELS.each_with_index do |(tuner, rule), column|
    batch_panel(plot, column, tuner, all.only(tuner, rule))
  end
  plot.draw
end

def batch_dots(tuner, found)
  path = "#{Host.folder}/random_plants-#{tuner}.csv"
  lines = found.results.map do |row|
    ms, errors = row.values_at('ms', 'iae').map(&:to_f)
    ms, errors = MS_DRAWN, ERRORS_DRAWN.max if errors.negative?
    "#{[ms, MS_DRAWN].min},#{errors.clamp(ERRORS_DRAWN)}"
  end
  File.write(path, "#{lines.join("\n")}\n")
  path
end

def batch_panel(plot, column, tuner, found)
  dots = "'#{batch_dots(tuner, found)}' using 1:2 with points pointtype 7 " \
         "pointsize 0.45 linecolor '#{BATCH_COLORS.fetch(tuner).sub('#', '#80')}' notitle"
  title = "set title \"{/:Bold #{TUNERS.fetch(tuner).gsub('_', '\\\\\\_')}}, " \
          "#{BATCH_RULES.fetch(BATCH_PANELS.fetch(tuner))}\\n" \
          "gains for #{found.results.size} plants, none for " \
          "#{found.rows.size - found.results.size}\""
  plot.panel(0, column, [dots, '1 with lines linecolor \'#444444\' dashtype 2 notitle'],
             [title, 'set key off', *batch_marks, *batch_axes(column)])
end

def batch_marks
  low, high = ROBUST.minmax
  ["set object 1 rectangle from #{low}, graph 0 to #{high}, graph 1 behind " \
   "fillcolor '#DDF0E4' fillstyle solid noborder",
   "set object 2 rectangle from #{THIN}, graph 0 to graph 1, graph 1 behind " \
   "fillcolor '#F9E3DC' fillstyle solid noborder",
   "set label 'a good margin' at #{(low + high) / 2.0}, graph 0.965 center",
   "set label 'close to oscillation' at #{(THIN + MS_DRAWN) / 2.0}, graph 0.965 center",
   "set label 'slower' at 1.03, 1.22", "set label 'quicker' at 1.03, 0.83"]
end

def batch_axes(column)
  ['set logscale y', "set xrange [1:#{MS_DRAWN}]",
   "set yrange [#{ERRORS_DRAWN.minmax.join(':')}]",
   'set xtics 0.2', 'set ytics (0.1, 0.2, 0.5, 1, 2, 5, 10)',
   "set xlabel 'Ms: the most that the loop makes of a disturbance'",
   *(column.zero? ? ["set ylabel 'sum of errors after a load, 1: gains of the known plant'"] : [])]
end

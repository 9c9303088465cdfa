# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What sim/random_plants prints, summed up: how good the gains are that autotuners
# find on plants of many families. `study.rb PROGRAM SEED PLANTS` prints tables.
module Study
  class Failure < StandardError; end

  HEADER = File.expand_path('../../../include/fixpid_autotune.h', __dir__)

  # The names of an enumeration of the header, in their order.
  def self.names(enumeration)
    text = File.read(HEADER)[/^enum #{enumeration} \{(.*?)^\};/m, 1] or raise Failure, "no #{enumeration} in #{HEADER}"
    text.scan(/^ +FIXPID_AUTOTUNE_(\w+)/).flatten
  end

  STATUSES = names('fixpid_autotune_state').freeze
  REASONS = names('fixpid_autotune_cause').freeze

  OURS = 'fixpid_autotune'
  DESIGNS = ['PI quick', 'PI safe', 'PI calm', 'PID quick', 'PID safe', 'PID calm'].freeze
  PEERS = { 'Arduino PID AutoTune' => %w[PI PID],
            'QuickPID' => ['Tyreus-Luyben PI', 'Ziegler-Nichols PID', 'AMIGO PID'],
            'sTune' => ['Ziegler-Nichols PI', 'Ziegler-Nichols PID'] }.freeze

  # What is drawn: L is the dead time, T the lag.
  FAMILIES = {
    'lag-dominant' => 'lag, L / T 0.02 to 0.2', 'balanced' => 'lag, L / T 0.2 to 1',
    'dead-time' => 'lag, L / T 1 to 10', 'equal lags' => '3 to 8 equal lags', 'inverse' => 'inverse response',
    'oscillatory' => 'oscillatory, damping 0.3 to 0.9', 'integrator' => 'integrator, dead time',
    'servo' => 'servo, 0 to 3 steps of dead time', 'integrator and lag' => 'integrator, lag, dead time',
    'unstable' => 'unstable, one lag', 'fractional lag' => 'fractional lag', 'batch' => 'batch of AMIGO',
    'two lags' => 'two lags, dead time', 'servo and lag' => 'servo with a second lag',
    'heater' => 'heater, cools 2 to 5 times as slowly', 'backlash' => 'backlash of 0.3 to 3 %',
    'drift' => 'drift of up to 10 %', 'holding low' => '3 to 5 % hold the setpoint',
    'holding high' => '93 to 97 % hold the setpoint', 'coarse' => '8-bit actuator, noisy sensor',
    'load' => 'load step in every run', 'servo without delay' => 'servo without dead time'
  }.freeze

  ROBUST = (1.2..1.8).freeze # Ms of a loop with a margin that is not too calm
  THIN = 2.2                 # Ms of one with too little

  Row = Struct.new(:family, :tuner, :rule, :status, :reason, :lasts, :outside, :ms, :slower) do
    def found?
      !ms.zero?
    end

    def stable?
      ms.positive?
    end
  end

  # Some rows, of one tuner and rule or of several.
  class Rows
    include Enumerable
    attr_reader :rows

    def initialize(rows)
      @rows = rows
    end

    def +(other)
      Rows.new(rows + other.rows)
    end

    def each(&block)
      rows.each(&block)
    end

    def of(tuner, rule)
      found = rows.select { |row| row.tuner == tuner && row.rule == rule }
      found.empty? and raise Failure, "no plant tuned by #{tuner}, #{rule}"
      Rows.new(found)
    end

    def family(name)
      Rows.new(rows.select { |row| row.family == name })
    end

    def with_gains
      @with_gains ||= rows.select(&:found?)
    end

    def gains
      with_gains.size
    end

    def ended(status)
      count { |row| STATUSES[row.status] == status }
    end

    def refused(reason)
      count { |row| REASONS[row.reason] == reason }
    end

    def unstable
      with_gains.count { |row| !row.stable? }
    end

    # An unstable loop has none.
    def sensitivities
      @sensitivities ||= with_gains.map { |row| row.stable? ? row.ms : Float::INFINITY }.sort
    end

    # Stable, but close to oscillation.
    def thin
      sensitivities.count { |ms| ms > THIN } - unstable
    end

    def thin_percent
      percent(thin + unstable, gains)
    end

    def robust_percent
      percent(sensitivities.count { |ms| ROBUST.cover?(ms) }, gains)
    end

    # Of the loops' Ms.
    def ms(share)
      Rows.quantile(sensitivities, share)
    end

    def worst
      sensitivities.last
    end

    # Of the experiments that gave gains, in units of L + T.
    def lasts(share)
      Rows.quantile(with_gains.map(&:lasts).sort, share)
    end

    # The sum of errors after a step of the load, over that of the best PI.
    def slower(share)
      Rows.quantile(with_gains.map(&:slower).reject(&:zero?).sort, share)
    end

    def outside
      sum(&:outside)
    end

    def self.quantile(sorted, share)
      sorted[(share * (sorted.size - 1)).round] unless sorted.empty?
    end

    private

    def percent(part, whole)
      whole.zero? ? 0.0 : 100.0 * part / whole
    end
  end

  COLUMNS = 11

  # Of the program's lines, without their first one.
  def self.rows(lines)
    Rows.new(lines.map do |line|
      line.count(';') == COLUMNS - 1 or raise Failure, "not a row: #{line.chomp}"
      _, family, tuner, rule, status, reason, _, lasts, outside, ms, slower = line.chomp.split(';')
      Row.new(family, tuner, rule, Integer(status), Integer(reason), Float(lasts), Integer(outside), Float(ms),
              Float(slower))
    end)
  rescue ArgumentError => e
    raise Failure, e.message
  end

  # Ms with two digits.
  def self.shown(sensitivity)
    return '-' if sensitivity.nil?

    sensitivity.finite? ? format('%.2f', sensitivity) : 'unstable'
  end

  # What the tables of a terminal say.
  module Tables
    LINE = '%-38s %6s %6s %8s %8s %8s %8s %9s %6s %8s %6s'

    module_function

    def designs(all)
      DESIGNS.each do |design|
        puts design, format(LINE, '', 'plants', 'gains', 'Ms 5 %', '50 %', '95 %', 'max', '1.2..1.8', '> 2.2',
                            'unstable', 'lasts')
        FAMILIES.each { |name, title| line(title, all.of(OURS, design).family(name)) }
        line('all', all.of(OURS, design))
        puts ''
      end
    end

    def line(title, rows)
      sensitivities = [0.05, 0.5, 0.95, 1.0].map { |share| Study.shown(rows.ms(share)) }
      puts format(LINE, title, rows.count, rows.gains, *sensitivities, format('%.1f %%', rows.robust_percent), rows.thin, rows.unstable, rows.lasts(0.5)&.round || '-')
    end

    # Of the plants without gains: what the experiment said, or else the result.
    def refusals(all)
      safe = all.of(OURS, 'PI safe')
      columns = STATUSES.drop(3) + REASONS.drop(3)
      puts format("%-38s#{' %9s' * (columns.size + 1)}", 'PI safe', 'gains', *columns.map { |name| name[0, 9] })
      FAMILIES.merge(nil => 'all').each do |name, title|
        rows = name ? safe.family(name) : safe
        puts format("%-38s#{' %9d' * (columns.size + 1)}", title, rows.gains,
                    *STATUSES.drop(3).map { |status| rows.ended(status) },
                    *REASONS.drop(3).map { |reason| rows.refused(reason) })
      end
    end
  end

  def self.main(program, seed, plants)
    lines = IO.popen([program, 'ours', seed, plants], &:readlines)
    $?.success? or abort "study: #{program} failed"
    all = rows(lines.drop(1))
    Tables.designs(all)
    Tables.refusals(all)
  end
end

Study.main(*ARGV) if $PROGRAM_NAME == __FILE__

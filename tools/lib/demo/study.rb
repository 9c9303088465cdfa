# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What sim/random_plants prints, summed up: how good the gains are that the tuners find on
# plants of many families and kinds.
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

  DESIGNS = ['PI quick', 'PI safe', 'PI calm', 'PID quick', 'PID safe', 'PID calm'].freeze

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

  WORDS = %i[family rule advice].freeze
  WHOLE = %i[plant part status reason possible outside status_then reason_then].freeze
  COLUMNS = [*WORDS, *WHOLE, :lasts, :periods, :minutes, :beyond, :ms, :slower].freeze

  # What its study has no column for is nil.
  Row = Struct.new(*COLUMNS, keyword_init: true) do
    def found?
      !ms.zero?
    end

    def stable?
      ms.positive?
    end
  end

  # Some rows, of one rule or of several.
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

    def of(rule)
      found = rows.select { |row| row.rule == rule }
      found.empty? and raise Failure, "no plant tuned by #{rule}"
      Rows.new(found)
    end

    def family(*names)
      Rows.new(rows.select { |row| names.include?(row.family) })
    end

    def but(*names)
      Rows.new(rows.reject { |row| names.include?(row.family) })
    end

    def possible
      Rows.new(rows.select { |row| row.possible == 1 })
    end

    def with_gains
      @with_gains ||= rows.select(&:found?)
    end

    def gains
      with_gains.size
    end

    def gains_percent
      percent(gains, count)
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

    # Of the experiments that gave gains, in units of L + T, or of a column.
    def lasts(share, column = :lasts)
      Rows.quantile(with_gains.map(&column).sort, share)
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

  # Of the program's lines, of which the first names the columns.
  def self.rows(lines)
    columns = lines[0].to_s.chomp.split(';').map(&:to_sym)
    (columns - COLUMNS).empty? or raise Failure, "not the head of a study: #{lines[0]}"
    Rows.new(lines.drop(1).map { |line| row(columns, line.chomp.split(';')) })
  end

  def self.row(columns, values)
    values.size == columns.size or raise Failure, "not a row: #{values.join(';')}"
    Row.new(**columns.zip(values).to_h { |column, value| [column, read(column, value)] })
  rescue ArgumentError => e
    raise Failure, e.message
  end

  def self.read(column, value)
    return value if WORDS.include?(column)

    WHOLE.include?(column) ? Integer(value) : Float(value)
  end
  private_class_method :row, :read

  # Ms with two digits.
  def self.shown(sensitivity)
    return '-' if sensitivity.nil?

    sensitivity.finite? ? format('%.2f', sensitivity) : 'unstable'
  end
end

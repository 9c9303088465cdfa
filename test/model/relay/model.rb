# SPDX-License-Identifier: MIT
# The relay experiment and its tuning rules once more, in integers without an
# end, written from the definition and not from src/. Reads what trace.c prints
# and says where the two differ.
require_relative '../../support/trace_replay'

class Model
  STATUS = %i[refused running done no_oscillation saturated irregular too_fast too_small].freeze
  RULES = [[80, 116, 0], [116, 116, 41]].freeze
  FIELDS = %i[low high rest least most hysteresis timeout cycles options].freeze
  CYCLES_AT_MOST = 24
  # Steps of its halves, counts of its swing, sum of the errors' magnitudes, and
  # the steps after which the two extremes stood.
  Cycle = Struct.new(:high, :low, :swing, :errors, :extremes) do
    def period
      high + low
    end

    def turning
      (extremes.sum - high) % 65_536
    end

    def uneven
      (high - low).abs
    end
  end

  attr_reader :status

  def initialize(values)
    @given = FIELDS.zip(values).to_h
    @legal = legal?
    reset
  end

  def accepted?
    @legal
  end

  def reset
    @status = @legal ? :running : :refused
    @side = nil
    @elapsed = 0
    @cycles = []
    @alike = []
  end

  def step(setpoint, measurement)
    watch(measurement)
    swing(setpoint, measurement) if @status == :running
    return @legal ? @given[:rest] : 0 unless @status == :running

    @elapsed += 1
    @given[@side]
  end

  # [kp, ki, kd, filter], or nil
  def result(rule)
    return unless @status == :done && RULES[rule] && serves?(rule, @alike.last)

    kp_part, ki_part, td_part = RULES[rule]
    count = @alike.size
    ultimate = 326 * 16 * (@given[:high] - @given[:low]) * count / @alike.sum(&:swing)
    period = (16 * @alike.sum(&:period) + count / 2) / count
    kp_fine = ultimate * kp_part / 16
    # 16 q + 16 rest / Tu, each rounded down, is the quotient of the whole.
    gains(kp_fine, kp_fine * ki_part * 16 / period, period * td_part / 256)
  end

  private

  def legal?
    g = @given
    g[:low] < g[:high] && g[:least] < g[:most] && (1..8191).cover?(g[:hysteresis]) &&
      (2..32_767).cover?(g[:timeout]) && (1..8).cover?(g[:cycles]) && [0, 0x80].include?(g[:options])
  end

  def gains(kp_fine, integral, rate_time)
    kp = (kp_fine + 128) / 256
    filter = (0..7).select { |n| n.zero? || 2**n <= rate_time / 128 }.max
    kd = kp * rate_time / 2**(4 + filter)
    good = (1..32_767).cover?(kp) && (8..0x7FFF0000).cover?(integral) && rate_time <= 0x1FFFF && kd <= 32_255
    [kp, integral, kd, filter] if good
  end

  # PI: 8 errors / period / (swing - 1.5 hysteresis) < 2 + (turning + uneven) / period
  def serves?(rule, last)
    return pid_serves?(last) if rule == 1
    return true if last.turning > last.period / 2 + last.period / 16

    steps = 2 * last.period + last.turning + last.uneven
    16 * last.errors / steps < 2 * last.swing - 3 * @given[:hysteresis]
  end

  def pid_serves?(last)
    last.period >= 20 && last.uneven < last.period / 3 && last.turning < last.period / 2 - last.period / 20
  end

  def watch(measurement)
    return unless @status == :running

    @status = :no_oscillation if @elapsed >= @given[:timeout]
    @status = :saturated if measurement <= @given[:least] || measurement >= @given[:most]
  end

  def error(setpoint, measurement)
    difference = @given[:options].zero? ? setpoint - measurement : measurement - setpoint
    difference.clamp(-32_768, 32_767)
  end

  def swing(setpoint, measurement)
    error = error(setpoint, measurement)
    unless @side
      @side = error >= 0 ? :high : :low
      begin_cycle(measurement)
    end
    @seen << measurement
    @errors += (setpoint - measurement).abs
    if @side == :high && error < -@given[:hysteresis]
      @side = :low
      @high_steps = @elapsed
      @elapsed = 0
    elsif @side == :low && error > @given[:hysteresis]
      end_of_cycle
      @side = :high
      @elapsed = 0
      begin_cycle(measurement)
    end
  end

  def begin_cycle(measurement)
    @seen = [measurement]
    @errors = 0
  end

  def end_of_cycle
    extremes = @seen.minmax
    @cycles << Cycle.new(@high_steps || 0, @elapsed, extremes[1] - extremes[0], @errors,
                         extremes.map { |extreme| @seen.index(extreme) })
    average(@cycles.last) unless @cycles.size == 1
    @status = @alike.size == @given[:cycles] ? verdict : @status
    @status = :irregular if @status == :running && @cycles.size == CYCLES_AT_MOST
  end

  def average(cycle)
    @alike = [] unless @alike.empty? || alike?(cycle, @alike.last)
    @alike << cycle
  end

  def alike?(cycle, before)
    [[cycle.period, before.period], [cycle.swing, before.swing]].all? do |now, then_|
      (now - then_).abs <= now / 4 + 2
    end
  end

  def verdict
    last = @alike.last
    return :irregular if last.high > 4 * last.low || last.low > 4 * last.high
    return :too_fast if @alike.sum(&:period) < 6 * @alike.size
    return :too_small if @alike.sum(&:swing) < 4 * @given[:hysteresis] * @alike.size

    :done
  end
end

class Replay < TraceReplay
  def initialize
    super(Model)
  end

  def r(values)
    gains = @model.result(values[0])
    @endings[@model.status] += 1 if values[0].zero?
    @results[[values[0], !gains.nil?]] += 1
    [[gains ? 1 : 0, *(gains || [0, 0, 0, 0])], values.drop(1)]
  end
end

# What must have happened, and how often, for the comparison to mean anything.
def complaints(replay)
  expected = Model::STATUS.drop(2).unshift(:refused).map { |status| [replay.endings[status], 50, status] }
  Model::RULES.each_index do |rule|
    [true, false].each { |good| expected << [replay.results[[rule, good]], 300, "rule #{rule}: #{good}"] }
  end
  expected << [replay.results.values.sum, 9000, 'results']
  TraceReplay.too_few(expected)
end

if $PROGRAM_NAME == __FILE__
  replay = Replay.new
  $stdin.each_line { |line| replay.read(line) }
  puts(replay.endings.map { |status, count| "#{status} #{count}" })
  puts "#{replay.endings.values.sum} experiments, #{replay.lines} lines, #{replay.results.values.sum} results agree"
  abort "too few of #{complaints(replay).join(', ')}" unless complaints(replay).empty?
end

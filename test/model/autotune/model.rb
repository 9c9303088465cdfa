# SPDX-License-Identifier: MIT
# The experiment, the model that it makes of the plant and the tuning rules once
# more, in integers and fractions without an end, written from the definition and
# not from src/. Reads what trace.c prints and says where the two differ.
require_relative '../../support/trace_replay'

# A number of 16 significant bits, not negative: everything beyond is cut off.
class Short
  attr_reader :value

  def self.cut(value)
    return new(0) if value.zero?

    # 17 or 18 bits, then 16
    exponent = value.numerator.bit_length - value.denominator.bit_length - 17
    kept = (value / Rational(2)**exponent).floor
    until kept < 65_536
      kept /= 2
      exponent += 1
    end
    new(kept * Rational(2)**exponent, Rational(2)**exponent)
  end

  # The one nearest to a decimal fraction.
  def self.nearest(text)
    exact = Rational(text)
    last = cut(exact).last
    new((exact / last).round * last, last)
  end

  # What the last one of the 16 bits is worth.
  attr_reader :last

  def initialize(value, last = nil)
    @value = Rational(value)
    @last = last
  end

  def zero?
    @value.zero?
  end

  def *(other)
    Short.cut(@value * Short.of(other).value)
  end

  def /(other)
    Short.cut(@value / Short.of(other).value)
  end

  # Each has 15 bits more on the way.
  def +(other)
    left, right = [self, Short.of(other)].sort_by(&:value).reverse
    right.zero? ? left : Short.cut(left.value + right.cut_at(left.last / 2**15))
  end

  def -(other)
    right = Short.of(other)
    return self if right.zero?
    return Short.new(0) if right.value >= @value

    Short.cut(@value - right.cut_at(@last / 2**15))
  end

  def cut_at(step)
    (@value / step).floor * step
  end

  def most(other)
    (self - other).zero? ? self : Short.of(other)
  end

  def least(other)
    (self - other).zero? ? Short.of(other) : self
  end

  def integer(fraction)
    scaled = @value * 2**fraction
    scaled >= 2**31 ? 0xFFFFFFFF : (scaled + Rational(1, 2)).floor
  end

  CONSTANTS = Hash.new { |known, text| known[text] = nearest(text) }

  # Of an integer, of a fraction that fits, or of the text of a constant.
  def self.of(number)
    case number
    when Short then number
    when String then CONSTANTS[number]
    else cut(Rational(number))
    end
  end
end

# What an experiment is summed up in.
Sums = Struct.new(:all, :on, :rise, :steps, :on_steps) do
  def self.none
    new(0, 0, 0, 0, 0)
  end

  # The mean deviation in 1/256.
  def mean_q8
    sign * (256 * all.abs / steps)
  end

  def sign
    all <=> 0
  end

  # Of what lies below the mean while the output is high.
  def area
    sign * (all.abs * on_steps / steps) - on - (rise.abs / 2) * (rise <=> 0)
  end

  def good?
    on_steps.positive? && on_steps < steps && area.positive?
  end

  def lopsided?
    [on_steps, steps - on_steps].min < steps / 8
  end
end

# The experiment, step by step.
class Experiment
  STATUS = %i[refused running done no_oscillation saturated irregular too_fast too_small too_slow].freeze
  FIELDS = %i[min max rest least most swing timeout cycles options].freeze

  attr_reader :given, :status, :sums, :highest, :lowest, :noise

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
    @phase = :noise
    @side = :low
    @sums = [Sums.none, Sums.none]
    @first_cycle = true
    @averaged = @elapsed = @period = @last_period = @seen = @noise = @centre = @half = 0
    @before = []
  end

  def step(setpoint, measurement)
    watch(measurement)
    if running?
      difference = reverse? ? setpoint - measurement : measurement - setpoint
      deviation = difference.clamp(-32_767, 32_767)
      @phase == :noise ? listen(deviation) : relay(deviation)
    end
    return 0 unless @legal
    return @given[:rest] if !running? || @phase == :noise

    level(@phase, @side)
  end

  def hysteresis
    1 + (@noise + @noise / 2 + 16) / 32
  end

  def level(phase, side)
    return @given[side == :high ? :max : :min] if phase == :find

    part = { centre: [@half + @half / 2] * 2, second: [2 * @half, @half] }.fetch(phase, [@half, 2 * @half])
    (side == :high ? @centre + part[1] : @centre - part[0]).clamp(@given[:min], @given[:max])
  end

  private

  def legal?
    g = @given
    g[:min] < g[:max] && g[:least] < g[:most] && (g[:min]..g[:max]).cover?(g[:rest]) &&
      (g[:swing].zero? || (8..16_383).cover?(g[:swing])) && (2..32_767).cover?(g[:timeout]) &&
      (1..4).cover?(g[:cycles]) && [0, 0x80].include?(g[:options])
  end

  def running?
    @status == :running
  end

  def reverse?
    @given[:options] == 0x80
  end

  def watch(measurement)
    return unless running?

    @status = :no_oscillation if @elapsed >= @given[:timeout]
    @status = :saturated if measurement <= @given[:least] || measurement >= @given[:most]
  end

  def listen(deviation)
    last, last_but_one = @before.first(2)
    @noise += [(deviation - 2 * last + last_but_one).abs, 1023].min if last_but_one
    @before.unshift(deviation)
    @elapsed += 1
    return unless @elapsed == 34

    @phase = :find
    @side = deviation <= 0 ? :high : :low
    @elapsed = 0
    @highest = @lowest = deviation
  end

  def relay(deviation)
    @highest = [@highest, deviation].max
    @lowest = [@lowest, deviation].min
    count(deviation) unless @elapsed.zero?
    return unless running?

    turn(deviation)
    @elapsed += 1
    lose if running? && @phase != :find && @elapsed / 4 > @last_period
  end

  def present
    @sums[@phase == :second ? 1 : 0]
  end

  def count(deviation)
    @period += 1
    return if @first_cycle

    sums = present
    sums.all += deviation
    sums.steps += 1
    if @side == :high
      sums.on += deviation
      sums.on_steps += 1
    end
    sums.rise += deviation.clamp(-2047, 2047) * (@side == :high ? -1 : 1) if @elapsed == 1
    @status = :too_slow if sums.steps == 32_767
  end

  def turn(deviation)
    if @side == :high && deviation > hysteresis
      @side = :low
      @elapsed = 0
    elsif @side == :low && deviation < -hysteresis
      @side = :high
      end_of_cycle
      @elapsed = 0
      @highest = @lowest = deviation if running?
    end
  end

  def lose
    @sums[0] = Sums.none
    @phase = :find
    @first_cycle = true
    @period = 0
    @elapsed = 1
    @seen += 8
  end

  def end_of_cycle
    before = @last_period
    @last_period = @period
    @period = 0
    @seen += 1
    if @seen >= 48
      @status = :irregular
    elsif @first_cycle
      @first_cycle = false
      @averaged = 0
    elsif %i[find centre].include?(@phase)
      recentre
      go_on
    elsif like?(before)
      @averaged += 1
      go_on if @averaged == @given[:cycles]
    else
      @phase = :first if @phase == :third
      @sums[@phase == :second ? 1 : 0] = Sums.none
      @averaged = 0
    end
  end

  def go_on
    @first_cycle = true
    case @phase
    when :find then @phase = :centre
    when :centre
      @sums[0] = Sums.none
      @phase = :first
    when :first
      @sums[1] = Sums.none
      @phase = :second
    when :second then @phase = :third
    else @status = verdict
    end
  end

  def like?(before)
    return (@last_period - before).abs <= @last_period / 8 + 1 unless @phase == :third

    others = @given[:cycles] + @averaged
    high = @last_period - @elapsed
    (high * (others + 1) - @sums[0].on_steps).abs <= others * (@last_period / 32 + 1)
  end

  def verdict
    return :irregular if @sums.any?(&:lopsided?)
    return :too_fast if @last_period < 10
    return :too_small if @highest - @lowest < 4 * hysteresis

    :done
  end

  def recentre
    low = level(@phase, :low)
    drive = level(@phase, :high) - low
    swing = @highest - @lowest
    @centre = low + (drive * (256 * -@lowest / swing) + 128) / 256 if -@lowest < swing
    wanted = @given[:swing].zero? ? 24 * hysteresis : @given[:swing]
    while wanted > swing
      wanted /= 2
      drive *= 2
    end
    drive = [drive, 131_072].min
    drive = drive * (256 * wanted / swing) / 256 if wanted < swing
    @half = [2, [drive, @given[:max] - @given[:min]].min * 85 / 256].max
  end
end

# The plant, as an experiment that is done shows it.
class Plant
  Relay = Struct.new(:slope, :mid, :turn, :ultimate, :drive)

  attr_reader :gain, :flat, :slope, :lag, :dead, :later, :ultimate, :period, :holding

  # nil if the sums make no sense
  def self.of(experiment)
    new(experiment) if experiment.status == :done && experiment.sums.all?(&:good?)
  end

  def initialize(experiment)
    @experiment = experiment
    @counts = [2 * experiment.given[:cycles], experiment.given[:cycles]]
    @first, @second = relays = [relay(0, :first), relay(1, :second)]
    @slope, @mid, @ultimate = %i[slope mid ultimate].map { |name| relays.map(&name).inject(:+) / 2 }
    @period = experiment.sums.zip(@counts).map { |sums, count| Short.of(sums.steps) / count }.inject(:+) / 2
    find_gain
    limit_ratio
    find_times
    @holding = hold
  end

  private

  def drive(phase)
    @experiment.level(phase, :high) - @experiment.level(phase, :low)
  end

  def output_q8(number, phase)
    sums = @experiment.sums[number]
    256 * @experiment.level(phase, :low) + 256 * drive(phase) * sums.on_steps / sums.steps
  end

  def relay(number, phase)
    sums = @experiment.sums[number]
    count = @counts[number]
    height = Short.of(drive(phase))
    area = Short.of(sums.area)
    both = Short.of(sums.on_steps) * (sums.steps - sums.on_steps) / sums.steps
    mid = both / count
    rise = Short.of(sums.rise.abs) / (height * count)
    share = both / sums.steps
    ultimate = height * sums.steps * (share * share) / area * '3.24243'
    Relay.new(slope_of(area, count, height, mid * mid, rise), mid, sums.rise.negative? ? Short.new(0) : rise,
              ultimate, height)
  end

  def slope_of(area, count, height, mid_squared, rise)
    plain = area * 2 / count / (height * mid_squared)
    correction = rise * rise / mid_squared
    plain + correction / (plain + correction / plain)
  end

  def find_gain
    measured = @experiment.sums[0].mean_q8 - @experiment.sums[1].mean_q8
    driven = output_q8(0, :first) - output_q8(1, :second)
    swing = @experiment.highest - @experiment.lowest
    noise = Short.of(3 * @experiment.noise / 4) / 16
    @flat = driven.positive? && measured > 16 * swing ? Short.of(driven) / measured : Short.new(0)
    @round = @first.slope * (@first.mid * @first.drive) / 2 / (Short.of(swing) - noise + 1)
  end

  def expected_round
    @ratio * @ratio * (@ratio * '0.2' + '0.3') + '0.5'
  end

  def integrator?
    (@ratio - '0.00390625').zero?
  end

  def limit_ratio
    @ratio = (@slope * @mid * @flat / 2).most('0.984375')
    limit = @round * '1.1' + Short.of(1) / @mid
    until (expected_round - limit).zero?
      @ratio *= '0.9375'
      break if integrator?
    end
    @flat = integrator? ? Short.new(0) : @ratio * 2 / (@slope * @mid)
    @ratio = Short.new(0) if integrator?
  end

  def find_times
    turns = (@first.turn + @second.turn) / 2
    z = @round / expected_round - '1.04'
    @later = z * ((Short.of(1) - @ratio * 6).least('0.25') * (z * 8 + '2.5'))
    cubic = @ratio * @ratio * (@ratio * '0.31')
    @slope /= Short.of(1) - @ratio * (@ratio * (cubic + '0.64') + '0.05')
    @dead = (@mid + @mid * @ratio + 1 - turns / @slope).least('0.5')
    return if @flat.zero?

    @lag = Short.of(1) / (@slope * @flat)
    @gain = Short.of(1) / @flat
  end

  def hold
    mean = output_q8(0, :first) / 2 + output_q8(1, :second) / 2
    off = @experiment.sums.sum { |sums| sums.mean_q8 / 2 }
    mean -= (off <=> 0) * (@flat * off.abs).integer(0)
    ((mean + 128) / 256).clamp(@experiment.given[:min], @experiment.given[:max])
  end
end

# Gains by a rule, and what is written out of a plant.
module Rules
  CLASSIC = { 3 => [80, 116, 0], 4 => [116, 116, 41], 5 => [115, 307, 0], 6 => [154, 512, 32] }.freeze
  ENDLESS = 0xFFFFFFFF

  module_function

  def model(experiment)
    plant = Plant.of(experiment)
    return [0] * 10 unless plant

    [1, plant.gain ? plant.gain.integer(8) : ENDLESS, plant.lag ? plant.lag.integer(4) : ENDLESS,
     plant.dead.integer(4), plant.slope.integer(24), plant.ultimate.integer(8), plant.period.integer(4),
     plant.holding, (experiment.noise + 2) / 4, experiment.hysteresis]
  end

  # [kp, ki, kd, filter, whether kp acts on the measurement], or nil
  def result(experiment, rule, robustness)
    plant = Plant.of(experiment) if (0..6).cover?(rule) && (8..64).cover?(robustness)
    return unless plant

    delay = plant.dead + '0.5'
    kp, ti, td, measured = case rule
                           when 0 then simc(plant, delay, robustness)
                           when 1 then amigo_pi(plant, delay)
                           when 2 then amigo_pid(plant, delay)
                           else classic(plant, *CLASSIC[rule])
                           end
    gains(kp, ti, td, measured)
  end

  def simc(plant, delay, robustness)
    closed = delay * (plant.later + 1) * (Short.of(robustness + 16) / 16)
    ti = closed * 4
    [Short.of(1) / (plant.slope * closed), plant.lag ? plant.lag.most(ti) : ti, Short.new(0), false]
  end

  def amigo_pi(plant, delay)
    lag = plant.lag
    return [Short.of('0.35') / (plant.slope * delay), delay * '13.4', Short.new(0), false] unless lag

    sum = delay + lag
    kp = plant.flat * '0.15' +
         (Short.of('0.35') - delay * lag / (sum * sum)) / (plant.slope * delay)
    ti = delay * '0.35' + delay * (lag * lag) * 13 / (lag * lag + delay * (lag * 12 + delay * 7))
    [kp, ti, Short.new(0), false]
  end

  def amigo_pid(plant, delay)
    lag = plant.lag
    kp = Short.of('0.45') / (plant.slope * delay)
    return [kp, delay * 8, delay / 2, true] unless lag

    [plant.flat * '0.2' + kp, (delay * '0.4' + lag * '0.8') * delay / (delay + lag * '0.1'),
     delay * lag / 2 / (delay * '0.3' + lag), !(lag - delay).zero?]
  end

  def classic(plant, proportional, reset, rate)
    [plant.ultimate * Rational(proportional, 256), plant.period / Rational(reset, 256),
     plant.period * Rational(rate, 256), false]
  end

  def gains(proportional, reset, rate, measured)
    eighth = rate.integer(0) / 8
    filter = (0..7).select { |n| n.zero? || 2**n <= eighth }.max
    kp = proportional.integer(8)
    ki = (proportional / reset).integer(24)
    kd = (proportional * rate).integer(8 - filter)
    [kp, ki, kd, filter, measured] if kp <= 32_767 && (8..0x7FFF0000).cover?(ki) && kd <= 32_255
  end
end

class Replay < TraceReplay
  attr_reader :models, :answers

  def initialize
    super(Experiment)
    @answers = 0
    @models = Hash.new(0)
  end

  def m(values)
    expected = Rules.model(@model)
    @endings[@model.status] += 1
    @models[expected[1] == Rules::ENDLESS ? :integrating : :lag] += 1 if expected[0] == 1
    @models[:none] += 1 if @model.status == :done && expected[0].zero?
    [expected, values.map.with_index { |value, at| at == 7 ? value : value % 2**32 }]
  end

  def r(values)
    rule, robustness, *found = values
    before = found.last / 256
    gains = Rules.result(@model, rule, robustness)
    @answers += 1
    @results[[rule, !gains.nil?]] += 1 if @model.status == :done
    return [[0, 0, 0, 0, 0, 128, before * 257], found] unless gains

    options = gains[4] ? before | 0x20 : before & ~0x20
    [[1, *gains.first(4), gains[4] ? 0 : 256, before * 256 + options], found]
  end
end

# What must have happened, and how often, for the comparison to mean anything.
def complaints(replay)
  expected = Experiment::STATUS.reject { |status| status == :running }
                               .map { |status| [replay.endings[status], 4, status] }
  (0..6).each { |rule| [true, false].each { |good| expected << [replay.results[[rule, good]], 25, "rule #{rule}: #{good}"] } }
  { integrating: 40, lag: 40, none: 10 }.each { |model, least| expected << [replay.models[model], least, model] }
  TraceReplay.too_few(expected)
end

if $PROGRAM_NAME == __FILE__
  replay = Replay.new
  $stdin.each_line { |line| replay.read(line) }
  puts(replay.endings.merge(replay.models).map { |what, count| "#{what} #{count}" })
  puts "#{replay.endings.values.sum} experiments, #{replay.lines} lines, #{replay.answers} results agree"
  abort "too few of #{complaints(replay).join(', ')}" unless complaints(replay).empty?
end

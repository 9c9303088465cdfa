# SPDX-License-Identifier: MIT
# The experiment, what it tells of the process and the gains once more, in integers
# and fractions without an end, written from the definition and not from src/. Reads
# what trace.c prints and says where the two differ.
#
# Names are the definition's: h what the noise asks for, w the wanted swing, W the
# swing, D a relay's two outputs apart, P and p the steps of a sum and those at high,
# A the area, M the mid, X the turn, k the slope, q how far two slopes are apart, r the
# part of the drive that the static gain has answered, c the delay.

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

  def above?(other)
    !(self - other).zero?
  end

  def integer(fraction)
    scaled = @value * 2**fraction
    scaled >= 2**31 ? 0xFFFFFFFF : (scaled + Rational(1, 2)).floor
  end

  # These are not the nearest to what they are called: the definition has them by
  # their 16 bits and an exponent.
  CALLED = { '4.608' => [37_748, -13], '9.462' => [38_757, -12], '4.627' => [37_905, -13], '4.382' => [35_898, -13],
             '5.488' => [44_957, -13], '1.188' => [38_935, -15], '6.815' => [55_829, -13], '11.667' => [47_790, -12],
             '1.193' => [39_086, -15] }.freeze

  CONSTANTS = Hash.new do |known, text|
    bits, exponent = CALLED[text]
    known[text] = bits ? cut(bits * Rational(2)**exponent) : nearest(text)
  end

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

  def lopsided?
    [on_steps, steps - on_steps].min < steps / 8
  end
end

# The experiment, step by step.
class Experiment
  STATUS = %i[refused running done no_oscillation saturated irregular too_fast too_small too_slow].freeze
  PHASES = %i[noise find centre first second third].freeze
  FIELDS = %i[min max rest least most swing timeout cycles reverse].freeze
  OVER = 6
  MOST_STEPS = 32_767
  MOST_TURN = 2047
  MOST_CYCLES = 48

  attr_reader :given, :status, :sums, :highest, :lowest, :noise, :edge

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
    @averaged = nil # cycles in the sums; nil: the first one, which never counts
    @elapsed = @period = @last_period = @seen = @noise = @edge = @centre = @half = @first_on = 0
    @highest = @lowest = 0
    @process = nil
  end

  # As it has ended.
  def ended(status, sums, values)
    @status = status
    @sums = sums
    @centre, @half, @last_period, @edge, @noise, @highest, @lowest = values
  end

  def step(setpoint, measurement)
    return 0 unless @legal

    watch(measurement) if running?
    if running?
      difference = reverse? ? setpoint - measurement : measurement - setpoint
      x = difference.clamp(-32_767, 32_767)
      @phase == :noise ? listen(x) : relay(x)
    end
    !running? || @phase == :noise ? @given[:rest] : level(@phase, @side)
  end

  # [phase, done, expected, period]
  def progress
    each = @given[:cycles] + 1
    expected = @legal ? 4 + 3 * each : 0
    return [OVER, expected, expected, @last_period] unless running?

    before = { noise: 0, find: 0, centre: 2, first: 4, second: 4 + each, third: 4 + 2 * each }
    [PHASES.index(@phase), before[@phase] + (@averaged ? @averaged + 1 : 0), expected, @last_period]
  end

  def h
    1 + (@noise + @noise / 2 + 16) / 32
  end

  def level(phase, side)
    return @given[side == :high ? :max : :min] if phase == :find

    down, up = { centre: [@half + @half / 2] * 2, second: [2 * @half, @half] }.fetch(phase, [@half, 2 * @half])
    (side == :high ? @centre + up : @centre - down).clamp(@given[:min], @given[:max])
  end

  def process
    @process ||= Identified.new(self)
  end

  # All but a refused one, and one that runs, can be packed.
  def packs?
    @legal && !running?
  end

  private

  def legal?
    g = @given
    g[:min] < g[:max] && g[:least] < g[:most] && (g[:min]..g[:max]).cover?(g[:rest]) &&
      (g[:swing].zero? || (8..16_383).cover?(g[:swing])) && (2..32_767).cover?(g[:timeout]) && (1..4).cover?(g[:cycles])
  end

  def running?
    @status == :running
  end

  def reverse?
    @given[:reverse] != 0
  end

  def watch(measurement)
    @status = :no_oscillation if @elapsed >= @given[:timeout]
    @status = :saturated if measurement <= @given[:least] || measurement >= @given[:most]
  end

  def listen(x)
    b = [(x - 2 * @highest + @lowest).abs, 1023].min
    @lowest = @highest
    @highest = x
    @elapsed += 1
    @noise += b if @elapsed > 2
    return unless @elapsed == 34

    @phase = :find
    @side = x <= 0 ? :high : :low
    @elapsed = 0
    @highest = @lowest = x
    @edge = wanted_edge
  end

  def w
    @given[:swing].zero? ? 24 * h : @given[:swing]
  end

  def wanted_edge
    [h, w / 8 + w / 16].max
  end

  def relay(x)
    @highest = [@highest, x].max
    @lowest = [@lowest, x].min
    count(x) unless @elapsed.zero?
    return @status = :too_slow if present.steps == MOST_STEPS

    turn(x)
    @elapsed += 1
    lose if running? && @phase != :find && @elapsed / 4 > @last_period
  end

  def present
    @sums[@phase == :second ? 1 : 0]
  end

  def clear_present
    @sums[@phase == :second ? 1 : 0] = Sums.none
  end

  def count(x)
    @period += 1
    return unless @averaged

    s = present
    s.all += x
    s.steps += 1
    if @side == :high
      s.on += x
      s.on_steps += 1
    end
    return unless @elapsed == 1

    t = x.clamp(-MOST_TURN, MOST_TURN)
    s.rise += @side == :high ? -t : t
  end

  def turn(x)
    if @side == :high
      switch(:low) if x > @edge
    elsif x < -@edge
      end_of_cycle
      switch(:high)
      @highest = @lowest = x if running?
    end
  end

  def switch(side)
    @side = side
    @elapsed = 0
  end

  def lose
    @sums[0] = Sums.none
    @phase = :find
    @averaged = nil
    @period = 0
    @elapsed = 1
    @seen += 8
  end

  def end_of_cycle
    before = @last_period
    @last_period = @period
    @period = 0
    @seen += 1
    if @seen >= MOST_CYCLES then @status = :irregular
    elsif @averaged.nil? then @averaged = 0
    elsif %i[find centre].include?(@phase) then approach
    elsif @phase == :third ? !same_load? : !alike?(before) then again
    else
      @averaged += 1
      next_phase if @averaged == @given[:cycles]
    end
  end

  def approach
    recentre
    @averaged = nil
    if @phase == :find
      @phase = :centre
    else
      @sums[0] = Sums.none
      @phase = :first
    end
  end

  def again
    @phase = :first if @phase == :third
    clear_present
    @averaged = 0
  end

  def next_phase
    @averaged = nil
    case @phase
    when :first
      @first_on = @sums[0].on_steps
      @sums[1] = Sums.none
      @phase = :second
    when :second then @phase = :third
    else same_sums? ? @status = verdict : again
    end
  end

  def alike?(before)
    (@last_period - before).abs <= @last_period / 8 + 1
  end

  def same_load?
    o = @given[:cycles] + @averaged
    on = @last_period - @elapsed
    (on * (o + 1) - @sums[0].on_steps).abs <= o * (@last_period / 32 + 1)
  end

  def same_sums?
    (@sums[0].on_steps - 2 * @first_on).abs <= @sums[0].steps / 128 + 2
  end

  def verdict
    return :irregular if @sums.any?(&:lopsided?)
    return :too_fast if @last_period < 10
    return :too_small if @highest - @lowest < 5 * h

    :done
  end

  def recentre
    low = level(@phase, :low)
    high = level(@phase, :high)
    drive = high - low
    over = [1, @highest - @lowest - 2 * @edge].max
    below = [0, -@lowest - @edge].max
    @centre = below >= over ? high : low + (drive * (256 * below / over) + 128) / 256
    @half = [2, amplitude(drive, over) * 85 / 256].max
  end

  def amplitude(drive, over)
    wanted = w < 2 * @edge ? @edge : w - @edge
    while wanted > over
      wanted /= 2
      drive *= 2
    end
    drive = [drive, 131_072].min
    drive = drive * (256 * wanted / over) / 256 if wanted < over
    [drive, @given[:max] - @given[:min]].min
  end
end

# What one relay tells, of the sums over n cycles.
class Relay
  attr_reader :low, :drive, :sums

  def initialize(sums, cycles, low, high)
    @sums = sums
    @n = cycles
    @low = low
    @drive = high - low
  end

  def whole?
    @sums.on_steps.positive? && @sums.on_steps < @sums.steps && area.positive?
  end

  # The mean deviation and the mean output in 1/256.
  def ybar
    sign * (256 * @sums.all.abs / @sums.steps)
  end

  def ubar
    256 * @low + 256 * @drive * @sums.on_steps / @sums.steps
  end

  # Of what lies below the mean while the output is high.
  def area
    sign * (@sums.all.abs * @sums.on_steps / @sums.steps) - @sums.on - (@sums.rise.abs / 2) * (@sums.rise <=> 0)
  end

  def mid
    @mid ||= Short.of(@sums.on_steps) * (@sums.steps - @sums.on_steps) / @sums.steps / @n
  end

  def turn
    @turn ||= Short.of(@sums.rise.abs) / (Short.of(@n) * @drive)
  end

  def upward_turn
    @sums.rise.negative? ? Short.of(0) : turn
  end

  def slope
    @slope ||= begin
      m2 = mid * mid
      j = Short.of(area) * 2 / @n / (Short.of(@drive) * m2)
      t = turn * turn / m2
      j + t / (j + t / j)
    end
  end

  private

  def sign
    @sums.all.negative? ? -1 : 1
  end
end

# The process, as an experiment that is done shows it, or the reason why it does not.
class Identified
  REASONS = %i[no_reason not_done not_legal shape two_processes runs_away gain_too_large gain_too_small].freeze

  attr_reader :reason, :flat, :level, :slope, :late, :bend

  def initialize(experiment)
    @experiment = experiment
    @reason = :not_done
    return unless experiment.status == :done

    cycles = experiment.given[:cycles]
    @cycles = cycles
    @relays = [relay(0, :first, 2 * cycles), relay(1, :second, cycles)]
    @reason = @relays.all?(&:whole?) ? identify : :shape
  end

  # T, or nothing if it integrates.
  def lag
    Short.of(1) / (@slope * @flat) unless integrating?
  end

  def integrating?
    @r.zero?
  end

  # The output that holds the setpoint.
  def holding
    output = @relays.sum { |relay| relay.ubar / 2 }
    off = @relays.sum { |relay| relay.ybar / 2 }
    output -= (off.negative? ? -1 : 1) * (@level * off.abs).integer(0) unless @level.zero?
    ((output + 128) / 256).clamp(@experiment.given[:min], @experiment.given[:max])
  end

  private

  def relay(number, phase, cycles)
    low, high = %i[low high].map { |side| @experiment.level(phase, side) }
    Relay.new(@experiment.sums[number], cycles, low, high)
  end

  def swing
    @experiment.highest - @experiment.lowest
  end

  def identify
    see_wave
    return :shape if !@round.above?('0.3') || @chi.above?('1.5')
    return :two_processes if @q.above?(Rational(1, 2))

    @r = Short.of(0)
    return :runs_away if see_gain == :runs_away

    limit_ratio
    decide_integrating
    make_process
    :no_reason
  end

  def see_wave
    first, second = @relays
    k0, k1 = @relays.map(&:slope)
    @k = (k0 + k1) / 2
    @m = (first.mid + second.mid) / 2
    @km = @k * @m
    @net = Short.of(1) + (Short.of(swing) - Short.of(3 * @experiment.noise / 4) / 16)
    @round = k0 * (first.mid * first.drive) / 2 / @net
    @chi = (first.upward_turn + second.upward_turn) / 2 / @km
    @q = ((k0 - k1) + (k1 - k0)) / @k
  end

  def see_gain
    dy = @relays[0].ybar - @relays[1].ybar
    @du = @relays[0].ubar - @relays[1].ubar
    return unless dy > 16 * swing

    @r = @km * (Short.of(@du.abs) / dy) / 2
    if @du <= 0
      return :runs_away if @r.above?('0.06')

      @r = Short.of(0)
    end
    @r = @r.most(Rational(63, 64))
  end

  def f
    @r * @r * (@r * '0.2' + '0.3') + Rational(1, 2)
  end

  def limit_ratio
    limit = @round * '1.1' + Short.of(1) / @m + @chi * '0.3'
    @r *= Rational(15, 16) while f.above?(limit) && @r.above?(Rational(1, 256))
  end

  # s is r less what the means leave open.
  def decide_integrating
    @s = @r
    unless @r.zero?
      open = Short.of(@relays.map(&:drive).max) * 64 * (Short.of(Rational(1, 32)) + Short.of(@cycles) / @relays[1].sums.steps)
      @s = @r * (Short.of(1) - open / @du)
    end
    @r = Short.of(0) unless @s.above?('0.03')
  end

  def psi
    Short.of(1) - @r * (@r * (@r * @r * (@r * '0.31') + '0.64') + '0.05')
  end

  def make_process
    @slope = @k / psi
    @flat = integrating? ? Short.of(0) : @s * 2 / @km
    @level = integrating? ? Short.of(0) : @r * 2 / @km
    @i = (Short.of(1) / @m).most(Rational(1, 4))
    @chi = @chi.most('0.75')
    @late = (integrating? ? delay_of_integrator : delay_of_lag) * @m
    @bend = @round - '0.53'
  end

  def delay_of_integrator
    v = (Short.of(@experiment.h) / @net).most(Rational(1, 4))
    l = Short.of('0.46') - @round
    e = @round.most('0.875') + v * '0.2' - '0.53'
    a = Short.of('4.608') + e * '26.16' + e * e * '22.4' + @chi * @chi * '9.462' + @i * '4.627' + @q * '1.16' + v * '0.216'
    b = @chi * '11.75' + e * @chi * '45.48' + l * '0.808'
    (a - b).least(l.zero? ? '0.6' : Short.of('1.2') + l * 4)
  end

  def delay_of_lag
    z = @round / f
    e = (z - '1.03').most('0.47')
    a = Short.of('3.204') + e * '4.382' + @chi * @chi * '5.488' + @i * '2.068' + @r * @r * '2.828' + @r * e * '28.086' +
        @r * @chi * '5.285' + @q * '1.188' + (Short.of('0.9') - z) * '2.272'
    b = @chi * '6.815' + e * @chi * '11.667' + @r * '1.193'
    (a - b).least('0.6')
  end
end

# Gains by a rule, and what is written of a process.
module Rules
  PI = 0
  PID = 1
  ENDLESS = 0xFFFFFFFF

  module_function

  # [1, gain, lag, delay, slope, holding, noise, hysteresis]
  def model(experiment)
    process = experiment.process
    return [0] * 8 unless process.reason == :no_reason

    slope = process.slope
    level = process.level
    lag = process.integrating? ? [ENDLESS] * 2 : [(Short.of(1) / level).integer(8), (Short.of(1) / (slope * level)).integer(4)]
    [1, *lag, process.late.integer(3), slope.integer(24), process.holding, (experiment.noise + 2) / 4, experiment.edge]
  end

  # [reason, kp, ki, kd, filter]
  def gains(experiment, rule, robustness)
    return [:not_done] unless experiment.status == :done
    return [:not_legal] unless [PI, PID].include?(rule) && (8..64).cover?(robustness)

    process = experiment.process
    return [process.reason] unless process.reason == :no_reason

    c = process.late * (Short.of(robustness + 18) / 32)
    rounded(*(rule == PI ? pi(process, c) : pid(process, c / 2)), rule)
  end

  # [kp, Ti, Td]
  def pi(process, c)
    ti = process.integrating? ? c * 4 : process.lag.most(c * 4)
    [Short.of(1) / (process.slope * c), ti, Short.of(0)]
  end

  def pid(process, l)
    kp = Short.of('0.45') / (process.slope * l)
    t = process.lag
    unless t
      z = process.bend.most('0.12')
      return [kp * (Short.of(1) + z * '10'), l * 8 / (Short.of(1) + z * '6'), l / 4]
    end
    [process.flat * '0.2' + kp, (l * '0.4' + t * '0.8') * l / (l + t * '0.1'), l * t / 4 / (l * '0.3' + t)]
  end

  # The derivative filter lags at most an eighth of Td; a PID's, twice that.
  def filter(lag, rule)
    n = (0..7).select { |places| places.zero? || 2**places <= lag }.max
    rule == PID ? [n + 1, 7].min : n
  end

  def rounded(proportional, reset, rate, rule)
    kp = proportional.integer(8)
    ki = (proportional / reset).integer(24)
    n = filter(rate.integer(0) / 8, rule)
    kd = (proportional * rate).integer(8 - n)
    return [:gain_too_large] if kp > 32_767 || ki > 0x7FFF0000 || kd > 32_255
    return [:gain_too_small] if ki < 8

    [:no_reason, kp, ki, kd, n]
  end
end

# Replays a trace (trace_lines.c) on a model and stops at the first line on which
# the two differ. A model says its FIELDS and STATUS; what it is asked in the end
# is the subclass's.
class TraceReplay
  attr_reader :lines, :endings, :results

  def initialize(model_class)
    @model_class = model_class
    @lines = 0
    @endings = Hash.new(0)
    @results = Hash.new(0)
  end

  def read(line)
    @lines += 1
    kind, *values = line.split
    return @input = values.first if kind == 'x'

    values.map!(&:to_i)
    expected, found = send(kind, values)
    return if expected == found

    puts "input #{@input}" if @input
    abort "line #{@lines}, #{line.chomp}: the model says #{expected.inspect}"
  end

  def i(values)
    @model = @model_class.new(values.first(@model_class::FIELDS.size))
    [@model.accepted? ? 1 : 0, values.last]
  end

  def n(values)
    @model.reset
    [status, values.last]
  end

  def s(values)
    output = @model.step(values[0], values[1])
    [[output, status], values.last(2)]
  end

  def status
    @model_class::STATUS.index(@model.status)
  end

  # [how often, at least, what] of what must have happened for the comparison to
  # mean anything: what did not.
  def self.too_few(expected)
    expected.select { |count, least,| count < least }.map { |count, least, what| "#{what} (#{count}, not #{least})" }
  end
end

class Replay < TraceReplay
  attr_reader :reasons, :processes, :answers

  def initialize
    super(Experiment)
    @answers = 0
    @processes = Hash.new(0)
    @reasons = Hash.new(0)
  end

  def s(values)
    output = @model.step(values[0], values[1])
    [[output, status, *@model.progress], values.drop(2)]
  end

  # The model goes on as it was: so must what came back from a record.
  def u(values)
    packs = @model.packs? ? 1 : 0
    @endings[@model.status] += 1
    [[packs, 0, packs, status, *@model.progress], values]
  end

  def m(values)
    expected = Rules.model(@model)
    @processes[expected[1] == Rules::ENDLESS ? :integrating : :lag] += 1 if expected[0] == 1
    [expected, values.map.with_index { |value, at| at == 5 ? value : value % 2**32 }]
  end

  def r(values)
    rule, robustness, *found = values
    before = found[6] / 256
    reason, *gains = Rules.gains(@model, rule, robustness)
    @answers += 1
    @reasons[reason] += 1
    good = reason == :no_reason
    @results[rule] += 1 if good
    written = good ? [1, *gains, 256, before * 256 + (before & ~0x20)] : [0, 0, 0, 0, 0, 128, before * 257]
    [[*written, Identified::REASONS.index(reason)], found]
  end
end

# What must have happened, and how often, for the comparison to mean anything.
def complaints(replay)
  expected = Experiment::STATUS.reject { |status| status == :running }
                               .map { |status| [replay.endings[status], 4, status] }
  Identified::REASONS.each { |reason| expected << [replay.reasons[reason], 10, reason] }
  [Rules::PI, Rules::PID].each { |rule| expected << [replay.results[rule], 100, "gains by rule #{rule}"] }
  %i[integrating lag].each { |process| expected << [replay.processes[process], 40, process] }
  TraceReplay.too_few(expected)
end

if $PROGRAM_NAME == __FILE__
  replay = Replay.new
  $stdin.each_line { |line| replay.read(line) }
  puts(replay.endings.merge(replay.processes, replay.reasons).map { |what, count| "#{what} #{count}" })
  puts "#{replay.endings.values.sum} experiments, #{replay.lines} lines, #{replay.answers} results agree"
  abort "too few of #{complaints(replay).join(', ')}" unless complaints(replay).empty?
end

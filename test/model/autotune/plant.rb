# SPDX-License-Identifier: MIT
# The plant of the recorded experiments once more, in integers without an end.
class Plant
  LAGS_MAX = 8

  # The values of a row, by the names of its columns.
  def initialize(values, resting)
    values.each { |name, value| instance_variable_set("@#{name}", value) }
    @random = @seed
    @slack = resting
    @line = [@start] * @delay
    @x = [@start << 16] * (LAGS_MAX + 1)
    @position = @start << 16
    @steps = @speed = @integral = 0
  end

  def measure
    level = @integrating.zero? ? last_level * @gain_q16 : @integral
    (@base + (level >> 32) + draw).clamp(0, @full_scale)
  end

  def move(output)
    @steps += 1
    input = through_delay(pushed(output)) << 16
    input = swung(input) unless @spring_q16.zero?
    @x[0] = input
    input = lagged(input)
    integrate(input) unless @integrating.zero?
  end

  private

  def draw
    @random = (@random * 1_664_525 + 1_013_904_223) % 2**32
    (((@random >> 16) * (2 * @noise + 1)) >> 16) - @noise
  end

  def given_on(lag, input)
    lag > @lags - @leads ? @x[lag] + ((input - @x[lag]) * @lead_q16 >> 16) : @x[lag]
  end

  def last_level
    (1..@lags).inject(@x[0]) { |input, lag| given_on(lag, input) }
  end

  def pushed(output)
    @slack = @slack.clamp(output - @backlash, output + @backlash)
    @slack + @load + (@steps > @step_at ? @step_by : 0) + ([@steps, @drift_steps].min * @drift_q16 >> 16)
  end

  def through_delay(input)
    @line.push(input)
    @line.shift
  end

  def swung(input)
    @speed += ((input - @position) * @spring_q16 >> 16) - (@speed * @damp_q16 >> 16)
    @position += @speed
  end

  def lagged(input)
    pole = @pole_q16
    (1..@lags).inject(input) do |given, lag|
      falls = lag == 1 && @fall_q16 != 0 && given < @x[lag]
      @x[lag] += (given - @x[lag]) * (falls ? @fall_q16 : pole) >> 16
      pole = (pole * @ratio_q8 >> 8).clamp(1, 65_536)
      given_on(lag, given)
    end
  end

  def integrate(input)
    moved = @integral + input.clamp(-2**40, 2**40) * @gain_q16 + (@integral >> 16) * @growth_q16
    @integral = moved.clamp(-2**47, 2**47)
  end
end

# SPDX-License-Identifier: MIT
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

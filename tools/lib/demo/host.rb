# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# A recorded run: rows of numbers with named columns, the first of which is the
# time: from 0, in even steps, to `last` at least. Whatever else stands there is a
# failure, and so is a question about a time of which rows are missing.
class Trace
  attr_reader :path

  def initialize(path, last = 0.0)
    @path = path
    head, *lines = File.readlines(path, chomp: true)
    @names = head.to_s.split(',')
    @rows = lines.each_with_index.map { |line, i| numbers(line, i + 2) }
    @rows.empty? and raise Host::Failure, "#{path} has no rows"
    check_times(last)
  end

  # The values of a column while from <= time < to; at least one.
  def values(name, from = -Float::INFINITY, to = Float::INFINITY)
    column = @names.index(name) or raise Host::Failure, "no column #{name}"
    rows = @rows.select { |row| row[0] >= from && row[0] < to }
    rows.empty? || (to.finite? && to > @rows.last[0] + 1.5 * @period) and
      raise Host::Failure, "#{path} has no rows from #{from} to #{to}"
    rows.map { |row| row[column] }
  end

  def times(from = -Float::INFINITY, to = Float::INFINITY)
    values('time_s', from, to)
  end

  # Largest magnitude of a column.
  def peak(name, from = -Float::INFINITY, to = Float::INFINITY)
    values(name, from, to).map(&:abs).max
  end

  def mean(name, from, to)
    found = values(name, from, to)
    found.sum / found.size
  end

  # Largest minus smallest.
  def swing(name, from, to)
    low, high = values(name, from, to).minmax
    high - low
  end

  # Seconds after `from` when the column was last more than `band` from
  # `target`; 0 if it never was.
  def settling(name, target, band, from = 0.0, to = Float::INFINITY)
    outside = times(from, to).zip(values(name, from, to))
                             .select { |_, v| (v - target).abs > band }
    outside.empty? ? 0.0 : outside.last[0] - from
  end

  # Changes of sign, zeros ignored.
  def reversals(name, from, to)
    signs = values(name, from, to).map { |v| v <=> 0.0 }.reject(&:zero?)
    signs.each_cons(2).count { |a, b| a != b }
  end

  private

  def check_times(last)
    times = @rows.map(&:first)
    @period = times.last / [times.size - 1, 1].max
    late = times.each_with_index.find { |time, row| (time - row * @period).abs > 0.01 * @period + 1e-6 }
    late and raise Host::Failure, "#{path} misses a row before #{late.first}"
    times.last + 0.5 * @period < last and raise Host::Failure, "#{path} ends at #{times.last}, not at #{last}"
  end

  def numbers(line, number)
    cells = line.split(',', -1)
    found = cells.map { |cell| Float(cell, exception: false) }
    return found if found.all? && cells.size == @names.size

    raise Host::Failure, "#{path}, line #{number}: not #{@names.size} " \
                         "numbers: #{line}"
  end
end

# The built examples and the programs that draw.
module Host
  class Failure < StandardError; end

  class << self
    attr_reader :root, :folder

    def setup(root)
      @root = root
      build = "#{root}/build/host-examples"
      @programs = "#{build}/examples"
      @comparisons = "#{build}/sim"
      @folder = "#{root}/build/demo"
    end

    # Runs a program to its end; none is left behind when we are stopped.
    def execute(environment, *command)
      pid = Process.spawn(environment, *command)
      _, status = Process.wait2(pid)
      pid = nil
      status.success? or raise Failure, "#{File.basename(command[0])} failed"
    ensure
      stop(pid) if pid
    end

    # A run of an example, recorded as build/demo/<name>.csv.
    def run(program, name, every: nil, **scenario)
      csv = "#{folder}/#{name}.csv"
      options = ['--csv', csv]
      options += ['--every', every.to_s] if every
      scenario.each { |key, value| options += ['--set', "#{key}=#{value}"] }
      execute({}, "#{@programs}/#{program}", *options,
              { out: "#{folder}/#{name}.txt" })
      Trace.new(csv, seconds(program, scenario))
    end

    # How long a scenario lasts: as it says, or as the program does.
    def seconds(program, scenario)
      scenario.fetch(:seconds) do
        help = IO.popen(["#{@programs}/#{program}", '--help'], &:read)
        Float(help[/^ +seconds +.*\((\S+)\)$/, 1] || raise(Failure, "#{program} does not say how long it runs"))
      end
    end

    # What the program of the run `name` printed.
    def printed(name)
      File.read("#{folder}/#{name}.txt")
    end

    # What a recipe prints, kept as build/demo/<name>; its path.
    def recipe(program, name)
      path = "#{folder}/#{name}"
      execute({}, "#{@programs}/recipe_#{program}", { out: path })
      path
    end

    # What a program prints, kept as build/demo/<name>; its path.
    def print(program, name, *arguments)
      path = "#{folder}/#{name}"
      execute({}, "#{@comparisons}/#{program}", *arguments, { out: path })
      path
    end

    private

    def stop(pid)
      Process.kill('TERM', pid)
      Process.wait(pid)
    rescue SystemCallError
      nil # it has ended by itself
    end
  end
end

# How far two runs of the same length are apart, up to a time.
def largest_difference(one, other, column, to = Float::INFINITY)
  values = [one, other].map { |run| run.values(column, 0.0, to) }
  values[0].size == values[1].size or
    raise Host::Failure, "#{one.path} and #{other.path} differ in length"
  values.transpose.map { |a, b| (a - b).abs }.max
end

# A range for gnuplot that holds these columns and leaves room for the key.
def range_with_headroom(run, columns, from, to)
  low, high = columns.flat_map { |name| run.values(name, from, to) }.minmax
  room = high - low
  "set yrange [#{(low - 0.05 * room).round}:#{(high + 0.35 * room).round}]"
end

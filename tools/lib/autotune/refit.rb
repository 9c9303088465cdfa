# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The regression behind the delay's constants: refit.rb PROGRAM SEED PLANTS. The
# program prints the features of each experiment and the delay that would have been
# right. A delay above it makes a calmer loop, so the fit is no mean: it is above the
# right one for a share of the plants.
require_relative 'constants'

# Of one experiment.
class Features
  NUMBERS = %i[middle ratio roundness skew quarrel noise wanted].freeze
  attr_reader :family, *NUMBERS

  def initialize(cells)
    @family = cells.fetch('family')
    @refused = cells.fetch('refused') == '1'
    @lag = cells.fetch('lag') == '1'
    NUMBERS.each { |name| instance_variable_set("@#{name}", Float(cells.fetch(name.to_s))) }
  end

  # What the rules serve, and what is not two processes or an unstable one.
  def fits?
    !@refused && wanted < 9 && !%w[unstable heater].include?(family)
  end

  def lag?
    @lag
  end

  # There are few of them, and they are the hardest.
  def weight
    family == 'oscillatory' ? 10.0 : 1.0
  end

  def step
    [1.0 / middle, 0.25].min
  end

  def chi
    [skew, 0.75].min
  end
end

def above(value, least)
  [value - least, 0.0].max
end

# A polynomial of c / M: its terms, and what the library has for them.
Shape = Struct.new(:name, :share, :constants, :terms)

SHAPES = {
  false => Shape.new(
    'integrating', 0.92,
    { '1' => 4.608, 'E' => 26.16, 'E E' => 22.4, 'CHI' => -11.75, 'CHI CHI' => 9.462, 'E CHI' => -45.48, 'I' => 4.627,
      'Q' => 1.16, 'FLATTER' => -0.808, 'V' => 0.216 },
    lambda do |one|
      e = above([one.roundness, 0.875].min + 0.2 * one.noise, 0.53)
      [1.0, e, e * e, one.chi, one.chi**2, e * one.chi, one.step, one.quarrel, above(0.46, one.roundness), one.noise]
    end
  ),
  true => Shape.new(
    'lag', 0.93,
    { '1' => 3.204, 'E' => 4.382, 'CHI' => -6.815, 'CHI CHI' => 5.488, 'E CHI' => -11.667, 'I' => 2.068, 'R' => -1.193,
      'R R' => 2.828, 'R E' => 28.086, 'R CHI' => 5.285, 'Q' => 1.188, 'FLATTER' => 2.272 },
    lambda do |one|
      r = one.ratio
      z = one.roundness / (0.5 + r * r * (0.3 + 0.2 * r))
      e = [above(z, 1.03), 0.47].min
      [1.0, e, one.chi, one.chi**2, e * one.chi, one.step, r, r * r, r * e, r * one.chi, one.quarrel, above(0.9, z)]
    end
  )
}.freeze

# Weighted least squares, and quantiles by repeating them: a row that lies below the
# line gets another weight than one above.
module Quantile
  ROUNDS = 60
  NEAREST = 0.005 # a row on the line must not get all of the weight
  RIDGE = 1e-4

  module_function

  # The line that has `share` of the ones below it: rows * result is 1 or more for
  # them.
  def line(rows, weights, share)
    line = solve(*normal(rows, weights))
    ROUNDS.times do
      now = rows.each_with_index.map do |row, i|
        left = 1.0 - dot(row, line)
        weights[i] * (left.positive? ? share : 1.0 - share) / [left.abs, NEAREST].max
      end
      line = solve(*normal(rows, now, RIDGE))
    end
    line
  end

  def dot(one, other)
    sum = 0.0
    one.each_with_index { |value, i| sum += value * other[i] }
    sum
  end

  # Gram's matrix with a little more on its diagonal, and the right side.
  def normal(rows, weights, ridge = 0.0)
    size = rows.first.size
    matrix = Array.new(size) { |i| Array.new(size) { |j| i == j ? ridge : 0.0 } }
    side = Array.new(size, 0.0)
    rows.each_with_index { |row, at| add(matrix, side, row, weights[at]) }
    size.times { |i| i.times { |j| matrix[i][j] = matrix[j][i] } }
    [matrix, side]
  end

  def add(matrix, side, row, weight)
    row.each_with_index do |value, i|
      value *= weight
      side[i] += value
      line = matrix[i]
      i.upto(row.size - 1) { |j| line[j] += value * row[j] }
    end
  end

  # Gauss, with the largest pivot of each column.
  def solve(matrix, side)
    rows = matrix.each_with_index.map { |row, i| [*row, side[i]] }
    rows.size.times { |column| eliminate(rows, column) }
    rows.each_index.reverse_each.with_object([]) do |i, found|
      known = found.each_with_index.sum(0.0) { |value, j| rows[i][i + 1 + j] * value }
      found.unshift((rows[i].last - known) / rows[i][i])
    end
  end

  def eliminate(rows, column)
    best = (column...rows.size).max_by { |i| rows[i][column].abs }
    rows[column], rows[best] = rows[best], rows[column]
    (column + 1...rows.size).each do |i|
      factor = rows[i][column] / rows[column][column]
      (column..rows.size).each { |j| rows[i][j] -= factor * rows[column][j] }
    end
  end
end

def read(program, seed, plants)
  head, *lines = IO.popen([program, 'features', seed, plants], &:readlines).map { |line| line.chomp.split(';') }
  $?.success? or abort "refit: #{program} failed"
  lines.map { |cells| Features.new(head.zip(cells).to_h) }
end

# Each is what constants.rb has, but for its sign.
def check(shape)
  shape.constants.each_value do |value|
    AutotuneConstants::ALL.key?(value.abs.to_s.to_r) or abort "refit: constants.rb has no #{value.abs}"
  end
end

# Of these plants, percent whose loop has at most the wanted Ms.
def served(shape, plants, line)
  good = plants.count { |one| Quantile.dot(shape.terms.call(one), line) >= one.wanted }
  100.0 * good / plants.size
end

LEAST = 100 # plants of a half

def line_of(shape, plants)
  rows = plants.map { |one| shape.terms.call(one).map { |term| term / one.wanted } }
  Quantile.line(rows, plants.map(&:weight), shape.share)
end

# The halves tell how well a constant is known.
def report(shape, halves)
  halves.map(&:size).min < LEAST and abort "refit: too few plants to fit #{shape.constants.size} constants"
  lines = [shape.constants.values, *halves.map { |half| line_of(shape, half) }]
  puts "#{shape.name}, two halves of #{halves.map(&:size).join(' and ')} plants:",
       '  term        library   of one half   of the other'
  shape.constants.keys.zip(*lines) { |name, *values| puts format('  %-9s %9.3f     %9.3f      %9.3f', name, *values) }
  ours = halves.map { |half| served(shape, half, lines[0]) }
  theirs = [served(shape, halves[0], lines[2]), served(shape, halves[1], lines[1])]
  puts format('  Ms at most 1.6, library: %.1f %% of one half and %.1f %% of the other', *ours),
       format('  refitted to the half that is not counted: %.1f %% and %.1f %%', *theirs), ''
end

def main(program, seed, plants)
  halves = read(program, seed, plants).partition.with_index { |_, i| i.even? }
  SHAPES.each do |lag, shape|
    check(shape)
    report(shape, halves.map { |half| half.select { |one| one.fits? && one.lag? == lag } })
  end
end

main(*ARGV) if $PROGRAM_NAME == __FILE__

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'limit'
require_relative 'tables'

# The promises. Those of single figures are in limits.csv, a line each: the row
# (Subject#key, or a function, chip and build), the figure in the words below, its
# limit, and, if that is more than 3 % above the figure, the reason. Each row of the
# steps has one of its bound and one of its flash.
#
# `tools/cost --tighten` lowers them and adds what is missing; only
# `tools/cost --loosen WORD...` raises any.
class Limits
  FILE = 'tools/lib/measure/limits.csv'
  HEAD = %w[row figure limit reason].freeze
  WORDS = { 'worst found' => :most, 'bound' => :bound, 'flash of the step' => :step_flash, 'flash with init' => :needed,
            'flash as linked' => :linked, 'variables of the step' => :step_variables, 'RAM in all' => :ram,
            'flash' => :flash, 'RAM each' => :instance }.freeze
  OF_EACH_ROW = ['bound', 'flash with init'].freeze
  ROOM = 0.01 # above the figure, of a limit that is tightened

  BOUND_MOST = 1.07
  # Of the worst found by that of the straightforward form, with the reason.
  RATIOS = { 'ATmega328P' => [1.00, 'never slower'], 'Cortex-M0' => [1.25, 'what an 8-bit form may cost there'],
             'Cortex-M4' => [1.25, 'what an 8-bit form may cost there'] }.freeze

  # A line of the file, the subject that it is of, and its figure now.
  Line = Struct.new(:row, :figure, :most, :reason, :subject, :now, keyword_init: true) do
    def limit
      Limit.new("#{row}, #{figure}", most, now, unit, reason)
    end

    # What it would be if it were new.
    def tight
      (now * (1 + ROOM)).floor
    end

    def cells
      [row, figure, most, reason]
    end

    private

    def unit
      return subject.chip.cost if ['worst found', 'bound'].include?(figure)

      figure.start_with?('flash') ? subject.chip.flash : 'bytes'
    end
  end

  # What was measured: { subject => figures }, { subject => { function => figures } } and
  # { subject => the worst of its straightforward form }. Those of `left_out` are as documented,
  # and not judged: the largest bound among them stands beside the others.
  def initialize(measured, called, plain_c, path = "#{Host.root}/#{FILE}", left_out: [])
    @rows = rows(measured, called)
    @measured = measured
    @plain_c = plain_c
    @path = path
    @left_out = left_out
    @lines = read.reject { |line| left_out.include?(line.subject) }
  end

  def all
    @lines.map(&:limit) + missing.map { |line| Limit.new("#{line.row}, #{line.figure}, of which there is no limit", 0, line.now, '') } +
      bounds + ratios(@plain_c.reject { |subject, _| @left_out.include?(subject) })
  end

  # Those that are not in the file.
  def others
    bounds + ratios(@plain_c)
  end

  # Lowers what is too high, unless there is a reason for it.
  def tighten
    lowered = @lines.select { |line| line.reason.empty? && line.limit.kept? && line.tight < line.most }
    lowered.each { |line| line.most = line.tight }
    added = missing.each { |line| line.most = line.tight }
    write(@lines + added)
    (lowered + added).map { |line| "#{line.row}, #{line.figure}: #{line.most}" }
  end

  # Raises what is exceeded, of the subjects that match the words.
  def loosen(words)
    raised = @lines.reject { |line| line.limit.kept? }.select { |line| line.subject.matches?(words) }
    raised.each { |line| line.most = line.now }
    write(@lines)
    raised.map { |line| "#{line.row}, #{line.figure}: #{line.most}" }
  end

  private

  # { name => [subject, figures] }
  def rows(measured, called)
    functions = called.flat_map do |subject, all|
      all.map { |name, figures| ["#{name}-#{subject.chip.name}-#{subject.build.delete('-')}", [subject, figures]] }
    end
    measured.to_h { |subject, figures| [subject.key, [subject, figures]] }.merge(functions.to_h)
  end

  def read
    head, *lines = File.readlines(@path, chomp: true).map { |line| line.split(',', 4) }
    raise Host::Failure, "#{FILE}:1: the columns are not #{HEAD.join(', ')}" if head != HEAD

    lines.each_with_index.map { |cells, at| line(cells, "#{FILE}:#{at + 2}") }
  end

  def line((row, figure, most, reason), place)
    subject, figures = @rows[row]
    raise Host::Failure, "#{place}: no row is called #{row}" unless subject
    raise Host::Failure, "#{place}: no figure is called #{figure}" unless WORDS.key?(figure)
    raise Host::Failure, "#{place}: #{most} is no limit" unless most&.match?(/\A\d+\z/)

    Line.new(row: row, figure: figure, most: most.to_i, reason: reason.to_s, subject: subject, now: figure_of(figures, figure))
  end

  def figure_of(figures, word)
    name = WORDS.fetch(word)
    name == :ram ? figures.instance + figures.fixed : figures[name]
  end

  def missing
    there = @lines.map { |line| [line.row, line.figure] }
    wanted = (@measured.keys - @left_out).map(&:key).product(OF_EACH_ROW) - there
    wanted.map do |row, figure|
      subject, figures = @rows[row]
      Line.new(row: row, figure: figure, reason: '', subject: subject, now: figure_of(figures, figure))
    end
  end

  # In the order of the tables.
  def write(lines)
    places = @rows.keys
    sorted = lines.sort_by { |line| [places.index(line.row), WORDS.keys.index(line.figure)] }
    File.write("#{@path}.new", [HEAD, *sorted.map(&:cells)].map { |cells| "#{cells.join(',')}\n" }.join)
    File.rename("#{@path}.new", @path)
  end

  # Of the worst found; the largest is in the table of limits. What plain
  # questions find is no measure of the code's longest path. Nor is the bound of
  # an ATtiny85, whose library turns 8 times for a weight and 16 times for a gain.
  def bounds
    subject, figures = @measured.reject { |one, _| one.controller.id == 'pid_plain' || one.chip.name == 'attiny85' }
                                .max_by { |_, one| one.bound.fdiv(one.most) }
    [Limit.new("bound by worst found, largest: #{subject}", BOUND_MOST, figures.bound.fdiv(figures.most))]
  end

  def ratios(worst_of)
    worst_of.map do |subject, worst|
      most, reason = RATIOS.fetch(subject.chip.title)
      Limit.new("#{subject}, by the straightforward form", most, @measured.fetch(subject).most.fdiv(worst).round(2), nil, reason)
    end
  end
end

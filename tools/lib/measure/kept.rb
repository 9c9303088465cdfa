# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'host'
require_relative 'subjects'

# The sequences of steps that are kept, with which the search for the worst step
# begins: test/tools/cost/kept/CONTROLLER.csv. Each line is a step of the row of the
# table that the first column names (Subject#key), the lines of one row are a
# sequence, and a cell is empty if the step does not read that number.
class Kept
  FOLDER = 'test/tools/cost/kept'
  FIRST = %w[row times calls].freeze # columns

  class << self
    # The C file with all of them: `kept_sequences` of sequence.h.
    def table(folder = FOLDER)
      "#include <stddef.h>\n#include \"sequence.h\"\n" \
        "const struct kept kept_sequences[] = {\n#{all(folder).map(&:entries).join}{NULL, NULL, {.count = 0}},\n};\n"
    end

    def all(folder = FOLDER)
      folder = File.expand_path(folder, Host.root)
      names = CONTROLLERS.map(&:name).uniq
      missing = names.reject { |name| File.exist?("#{folder}/#{name}.csv") }
      raise Host::Failure, "#{folder} has no #{missing.join(', ')}" if missing.any?

      names.map { |name| new(name, "#{folder}/#{name}.csv") }
    end

    # The sequence that a run has printed, as lines of cells by column.
    def printed(text)
      text.scan(/^step (.*)$/).map do |(words)|
        words.split.each_slice(2).to_h.transform_values { |value| value.tr(',', ' ') }
      end
    end
  end

  attr_reader :name

  def initialize(name, path)
    @name = name
    @path = path
    @head, *lines = File.readlines(path, chomp: true).map { |line| line.split(',', -1) }
    fail_at(1, "the first columns are not #{FIRST.join(', ')}") unless @head&.take(3) == FIRST
    @sequences = {}
    lines.each_with_index { |cells, at| read(cells, at + 2) }
  end

  # Each sequence is there once, with all rows that it is of.
  def entries
    @sequences.group_by(&:last).map do |steps, rows|
      names = rows.map { |row, _| "\"#{row}\", " }.join
      "{\"#{@name}\", (const char *const[]){#{names}NULL},\n" \
        "{.segments = {#{steps.map { |step| segment(step) }.join(', ')}}, .count = #{steps.size}}},\n"
    end
  end

  def replace(row, steps)
    unknown = steps.flat_map(&:keys).uniq - @head
    raise Host::Failure, "#{@path} has no column #{unknown.join(', ')}" if unknown.any?

    @sequences[row] = steps.map { |step| @head.drop(1).to_h { |column| [column, step.fetch(column, '')] } }
  end

  # In the order of the table.
  def write
    places = Subject.with_plain_c.map(&:key)
    lines = @sequences.sort_by { |row, _| places.index(row) }.flat_map do |row, steps|
      steps.map { |step| [row, *@head.drop(1).map { |column| step[column] }] }
    end
    File.write("#{@path}.new", [@head, *lines].map { |cells| "#{cells.join(',')}\n" }.join)
    File.rename("#{@path}.new", @path)
  end

  private

  def fail_at(line, why)
    raise Host::Failure, "#{@path.delete_prefix("#{Host.root}/")}:#{line}: #{why}"
  end

  def read(cells, line)
    fail_at(line, "#{cells.size} cells, not #{@head.size}") if cells.size != @head.size
    step = @head.zip(cells).to_h
    row = step.delete('row')
    fail_at(line, "no row is called #{row}") unless rows.include?(row)
    wrong = step.find { |column, cell| !cell.match?(column == 'calls' ? /\A[a-z_ ]*\z/ : /\A(-?\d+)?\z/) }
    fail_at(line, "#{wrong.first} is #{wrong.last}") if wrong
    add(row, step, line)
  end

  def add(row, step, line)
    fail_at(line, "#{row} stands in two places") if @sequences.key?(row) && row != @last
    first = !@sequences.key?(row)
    fail_at(line, "init is not the first step's call and no other's") if first != step['calls'].split.include?('init')
    (@sequences[row] ||= []) << step
    fail_at(line, "#{row} has more steps than #{SEGMENTS_MOST}") if @sequences[row].size > SEGMENTS_MOST
    @last = row
  end

  SEGMENTS_MOST = 6 # SEGMENTS_MAX of sequence.h

  def rows
    @rows ||= Subject.with_plain_c.select { |one| one.controller.name == @name }.map(&:key)
  end

  # What the compiler does not know of, it refuses.
  def segment(step)
    calls = step['calls'].split.map { |call| " | CALL_#{call.upcase}" }.join
    numbers = step.reject { |column, cell| FIRST.include?(column) || cell.empty? }.map { |column, cell| ", .#{column} = #{cell}" }
    "{.question = {.#{@name} = {.calls = 0u#{calls}#{numbers.join}}}, .times = #{step['times']}}"
  end
end

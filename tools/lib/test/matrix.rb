# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Runs the rows that test/matrix.txt has of a runner, in a folder of their own each:
#
#   ruby tools/lib/test/matrix.rb RUNNER [NAME]...    as `RUNNER [NAME]...` says
#
# The table says how it is read.
require 'fileutils'
require 'open3'
require_relative 'named'

Encoding.default_external = 'UTF-8'

# The tests of a runner.
class Matrix
  TABLE = 'test/matrix.txt'
  WHEN = %w[daily weekly].freeze
  CHOICE = /(?<!\$)\{(?! )([^{}]*;[^{}]*)\}/.freeze
  PRELUDE = %w[tools/lib/setup.sh tools/lib/build/sdcc.sh tools/lib/test/runs.sh tools/lib/test/compilers.sh].freeze

  Row = Struct.new(:runner, :name, :when, :compilers, :steps)

  # All rows of the table; what it says twice or in another way ends the run.
  def self.rows(lines = File.readlines(TABLE, chomp: true))
    runner = nil
    sets = {}
    lines.each_with_object([]) do |line, rows|
      case line
      when /\A(#|\z)/ then next
      when /\A +/ then rows.last.last.steps.concat(choices(line.strip))
      when /\Alet (\S+) (.*)/ then sets[Regexp.last_match(1)] = Regexp.last_match(2).split
      when %r{\A\S+/\S+\z} then runner = line
      else rows << row_of(runner, *line.split.flat_map { |word| sets.fetch(word, [word]) })
      end
    end.flatten.each { |row| row.steps.empty? and abort "#{TABLE}: #{row.name} has no step" }
  end

  # Of `NAME_* daily A B weekly C` a row for each of A, B and C, which share their steps.
  def self.row_of(runner, name, *words)
    WHEN.include?(words.first) or abort "#{TABLE}: #{name}: daily or weekly?"
    steps = []
    words.slice_before { |word| WHEN.include?(word) }.flat_map do |time, *compilers|
      next [Row.new(runner, name, time, compilers, steps)] unless name.end_with?('*')

      compilers.map { |compiler| Row.new(runner, name.sub('*', compiler), time, [compiler], steps) }
    end
  end

  # A line for each of the words between { and }, of all such places.
  def self.choices(line)
    found = CHOICE.match(line) or return [line]
    found[1].split(';').flat_map { |word| choices("#{found.pre_match}#{word}#{found.post_match}") }
  end

  def initialize(runner)
    @folder = File.dirname(runner)
    @work = "#{Dir.pwd}/build/#{File.basename(@folder)}"
    @tests = NamedTests.new(runner)
    Matrix.rows.select { |row| row.runner == runner }.each do |row|
      @tests.add(row.name, *row.compilers, row.when) { attempt(row) }
    end
  end

  def run(arguments)
    @tests.run(arguments)
  end

  private

  def attempt(row)
    folder = "#{@work}/#{row.name}"
    FileUtils.rm_rf(folder)
    FileUtils.mkdir_p(folder)
    File.write("#{folder}.sh", script(row))
    output, status = Open3.capture2e('sh', "#{folder}.sh", chdir: folder, stdin_data: '')
    File.write("#{folder}.log", output)
    raise output unless status.success?
  end

  def script(row)
    sources = (PRELUDE + ["#{@folder}/steps.sh"]).map { |path| ". '#{Dir.pwd}/#{path}'" }
    steps = row.compilers.empty? ? row.steps : row.compilers.flat_map { |compiler| ["CC=#{compiler}", *row.steps] }
    ['set -e', "root='#{Dir.pwd}' here='#{Dir.pwd}/#{@folder}' work='#{@work}' test=#{row.name}", *sources, *steps, ''].join("\n")
  end
end

exit Matrix.new(ARGV.shift).run(ARGV) if $PROGRAM_NAME == __FILE__

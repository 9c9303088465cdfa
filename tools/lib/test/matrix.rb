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
  PRELUDE = %w[tools/lib/setup.sh tools/lib/build/sdcc.sh tools/lib/build/gpsim.sh tools/lib/test/runs.sh
               tools/lib/test/compilers.sh].freeze

  Row = Struct.new(:name, :when, :compilers, :steps)

  # [what comes before all tests of the runner, its rows]
  def self.read(runner)
    text = File.read(TABLE)
    sets = text.scan(/^let (\S+) (.*)/).to_h { |name, words| [name, words.split] }
    section = text[%r{^#{runner}$.*?(?=^\S+/\S+$|\z)}m] or abort "#{TABLE}: nothing of #{runner}"
    lines = section.lines(chomp: true).drop(1).grep_v(/\A(#|\z)/)
    before = lines.take_while { |line| line.start_with?(' ') }
    [before, lines.drop(before.size).slice_before(/\A\S/).flat_map do |head, *steps|
      rows_of(steps.flat_map { |line| choices(line.strip) }, *head.split.flat_map { |word| sets.fetch(word, [word]) })
    end]
  end

  # Of `NAME_* daily A B weekly C` a row for each of A, B and C.
  def self.rows_of(steps, name, *words)
    WHEN.include?(words.first) && !steps.empty? or abort "#{TABLE}: #{name}: when, and what?"
    words.slice_before { |word| WHEN.include?(word) }.flat_map do |time, *compilers|
      next [Row.new(name, time, compilers, steps)] unless name.end_with?('*')

      compilers.map { |compiler| Row.new(name.sub('*', compiler), time, [compiler], steps) }
    end
  end

  # A line for each of the words between { and }, of all such places.
  def self.choices(line)
    found = CHOICE.match(line) or return [line]
    found[1].split(';').flat_map { |word| choices("#{found.pre_match}#{word}#{found.post_match}") }
  end

  def initialize(runner)
    @runner = runner
    @folder = File.dirname(runner)
    @work = "#{Dir.pwd}/build/#{File.basename(@folder)}"
    @before, rows = Matrix.read(runner)
    @tests = NamedTests.new(runner, *ENV['AT_A_TIME']&.to_i)
    rows.each { |row| @tests.add(row.name, *row.compilers, row.when) { attempt(row) } }
  end

  # What comes before all tests has exported what they need when this runs again.
  def run(arguments)
    return @tests.run(arguments) if ENV['MATRIX_READY'] || %w[--list --help -h].include?(arguments.first)

    script = [*prelude, "work_folder '#{@work}' 200", *@before.map(&:strip), 'export MATRIX_READY=yes', 'exec ruby "$0" "$@"']
    exec('sh', '-c', script.join("\n"), $PROGRAM_NAME, @runner, *arguments)
  end

  private

  def attempt(row)
    folder = "#{@work}/#{row.name}"
    FileUtils.rm_rf(folder)
    FileUtils.mkdir_p(folder)
    File.write("#{folder}.sh", [*prelude, "test=#{row.name}", *steps(row), ''].join("\n"))
    output, status = Open3.capture2e({ 'MATRIX_READY' => nil }, 'sh', "#{folder}.sh", chdir: folder, stdin_data: '')
    File.write("#{folder}.log", output)
    raise output unless status.success?
  end

  def prelude
    sources = [*PRELUDE, *Dir["#{@folder}/steps.sh"]].map { |path| ". '#{Dir.pwd}/#{path}'" }
    ['set -e', "root='#{Dir.pwd}' here='#{Dir.pwd}/#{@folder}' work='#{@work}'", *sources]
  end

  def steps(row)
    row.compilers.empty? ? row.steps : row.compilers.flat_map { |compiler| ["CC=#{compiler}", *row.steps] }
  end
end

exit Matrix.new(ARGV.shift).run(ARGV) if $PROGRAM_NAME == __FILE__

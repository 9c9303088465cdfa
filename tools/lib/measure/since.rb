# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What a change costs: the figures of docs/cost.md at a commit, and those that it has here, as
# a table in Markdown for a pull request. Nothing is measured: tools/cost --check, which
# tools/test runs, holds the page to what is.
#
#   since.rb COMMIT
require 'open3'

class Since
  PAGE = 'docs/cost.md'
  # Tables, and the columns that are no figures of a build.
  TABLES = %w[steps modules together].freeze
  KEYS = ['', 'chip', 'built', '`fixpid_pid`'].freeze
  NUMBER = /\d+(?:\.\d+)?/.freeze

  def initialize(before, after)
    @rows = TABLES.flat_map { |name| changes(name, table(before, name), table(after, name)) }
    @same = TABLES.sum { |name| (figures(table(before, name)).to_a & figures(table(after, name)).to_a).size }
  end

  def to_s
    return "No figure of `#{PAGE}` changed: #{@same} are as they were.\n" if @rows.empty?

    "| | figure | before | after | |\n|---|---|---|---|---|\n#{@rows.join}\n#{@same} figures of `#{PAGE}` are as they were.\n"
  end

  private

  # The rows of a table, each with its cells by the names of the columns.
  def table(text, name)
    head, _, *rows = text[/<!-- #{name}:begin -->\n(.*?)<!-- #{name}:end -->/m, 1].to_s.lines.map { |line| line.split('|')[1...-1].map(&:strip) }
    rows.map { |cells| head.zip(cells).to_h }
  end

  # { [row, column] => cell }
  def figures(rows)
    rows.flat_map do |row|
      keys, cells = row.partition { |column, _| KEYS.include?(column) }
      cells.map { |column, cell| [[keys.map(&:last).join(', '), column], cell] }
    end.to_h
  end

  def changes(name, before, after)
    old = figures(before)
    new = figures(after)
    (new.keys | old.keys).reject { |key| old[key] == new[key] }
                         .map { |key| "| #{name}: #{key.first} | #{key.last} | #{old[key] || '-'} | #{new[key] || '-'} | #{difference(old[key], new[key])} |\n" }
  end

  # Of a cell with one number, as it is with most.
  def difference(before, after)
    return 'new' unless before
    return 'gone' unless after

    one, other = [before, after].map { |cell| cell.scan(NUMBER) }
    one.size == 1 && other.size == 1 ? format('%+g', other.first.to_f - one.first.to_f) : 'changed'
  end
end

if $PROGRAM_NAME == __FILE__
  before, errors, status = Open3.capture3('git', 'show', "#{ARGV.fetch(0)}:#{Since::PAGE}")
  abort "cost: #{errors.lines.first}" unless status.success?

  puts Since.new(before, File.read(Since::PAGE))
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What a change costs: the figures of docs/data at a commit, and those that it has here, as
# a table in Markdown for a pull request. Nothing is measured: tools/cost --check, which
# tools/test runs, holds the tables to what is.
#
#   since.rb COMMIT
require 'csv'
require 'open3'

class Since
  # Tables, and the columns that are no figures of a build.
  TABLES = %w[steps modules together].freeze
  KEYS = ['controller', 'function', 'chip', 'built', '`fixpid_pid`'].freeze
  NUMBER = /\d+(?:\.\d+)?/.freeze

  def self.path(name)
    "docs/data/cost_#{name}.csv"
  end

  # The text of each table.
  def initialize(before, after)
    @rows = TABLES.flat_map { |name| changes(name, table(before[name]), table(after[name])) }
    @same = TABLES.sum { |name| (figures(table(before[name])).to_a & figures(table(after[name])).to_a).size }
  end

  def to_s
    return "No cost changed: #{@same} figures are as they were.\n" if @rows.empty?

    "| | figure | before | after | |\n|---|---|---|---|---|\n#{@rows.join}\n#{@same} figures are as they were.\n"
  end

  private

  # Its rows, each with its cells by the names of the columns.
  def table(text)
    CSV.parse(text.to_s, headers: true).map(&:to_h)
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
  _, errors, status = Open3.capture3('git', 'rev-parse', '--verify', "#{ARGV.fetch(0)}^{commit}")
  abort "cost: #{errors.lines.first}" unless status.success?

  # Of a commit without them all are new.
  before = Since::TABLES.to_h { |name| [name, Open3.capture2e('git', 'show', "#{ARGV[0]}:#{Since.path(name)}").then { |text, shown| shown.success? ? text : '' }] }
  puts Since.new(before, Since::TABLES.to_h { |name| [name, File.read(Since.path(name))] })
end

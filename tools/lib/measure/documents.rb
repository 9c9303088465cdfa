# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../data_tables'

# Tables that are files of docs/data, and what they said before.
class DataFiles
  def initialize(root)
    @root = root
    @tables = {}
  end

  def replace(name, rows)
    @tables[name] = rows
    DataTables.difference(name, rows, @root) ? Changes.new(Tables.markdown(DataTables.read(name, @root)), rows).to_a : []
  end

  def write
    @tables.each { |name, rows| DataTables.write(name, rows, @root) }
  end
end

# Tables between markers of the documents, and what they said before.
class Document
  # A page, or the folder of the tables.
  def self.of(path, root)
    path == DataTables::FOLDER ? DataFiles.new(root) : new("#{root}/#{path}")
  end

  def initialize(path)
    @path = path
    @text = @old = File.read(path)
  end

  # Puts a table between its markers and says what differs from the old one.
  def replace(name, rows)
    marks = ["<!-- #{name}:begin -->\n", "<!-- #{name}:end -->"]
    head, rest = @text.split(marks[0], 2)
    old, tail = rest&.split(marks[1], 2)
    tail or raise Host::Failure, "#{@path} has lost its markers of #{name}"
    @text = [head, marks[0], Tables.markdown(rows), marks[1], tail].join
    old == Tables.markdown(rows) ? [] : Changes.new(old, rows).to_a
  end

  # Whole or not at all.
  def write
    return if @text == @old

    File.write("#{@path}.new", @text)
    File.rename("#{@path}.new", @path)
  end
end

# How a table differs from the committed one, cell by cell. Less is better.
class Changes
  # Columns that say what a row is about; the first one always does.
  KEYS = %w[chip built].freeze

  def initialize(old, rows)
    @old = old.lines.map { |line| line.strip.split('|').drop(1).map(&:strip) }
    @new = rows.map { |row| row.map(&:to_s) }
    @head = @new.first
    @keys = 1 + (@head & KEYS).size
  end

  def to_a
    return ['the table is new'] if @old.first != @head

    gone = @old.drop(2).map { |row| key(row) } - @new.map { |row| key(row) }
    found = @new.drop(1).flat_map { |row| changes(row) } + gone.map { |words| "#{words}: gone" }
    found.empty? ? ['rows have changed their places'] : found
  end

  private

  def key(row)
    row.take(@keys).join(', ')
  end

  def changes(row)
    old = @old.find { |one| key(one) == key(row) } or return ["#{key(row)}: new"]
    row.zip(old, @head).reject { |cell, before, _| cell == before }.map do |cell, before, column|
      "#{key(row)}, #{column}: #{before} is documented, #{cell} measured#{judgement(before, cell)}"
    end
  end

  def judgement(before, cell)
    numbers = [before, cell].map { |text| text.to_s.scan(/\d+(?:\.\d+)?/).map(&:to_f) }
    return '' if numbers[0].size != numbers[1].size || numbers[0].empty?

    worse = numbers[1].zip(numbers[0]).any? { |now, then_| now > then_ }
    worse ? ', which is worse' : ', which is better'
  end
end

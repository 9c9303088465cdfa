# SPDX-License-Identifier: MIT
# A recorded file of test/support/vectors/, as text: the names of its columns and its rows.
class Recorded
  attr_reader :names, :rows

  def initialize(path)
    @path = path
    @names, *@rows = File.readlines(path, chomp: true).map { |line| line.strip.split(',', -1) }
  end

  # The numbers of a column.
  def numbers(name)
    at = names.index(name) or abort "#{@path} has no column #{name}"
    rows.map { |row| Integer(row[at], 10) }
  end

  # Each row by its columns' names.
  def by_name
    rows.map { |row| names.zip(row).to_h }
  end
end

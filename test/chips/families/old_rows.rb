# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../../../tools/lib/measure/host'

# The rows of a table as it stands between its markers in a document. A test that was left
# out, as --daily does, has no figures: its row stays as it is, and must be there.
class OldRows
  def initialize(text, name)
    table = text[/<!-- #{name}:begin -->\n(.*?)<!-- #{name}:end -->/m, 1] or raise Host::Failure, "no markers of #{name}"
    @name = name
    @rows = table.lines.map { |line| line.split('|', -1)[1..-2].map(&:strip) }
  end

  # The row that begins with these cells.
  def of(*cells)
    @rows.find { |row| row.take(cells.size) == cells } or
      raise Host::Failure, "the table #{@name} has no row of #{cells.join(', ')}, which did not run"
  end

  # One cell of it, below this word of the head.
  def cell(column, *cells)
    of(*cells).fetch(@rows.first.index(column))
  end
end

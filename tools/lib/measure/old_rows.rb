# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'host'

# The rows of a table as it stands between its markers in a document. What was left out, as
# --daily does, has no figures: its row stays as it is, and must be there.
class OldRows
  def initialize(text, name)
    table = text[/<!-- #{name}:begin -->\n(.*?)<!-- #{name}:end -->/m, 1] or raise Host::Failure, "the document has lost its markers of #{name}"
    @name = name
    @rows = table.lines.map { |line| line.split('|', -1)[1..-2].map(&:strip) }
  end

  # The row that begins with these cells.
  def of(*cells)
    @rows.find { |row| row.take(cells.size) == cells } or
      raise Host::Failure, "no row of #{cells.join(', ')} in #{@name}, which did not run"
  end

  # Its cells by the words of the head.
  def named(*cells)
    @rows.first.zip(of(*cells)).to_h
  end
end

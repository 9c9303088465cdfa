# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# A cell of a table, which is a number only if it looks like one: Ruby takes
# `nan`, `-` and nothing at all for 0.
class Cell < String
  def to_f
    found = Float(self, exception: false)
    found&.finite? ? found : raise(Host::Failure, "not a number in a table: '#{self}'")
  end

  def to_i
    Integer(self, 10, exception: false) || raise(Host::Failure, "not an integer in a table: '#{self}'")
  end
end

# A table that the program `loops` prints: rows by the names in its first line.
module Loops
  NO_NUMBER = /\A(?:[-+]?(?:nan|inf)|-\z)/i.freeze

  def self.table(name, size)
    read(Host.print('loops', "#{Report.loop}-#{name}.txt", name), size)
  end

  def self.read(path, size)
    head, *rows = File.readlines(path, chomp: true)
                      .map { |line| line.split(';', -1) }
    rows.size == size or raise Host::Failure, "#{path} has #{rows.size} rows, not #{size}"
    rows.map { |row| named(path, head, row) }
  end

  # Ruby would read `nan`, `-`, and a cell that is not there, as 0.
  def self.named(path, head, row)
    row.size == head.size && row.grep(NO_NUMBER).empty? or
      raise Host::Failure, "#{path}: #{row.join(';')}"
    Hash.new { |_, key| raise Host::Failure, "#{path} has no #{key}" }
        .merge(head.zip(row.map { |text| Cell.new(text) }).to_h)
  end
end

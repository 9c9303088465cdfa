# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# A table that the program `loops` prints: rows by the names in its first line.
module Loops
  NO_NUMBER = /\A(?:[-+]?(?:nan|inf)|-\z)/i.freeze

  def self.table(name)
    read(Host.print('loops', "#{Report.loop}-#{name}.txt", name))
  end

  def self.read(path)
    head, *rows = File.readlines(path, chomp: true)
                      .map { |line| line.split(';', -1) }
    rows.empty? and raise Host::Failure, "#{path} has no rows"
    rows.map { |row| named(path, head, row) }
  end

  # Ruby would read `nan`, `-`, and a cell that is not there, as 0.
  def self.named(path, head, row)
    row.size == head.size && row.grep(NO_NUMBER).empty? or
      raise Host::Failure, "#{path}: #{row.join(';')}"
    Hash.new { |_, key| raise Host::Failure, "#{path} has no #{key}" }
        .merge(head.zip(row).to_h)
  end

  # A scene of three runs, a row for each step.
  def self.scene(name)
    Trace.new(Host.print('loops', "#{Report.loop}-#{name}.csv", 'scene', name))
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# A table that the program `loops` prints: rows by the names in its first line.
module Loops
  def self.table(name)
    path = Host.print('loops', "#{Report.loop}-#{name}.txt", name)
    head, *rows = File.readlines(path, chomp: true)
                      .map { |line| line.split(';', -1) }
    rows.map { |row| head.zip(row).to_h }
  end

  # A scene of three runs, a row for each step.
  def self.scene(name)
    Trace.new(Host.print('loops', "#{Report.loop}-#{name}.csv", 'scene', name))
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../../../tools/lib/measure/limit'

# What the examples' firmware must not exceed, whatever docs/data says; figures.rb has
# its table, which these name by row and column.
module FirmwareLimits
  ALL = {
    ['pendulum, PIC16F684', 'interrupt'] => [40, 'cycles'],
    ['pendulum, PIC16F684', 'flash'] => [930, 'words'],
    ['pendulum, PIC16F684', 'RAM, bytes'] => [72, 'bytes'],
    ['pendulum, PIC16F684', 'stack used'] => [4, 'levels'],
    ['motor, PIC18F4520', 'interrupt'] => [18, 'cycles']
  }.freeze

  # A wrong figure, and what must be said of it: its row, column, what stands there, words.
  FAULTS = {
    'exceeded' => [0, 3, '5 of 8', 'pendulum, PIC16F684, stack used: 5 levels, at most 4 levels allowed'],
    'no_number' => [0, 3, '-', 'pendulum, PIC16F684, stack used: -, at most 4 levels allowed'],
    'no_cell' => [1, 7, nil, 'motor, PIC18F4520, interrupt: -, at most 18 cycles allowed'],
    'no_row' => [1, 0, 'motor', 'motor, PIC18F4520, interrupt: -, at most 18 cycles allowed'],
    'no_column' => [-1, 3, 'stack', 'pendulum, PIC16F684, stack used: -, at most 4 levels allowed']
  }.freeze
  HEAD = ['firmware', 'flash', 'RAM, bytes', 'stack used', 'step', 'pass with a tick', 'pass without', 'interrupt', 'of a tick'].freeze
  GOOD = [['pendulum, PIC16F684', '928 of 2048 words', '69 of 128', '4 of 8', 504, 1489, '-', 23, '19 %'],
          ['motor, PIC18F4520', '2762 of 32768 bytes', '305 of 1536', '7 of 31', 283, 1696, 1394, 18, '17 %']].freeze

  class << self
    # Of the cells of the table.
    def of(head, rows)
      ALL.map do |(name, column), (most, unit)|
        row = rows.find { |one| one.first == name }
        Limit.new("#{name}, #{column.delete_suffix(', bytes')}", most, row && number(row[head.index(column) || row.size]), unit)
      end
    end

    def exceeded(head, rows)
      of(head, rows).reject(&:kept?).map { |limit| "#{limit.what}: #{limit.wrong}" }
    end

    # Raises unless just this fault is said, and nothing of the table without it.
    def notice(fault)
      row, column, instead, said = FAULTS.fetch(fault)
      cells = [HEAD, *GOOD].map(&:dup)
      before = exceeded(*split(cells))
      cells[row + 1][column] = instead
      found = exceeded(*split(cells))
      raise "said of #{fault}: #{before + found}, not #{said}" unless before.empty? && found == [said]

      said
    end

    private

    def split(cells)
      [cells.first, cells.drop(1)]
    end

    # The first of a cell, as in "4 of 8"; nil, which keeps no limit, of "-".
    def number(cell)
      cell && cell.to_s[/\A\d+/]&.to_i
    end
  end
end

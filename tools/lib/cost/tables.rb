# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The figures as rows of text.
module Tables
  HEAD = ['', 'chip', 'built', 'least', 'mean', 'worst', 'bound', 'flash of the step', 'with init',
          'RAM each', 'RAM once', 'stack'].freeze

  class << self
    # A row for each subject, after the head.
    def steps(measured)
      [HEAD] + measured.map { |subject, figures| row(subject, figures) }
    end

    def markdown(rows)
      lines = [rows.first, rows.first.map { '---' }] + rows.drop(1)
      lines.map { |cells| "| #{cells.join(' | ')} |\n" }.join
    end

    def plain(rows)
      widths = rows.transpose.map { |column| column.map { |cell| cell.to_s.size }.max }
      rows.map { |row| row.zip(widths).map { |cell, width| cell.to_s.ljust(width) }.join('  ').rstrip }
    end

    private

    def row(subject, figures)
      [subject.controller.title, subject.chip.title, subject.built.delete('`'),
       figures.least, figures.mean.round, figures.most, figures.bound,
       "#{figures.step_flash} #{subject.chip.flash}", figures.flash, figures.instance, figures.fixed,
       stack(subject.chip, figures)]
    end

    def stack(chip, figures)
      return "#{figures.stack} bytes" unless chip.kind == :pic

      levels = "#{figures.levels} levels"
      figures.stack.zero? ? levels : "#{levels}, #{figures.stack} bytes"
    end
  end
end

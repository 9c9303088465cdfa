# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'tables'
require_relative '../demo/plot'

# Bars of the worst step, a panel for each chip, on logarithmic axes.
class Picture
  Bar = Struct.new(:title, :value, :color)

  OURS = Plot::BLUE
  NOTE = Plot::RED
  PEER = '#AAAAAA'
  # Chip, build, and whose costs are drawn beside.
  PANELS = [['pic16f684', nil, 'PIC16F684, cycles'], ['pic18f4520', nil, 'PIC18F4520, cycles'],
            ['atmega328p', '-O2', 'ATmega328P -O2, cycles'], ['cortex-m0', '-Os', 'Cortex-M0 -Os, instructions'],
            ['cortex-m4', '-Os', 'Cortex-M4 -Os, instructions']].freeze

  def initialize(measured)
    @measured = measured
  end

  def draw
    panels = PANELS.map { |chip, build, title| [title, bars(chip, build)] }
    plot = Plot.new('cost', 'What a step costs at most: fixpid (blue), the notes\' own firmware (orange) and others (grey)',
                    width: 1000, height: 22 * panels.sum { |_, list| list.size + 2 } + 90,
                    rows: panels.map { |_, list| list.size + 1.0 }, gap_y: 0.044,
                    margins: { left: 0.275, right: 0.955, top: 0.935, bottom: 0.04 })
    panels.each_with_index { |(title, list), row| panel(plot, row, title, list) }
    plot.draw
  end

  private

  def bars(chip, build)
    ours = @measured.select { |subject, _| subject.chip.name == chip && (build.nil? || subject.build == build) }
    list = ours.map { |subject, figures| Bar.new(own_title(subject, build), figures.most, OURS) }
    list += others(NOTES, chip, build, NOTE) + others(PEERS, chip, build, PEER)
    list.sort_by(&:value)
  end

  def own_title(subject, build)
    ['fixpid', [subject.controller.title, build ? subject.variant&.name : subject.built].compact.join(', ')].join(' ')
  end

  def others(list, chip, build, color)
    list.map { |other| Bar.new(other.title, other.costs["#{chip}#{build}"], color) }.select(&:value)
  end

  def panel(plot, row, title, list)
    path = "#{Host.folder}/bars-#{row}.csv"
    File.write(path, list.each_with_index.map { |bar, i| "#{i},#{bar.value},#{bar.color.sub('#', '0x')}\n" }.join)
    names = list.each_with_index.map { |bar, i| "\"#{bar.title}\" #{i}" }
    low, high = list.map(&:value).minmax
    plot.panel(row, 0,
               ["'#{path}' using (#{low / 2.0}):1:(#{low / 2.0}):2:($1-0.36):($1+0.36):3 with boxxyerror " \
                'fillstyle solid noborder linecolor rgb variable notitle',
                "'#{path}' using 2:1:(sprintf(' %d', $2)) with labels left font ',9' notitle"],
               ["set title \"{/:Bold #{title}}\" offset 0,-0.8", 'set logscale x', "set xrange [#{low / 2.0}:#{high * 1.35}]",
                "set yrange [#{list.size - 0.4}:-0.6]", "set ytics (#{names.join(', ')}) noenhanced scale 0",
                'set xtics (10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000) offset 0,0.4',
                'unset grid', 'set grid xtics', 'set border 1'])
  end
end

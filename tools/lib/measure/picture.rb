# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'tables'
require_relative '../demo/plot'

# Dots of what a step costs at most, a panel for each of two chips, on logarithmic axes: ours
# are filled and the bounds of their code, with the worst step found as a tick; the others'
# are hollow, and what was measured of them. Both panels have one order: ours, then the
# others by what they take on an ATmega.
class Picture
  Dot = Struct.new(:title, :most, :found, :kind)

  OURS = Plot::MEASUREMENT
  PEER = '#555555'
  # Chip, build, and the panel's title.
  PANELS = [['atmega328p', '-O2', 'ATmega328P, -O2, cycles'], ['cortex-m4', '-O2', 'Cortex-M4, -O2, instructions']].freeze
  # From where to where the axes of a panel go; its names are on their left.
  PLACES = [[0.2, 0.44], [0.7, 0.94]].freeze
  ROW = 19 # pixels
  TOP = 60
  KEY = 105 # the axes and what the dots are, below the panels

  def initialize(measured)
    @measured = measured
  end

  def draw
    panels = PANELS.map { |chip, build, title| [title, dots(chip, build)] }
    rows = panels.map { |_, list| list.size }.max
    @height = TOP + rows * ROW + KEY
    plot = Plot.new('cost', 'What a step costs at most', width: 900, height: @height)
    key(plot, TOP + rows * ROW + 25)
    panels.each_with_index { |(title, list), at| draw_panel(plot, at, title, list) }
    plot.draw
  end

  private

  def dots(chip, build)
    ours = @measured.select { |subject, _| subject.chip.name == chip && subject.build == build && subject.variant.nil? }
                    .reject { |subject, _| subject.controller.id == 'pid_plain' }
    list = ours.map { |subject, figures| Dot.new("fixpid #{subject.controller.title}", figures.bound, figures.most, :ours) }
    list + PEERS.sort_by { |peer| rank(peer) }.map { |peer| Dot.new(peer.title, peer.worst("#{chip}#{build}"), nil, :peer) }.select(&:most)
  end

  def rank(peer)
    peer.worst('atmega328p-O2') || Float::INFINITY
  end

  # In the plot's own rows, so that a row is as high in each panel.
  def draw_panel(plot, at, title, list)
    top = 1.0 - TOP.fdiv(@height)
    plot.panel_at(PLACES[at], [top - (list.size * ROW).fdiv(@height), top], curves(at, list), settings(title, list))
  end

  STYLES = { ours: "pointtype 7 linecolor '#{OURS}'", peer: "pointtype 6 linewidth 1.4 linecolor '#{PEER}'" }.freeze

  def curves(name, list)
    rows = list.each_with_index.to_a
    curves = STYLES.map do |kind, style|
      points(name, kind, rows.select { |dot, _| dot.kind == kind }, style)
    end
    curves.compact + [found(name, rows.select { |dot, _| dot.found })].compact
  end

  def points(name, kind, rows, style)
    return if rows.empty?

    path = file("#{name}-#{kind}", rows.map { |dot, at| [dot.most, at] })
    "'#{path}' using 1:2 with points pointsize 1.1 #{style} notitle"
  end

  def found(name, rows)
    return if rows.empty?

    path = file("#{name}-found", rows.map { |dot, at| [dot.found, at] })
    "'#{path}' using 1:2:(0):(0.42) with vectors nohead linewidth 1.6 linecolor '#{OURS}' notitle, " \
      "'' using 1:2:(0):(-0.42) with vectors nohead linewidth 1.6 linecolor '#{OURS}' notitle"
  end

  def file(name, rows)
    path = "#{Host.folder}/dots-#{name}.csv"
    File.write(path, rows.map { |row| "#{row.join(',')}\n" }.join)
    path
  end

  # The most is a number at the right end of its row, too.
  def settings(title, list)
    low, high = list.flat_map { |dot| [dot.most, dot.found].compact }.minmax
    names = list.each_with_index.map { |dot, i| "\"#{name_of(dot)}\" #{i}" }
    numbers = list.each_with_index.map { |dot, i| "set label \"#{dot.most}\" at graph 1.17, first #{i} right font ',10'" }
    ["set title \"{/:Bold #{title}}\" offset 0,-0.7", 'set logscale x', "set xrange [#{low * 0.8}:#{high * 1.25}]",
     "set yrange [#{list.size - 0.5}:-0.5]", "set ytics (#{names.join(', ')}) scale 0 font ',10'",
     "set xtics (#{ticks(low, high)}) offset 0,0.4 font ',10'", "set grid linecolor '#e4e4e4' linetype 1", 'set border 1', *numbers]
  end

  # Ours in bold. The others' may have what gnuplot takes for a subscript.
  def name_of(dot)
    dot.kind == :ours ? "{/:Bold #{dot.title}}" : dot.title.gsub('_') { '\\\\_' }
  end

  def ticks(low, high)
    digits = high > 30 * low ? [1, 3] : [1, 2, 5] # as many as have room
    tens = digits.product([10, 100, 1000, 10_000]).map { |digit, ten| digit * ten }
    tens.select { |value| value.between?(low * 0.8, high * 1.25) }.sort.join(', ')
  end

  # Below the first panel, `top` pixels from above. gnuplot draws no key of
  # nothing, so there is a curve out of sight.
  def key(plot, top)
    entries = [["pointtype 7 linecolor '#{OURS}'", 'fixpid, the bound of its code'],
               ["pointtype '|' linecolor '#{OURS}'", 'and the worst step found'],
               [STYLES[:peer], 'other libraries, the worst of a trace']]
    curves = entries.map { |style, title| "keyentry with points pointsize 1.1 #{style} title \"#{title}\"" }
    plot.panel_at([PLACES[0][0], 0.55], [0.01, 1.0 - top.fdiv(@height)],
                  ['-1 notitle', *curves],
                  ['unset border', 'unset tics', 'unset grid', 'set xrange [0:1]', 'set yrange [0:1]',
                   'set key left top vertical reverse Left samplen 1'])
  end
end

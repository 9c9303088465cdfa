# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Pictures of several panels, drawn by gnuplot as PNG and SVG.
class Plot
  # A colour has one meaning in all pictures. Where runs are compared, what is shown has
  # the first, in each of its panels, and what it is compared with the second.
  MEASUREMENT = '#0072B2'
  WITHOUT = '#D55E00' # the same without what is shown, or somebody else's
  SETPOINT = '#222222' # dashed
  OUTPUT = '#CC79A7'
  SECOND = '#5E3C99' # another measurement, or another run
  LIMIT = '#888888'
  LIMIT_TEXT = '#666666'
  DISTURBANCE = '#888888' # a line; a stretch of time is AREA
  AREA = '#E8E8E8'
  TERMS = { 'proportional' => ['P', '#56B4E9'], 'integral' => ['I', '#E69F00'], 'derivative' => ['D', '#009E73'] }.freeze
  # One measurement at several settings.
  FAMILY = %w[#9ECAE1 #6BAED6 #0072B2 #08306B].freeze
  TEXT = SETPOINT

  FONT = 'DejaVu Sans,Arial,sans-serif'
  MARGINS = { left: 0.085, right: 0.975, top: 0.90, bottom: 0.075 }.freeze
  GAP_X = 0.055
  GAP_Y = 0.035

  Curve = Struct.new(:data, :title)

  def initialize(name, title, width: 1000, height: 800, columns: [1.0],
                 rows: [1.0], gap_x: GAP_X, gap_y: GAP_Y, margins: {})
    @name = name
    @title = title
    @size = [width, height]
    @gap_x = gap_x
    @sides = [margin(margins, :left), margin(margins, :right)]
    @x = spans(columns, *@sides, gap_x)
    @y = spans(rows.reverse, margin(margins, :bottom), margin(margins, :top),
               gap_y).reverse
    @panels = []
  end

  # `curves` are gnuplot's plot elements, `settings` its commands.
  def panel(row, column, curves, settings)
    panel_at(@x[column], @y[row], curves, settings)
  end

  # In a row that `size` panels fill.
  def panel_of(row, index, size, curves, settings)
    panel_at(spans([1.0] * size, *@sides, @gap_x)[index], @y[row], curves, settings)
  end

  # From x[0] to x[1] and from y[0] to y[1], shares of the whole from below left.
  def panel_at(x, y, curves, settings)
    place = ["set lmargin at screen #{x[0]}", "set rmargin at screen #{x[1]}",
             "set bmargin at screen #{y[0]}", "set tmargin at screen #{y[1]}"]
    @panels << [*place, *settings, "plot #{curves.join(", \\\n     ")}"]
  end

  # Three terms over time, in their colors. D is drawn first, because its noise
  # would hide the others: over `span` seconds it is the band that the noise fills.
  def self.terms(trace, scale: 1.0, span: nil, **options)
    TERMS.to_a.reverse.flat_map do |name, (_, color)|
      next band(trace, name, color, scale, span) if span && name == 'derivative'

      curve(trace, "(column('#{name}')*#{scale})", color, width: 1.2, **options)
    end
  end

  BAND_PARTS = 250 # of a span

  # From the least to the greatest value of each part of the time.
  def self.band(trace, column, color, scale, span)
    path = "#{trace.path.delete_suffix('.csv')}_#{column}_#{(1000 * span).round}.csv"
    rows = trace.times.zip(trace.values(column)).chunk_while { |one, other| [one, other].map { |t, _| (t * BAND_PARTS / span).floor }.uniq.size == 1 }
    Report.replace(path, rows.map { |part| "#{part[0][0]},#{part.map(&:last).minmax.map { |value| value * scale }.join(',')}\n" }.join)
    ["'#{path}' using 1:2:3 with filledcurves fillcolor '#{color}' fillstyle solid 0.35 noborder notitle",
     *[2, 3].map { |edge| "'#{path}' using 1:#{edge} with lines linewidth 0.8 linecolor '#{color}' notitle" }]
  end

  # A name beside its curve, in the curve's colour.
  def self.text(words, x, y, color = TEXT, align = 'left')
    "set label '#{words}' at #{x},#{y} #{align} textcolor '#{color}' front"
  end

  # P, I and D beside their curves.
  def self.terms_text(*places)
    TERMS.values.zip(places).map { |(title, color), (x, y)| text(title, x, y, color) }
  end

  # A column that is the setpoint, or a number.
  def self.setpoint(trace, column = 'setpoint')
    return curve(trace, column, SETPOINT, style: 'dashtype 2', width: 1.2) if trace

    "#{column} notitle linecolor '#{SETPOINT}' linewidth 1.2 dashtype 2"
  end

  # A column of a trace over time.
  def self.curve(trace, column, color, every: 1, width: 1.6, style: '')
    "'#{trace.path}' using 'time_s':#{expression(column)} every #{every} " \
      "with lines linewidth #{width} linecolor '#{color}' #{style} notitle"
  end

  def self.expression(column)
    column.include?('(') ? column : "'#{column}'"
  end

  def draw
    base = "#{Host.folder}/#{@name}"
    make("#{base}.png", "pngcairo font '#{FONT.split(',')[0]},10' " \
                        "background '#ffffff'")
    make("#{base}.svg", "svg dynamic font '#{FONT},12' background 'white'")
  end

  private

  def margin(margins, side)
    margins.fetch(side, MARGINS[side])
  end

  # Parts of low..high in proportion to `weights`, with gaps.
  def spans(weights, low, high, gap)
    unit = (high - low - gap * (weights.size - 1)) / weights.sum
    at = low
    weights.map do |weight|
      span = [at.round(4), (at + unit * weight).round(4)]
      at += unit * weight + gap
      span
    end
  end

  def script(path, terminal)
    head = ["set terminal #{terminal} size #{@size.join(',')}",
            "set output '#{path}'",
            "set datafile separator ','", 'set encoding utf8',
            "set multiplot title \"#{@title}\" font ',13'"]
    panels = @panels.flat_map { |lines| ['reset', *style, *lines] }
    [*head, *panels, 'unset multiplot', 'unset output', ''].join("\n")
  end

  def style
    ["set datafile separator ','",
     "set grid linecolor '#dddddd' linetype 1 linewidth 0.7",
     "set border 3 linecolor '#444444'",
     'set tics nomirror out scale 0.6',
     'set key top right horizontal reverse Left samplen 1.5 noenhanced width 1']
  end

  # Drawn beside its place and moved there when it is complete.
  def make(path, terminal)
    gnuplot = "#{Host.folder}/#{@name}.gp"
    File.write(gnuplot, script("#{path}.new", terminal))
    # Without a UTF-8 locale gnuplot loses the degree sign.
    Host.execute({ 'LC_ALL' => 'C.UTF-8' }, 'gnuplot', gnuplot)
    File.rename("#{path}.new", path)
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The tables of docs/chips.md, which --long --update writes. A shorter run finds no
# more than the worst steps that stand there, and all else as it stands.
class Document
  PATH = 'docs/chips.md'
  HEAD = ['', 'mean', 'worst', 'flash', 'RAM'].freeze

  def initialize(results, long)
    @results = results
    @long = long
  end

  def update
    File.write(PATH, renewed(File.read(PATH)))
    "#{PATH} is rewritten"
  end

  def check
    old = File.read(PATH)
    expected = renewed(old.dup)
    stale = old.lines.zip(expected.lines).reject { |was, is| same?(was, is) }
    return PATH if stale.empty?

    raise Host::Failure, "#{PATH} is stale; test/chips/families/run --update renews it\n#{stale.first.join}"
  end

  private

  def same?(was, is)
    return was == is if @long

    was.sub(WORST, '\1') == is.sub(WORST, '\1') && was[WORST, 2].to_i >= is[WORST, 2].to_i
  end

  # Of a row of costs, whose cells are numbers.
  WORST = /\A(\| [^|]+ \| \d+ \|) (\d+)/.freeze

  def renewed(text)
    tables.reduce(text) { |all, (name, content)| put(all, name, content) }
  end

  def put(text, name, content)
    text.sub!(/(<!-- #{name}:begin -->\n).*?(<!-- #{name}:end -->)/m) { "#{$1}#{content}#{$2}" } or
      raise Host::Failure, "#{PATH} has no markers of #{name}"
  end

  def tables
    { 'families' => exact, 'family-costs' => costs }
  end

  def markdown(head, rows)
    [head, head.map { '---' }, *rows].map { |cells| "| #{cells.join(' | ')} |\n" }.join
  end

  def exact
    markdown(['', *TITLES.values], FAMILIES.map { |family| [family.title, *TITLES.keys.map { |name| exact_cell(family, name) }] })
  end

  def exact_cell(family, controller)
    return family.refused.fetch(controller).last if family.refused.key?(controller)

    result = @results.fetch([family.name, controller])
    "#{thousands(result.rows)} rows, #{thousands(STEPS_LONG)} steps, #{result.different} different"
  end

  def costs
    rows = FAMILIES.select(&:costs_listed?).flat_map do |family|
      family.controllers.map { |controller| costs_row(family, controller, @results.fetch([family.name, controller])) }
    end
    markdown(HEAD, rows)
  end

  def costs_row(family, controller, result)
    ["#{TITLES.fetch(controller)}, #{family.title}", result.mean, result.worst, result.flash, result.ram]
  end

  def thousands(number)
    number.to_s.reverse.scan(/\d{1,3}/).join(' ').reverse
  end
end

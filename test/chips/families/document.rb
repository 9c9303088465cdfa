# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../../../tools/lib/measure/old_rows'

# The tables of docs/chips.md, which --long --update writes. A shorter run finds no
# more than the worst steps that stand there, and all else as it stands. What was left out,
# by family, controller and mode, keeps its cells and rows.
class Document
  HEAD = ['', 'built', 'mean', 'worst', 'flash', 'RAM'].freeze

  def initialize(results, long, left_out = [], path = 'docs/chips.md')
    @results = results
    @long = long
    @left_out = left_out
    @path = path
  end

  def update
    File.write(@path, renewed(File.read(@path)))
    "#{@path} is rewritten"
  end

  def check
    old = File.read(@path)
    expected = renewed(old.dup)
    stale = old.lines.zip(expected.lines).reject { |was, is| same?(was, is) }
    return @path if stale.empty?

    raise Host::Failure, "#{@path} is stale; test/chips/families/run --update renews it\n#{stale.first.join}"
  end

  private

  def same?(was, is)
    return was == is if @long

    was.sub(WORST, '') == is.sub(WORST, '') && was[WORST, 1].to_i >= is[WORST, 1].to_i
  end

  # The fourth cell of a row of costs.
  WORST = /(?<=`object` \||`pointer` \|) \d+ \| (\d+)/.freeze

  def renewed(text)
    tables(text).reduce(text) { |all, (name, content)| put(all, name, content) }
  end

  def put(text, name, content)
    text.sub!(/(<!-- #{name}:begin -->\n).*?(<!-- #{name}:end -->)/m) { "#{$1}#{content}#{$2}" } or
      raise Host::Failure, "#{@path} has no markers of #{name}"
  end

  def tables(text)
    { 'families' => exact(OldRows.new(text, 'families')), 'family-costs' => costs(OldRows.new(text, 'family-costs')) }
  end

  def left_out?(family, controller, modes)
    modes.any? { |mode| @left_out.include?([family.name, controller, mode]) }
  end

  def markdown(head, rows)
    [head, head.map { '---' }, *rows].map { |cells| "| #{cells.join(' | ')} |\n" }.join
  end

  def exact(old)
    markdown(['', *TITLES.values], FAMILIES.map { |family| [family.title, *TITLES.keys.map { |name| exact_cell(family, name, old) }] })
  end

  # It is of all modes.
  def exact_cell(family, controller, old)
    return family.refused.fetch(controller).last if family.refused.key?(controller)

    modes = family.modes.fetch(controller)
    return old.named(family.title).fetch(TITLES.fetch(controller)) if left_out?(family, controller, modes)

    results = modes.map { |mode| @results.fetch([family.name, controller, mode]) }
    cell = "#{thousands(results.sum(&:rows))} rows, #{thousands(STEPS_LONG * results.size)} steps, #{results.sum(&:different)} different"
    modes == BOTH ? cell : "#{cell}, #{modes.first} mode"
  end

  def costs(old)
    rows = FAMILIES.select(&:costs_listed?).flat_map do |family|
      family.modes.flat_map { |controller, modes| (BOTH.reverse & modes).map { |mode| costs_row(family, controller, mode, old) } }
    end
    markdown(HEAD, rows)
  end

  def costs_row(family, controller, mode, old)
    head = ["#{TITLES.fetch(controller)}, #{family.title}", "`#{mode}`"]
    return old.of(*head) if left_out?(family, controller, [mode])

    result = @results.fetch([family.name, controller, mode])
    [*head, result.mean, result.worst, result.flash, result.ram]
  end

  def thousands(number)
    number.to_s.reverse.scan(/\d{1,3}/).join(' ').reverse
  end
end

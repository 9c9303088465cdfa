# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../../../tools/lib/data_tables'

# Two tables of docs/data, which --long --update writes. A shorter run finds no more than the
# worst steps that stand there, and all else as it stands.
class Document
  HEAD = %w[controller mean worst flash RAM].freeze
  WORST = HEAD.index('worst')

  def initialize(results, long)
    @results = results
    @long = long
  end

  def update
    tables.each { |name, rows| DataTables.write(name, rows) }
    "#{tables.keys.join(', ')} of #{DataTables::FOLDER}"
  end

  def check
    tables.each do |name, rows|
      lines = DataTables.difference(name, allowed(name, rows)) or next
      raise Host::Failure, "#{DataTables.path(name)} is stale; test/chips/families/run --update renews it\n#{lines.map { |row| row.to_a.to_csv }.join}"
    end
    "#{tables.keys.join(', ')} of #{DataTables::FOLDER}"
  end

  private

  # What may stand there: in a shorter run a worst step that it has not found.
  def allowed(name, rows)
    return rows if @long || name != COSTS

    old = DataTables.read(name)
    rows.each_with_index.map do |row, at|
      worst = old.dig(at, WORST)
      worst.to_i > row[WORST].to_i ? row.dup.tap { |one| one[WORST] = worst } : row
    end
  end

  COSTS = 'chips_family_costs'

  def tables
    @tables ||= { 'chips_families' => exact, COSTS => costs }
  end

  def exact
    [['chip', *TITLES.values], *FAMILIES.map { |family| [family.title, *TITLES.keys.map { |name| exact_cell(family, name) }] }]
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
    [HEAD, *rows]
  end

  def costs_row(family, controller, result)
    ["#{TITLES.fetch(controller)}, #{family.title}", result.mean, result.worst, result.flash, result.ram]
  end

  def thousands(number)
    number.to_s.reverse.scan(/\d{1,3}/).join(' ').reverse
  end
end

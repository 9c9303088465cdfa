# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'meters'
require_relative 'modules'
require_relative '../data_tables'

# Figures as they stand in the tables of docs/data, of what is not measured this time, as
# --daily does: other tables have them, too, and the largest of all is among the limits.
class Documented
  # The rows of each table, by its name.
  def initialize(tables = Hash.new { |all, name| all[name] = DataTables.read(name, Host.root) })
    @tables = tables
  end

  # Without the step's variables, which stand in no table.
  def figures(subject)
    cells = named('cost_steps', subject.controller.title, subject.chip.title, subject.built)
    Figures.new(**costs(cells, subject.chip), step_flash: cells['flash of the step'].to_i, needed: cells['with init'].to_i,
                linked: cells['linked'].to_i, instance: cells['RAM each'].to_i, fixed: cells['RAM once'].to_i,
                levels: cells['stack'][/(\d+) levels/, 1].to_i, stack: cells['stack'][/(\d+) bytes/, 1].to_i)
  end

  # By function.
  def called(subject)
    subject.called.functions.transform_values do |function|
      cells = named('cost_modules', subject.title_of(function), subject.chip.title, subject.build)
      ModuleFigures.new(**costs(cells, subject.chip), flash: cells['flash'].to_i, instance: cells['RAM each'].to_i)
    end
  end

  # The worst of its straightforward form.
  def plain_c(subject)
    named('cost_ratios', subject.controller.title, subject.chip.title, subject.build)['straightforward'].to_i
  end

  private

  # The row that begins with these cells, by the words of the head.
  def named(name, *cells)
    head, *rows = @tables[name]
    row = rows.find { |one| one.take(cells.size) == cells } or raise Host::Failure, "no row of #{cells.join(', ')} in #{name}, which did not run"
    head.zip(row).to_h
  end

  # A bound is "-" where there is none; in cycles it is another one where instructions are counted.
  def costs(cells, chip)
    bounds = cells['bound in cycles'].scan(/\d+/).map(&:to_i)
    { least: cells['least'].to_i, mean: cells['mean'].to_i, most: cells['worst found'].to_i, bound: cells['bound'][/\d+/]&.to_i,
      cycles: chip.cost == 'cycles' || bounds.empty? ? nil : bounds }
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../../data_tables'

# What a step costs on each chip, from the tables that tools/cost writes and checks.
module Costs
  BUILDS = %w[object -O2].freeze # what one would take; the others are variants of it

  class << self
    # Rows [controller, chip, bound, flash with init, its unit, RAM each].
    def steps
      DataTables.hashes('cost_steps').filter_map do |row|
        next unless BUILDS.include?(row['built'])

        number, unit = row['flash of the step'].split
        raise "no unit: #{number}" unless unit

        [row['controller'], row['chip'], row['bound'].to_i, row['with init'].to_i, unit, row['RAM each'].to_i]
      end
    end

    # { chip => rows [bit, steps more, bytes more] }, the first row with none.
    def features
      rows = DataTables.hashes('features').reject { |row| row['feature'] == 'all' }
      head = rows.first.keys
      head.each_index.select { |at| head[at].match?(/ (cycles|instructions)\z/) }.to_h do |at|
        [head[at][/\A[^,\s]+/], rows.map { |row| [row['bit'][/0x\h+/].hex, row.values[at].to_i, row.values[at + 1].to_i] }]
      end
    end
  end
end

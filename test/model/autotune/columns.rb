# SPDX-License-Identifier: MIT
# What columns of test/support/vectors/autotune.csv make a configuration.
module Columns
  CONFIG = %w[output_min output_max output_rest measurement_min measurement_max swing timeout_steps].freeze
  REVERSE = 0x80 # the one bit that options have

  # The numbers of a configuration, reverse (0 or 1) at last. Another bit of options is
  # refused; the library has no place for one, and refuses no cycles likewise.
  def self.configuration(row)
    options = Integer(row['options'])
    cycles = (options & ~REVERSE).zero? ? Integer(row['cycles']) : 0
    [*row.values_at(*CONFIG).map { |text| Integer(text) }, cycles, options[7]]
  end
end

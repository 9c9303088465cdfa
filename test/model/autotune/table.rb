# SPDX-License-Identifier: MIT
# Prints a C file that implements test/model/autotune/table.h:
#
#   ruby table.rb FILE.csv
require_relative '../../support/recorded'
require_relative 'columns'

PLANT = %w[integrating growth_q16 delay lags pole_q16 ratio_q8 lead_q16 leads spring_q16 damp_q16 fall_q16 backlash
           gain_q16 load step_at step_by drift_q16 drift_steps base start noise seed full_scale].freeze
MODEL = %w[gain_q8 lag_q4 dead_q4 slope_q24 holding noise_q4 hysteresis].freeze
GAINS = %w[pi_quick pi_safe pi_calm pi_robustness pid_quick pid_safe pid_calm pid_robustness rule_2].freeze
MASK = 0xFFFFFFFF
WEIGHT_BEFORE = 128
WEIGHT = 256

# [reason, kp, ki, kd, filter, weight, proportional on the measurement]
def gains_values(text)
  return [Integer(text[1..], 10), 0, 0, 0, 0, WEIGHT_BEFORE, 1] if text.start_with?('-')

  [0, *text.split.map { |number| Integer(number, 10) }, WEIGHT, 0]
end

# The order of enum player_value.
def recorded_values(row)
  model = row.values_at(*MODEL)
  model_values = model.first.empty? ? [0] * 8 : [1, *model.map { |number| Integer(number, 10) & MASK }]
  [Integer(row['status']), Integer(row['steps']), row['digest'].hex, row['told'].hex, *model_values,
   *row.values_at(*GAINS).flat_map { |text| gains_values(text) }]
end

def fnv(bytes)
  bytes.inject(2_166_136_261) { |digest, byte| ((digest ^ byte) * 16_777_619) & MASK }
end

def table_row(row)
  config = Columns.configuration(row)
  plant = [*row.values_at(*PLANT), config.last]
  values = recorded_values(row)
  digest = fnv(values.pack('V*').bytes)
  ["// #{values.map { |value| format('%08x', value) }.join(' ')}",
   "{{{#{config.join(', ')}}, {#{plant.join(', ')}}, #{row['setpoint']}, #{row['robustness_q4']}}, #{digest}u},"]
end

rows = Recorded.new(ARGV[0]).by_name
puts '// Made by table.rb: do not edit.', '#include "table.h"'
puts 'const struct table_row table_rows[] = {', rows.flat_map { |row| table_row(row) }, '};'
puts "const uint16_t table_count = #{rows.size};"

# SPDX-License-Identifier: MIT
# Prints a C file that implements test/model/autotune/table.h:
#
#   ruby table.rb FILE.csv [COUNT]        the first rows, or all
CONFIG = %w[output_min output_max output_rest measurement_min measurement_max swing timeout_steps cycles
            options].freeze
PLANT = %w[delay lags pole_q16 gain_q16 load step_at step_by base start noise seed full_scale].freeze
MODEL = %w[gain_q8 lag_q4 dead_q4 slope_q24 ultimate_q8 period_q4 holding noise_q4 hysteresis].freeze
RULES = %w[simc_pi amigo_pi amigo_pid tyreus_luyben_pi tyreus_luyben_pid ziegler_nichols_pi ziegler_nichols_pid
           rule_7].freeze
REVERSE = 0x80
MASK = 0xFFFFFFFF

# [accepted, kp, ki, kd, filter, weight, proportional on the measurement]
def rule_values(text)
  return [0] * 7 if text == '-'

  gains = text.split.map { |number| Integer(number, 10) }
  [1, *gains, gains.last.zero? ? 1 : 0]
end

# The order of enum player_value.
def recorded_values(row)
  model = row.values_at(*MODEL)
  model_values = model.first.empty? ? [0] * 10 : [1, *model.map { |number| Integer(number, 10) & MASK }]
  [Integer(row['status']), Integer(row['steps']), row['digest'].hex, *model_values,
   *row.values_at(*RULES).flat_map { |text| rule_values(text) }]
end

def fnv(bytes)
  bytes.inject(2_166_136_261) { |digest, byte| ((digest ^ byte) * 16_777_619) & MASK }
end

def table_row(row)
  plant = [row['integrating'], Integer(row['options']) & REVERSE == 0 ? 0 : 1, *row.values_at(*PLANT)]
  values = recorded_values(row)
  digest = fnv(values.pack('V*').bytes)
  [format("// #{values.map { |value| format('%08x', value) }.join(' ')}"),
   "{{{#{row.values_at(*CONFIG).join(', ')}}, {#{plant.join(', ')}}, #{row['setpoint']}, #{row['robustness_q4']}}, " \
   "#{digest}u},"]
end

names, *lines = File.readlines(ARGV[0], chomp: true).map { |line| line.split(',', -1) }
rows = lines.first(Integer(ARGV[1] || lines.size)).map { |line| names.zip(line).to_h }
puts '// Made by table.rb: do not edit.', '#include "table.h"'
puts 'const struct table_row table_rows[] = {', rows.flat_map { |row| table_row(row) }, '};'
puts "const uint16_t table_count = #{rows.size};"

# SPDX-License-Identifier: MIT
# The recorded experiments on the model of the definition, plants and all, and records
# of experiments, from which nothing but the answers is left to compute:
#
#   ruby rows.rb FILE.csv...
#
# Prints the first rows that differ, and how many do.
require_relative '../../support/recorded'
require_relative 'columns'
require_relative 'model'
require_relative 'plant'

REPORTED = 5

# What is recorded of an experiment that is over.
module Answers
  def self.of(experiment, robustness)
    model(experiment) + gains(experiment, robustness)
  end

  def self.model(experiment)
    accepted, *model = Rules.model(experiment)
    accepted == 1 ? model.map(&:to_s) : [''] * model.size
  end

  def self.gains(experiment, robustness)
    asked = [Rules::PI, Rules::PID].product([8, 16, 32, robustness]) << [2, 16]
    asked.map do |rule, robust|
      reason, *gains = Rules.gains(experiment, rule, robust)
      gains.empty? ? "-#{Identified::REASONS.index(reason)}" : gains.join(' ')
    end
  end
end

# A row that is played.
class Played
  def initialize(row)
    @at = row.transform_values(&:to_i)
    @config = Columns.configuration(row)
    @reverse = @config.last == 1
  end

  def found
    @experiment = Experiment.new(@config)
    steps, outputs, told = play
    [Experiment::STATUS.index(@experiment.status), steps].map(&:to_s) +
      [outputs, told].map { |bytes| format('%08x', fnv(bytes)) } + Answers.of(@experiment, @at['robustness_q4'])
  end

  private

  def turned(value)
    @reverse ? @at['full_scale'] - value : value
  end

  def play
    plant = Plant.new(@at, @at['output_rest'])
    setpoint = turned(@at['setpoint'])
    outputs = []
    told = []
    loop do
      outputs << @experiment.step(setpoint, turned(plant.measure))
      told.push(*@experiment.progress.values_at(0, 1, 3))
      break unless @experiment.status == :running

      plant.move(outputs.last)
    end
    [outputs.size, outputs.pack('s<*').bytes, told]
  end

  def fnv(bytes)
    bytes.inject(2_166_136_261) { |digest, byte| ((digest ^ (byte & 255)) * 16_777_619) & 0xFFFFFFFF }
  end
end

# A row that is a record: its bytes are as include/fixpid_autotune.h says.
class Record
  VERSION = 3
  SUMS = 'l<2s<S<2'
  FORMAT = "Cs<5S<2C3#{SUMS}#{SUMS}s<S<4s<2".freeze

  def initialize(row)
    @bytes = [row['record']].pack('H*')
    @robustness = row['robustness_q4'].to_i
  end

  def found
    version, *numbers = @bytes.unpack(FORMAT)
    return ['a wrong record'] unless version == VERSION && @bytes.unpack1('@60S<') == check

    experiment = Experiment.new(numbers.shift(9))
    status = numbers.shift
    sums = [Sums.new(*numbers.shift(5)), Sums.new(*numbers.shift(5))]
    experiment.ended(Experiment::STATUS[status], sums, numbers)
    _, done, _, period = experiment.progress
    [status, done, period].map(&:to_s) + Answers.of(experiment, @robustness)
  end

  private

  # CRC-16 of what is before it.
  def check
    @bytes.bytes.first(60).inject(0xFFFF) do |sum, byte|
      8.times.inject(sum ^ byte << 8) { |bits, _| (bits << 1 ^ (bits[15] == 1 ? 0x1021 : 0)) & 0xFFFF }
    end
  end
end

# [recorded, found] of each column that differs
def differences(row, recorded)
  found = (row.key?('record') ? Record : Played).new(row).found
  recorded.zip(found).reject { |one, other| one == other }
end

rows = wrong = 0
ARGV.each do |file|
  file_rows = Recorded.new(file)
  given = file_rows.names.index('status')
  rows += file_rows.rows.size
  file_rows.rows.each.with_index(1) do |fields, number|
    recorded, found = differences(file_rows.names.zip(fields).first(given).to_h, fields.drop(given)).first
    next unless recorded

    wrong += 1
    puts "#{File.basename(file)}, row #{number}: recorded #{recorded}, the model says #{found}" if wrong <= REPORTED
  end
end
puts "#{rows} rows, #{wrong} different from the model"
exit 1 unless wrong.zero?

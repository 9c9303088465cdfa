# SPDX-License-Identifier: MIT
require_relative '../../data_tables'

# Whether docs/data/chip_choices.csv says "no" of a controller and a chip where a simulated one did,
# and only there.
module ChipChoices
  CHOOSING = 'docs/data/chip_choices.csv'.freeze
  CHIPS = %w[chips_exact chips_families].freeze
  CONTROLLERS = { '`fixpid_an937`' => 'AN937', '`fixpid_an964`' => 'AN964', '`fixpid_an964_8bit`' => 'AN964 8-bit', '`fixpid_pid`' => 'PID' }.freeze
  # What the simulated ones are called, where they are others' names.
  SIMULATED = { 'PIC16F684' => 'PIC14', 'PIC18F4520' => 'PIC18', '8051, small model' => '8051, small', '8051, large model' => '8051, large' }.freeze
  # They have all controllers: they run the unit tests, test/chips/cores.
  ALL_OF_THEM = ['AVR with a multiplier', 'Cortex-M', 'RISC-V'].to_h { |name| [name, Hash.new('yes')] }.freeze
  SIZE = /, \d+ (?:words|bytes).*/.freeze

  class << self
    def failures
      found = simulated.merge(ALL_OF_THEM)
      chosen.flat_map do |row|
        names(row['chip']).flat_map { |name| wrong(row, name, found[SIMULATED.fetch(name, name)]) }
      end
    end

    private

    def names(cell)
      name = cell.sub(SIZE, '')
      SIMULATED.key?(name) ? [name] : name.split(', ')
    end

    def wrong(row, name, answers)
      return ["#{CHOOSING}: #{CHIPS.join(', ')} have no #{name}"] unless answers

      CONTROLLERS.reject { |controller, title| no?(row[controller]) == no?(answers[title]) }
                 .map { |controller, title| "#{CHOOSING}: #{controller} on #{name}: #{row[controller]}, but the run says #{answers[title]}" }
    end

    def no?(cell)
      cell.match?(/\Ano[t:]?\b/)
    end

    def chosen
      DataTables.hashes('chip_choices')
    end

    def simulated
      CHIPS.flat_map { |name| DataTables.hashes(name) }.to_h { |row| [row['chip'], row] }
    end
  end
end

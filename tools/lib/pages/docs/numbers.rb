# SPDX-License-Identifier: MIT
# The numbers of docs/figures.json that are counted in the sources: proofs of functions, steps
# recorded from the notes' firmware, faults, random plants, simulated chips, and the minutes that
# `tools/test` takes.
require_relative '../../demo/plot'
require_relative '../../demo/random_plants'
require_relative '../../demo/faults'
require_relative '../../prove/proofs'

module Numbers
  FAMILIES = 'test/chips/families/families.rb'.freeze
  BESIDE = ['model', PRIMITIVES, THEOREMS].freeze # of no function
  PICS = 'test/chips/target/figures.rb'.freeze
  CORES = 'test/chips/cores/cores.rb'.freeze

  class << self
    def counted
      { 'proofs' => Proofs.all.count { |proof| !BESIDE.include?(proof.group) },
        'rows' => Dir['test/support/vectors/*_firmware.csv'].sum { |path| File.readlines(path).size - 1 },
        'faults' => FAULT_LOOPS.values.sum(&:runs), 'plants' => LONG_SEEDS.size * LONG_PLANTS,
        'chips' => chips.size, 'minutes' => (seconds + 30) / 60 }
    end

    private

    # A chip may be tried in several ways, one for each memory model.
    def chips
      pics = File.read(PICS)[/^PROCESSORS = .*?\}/].scan(/=> '([^,']+)/)
      cores = File.read(CORES)[/^  ALL = \{.*?\}/m].scan(/^ +'([^']+)' =>/)
      (pics + cores + File.read(FAMILIES).scan(/\btitle: '([^,']+)/)).flatten.uniq
    end

    # Of the daily parts, on two cores.
    def seconds
      File.readlines('test/parts.txt').map(&:split).select { |words| words[1] == 'daily' }.sum { |words| words[2].to_i }
    end
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What each feature of fixpid_pid adds to a build with none: to the longest path
# of a step, and to the flash of `init` and the step. Both are of the code alone.
module Features
  TITLES = { 'FILTER' => 'derivative filter', 'WEIGHT' => 'setpoint weight, P on the measurement',
             'REVERSE' => 'reverse acting', 'DERIVATIVE_ON_ERROR' => 'derivative on the error',
             'FEEDFORWARD' => 'feed-forward', 'MANUAL' => 'manual, automatic, seed',
             'COARSE_KI' => 'ki above 0.5 per step', 'TRACK' => 'tracking' }.freeze
  # Each chip in a build: the columns.
  BUILDS = [%w[atmega328p -O2], %w[cortex-m0 -O2], %w[pic18f4520 object]].freeze
  NONE = 0
  ALL = 0xFF

  # A build of some features on a chip.
  Priced = Struct.new(:bits, :chip, :build) do
    def subject
      defines = bits == ALL ? [] : [format('FIXPID_PID_FEATURES=0x%02X', bits)]
      controller = Controller.new(id: format('pid_%02x', bits), name: 'pid', title: 'PID', calls: %w[init step],
                                  defines: defines, turns: FILTER_TURNS)
      Subject.new(controller, CHIPS.find { |one| one.name == chip }, build, nil)
    end

    def key
      "price-#{subject.key}"
    end
  end

  class << self
    # The bits, from the header.
    def bits
      header = File.read("#{Host.root}/include/fixpid_pid.h")
      found = header.scan(/^#define FIXPID_PID_HAS_(\w+) (0x\h+)u/).to_h
      raise Host::Failure, 'fixpid_pid.h has other features' if found.keys.sort != TITLES.keys.sort

      found.transform_values { |value| Integer(value) }
    end

    def all
      [NONE, *bits.values, ALL].flat_map { |bits| BUILDS.map { |chip, build| Priced.new(bits, chip, build) } }
    end

    # { priced => [bound, flash] } as a table.
    def table(prices)
      head = ['feature', 'bit', *BUILDS.flat_map { |chip, build| heads(chip, build) }]
      rows = TITLES.map do |name, title|
        [title, "`FIXPID_PID_HAS_#{name}` #{format('0x%02X', bits[name])}", *cells(prices, bits[name], '%+d')]
      end
      [head, ['none of them', '0x00', *cells(prices, NONE, '%d')], *rows, ['all', '0xFF', *cells(prices, ALL, '%+d')]]
    end

    private

    def heads(chip, build)
      subject = Priced.new(ALL, chip, build).subject
      name = [subject.chip.title, (build if build.start_with?('-'))].compact.join(' ')
      ["#{name}, #{subject.chip.cost}", 'bytes']
    end

    def cells(prices, bits, format)
      BUILDS.flat_map do |chip, build|
        none = prices.fetch(Priced.new(NONE, chip, build))
        prices.fetch(Priced.new(bits, chip, build)).zip(none).map do |now, least|
          format(format, bits == NONE ? now : now - least)
        end
      end
    end
  end
end

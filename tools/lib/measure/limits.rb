# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../modules'
require_relative 'limit'
require_relative 'tables'

# The promises.
module Limits
  BOUND_MOST = 1.10
  RATIOS = { 'ATmega328P' => 1.00, 'Cortex-M0' => 1.25, 'Cortex-M4' => 1.25 }.freeze

  # Controller, chip, build, variant: the figures and their limits.
  STEPS = {
    ['an937', 'pic18f4520', 'object', nil] => { most: 292, step_flash: 900 },
    ['an937', 'pic18f4520', 'object', 'C'] => { most: 411 },
    ['an937', 'pic18f4520', 'object', 'access-RAM'] => { most: 252, needed: 1125, ram: 37 },
    ['an937', 'pic18f4520', 'pointer', nil] => { most: 579 },
    ['an964', 'pic16f684', 'object', nil] => { most: 525, step_flash: 365 },
    ['an964', 'pic16f684', 'object', 'C'] => { most: 545, step_variables: 17 },
    ['an964', 'pic16f684', 'pointer', nil] => { most: 1250 },
    ['an964_8bit', 'pic16f684', 'object', nil] => { most: 340, step_flash: 360 },
    ['an964_8bit', 'pic16f684', 'object', 'C'] => { most: 378 },
    ['an964_8bit', 'pic16f684', 'pointer', nil] => { most: 1250 },
    ['an964', 'pic16f887', 'object', nil] => { most: 690 },
    ['an964', 'pic16f887', 'object', 'C'] => { most: 960 },
    ['an964', 'pic16f887', 'pointer', nil] => { most: 960 },
    ['an964_8bit', 'pic16f887', 'object', nil] => { most: 440 },
    ['an964_8bit', 'pic16f887', 'object', 'C'] => { most: 520 },
    ['an964_8bit', 'pic16f887', 'pointer', nil] => { most: 710 },
    ['an964', 'pic16f1788', 'object', nil] => { most: 610 },
    ['an964', 'pic16f1788', 'object', 'C'] => { most: 780 },
    ['an964', 'pic16f1788', 'pointer', nil] => { most: 740 },
    ['an964_8bit', 'pic16f1788', 'object', nil] => { most: 385 },
    ['an964_8bit', 'pic16f1788', 'object', 'C'] => { most: 440 },
    ['an964_8bit', 'pic16f1788', 'pointer', nil] => { most: 520 },
    ['an937', 'pic18f26k22', 'object', nil] => { most: 345 },
    ['pid', 'pic18f26k22', 'object', nil] => { most: 1700 },
    ['an937', 'atmega328p', '-O2', nil] => { most: 265 },
    ['an937', 'atmega328p', '-Os', nil] => { most: 270 },
    ['an964', 'atmega328p', '-O2', nil] => { most: 228 },
    ['an964', 'atmega328p', '-Os', nil] => { most: 240 },
    ['an964_8bit', 'atmega328p', '-O2', nil] => { most: 152 },
    ['an964_8bit', 'atmega328p', '-Os', nil] => { most: 191 },
    ['pid_plain', 'pic18f4520', 'object', 'access-RAM'] => { most: 800 },
    ['pid_plain', 'atmega328p', '-O2', nil] => { most: 360 },
    ['pid_plain', 'cortex-m0', '-O2', nil] => { most: 110 },
    ['pid_plain', 'cortex-m4', '-O2', nil] => { most: 75 },
    ['pid', 'pic18f4520', 'object', nil] => { most: 1320, linked: 5180 },
    ['pid', 'atmega328p', '-O2', nil] => { most: 519 },
    ['pid', 'atmega328p', '-Os', nil] => { needed: 1800 },
    ['pid', 'cortex-m0', '-O2', nil] => { most: 157, needed: 950 },
    ['pid', 'cortex-m4', '-O2', nil] => { most: 112 },
    ['pid_typical', 'pic18f4520', 'object', 'access-RAM'] => { most: 705, bound: 745, needed: 2950 },
    ['pid_typical', 'atmega328p', '-O2', nil] => { most: 300, bound: 320, needed: 900 },
    ['pid_typical', 'cortex-m0', '-O2', nil] => { most: 90, bound: 95, needed: 500 },
    ['pid_typical', 'cortex-m4', '-O2', nil] => { most: 62, bound: 64, needed: 450 },
    ['pid_typical', 'rv32imc', '-O2', nil] => { most: 74 },
    ['an937', 'rv32imc', '-O2', nil] => { most: 47 },
    ['an964', 'rv32imc', '-O2', nil] => { most: 93 },
    ['an964_8bit', 'rv32imc', '-O2', nil] => { most: 90 },
    ['pid_plain', 'rv32imc', '-O2', nil] => { most: 88 },
    ['pid', 'rv32imc', '-O2', nil] => { most: 125, needed: 1050 },
    ['an937', 'rv32ec', '-Os', nil] => { most: 210, needed: 400 },
    ['an964', 'rv32ec', '-Os', nil] => { most: 232, needed: 910 },
    ['an964_8bit', 'rv32ec', '-Os', nil] => { most: 186, needed: 750 },
    ['pid', 'rv32ec', '-Os', nil] => { most: 480, needed: 1045 },
    ['an937', 'attiny85', '-Os', nil] => { most: 675 },
    ['an964', 'attiny85', '-Os', nil] => { most: 305 },
    ['an964_8bit', 'attiny85', '-Os', nil] => { most: 230 },
    ['pid', 'attiny85', '-O2', nil] => { most: 1360 }
  }.freeze

  # What stands beside a controller: [function, chip, build, figures].
  CALLED = Modules::ALL.values.flat_map { |entry| entry.fetch(:limits, {}).to_a }.flat_map do |function, places|
    places.map { |place, figures| [function, *place.split, figures] }
  end.freeze

  WORDS = { most: 'worst', bound: 'bound', step_flash: 'flash of the step', needed: 'flash with init', linked: 'flash as linked', step_variables: 'variables of the step',
            ram: 'RAM in all' }.freeze

  CALLED_WORDS = { most: 'worst', flash: 'flash', instance: 'RAM each' }.freeze

  class << self
    # Of what was measured of them.
    def modules(called)
      CALLED.flat_map do |function, chip, build, limits|
        subject, functions = called.find { |one, all| one.chip.name == chip && one.build == build && all.key?(function) }
        raise Host::Failure, "no #{function} #{chip} #{build} to limit" unless subject

        limits.map do |figure, most|
          what = "#{function}, #{subject.chip.title}, #{build}, #{CALLED_WORDS.fetch(figure)}"
          Limit.new(what, most, functions[function][figure], figure == :most ? subject.chip.cost : 'bytes')
        end
      end
    end

    def all(measured, plain_c)
      steps(measured) + bounds(measured) + ratios(measured, plain_c)
    end

    # Of the worst found; the largest is in the table of limits. What plain
    # questions find is no measure of the code's longest path. Nor is the bound of
    # an ATtiny85, whose library turns 8 times for a weight and 16 times for a gain.
    def bounds(measured)
      subject, figures = measured.reject { |one, _| one.controller.questions == 'PLAIN' || one.chip.name == 'attiny85' }
                                 .max_by { |_, one| one.bound.fdiv(one.most) }
      [Limit.new("bound by worst found, largest: #{subject}", BOUND_MOST, figures.bound.fdiv(figures.most))]
    end

    private

    def steps(measured)
      STEPS.flat_map do |(controller, chip, build, variant), limits|
        subject = measured.keys.find { |one| one.is?(controller, chip, build, variant) } or
          raise Host::Failure, "no #{[controller, chip, build, variant].compact.join(' ')} to limit"
        limits.map { |figure, most| step(subject, measured[subject], figure, most) }
      end
    end

    def step(subject, figures, figure, most)
      now = figure == :ram ? figures.instance + figures.fixed : figures[figure]
      unit = { most: subject.chip.cost, bound: subject.chip.cost, step_variables: 'bytes', ram: 'bytes' }.fetch(figure, subject.chip.flash)
      Limit.new("#{subject}, #{WORDS.fetch(figure)}", most, now, unit)
    end

    def ratios(measured, plain_c)
      plain_c.map do |subject, most|
        Limit.new("#{subject}, by the straightforward form", RATIOS.fetch(subject.chip.title),
                  measured.fetch(subject).most.fdiv(most).round(2))
      end
    end
  end
end

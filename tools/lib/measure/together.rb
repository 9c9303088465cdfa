# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# A firmware with a controller, its guard and a table, linked for an ATmega328P: what all
# of it takes, the C library's start among it.
module Together
  FEATURES = { 'typical' => '0x00', 'all' => '0xFF' }.freeze # of FIXPID_PID_FEATURES
  LEVELS = %w[-Os -O2].freeze
  FLAGS = %w[-mmcu=atmega328p -std=c99 -ffunction-sections -fdata-sections -Wl,--gc-sections -Iinclude].freeze
  SECTIONS = %w[text data bss].freeze

  Built = Struct.new(:features, :level) do
    def key
      "together-#{features}#{level}"
    end

    # The bytes of each section.
    def sizes
      path = "#{Host.folder}/#{key}.elf"
      sources = %w[pid guard table].flat_map { |name| Modules.sources(name, Host.root) }
      Host.output('avr-gcc', level, *FLAGS, "-DFIXPID_PID_FEATURES=#{FEATURES.fetch(features)}", *Harness::WARNINGS,
                  'test/tools/cost/bare_together.c', *sources, '-o', path)
      Host.output('avr-size', path).lines.last.split.first(SECTIONS.size).map { |size| Integer(size) }
    end
  end

  class << self
    def all
      FEATURES.keys.product(LEVELS).map { |features, level| Built.new(features, level) }
    end

    # { built => sizes } as a table.
    def table(sizes)
      [['`fixpid_pid`', 'built', 'flash', 'RAM'],
       *sizes.map { |built, (text, data, bss)| ["#{built.features} features", built.level, text + data, data + bss] }]
    end
  end
end

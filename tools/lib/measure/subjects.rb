# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../modules'

# What is measured: each controller on each chip, in each mode and build. A new
# controller takes an entry in CONTROLLERS, a driver in test/chips/target/, with its
# questions in cases.c and what they consist of in test/tools/cost/sequence.c, and there
# an application in bare.c and kept/NAME.csv with its first line.

# `calls` are the functions that every application has; `questions` says that
# only some are measured, as in search.h, and `defines` how all of it is built.
# `plain_c` says that there is test/tools/cost/plain_c_NAME.c. `turns` are those of
# loops that count no constant down, by function.
Controller = Struct.new(:id, :name, :title, :pics, :calls, :questions, :defines, :plain_c, :turns,
                        keyword_init: true) do
  def function(verb)
    "fixpid_#{name}_#{verb}"
  end
end

# The derivative filter shifts by 0 to 7, tested once more than it shifts. So is a
# gain of 15 bits on an AVR without a multiplier.
GAIN_TURNS = { '__mulsi3_helper' => 16 }.freeze
FILTER_TURNS = { 'fixpid_pid_step' => 8, 'differentiate' => 8, **GAIN_TURNS }.freeze

# AN937's gains have 8 bits.
BYTE_TURNS = { '__mulsi3_helper' => 9 }.freeze

CONTROLLERS = [
  Controller.new(id: 'an937', name: 'an937', title: 'AN937', pics: %w[pic18f4520], calls: %w[init tick step],
                 plain_c: true, turns: BYTE_TURNS),
  Controller.new(id: 'an964', name: 'an964', title: 'AN964', pics: %w[pic16f684 pic18f4520], calls: %w[init step],
                 plain_c: true),
  Controller.new(id: 'an964_8bit', name: 'an964_8bit', title: 'AN964 8-bit', pics: %w[pic16f684 pic18f4520],
                 calls: %w[init step], plain_c: true),
  Controller.new(id: 'pid_typical', name: 'pid', title: 'PID, typical', pics: %w[pic18f4520], calls: %w[init step],
                 questions: 'REDUCED', turns: GAIN_TURNS, defines: %w[FIXPID_PID_FEATURES=0x00]),
  Controller.new(id: 'pid_plain', name: 'pid', title: 'PID, plain', pics: %w[pic18f4520], calls: %w[init step],
                 questions: 'REDUCED', turns: FILTER_TURNS),
  Controller.new(id: 'pid', name: 'pid', title: 'PID', pics: %w[pic18f4520], calls: %w[init step],
                 turns: FILTER_TURNS)
].freeze

# What stands beside them, measured by the program of test/chips/modules.
MODULES = Modules::ALL.keys.select { |name| Modules::ALL[name].key?(:calls) }.freeze

# The same controller built otherwise, for one chip in its first build:
# definitions and sources that are added.
Variant = Struct.new(:controller, :chip, :name, :defines, :sources)

VARIANTS = [
  Variant.new('an964', 'pic16f684', 'C', %w[FIXPID_NO_ASSEMBLY], []),
  Variant.new('an964_8bit', 'pic16f684', 'C', %w[FIXPID_NO_ASSEMBLY], []),
  *%w[pic16f887 pic16f1788].product(%w[an964 an964_8bit]).map do |chip, controller|
    Variant.new(controller, chip, 'C', %w[FIXPID_NO_ASSEMBLY], [])
  end,
  Variant.new('an937', 'pic18f4520', 'C', %w[FIXPID_NO_ASSEMBLY], []),
  Variant.new('an937', 'pic18f4520', 'access-RAM',
              %w[FIXPID_AN937_PLACE=__at(0x20) FIXPID_AN937_SIGNALS_PLACE=__at(0x38)], []),
  Variant.new('pid', 'pic18f4520', 'access-RAM',
              %w[FIXPID_PID_PLACE=__at(0x58) FIXPID_PID_SIGNALS_PLACE=__at(0x3D)
                 FIXPID_PID_OPERANDS_PLACE=__at(0x4C)],
              []),
  Variant.new('an937', 'atmega328p', 'C', %w[FIXPID_NO_ASSEMBLY], []),
  Variant.new('an964', 'atmega328p', 'C', %w[FIXPID_NO_ASSEMBLY], []),
  Variant.new('an964_8bit', 'atmega328p', 'C', %w[FIXPID_NO_ASSEMBLY], [])
].freeze

# `builds` are modes on a PIC, options elsewhere; `cost` is what is counted. A PIC
# that is `like` one which `pics` name has its controllers and needs no port.
Chip = Struct.new(:name, :title, :kind, :builds, :cost, :flash, :like, keyword_init: true) do
  # Where its configuration.h and its support/ are.
  def board
    like ? 'test/tools/cost/pic' : "port/pic/#{name}"
  end

  # Of tools/lib/build/build_pic.
  def build_pic
    like ? ['--board', board] : []
  end
end

MODES = %w[object pointer].freeze
OPTIONS = %w[-O2 -Os].freeze

CHIPS = [
  Chip.new(name: 'pic16f684', title: 'PIC16F684', kind: :pic, builds: MODES, cost: 'cycles', flash: 'words'),
  Chip.new(name: 'pic18f4520', title: 'PIC18F4520', kind: :pic, builds: MODES, cost: 'cycles', flash: 'bytes'),
  Chip.new(name: 'pic16f887', title: 'PIC16F887', kind: :pic, builds: MODES, cost: 'cycles', flash: 'words', like: 'pic16f684'),
  Chip.new(name: 'pic16f1788', title: 'PIC16F1788', kind: :pic, builds: MODES, cost: 'cycles', flash: 'words', like: 'pic16f684'),
  Chip.new(name: 'pic18f26k22', title: 'PIC18F26K22', kind: :pic, builds: MODES, cost: 'cycles', flash: 'bytes', like: 'pic18f4520'),
  Chip.new(name: 'atmega328p', title: 'ATmega328P', kind: :avr, builds: OPTIONS, cost: 'cycles', flash: 'bytes'),
  Chip.new(name: 'attiny85', title: 'ATtiny85', kind: :avr, builds: OPTIONS, cost: 'cycles', flash: 'bytes'),
  Chip.new(name: 'cortex-m0', title: 'Cortex-M0', kind: :arm, builds: OPTIONS, cost: 'instructions', flash: 'bytes'),
  Chip.new(name: 'cortex-m4', title: 'Cortex-M4', kind: :arm, builds: OPTIONS, cost: 'instructions', flash: 'bytes'),
  Chip.new(name: 'rv32imc', title: 'RV32IMC', kind: :riscv, builds: OPTIONS, cost: 'instructions', flash: 'bytes'),
  Chip.new(name: 'rv32ec', title: 'RV32EC', kind: :riscv, builds: OPTIONS, cost: 'instructions', flash: 'bytes')
].freeze

# src/ has a folder for each: a source that is not meant for a chip is empty.
CHIP_FOLDERS = 'pic14,pic18'

# One controller in one build on one chip: a row of the table. `form` is the
# library's or :plain_c, test/tools/cost/plain_c_NAME.c: the same law as one writes
# it for a 32-bit machine.
Subject = Struct.new(:controller, :chip, :build, :variant, :form) do
  def key
    [form, controller.id, chip.name, build.delete('-'), variant&.name].compact.join('-')
  end

  # A PIC and an ATtiny are not compared: nobody writes 32-bit products for them.
  def has_plain_c?
    controller.plain_c && %i[avr arm].include?(chip.kind) && chip.name != 'attiny85' && variant.nil?
  end

  def plain_c
    Subject.new(controller, chip, build, nil, :plain_c)
  end

  def plain_c?
    form == :plain_c
  end

  def step
    plain_c? ? "plain_c_#{controller.name}_step" : "#{controller.function('step')}#{features}"
  end

  # The suffix of the step's name: FIXPID_SUFFIXED in include/fixpid.h.
  def features
    controller.defines.to_a.join(' ')[/FIXPID_PID_FEATURES=(?!0xFF)(0x\h+)/, 1]&.prepend('_')
  end

  def driver
    plain_c? ? "test/tools/cost/driver_plain_c_#{controller.name}.c" : "test/chips/target/driver_#{controller.name}.c"
  end

  def built
    variant ? "#{build}, #{variant.name}" : build
  end

  def to_s
    [controller.title, chip.title, built, form].compact.join(', ')
  end

  def is?(*names)
    [controller.id, chip.name, build, variant&.name] == names
  end

  # Whether all words are among those that describe it.
  def matches?(words)
    own = [controller.id, chip.name, build, chip.kind.to_s, variant&.name].compact
    words.empty? || words.group_by { |word| Subject.kind_of_word(word) }
                         .all? { |_, group| group.any? { |word| own.include?(word) } }
  end

  def defines
    object = chip.kind == :pic && build == 'object'
    mode = object ? ["-DFIXPID_#{controller.name.upcase}_OBJECT=#{controller.name}_controller"] : []
    mode + (controller.defines.to_a + (variant ? variant.defines : [])).map { |define| "-D#{define}" }
  end

  # What every application needs, and with what only some do.
  def sources
    return ["test/tools/cost/plain_c_#{controller.name}.c"] if plain_c?

    ["src/#{controller.name}/fixpid_#{controller.name}.c"] + Dir.glob("src/*/fixpid_#{controller.name}_{#{CHIP_FOLDERS}}.c", base: Host.root)
  end

  def all_sources
    plain_c? ? sources : sources + Dir.glob("src/*/fixpid_#{controller.name}_{more,track}.c", base: Host.root).sort
  end

  class << self
    def all
      CHIPS.flat_map do |chip|
        CONTROLLERS.select { |one| chip.kind != :pic || one.pics.include?(chip.like || chip.name) }
                   .flat_map { |controller| of(controller, chip) }
      end
    end

    # And the straightforward forms.
    def with_plain_c
      all + all.select(&:has_plain_c?).map(&:plain_c)
    end

    def of(controller, chip)
      plain = chip.builds.map { |build| new(controller, chip, build, nil) }
      variants = VARIANTS.select { |one| one.controller == controller.name && one.chip == chip.name }
      plain.take(1) + variants.map { |one| new(controller, chip, chip.builds.first, one) } + plain.drop(1)
    end

    WORDS = {
      controller: CONTROLLERS.map(&:id) | MODULES,
      chip: CHIPS.map(&:name) + CHIPS.map { |chip| chip.kind.to_s },
      build: MODES + OPTIONS,
      variant: VARIANTS.map(&:name)
    }.freeze

    def kind_of_word(word)
      WORDS.keys.find { |kind| WORDS[kind].include?(word) }
    end
  end
end

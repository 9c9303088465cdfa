# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What the tests of the static bounds share: programs in assembly, each of a
# folder beside this file, on simulated chips. They are assembled when they are needed.
require 'fileutils'
require_relative '../../../test/tools/gates/gate'
%w[host meters].each { |name| require "#{PROJECT}/tools/lib/measure/#{name}" }
Host.setup(PROJECT)

# One of them, for gpsim, with a map as gplink writes it.
class PicProgram
  attr_reader :source

  def initialize(source, kind, options)
    @source = source
    @kind = kind
    @options = options
  end

  def code
    @code ||= @kind.new(path)
  end

  # Cycles of a routine, and levels of the return stack that all has used.
  def most(name)
    run(name)[/most (\d+)/, 1].to_i
  end

  def depth(name)
    run(name)[/levels (\d+)/, 1].to_i
  end

  private

  def path
    @path ||= Programs.path(source, @options).tap do |path|
      Host.output('gpasm', '-w1', *@options, '-c', '-o', "#{path}.o", source)
      Host.output('gplink', '-m', '-o', "#{path}.hex", "#{path}.o")
    end
  end

  def run(name)
    Host.output(PicProgram.meter, "#{path}.cod", name, '10000')
  end

  def self.meter
    @meter ||= "#{Host.folder}/function".tap { Harness.build_function }
  end
end

# One for simavr.
class AvrProgram
  attr_reader :source

  def initialize(source, options)
    @source = source
    @options = options
  end

  def code
    @code ||= AvrCode.new(elf)
  end

  # Cycles of a routine, and bytes of its stack with those of interrupts.
  def most(name)
    run(name)[/most (\d+)/, 1].to_i
  end

  def depth(name)
    run(name)[/stack of \w+ (\d+)/, 1].to_i
  end

  private

  def elf
    @elf ||= "#{Programs.path(source, @options)}.elf".tap do |elf|
      Host.output('avr-gcc', '-mmcu=atmega328p', '-nostartfiles', *@options.map { |one| "-Wa,--defsym,#{one.delete_prefix('-D')}=1" },
                  '-o', elf, source)
    end
  end

  def run(name)
    done, address = ['done', name].map { |symbol| code.symbol(symbol).to_s(16) }
    Host.output(AvrProgram.meter, elf, 'atmega328p', done, name, address)
  end

  def self.meter
    @meter ||= "#{Host.folder}/calls".tap do |path|
      Host.output('gcc', '-std=c99', '-O2', *Harness::WARNINGS, 'test/tools/cost/avr/calls.c', '-lsimavr', '-o', path)
    end
  end
end

# One for a core in QEMU, with the core's timings.
class CoreProgram
  # What a routine of it says of itself; `refusal` is a part of why it has no figures.
  Routine = Struct.new(:name, :instructions, :cycles, :stack, :measured, :refusal)

  FIGURES = /^(\w+): +[@#] (\d+) instructions, ([\d or]+) cycles, (\d+) bytes(?:, (\d+) measured)?$/.freeze
  REFUSALS = /^(\w+): +[@#] refused: (.*)$/.freeze

  attr_reader :name, :timings

  def initialize(name, core, kind, timings)
    @name = name
    @core = CORES.fetch(core)
    @kind = kind
    @timings = timings
    @source = "#{__dir__}/cores/#{name}.s"
  end

  def code(timing = Timing::INSTRUCTIONS)
    @kind.new(elf, timing)
  end

  def routines
    @routines ||= text.scan(FIGURES).map { |name, *figures| routine(name, *figures) } +
                  text.scan(REFUSALS).map { |name, why| Routine.new(name, nil, nil, nil, nil, why) }
  end

  # Instructions and bytes of stack.
  def measured(name)
    @measured ||= @core.run(elf)
    @measured.match(/^#{name} stack (\d+) instructions (\d+)$/).captures.map(&:to_i).reverse
  end

  private

  def text
    @text ||= File.read(@source)
  end

  def routine(name, instructions, cycles, stack, measured)
    Routine.new(name, instructions.to_i, cycles.scan(/\d+/).map(&:to_i), stack.to_i, (measured || instructions).to_i)
  end

  def elf
    @elf ||= "#{Host.folder}/core-#{@name}.elf".tap do |elf|
      each = routines.reject(&:refusal).map { |one| "EACH(#{one.name})" }.join(' ')
      object = elf.sub(/elf\z/, 'o')
      @core.compile('-c', @source, '-Wa,-Itools/bound/test/cores', '-o', object)
      @core.link(elf, '-O2', *Harness::WARNINGS, "-DROUTINES=#{each}", '-Itest/support', '-Wl,--no-gc-sections',
                 'tools/bound/test/cores/meter.c', object, *@core.sources)
    end
  end
end

# All of a folder, by chip.
module Programs
  KINDS = { 'pages' => Pic14Code, 'pic14' => Pic14Code, 'pic14e' => Pic14EnhancedCode, 'pic18' => Pic18Code }.freeze

  CORES = [['cortex_m0', 'cortex-m0', ArmCode, [Timing::CortexM0.new(1), Timing::CortexM0.new(32)]],
           ['cortex_m3', 'cortex-m4', ArmCode, [Timing::CortexM3.new]], ['cortex_m4', 'cortex-m4', ArmCode, [Timing::CortexM4.new]],
           ['ibex', 'rv32imc', RiscvCode, [Timing::Ibex.new]]].freeze

  class << self
    def cores
      CORES.map { |arguments| CoreProgram.new(*arguments) }
    end

    def all(folder, *options)
      Dir["#{__dir__}/#{folder}/*.{asm,s}"].sort.to_h { |source| [name(source), one(source, options)] }
    end

    def path(source, options)
      kind = File.basename(File.dirname(source))
      "#{Host.folder}/#{[kind, name(source), *options].join('-').tr('_', '-')}".tap { |path| FileUtils.mkdir_p(File.dirname(path)) }
    end

    private

    def name(source)
      File.basename(source)[/\w+/]
    end

    def one(source, options)
      source.end_with?('.s') ? AvrProgram.new(source, options) : PicProgram.new(source, KINDS.fetch(name(source)), options)
    end
  end
end

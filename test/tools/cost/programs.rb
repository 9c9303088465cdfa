# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What the tests of the static bounds share: programs in assembly, each of a
# folder beside this file, on simulated chips. They are assembled when they are needed.
require 'fileutils'
require_relative '../gates/gate'
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

# All of a folder, by chip.
module Programs
  KINDS = { 'pages' => Pic14Code, 'pic14' => Pic14Code, 'pic14e' => Pic14EnhancedCode, 'pic18' => Pic18Code }.freeze

  class << self
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

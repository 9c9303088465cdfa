# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The controllers on chip families that only a simulator's program knows, bit for
# bit, and what their steps cost there: see test/chips/families/run.
require_relative '../../../tools/lib/faults/faults'
require_relative '../../../tools/lib/measure/subjects'
require_relative '../../../tools/lib/test/named'
require_relative 'alone'
require_relative 'beside'
require_relative 'document'
require_relative 'metered'
require_relative 'msp430'
require_relative 'ucsim'

TITLES = CONTROLLERS.to_h { |one| [one.name, one.title[/[^,]*/]] }.freeze
ALL = TITLES.keys.freeze
S51 = { simulator: %w[s51 -t 52 -X 12M], order: 'little', interface: 'xram[0xffff]', memory: 'iram', cycle_ns: 1000.0 }.freeze
SPDK = ENV.fetch('SPDK', 'spdk').freeze
NO_RAM_8051 = [/Could not get \d+ consecutive bytes/, 'no: its variables do not fit into 128 bytes'].freeze
NO_RAM_PIC16 = [/No target memory available for section "UDL_/, 'no: a bank does not hold its variables'].freeze
PIC16 = { run: PicRun, refused: { 'pid' => NO_RAM_PIC16 }, limits: {} }.freeze
SMALL = (ALL - %w[pid]).freeze
NO_RAM_PADAUK = [/RAM value \d+ too large/, 'no: its variables do not fit into the RAM'].freeze

# `refused` says why a controller is not for a family, and how its linker says so;
# `limits` are of the worst step.
FAMILIES = [
  MeteredChip.new(name: 'pic16f887', title: 'PIC16F887', controllers: SMALL, **PIC16),
  MeteredChip.new(name: 'pic16f1788', title: 'PIC16F1788', controllers: SMALL, **PIC16),
  MeteredChip.new(name: 'pic18f26k22', title: 'PIC18F26K22', run: PicRun, controllers: ALL, refused: {}, limits: {}),
  MeteredChip.new(name: 'attiny85', title: 'ATtiny85', run: AvrRun, controllers: ALL, refused: {}, limits: {}),
  Ucsim.new(name: 'stm8', title: 'STM8', controllers: ALL, refused: {}, compiler: %w[-mstm8], linker: [],
            simulator: %w[sstm8 -t S208], order: 'big', interface: 'rom[0x57ff]', memory: 'rom', cycle_ns: 500.0,
            limits: { 'an937' => 495, 'an964' => 335, 'an964_8bit' => 345, 'pid' => 2240 }),
  Ucsim.new(name: '8051-small', title: '8051, small', controllers: SMALL,
            refused: { 'pid' => NO_RAM_8051 }, compiler: %w[-mmcs51 --model-small], linker: %w[--iram-size 256],
            limits: { 'an937' => 755, 'an964' => 590, 'an964_8bit' => 415 }, **S51),
  Ucsim.new(name: '8051-stack-auto', title: '8051, small, `--stack-auto`', controllers: ALL,
            refused: {}, compiler: %w[-mmcs51 --model-small --stack-auto], linker: %w[--iram-size 256],
            limits: { 'pid' => 2600 }, **S51),
  Ucsim.new(name: '8051-large', title: '8051, large', controllers: ALL, refused: {}, compiler: %w[-mmcs51 --model-large],
            linker: %w[--iram-size 256 --xram-size 0xff00], limits: {}, **S51),
  Msp430.new(name: 'msp430', title: 'MSP430', controllers: ALL, refused: {}, options: %w[-Os],
             limits: { 'an937' => 1440, 'an964' => 485, 'an964_8bit' => 395, 'pid' => 4350 }),
  # The forms for multipliers of 16 bits where int has 16, as on a dsPIC.
  Msp430.new(name: 'msp430-wide', title: 'MSP430, wide forms', controllers: ALL, refused: {}, options: %w[-Os -U__MSP430__], limits: {}),
  Ucsim.new(name: 'z80', title: 'Z80', controllers: ALL, refused: {}, compiler: %w[-mz80],
            linker: %w[--data-loc 0x8000 --code-loc 0x200], simulator: %w[sz80 -X 1M], order: 'little',
            interface: 'rom[0x7fff]', memory: 'rom', cycle_ns: 1000.0, limits: {}),
  Ucsim.new(name: 'pdk14', title: 'Padauk PDK14', controllers: %w[an964_8bit],
            refused: %w[an937 an964 pid].to_h { |name| [name, NO_RAM_PADAUK] }, compiler: %w[-mpdk14], linker: [],
            simulator: [SPDK, '-t', 'PDK14', '-X', '1M'], order: 'little', interface: 'ram[0x7f]', memory: 'ram', limits: {}),
  Ucsim.new(name: 'pdk15', title: 'Padauk PDK15', controllers: %w[an964 an964_8bit],
            refused: %w[an937 pid].to_h { |name| [name, NO_RAM_PADAUK] }, compiler: %w[-mpdk15], linker: [],
            simulator: [SPDK, '-t', 'PDK15', '-X', '1M'], order: 'little', interface: 'ram[0xff]', memory: 'ram', limits: {})
].freeze

STEPS = 1000
STEPS_LONG = 20_000

# All tests, and the results of runs by family and controller.
class Families
  attr_reader :results, :tests

  def initialize(steps)
    @folder = "#{Host.root}/build/families"
    @steps = steps
    @results = {}
    @mutex = Mutex.new
    @tests = NamedTests.new('test/chips/families/run')
    (exact + refusals + seeded).each { |name, step| @tests.add(name, &step) }
    @tests.add('limits', needs: exact.map(&:first)) { limits }
  end

  # A library with one fault, in src/ of a folder.
  def self.broken(folder, fault)
    FileUtils.mkdir_p(folder)
    FileUtils.cp_r(%w[include src], folder) # the one looks for the other beside it
    fault.seed(folder)
    "#{folder}/src"
  end

  private

  def exact
    FAMILIES.flat_map do |family|
      family.controllers.map { |controller| ["exact #{family.name} #{controller}", -> { compare(family, controller) }] }
    end
  end

  def compare(family, controller)
    result = run(family, controller, 'src')
    raise Host::Failure, result.to_s unless result.different.zero?

    @mutex.synchronize { @results[[family.name, controller]] = result }
  end

  def run(family, controller, source, name = "#{family.name}-#{controller}")
    family.run.new(family, controller, source, "#{@folder}/#{name}").result(questions)
  end

  # Whoever is said to have no room has none.
  def refusals
    FAMILIES.flat_map do |family|
      family.refused.map do |controller, (pattern, _)|
        ["refused #{family.name} #{controller}", -> { refuse(family, controller, pattern) }]
      end
    end
  end

  def refuse(family, controller, pattern)
    run(family, controller, 'src')
  rescue Host::Failure => e
    raise unless e.message.match?(pattern)

    e.message[pattern]
  else
    raise Host::Failure, 'it fits now: test/chips/families/families.rb'
  end

  # What the harness must notice: a fault in each family, and a simulator that says nothing, or
  # is not there.
  def seeded
    wrong = Faults.of('families').each_with_index.map do |fault, number|
      name, controller = fault.words(1)
      ["seeded #{name} #{controller} #{number + 1}", -> { notice(fault, FAMILIES.find { |one| one.name == name }, controller, "seeded-#{number + 1}") }]
    end
    wrong + [['seeded silent', -> { unusable(%w[true]) }], ['seeded missing', -> { unusable(%w[no-such-simulator]) }]]
  end

  def notice(fault, family, controller, name)
    result = run(family, controller, Families.broken("#{@folder}/faulty-#{name}", fault), name)
    raise Host::Failure, "not noticed: #{fault}: #{result}" if result.different.zero?

    result.to_s
  end

  def unusable(simulator)
    family = FAMILIES.find { |one| one.name == 'stm8' }.dup
    family.simulator = simulator
    result = begin
      run(family, 'an964', 'src', "unusable-#{simulator.first}")
    rescue Host::Failure, SystemCallError => e
      return e.message.lines.last.strip
    end
    raise Host::Failure, "not noticed: #{result}"
  end

  def questions
    @mutex.synchronize do
      @questions ||= begin
        FileUtils.mkdir_p(@folder)
        Questions.new(@folder, @steps)
      end
    end
  end

  def limits
    kept = FAMILIES.flat_map { |family| family.limits.map { |controller, most| [family, controller, most] } }
    kept.each do |family, controller, most|
      worst = @results.fetch([family.name, controller]).worst
      raise Host::Failure, "#{family.title}, #{controller}: #{worst}, at most #{most} allowed" if worst > most
    end
    "#{kept.size} kept"
  end
end

Host.setup(File.expand_path('../../..', __dir__))
Dir.chdir(Host.root)
update = ARGV.delete('--update')
long = ARGV.delete('--long') || update
FileUtils.rm_rf('build/families') unless ARGV.first.to_s.match?(/\A-(-list|-help|h)\z/)
families = Families.new(long ? STEPS_LONG : STEPS)
Alone::Tests.new('build/families', update).add(families.tests)
Beside::Tests.new('build/families').add(families.tests)
families.tests.add('document', needs: families.tests.names.grep(/\Aexact /)) do
  document = Document.new(families.results, long)
  update ? document.update : document.check
end
exit families.tests.run(ARGV)

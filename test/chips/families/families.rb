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
BOTH = %w[pointer object].freeze
ALL = TITLES.keys.to_h { |name| [name, BOTH] }.freeze
S51 = { simulator: %w[s51 -t 52 -X 12M], order: 'little', interface: 'xram[0xffff]', memory: 'iram', cycle_ns: 1000.0 }.freeze
SPDK = ENV.fetch('SPDK', 'spdk').freeze
NO_RAM_8051 = [/Could not get \d+ consecutive bytes/, 'no: its variables do not fit into 128 bytes'].freeze
NO_RAM_PIC16 = [/No target memory available for section "UDL_/, 'no: a bank does not hold its variables'].freeze
PIC16 = { run: PicRun, refused: { 'pid' => NO_RAM_PIC16 }, limits: {} }.freeze
SMALL = ALL.reject { |name, _| name == 'pid' }.freeze
NO_RAM_PADAUK = [/RAM value \d+ too large/, 'no: its variables do not fit into the RAM'].freeze

# `refused` says why a controller is not for a family, and how its linker says so;
# `limits` are of the worst step of the object mode or the pointer mode, whichever
# costs less.
FAMILIES = [
  MeteredChip.new(name: 'pic16f887', title: 'PIC16F887', modes: SMALL, **PIC16),
  MeteredChip.new(name: 'pic16f1788', title: 'PIC16F1788', modes: { **SMALL, 'an937' => %w[object] }, **PIC16),
  MeteredChip.new(name: 'pic18f26k22', title: 'PIC18F26K22', run: PicRun, modes: ALL, refused: {}, limits: {}),
  MeteredChip.new(name: 'attiny85', title: 'ATtiny85', run: AvrRun, modes: ALL, refused: {}, limits: {}),
  Ucsim.new(name: 'stm8', title: 'STM8', modes: ALL, refused: {}, compiler: %w[-mstm8], linker: [],
            simulator: %w[sstm8 -t S208], order: 'big', interface: 'rom[0x57ff]', memory: 'rom', cycle_ns: 500.0,
            limits: { 'an937' => 495, 'an964' => 335, 'an964_8bit' => 345, 'pid' => 1715 }),
  Ucsim.new(name: '8051-small', title: '8051, small', modes: SMALL,
            refused: { 'pid' => NO_RAM_8051 }, compiler: %w[-mmcs51 --model-small], linker: %w[--iram-size 256],
            limits: { 'an937' => 755, 'an964' => 590, 'an964_8bit' => 415 }, **S51),
  Ucsim.new(name: '8051-stack-auto', title: '8051, small, `--stack-auto`', modes: TITLES.keys.to_h { |name| [name, %w[object]] },
            refused: {}, compiler: %w[-mmcs51 --model-small --stack-auto], linker: %w[--iram-size 256],
            limits: { 'pid' => 1960 }, **S51),
  Ucsim.new(name: '8051-large', title: '8051, large', modes: ALL, refused: {}, compiler: %w[-mmcs51 --model-large],
            linker: %w[--iram-size 256 --xram-size 0xff00], limits: {}, **S51),
  Msp430.new(name: 'msp430', title: 'MSP430', modes: ALL, refused: {}, options: %w[-Os],
             limits: { 'an937' => 1440, 'an964' => 485, 'an964_8bit' => 395, 'pid' => 3200 }),
  # The forms for multipliers of 16 bits where int has 16, as on a dsPIC.
  Msp430.new(name: 'msp430-wide', title: 'MSP430, wide forms', modes: ALL, refused: {}, options: %w[-Os -U__MSP430__], limits: {}),
  Ucsim.new(name: 'z80', title: 'Z80', modes: ALL, refused: {}, compiler: %w[-mz80],
            linker: %w[--data-loc 0x8000 --code-loc 0x200], simulator: %w[sz80 -X 1M], order: 'little',
            interface: 'rom[0x7fff]', memory: 'rom', cycle_ns: 1000.0, limits: {}),
  Ucsim.new(name: 'pdk14', title: 'Padauk PDK14', modes: { 'an964_8bit' => %w[object] },
            refused: %w[an937 an964 pid].to_h { |name| [name, NO_RAM_PADAUK] }, compiler: %w[-mpdk14], linker: [],
            simulator: [SPDK, '-t', 'PDK14', '-X', '1M'], order: 'little', interface: 'ram[0x7f]', memory: 'ram', limits: {}),
  Ucsim.new(name: 'pdk15', title: 'Padauk PDK15', modes: { 'an964' => BOTH, 'an964_8bit' => BOTH },
            refused: %w[an937 pid].to_h { |name| [name, NO_RAM_PADAUK] }, compiler: %w[-mpdk15], linker: [],
            simulator: [SPDK, '-t', 'PDK15', '-X', '1M'], order: 'little', interface: 'ram[0xff]', memory: 'ram', limits: {})
].freeze

STEPS = 1000
STEPS_LONG = 20_000
STEPS_PLANTED = 250
APART_PLANTED = 8

# All tests, and the results of runs by family, controller and mode.
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

  def broken
    @mutex.synchronize { @broken ||= break_library }
  end

  # Family, controller and mode of what this run leaves out. All else has a result.
  def left_out
    (exact.map(&:first) - @tests.running).map { |name| name.split.drop(1) }
  end

  private

  def exact
    FAMILIES.flat_map do |family|
      family.modes.flat_map do |controller, modes|
        modes.map { |mode| ["exact #{family.name} #{controller} #{mode}", -> { compare(family, controller, mode) }] }
      end
    end
  end

  def compare(family, controller, mode)
    result = run(family, controller, mode, 'src', questions)
    raise Host::Failure, result.to_s unless result.different.zero?

    @mutex.synchronize { @results[[family.name, controller, mode]] = result }
  end

  def run(family, controller, mode, source, questions)
    name = [family.name, controller, mode, File.basename(source)].join('-')
    family.run.new(family, controller, mode, source, "#{@folder}/#{name}").result(questions)
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
    run(family, controller, 'object', 'src', questions)
  rescue Host::Failure => e
    raise unless e.message.match?(pattern)

    e.message[pattern]
  else
    raise Host::Failure, 'it fits now: test/chips/families/families.rb'
  end

  # What the harness must notice.
  def seeded
    wrong = FAMILIES.flat_map do |family|
      family.modes.map do |controller, modes|
        ["seeded #{family.name} #{controller}", -> { notice(family, controller, modes.last) }]
      end
    end
    wrong + [['seeded silent', -> { unusable(%w[true]) }], ['seeded missing', -> { unusable(%w[no-such-simulator]) }]]
  end

  def notice(family, controller, mode)
    # A meter has all recorded rows in it.
    result = run(family, controller, mode, broken, family.is_a?(MeteredChip) ? questions : few)
    raise Host::Failure, "not noticed: #{result}" if result.different.zero?

    result.to_s
  end

  # A simulator that says nothing, or is not there.
  def unusable(simulator)
    family = FAMILIES.find { |one| one.name == 'stm8' }.dup
    family.simulator = simulator
    result = begin
      run(family, 'an964', 'object', "#{Host.root}/src", few)
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

  def few
    @mutex.synchronize do
      @few ||= begin
        FileUtils.mkdir_p("#{@folder}/few")
        Questions.new("#{@folder}/few", STEPS_PLANTED, APART_PLANTED)
      end
    end
  end

  def break_library
    copy = "#{@folder}/broken"
    FileUtils.mkdir_p(@folder)
    FileUtils.cp_r(%w[include src], @folder) # the one looks for the other beside it
    (Faults.of('forms both') + Faults.of('forms families')).each { |fault| fault.seed(@folder) }
    File.rename("#{@folder}/src", copy)
    copy
  end

  # In the mode that costs less, of what ran in all its modes.
  def limits
    kept = FAMILIES.flat_map { |family| family.limits.map { |controller, most| [family, controller, most] } }
                   .reject { |family, controller, _| left_out.any? { |name, other, _| [name, other] == [family.name, controller] } }
    kept.each do |family, controller, most|
      worst = family.modes.fetch(controller).map { |mode| @results[[family.name, controller, mode]]&.worst || most + 1 }.min
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
Alone::Tests.new('build/families', -> { families.broken }, update).add(families.tests)
Beside::Tests.new('build/families').add(families.tests)
families.tests.add('document', needs: families.tests.names.grep(/\Aexact /)) do
  document = Document.new(families.results, long, families.left_out)
  update ? document.update : document.check
end
exit families.tests.run(ARGV)

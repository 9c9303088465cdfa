# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../../../tools/lib/modules'
require_relative 'machines'

# What stands beside a controller, in the program of test/chips/modules/: all recorded
# rows and random calls, on this machine against their definitions, and on the others,
# where the digest of all answers must be this machine's.
class CalledModule
  FOLDER = 'test/chips/modules'
  FLAGS = %W[-I#{WORK} -I#{FOLDER} #{FOLDER}/main.c test/support/numbers.c].freeze
  MORE_NUMBERS = %w[test/support/numbers_control.c test/support/numbers_pid.c].freeze
  DEFINITIONS = %w[-DCALLS_DEFINED -Isrc test/support/reference.c test/support/reference_control.c
                   test/support/reference_pid.c].freeze
  HOST = Machine::ALL.fetch('host')
  AVR = Machine.new('atmega1284p', %w[avr-gcc -mmcu=atmega1284p -std=gnu99], %w[test/chips/avr/avr_stdio.c]) { |program| ['test/chips/avr/run', program] }
  OTHERS = { 'avr' => AVR, 'cortex_m0' => Machine::ALL.fetch('cortex-m0'), 'cortex_m3' => Machine::ALL.fetch('cortex-m3') }.freeze

  # What XC8 makes of a module depends on the chip's class in few of them.
  XC8_MACHINES = Hash.new(%w[xc8_pic14]).update('table' => XC8).freeze

  # What is metered, if not `step`.
  FUNCTIONS = { 'gains' => %w[from_milli to_milli], 'record' => %w[pack unpack], 'autotune' => %w[step result],
                'step_error' => %w[step_error state restore], 'table' => %w[at], 'link' => %w[step receive answer] }.freeze

  # Whether a machine has the same of the autotuner's record, too.
  MORE_CALLS = { 'autotune' => %w[-DCALLS_RECORD] }.freeze

  # Where the calls of a module with its rows, each of its functions among them, need more
  # than 32 KB.
  CHIPS = %w[autotune guard step_error link].to_h { |name| [name, 'pic18f26k22'] }.freeze

  # The autotuner has no definition in C: test/model/autotune compares it.
  def initialize(name)
    @name = name
    @module = Modules::PARTS.dig(name, :of) || name
    @functions = FUNCTIONS.fetch(name, %w[step]).map { |verb| "fixpid_#{@module}_#{verb}" }
  end

  # name => what is done
  def tests
    { 'host' => -> { compared? ? against_definition('src') : answers }, 'seeded' => -> { seeded }, 'pic18' => -> { pic18 }, **by_name,
      **others.transform_values { |machine| -> { Target.same(answers, digests(machine)) } } }
      .transform_keys { |test| "#{test} #{@name}" }
  end

  private

  def others
    OTHERS.merge(XC8_MACHINES[@name].to_h { |name| [name, Machine::ALL.fetch(name)] })
  end

  def compared?
    @name != 'autotune'
  end

  def sources(folder = 'src')
    Modules.linked(@module, File.dirname(folder)).map { |file| Pathname("#{folder}/../#{file}").cleanpath.to_s }
  end

  # What makes the calls, with its recorded rows.
  def calls
    recorded = "test/support/vectors/#{@name}.csv"
    maker = "#{FOLDER}/rows.rb"
    rows = "#{WORK}/rows_#{@name}.h"
    if Modules.entry(@name)[:rows]
      BUILT.make(rows, [Inputs.digest([maker, 'tools/lib/modules.rb', recorded])]) { written(rows, said('ruby', maker, recorded)) }
    end
    [*FLAGS, *MORE_CALLS[@name], "#{FOLDER}/calls_#{@name}.c", *(MORE_NUMBERS | Modules.numbers(@name) if compared?)]
  end

  def digests(machine)
    machine.printed(machine.program(@name, calls + sources)).sub(/ different.*/, '')
  end

  def answers
    digests(HOST)
  end

  def against_definition(folder)
    program = HOST.program("defined-#{@name}-#{folder.tr('/', '-')}", [*calls, *DEFINITIONS, "-DCALLS=#{Target.amount.calls}", *sources(folder)])
    said(program)
  end

  def seeded
    return 'by test/model/autotune/run' unless compared?

    folder = Broken.module(@name)
    Target.noticed(/ different (?!0+$)/) { against_definition(folder) }
  end

  # The same by the object's name, of what tools/cost meters in both modes.
  def by_name
    metered = Modules.entry(@name)[:calls]&.find { |calls| calls[:pic] == %w[pointer object] } or return {}
    { 'pic18_object' => -> { pic18('-object', "-DFIXPID_#{@name.upcase}_OBJECT=#{metered[:object]}") } }
  end

  def pic18(mode = '', *options)
    meters = BUILT.command("#{WORK}/calls", *Programs::CC, "#{FOLDER}/chip.cc", *Programs::SIMULATORS['gpsim'], '-o', "#{WORK}/calls")
    text = said(meters, Images.program("calls-#{@name}#{mode}", ['-DCALLS_SILENT', *options, *calls, *sources], CHIPS.fetch(@name, 'pic18f4520')), *@functions)
    Target.same(answers, text.lines.first.sub(/ different.*/, ''))
    text
  end

  # All that have a calls_x.c and no driver.
  def self.all
    Modules.called.map { |name| new(name) }
  end
end

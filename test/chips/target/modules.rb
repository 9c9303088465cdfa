# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../../../tools/lib/measure/cores'
require_relative '../../../tools/lib/modules'
require_relative 'images'

# What stands beside a controller, in the program of test/chips/modules/: all recorded
# rows and random calls on a PIC18, where the digest of all answers must be this machine's.
class CalledModule
  FOLDER = 'test/chips/modules'
  FLAGS = %W[-I#{WORK} -I#{FOLDER} #{FOLDER}/main.c test/support/numbers.c].freeze
  MORE_NUMBERS = %w[test/support/numbers_control.c test/support/numbers_pid.c].freeze
  INCLUDES = %w[-Iinclude -Itest/support].freeze
  HOST = [*%w[gcc -std=c99 -O2 -Wall -Wextra -Werror], *INCLUDES].freeze

  # What is metered, if not `step`.
  FUNCTIONS = { 'gains' => %w[from_milli to_milli], 'record' => %w[pack unpack], 'autotune' => %w[step result], 'reaction' => %w[step result],
                'step_error' => %w[step_error state restore], 'table' => %w[at], 'link' => %w[step receive answer] }.freeze

  # Whether a machine has the same of the autotuner's record, too.
  MORE_CALLS = { 'autotune' => %w[-DCALLS_RECORD] }.freeze

  # Where the calls of a module with its rows, each of its functions among them, need more
  # than 32 KB.
  CHIPS = %w[autotune guard reaction step_error link].to_h { |name| [name, 'pic18f26k22'] }.freeze

  attr_reader :name

  # All that have a calls_x.c and no driver.
  def self.all
    Modules.called.map { |name| new(name) }
  end

  def initialize(name)
    @name = name
    @module = Modules::PARTS.dig(name, :of) || name
    @functions = FUNCTIONS.fetch(name, %w[step]).map { |verb| "fixpid_#{@module}_#{verb}" }
  end

  # With a pointer, and by the object's name what tools/cost meters in both modes.
  def modes
    metered = Modules.entry(@name)[:calls]&.find { |calls| calls[:pic] == %w[pointer object] }
    { '' => [], **(metered ? { '_object' => ["-DFIXPID_#{@name.upcase}_OBJECT=#{metered[:object]}"] } : {}) }
  end

  def on_pic18(mode, *options, source: 'src')
    meters = BUILT.command("#{WORK}/calls", *Programs::CC, "#{FOLDER}/chip.cc", *Programs::SIMULATORS['gpsim'], '-o', "#{WORK}/calls")
    image = Images.program("calls-#{@name}#{mode}", ['-DCALLS_SILENT', *options, *calls, *sources(source)], CHIPS.fetch(@name, 'pic18f4520'))
    text = said(meters, image, *@functions)
    Target.same(answers, text.lines.first.sub(/ different.*/, ''))
    text
  end

  # The same on a core with a C library, of what no unit test has the rows there.
  ON_CORES = { 'atmega2560' => %w[reaction], 'cortex-m0' => %w[reaction] }.freeze

  def on_core(core)
    program = "#{WORK}/calls-#{@name}.#{core}"
    given = [*calls, *sources('src')]
    if CORES.key?(core)
      CORES.fetch(core).link(program, '-Os', *INCLUDES, *given, *CORES.fetch(core).sources)
      text = CORES.fetch(core).run(program)
    else
      said('avr-gcc', "-mmcu=#{core}", '-std=gnu99', '-Os', *INCLUDES, *given, 'test/chips/cores/avr_stdio.c', '-o', program)
      text = said('test/chips/cores/simavr', core, program)
    end
    Target.same(answers, text.lines.first.sub(/ different.*/, ''))
    text
  end

  private

  def sources(folder)
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
    # The autotuner's numbers are its own.
    [*FLAGS, *MORE_CALLS[@name], "#{FOLDER}/calls_#{@name}.c", *(MORE_NUMBERS | Modules.numbers(@name) unless @name == 'autotune')]
  end

  # Of this machine.
  def answers
    program = "#{WORK}/#{@name}.host"
    said(BUILT.command(program, *HOST, *calls, *sources('src'), '-o', program)).sub(/ different.*/, '')
  end
end

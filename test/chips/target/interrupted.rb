# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'images'

# A program that prints, on an AVR or a Cortex-M.
class Machine
  SHARED = %W[-std=c99 -O2 -Wall -Wextra -Werror -Iinclude -Itest/support -I#{HERE}].freeze

  # `after` are words of the compiler that come last.
  def initialize(name, compiler, after = [], &run)
    @name = name
    @compiler = compiler
    @after = after
    @run = run
  end

  # Addresses of a program's instructions and their text, by function.
  def instructions(program)
    functions = Hash.new { |all, name| all[name] = {} }
    name = nil
    said(@compiler.first.sub(/gcc\z/, 'objdump'), '-d', program).each_line do |line|
      name = Regexp.last_match(1) if line =~ /\A\h+ <(.+)>:/
      functions[name][Regexp.last_match(1).hex] = Regexp.last_match(2) if line =~ /\A *(\h+):\t[\h ]+\t(\S.*)/
    end
    functions
  end

  # A program of these words, which are sources and options.
  def program(name, words)
    output = "#{WORK}/#{name}.#{@name}.elf"
    compiler, *options = @compiler
    BUILT.command(output, compiler, *SHARED, *options, *words, '-o', output, *@after)
  end

  # What it prints, with more words for its simulator. Some answer may be wrong: then
  # its exit status says so, and whoever compares sees it.
  def printed(program, *words)
    Open3.capture2e('timeout', '600', *@run.call(program), *words, stdin_data: '').first.lines.grep_v(/^Timer with period zero/).join
  end

  def self.avr(chip)
    new(chip, ['avr-gcc', "-mmcu=#{chip}"], %w[test/chips/cores/avr_stdio.c]) { |program| ['test/chips/cores/simavr', chip, program] }
  end

  def self.arm(core, board)
    new(core, ['arm-none-eabi-gcc', "-mcpu=#{core}", '-mthumb', '-ffreestanding', '-nostdlib', "-I#{HERE}/qemu"],
        ["#{HERE}/arm/start.c", "#{HERE}/qemu/runtime.c", '-T', "#{HERE}/arm/flash.ld", '-lgcc']) do |program|
      ['qemu-system-arm', '-M', board, '-nographic', '-semihosting', '-kernel', program]
    end
  end

  ALL = { 'atmega328p' => avr('atmega328p'),
          'cortex-m0' => arm('cortex-m0', 'microbit'), 'cortex-m3' => arm('cortex-m3', 'lm3s6965evb'),
          'cortex-m4' => arm('cortex-m4', 'mps2-an386') }.freeze
end

# fixpid_an937_tick from an interrupt before every instruction of its controller:
# interrupted.c on an AVR and on Cortex-M.
module Interrupted
  AVR = ["#{HERE}/avr/interrupted.c"].freeze
  ARM = ["#{HERE}/arm/interrupted.c"].freeze
  # A machine's interrupt, and the words with which its simulator's time is the
  # instructions: simavr's is the cycles anyway.
  MACHINES = { 'atmega328p' => [AVR, []], 'cortex-m0' => [ARM, %w[-icount shift=7]], 'cortex-m3' => [ARM, %w[-icount shift=7]],
               'cortex-m4' => [ARM, %w[-icount shift=7]] }.freeze
  OPTIMISED = { 'fast' => '-O2', 'small' => '-Os' }.freeze
  # docs/conditions.md says so.
  UNMASKED = "set_limits masked 256 unmasked 511\ninit masked 1000 unmasked 1023\n"

  class << self
    # What a step answers from an interrupt of an AVR, masked and not.
    def unmasked
      machine = Machine::ALL.fetch('atmega328p')
      found = machine.printed(machine.program('unmasked', ['-Isrc', "#{HERE}/avr/unmasked.c", *AVR, *Dir.glob('src/pid/*.c').sort]))
      found == UNMASKED ? found : raise(Host::Failure, "#{found}is not\n#{UNMASKED}")
    end

    # What the program says, if nothing is wrong.
    def run(name, mode, *options, source: 'src')
      machine = Machine::ALL.fetch(name)
      interrupt, words = MACHINES.fetch(name)
      program = machine.program(['interrupted', mode, source.tr('/', '_'), *options].join('-').gsub(/[^-\w]/, ''),
                                [*options, *(Images.object('an937') if mode == 'object'), "-I#{source}", "#{HERE}/interrupted.c", *interrupt,
                                 'test/support/numbers.c', *Dir.glob("#{source}/an937/*.c").sort])
      judged(machine.printed(program, *words), machine.instructions(program))
    end

    private

    def judged(text, functions)
      calls = text.scan(/^\w+ interrupts (\d+) before \d+ after \d+ neither (\d+)$/)
      raise Host::Failure, "#{text}not each function was called" if calls.size != 15
      raise Host::Failure, "#{text}a tick was neither before nor after a call" unless calls.all? { |came, neither| came.to_i.positive? && neither == '0' }

      "#{text}instructions #{every_instruction(text, functions)}\n"
    end

    # Of all functions but the one that interrupts. What fills up to the next function
    # is never executed.
    def every_instruction(text, functions)
      seen = text.scan(/^at( .*)/).flatten.flat_map(&:split).to_h { |address| [address.hex, true] }
      wanted = functions.select { |name, _| name&.start_with?('fixpid_an937_') && !name.start_with?('fixpid_an937_tick') }
                        .flat_map { |name, code| code.map { |address, what| [address, "#{name}: #{what}"] } }
                        .reject { |_, what| what =~ /: (\.\w+|nop)\b/ }
      missed = wanted.reject { |address, _| seen[address] }
      return wanted.size if missed.empty? && wanted.size > 100

      raise Host::Failure, "#{text}#{missed.size} of #{wanted.size} instructions were never interrupted, such as at " \
                           "#{missed.first&.then { |address, what| format('%04x in %s', address, what) }}"
    end
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'machines'

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

  class << self
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

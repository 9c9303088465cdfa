# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'alone'
require_relative '../../../tools/lib/faults/faults'
require_relative '../../../tools/lib/modules'

# What stands beside a controller, on chips of other families: the random calls of
# test/chips/modules/ give the same answers there as here.
module Beside
  FOLDER = 'test/chips/modules'
  CALLS = 500
  FLAGS = %W[-DCALLS=#{CALLS} -Iinclude -Itest/support -I#{FOLDER} -I#{Alone::FOLDER}].freeze
  NUMBERS = %w[test/support/numbers.c test/support/numbers_control.c test/support/numbers_pid.c].freeze
  CHIPS = Alone::CHIPS.select(&:runs).reject { |chip| chip.name == 'atmega328p' } # test/chips/target has an AVR with its multiplier
  NO_ROOM = { 'attiny85' => %w[link] }.freeze # its 8 KB, with the controller
  MODULES = (Modules.called - %w[autotune]).freeze # Alone does its experiments

  # The tests. `folder` is for what they build.
  class Tests
    def initialize(folder)
      @folder = "#{folder}/beside"
      @mutex = Mutex.new
      @answers = {}
    end

    def add(tests)
      MODULES.each do |name|
        chips = CHIPS.reject { |chip| NO_ROOM.fetch(chip.name, []).include?(name) }
        chips.each { |chip| tests.add("beside #{chip.name} #{name}") { compare(chip, name) } }
      end
      tests.add('seeded beside') { notice(CHIPS.first, 'tpo') }
    end

    private

    def compare(chip, name)
      given = on_chip(chip, name, '.')
      raise Host::Failure, "#{given}, here #{here(name)}" unless given == here(name)

      "random #{given}"
    end

    def notice(chip, name)
      tree = "#{@folder}/broken-#{name}"
      Families.broken(tree, Faults.of("beside #{name}").first)
      given = on_chip(chip, name, tree)
      raise Host::Failure, 'not noticed' if given == here(name)

      "random #{given}, not #{here(name)}"
    end

    # The digest of its answers.
    def on_chip(chip, name, tree)
      folder = "#{@folder}/#{chip.name}-#{name}-#{File.basename(tree)}"
      FileUtils.mkdir_p(folder)
      flags = ['-DCALLS_PART', *gnu(chip), *FLAGS, "-I#{rows(name)}"]
      chip.run(flags, ["#{FOLDER}/main.c", "#{FOLDER}/calls_#{name}.c", *numbers(name), *library(name, tree)], folder)
      format('%08x', File.binread("#{folder}/results", 4).unpack1('V'))
    end

    def here(name)
      rows = rows(name)
      @mutex.synchronize do
        @answers[name] ||= begin
          program = "#{@folder}/#{name}-here"
          Host.output('gcc', '-std=c99', '-O2', *Harness::WARNINGS, *FLAGS, "-I#{rows}", "#{FOLDER}/main.c", "#{FOLDER}/calls_#{name}.c",
                      *numbers(name), *library(name, '.'), '-o', program)
          Host.output(program)[/random (\h+)/, 1]
        end
      end
    end

    def numbers(name)
      NUMBERS | Modules.numbers(name)
    end

    def library(name, tree)
      Modules.linked(Modules::PARTS.dig(name, :of) || name, tree).map { |source| "#{tree}/#{source}" }
    end

    # The folder of its recorded rows, which the same file has calls of.
    def rows(name)
      folder = "#{@folder}/rows"
      @mutex.synchronize do
        header = "#{folder}/rows_#{name}.h"
        if Modules.entry(name)[:rows] && !File.exist?(header)
          FileUtils.mkdir_p(folder)
          File.write(header, Host.output('ruby', "#{FOLDER}/rows.rb", "test/support/vectors/#{name}.csv"))
        end
      end
      folder
    end

    # The rows are __flash, which is not of C99.
    def gnu(chip)
      chip.is_a?(Alone::Avr) ? %w[-std=gnu99] : []
    end
  end
end

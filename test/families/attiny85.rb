# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../../tools/lib/cost/meters'
require_relative 'harness'

# An ATtiny85 in simavr, by the meter of tools/cost, whose random steps are its own.
class Attiny85Run < Run
  CHIP = 'attiny85'
  FLAGS = ["-mmcu=#{CHIP}", '-Os', '-std=c99', '-ffreestanding', '-ffunction-sections', '-Wl,--gc-sections',
           *Harness::WARNINGS, *Harness::INCLUDES.reject { |path| path == '-Isrc' }, '-Itest/cost/avr'].freeze

  def result(questions)
    Harness.build(:avr)
    asked = questions.of(controller, 'little', mode)
    program = "#{folder}/firmware.elf"
    Host.output('avr-gcc', *FLAGS, *options, "-DREPLY=#{controller}_reply", 'test/target/driver_main.c',
                "test/target/driver_#{controller}.c", *library, '-o', program)
    text, = Host.run("#{Host.folder}/avr", program, CHIP, controller, *symbols(program), asked.steps.to_s, '0', '0', '0')
    read(text, asked)
  end

  private

  def symbols(program)
    table = Host.output('avr-nm', program)
    ['main', "fixpid_#{controller}_step", 'turn', "#{controller}_exchange"].map do |name|
      table[/^(\h+) \w #{name}$/, 1] or raise Host::Failure, "no #{name} in #{program}"
    end
  end

  # Lines of test/cost/search.h.
  def read(text, asked)
    sets = %w[rows random].map do |name|
      line = text[/^#{name} .*/] or raise Host::Failure, "no #{name}:\n#{text}"
      line.scan(/(\w+) (\d+)/).to_h { |key, value| [key, value.to_i] }
    end
    counts = sets.map { |set| set['steps'] }
    raise Host::Failure, "#{counts.sum} answers to #{asked.count} questions" if counts != [asked.rows, asked.steps]

    Result.new(rows: asked.rows, steps: asked.steps, different: sets.sum { |set| set['different'] },
               least: sets.map { |set| set['least'] }.min, mean: sets.first['total'] / asked.rows,
               worst: sets.map { |set| set['most'] }.max)
  end
end

# The family of one.
Attiny85 = Struct.new(:name, :title, :modes, :refused, :limits, keyword_init: true) do
  def run
    Attiny85Run
  end

  def in_cost?
    true
  end
end

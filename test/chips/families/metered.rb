# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../../../tools/lib/measure/meters'
require_relative 'harness'

# A chip that tools/cost measures, too, by its meter, whose random steps are its
# own.
MeteredChip = Struct.new(:name, :title, :run, :controllers, :refused, :limits, keyword_init: true) do
  def costs_listed?
    false
  end
end

# A run of the meter. Builds "#{folder}/firmware".
class MeteredRun < Run
  def result(questions)
    Harness.build(kind)
    asked = questions.of(controller, 'little')
    build("#{folder}/firmware")
    text, = Host.run("#{Host.folder}/#{kind}", *arguments("#{folder}/firmware"), 'none', asked.steps.to_s, *%w[0 0 1 0 0]) # no search
    read(text, asked)
  end

  private

  # Lines of test/tools/cost/search.h.
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

  def asking
    ["-DREPLY=#{controller}_reply", 'test/chips/target/driver_main.c', "test/chips/target/driver_#{controller}.c"]
  end

  def step
    "fixpid_#{controller}_step"
  end
end

# An ATtiny85 in simavr.
class AvrRun < MeteredRun
  FLAGS = ['-Os', '-std=c99', '-ffreestanding', '-ffunction-sections', '-Wl,--gc-sections',
           *Harness::WARNINGS, *Harness::INCLUDES.reject { |path| path == '-Isrc' }, '-Itest/tools/cost/avr'].freeze

  private

  def kind
    :avr
  end

  def build(output)
    Host.output('avr-gcc', "-mmcu=#{family.name}", *FLAGS, *options, *asking, *library, '-o', "#{output}.elf")
  end

  def arguments(output)
    ["#{output}.elf", family.name, controller, *symbols("#{output}.elf")]
  end

  def symbols(program)
    table = Host.output('avr-nm', program)
    ['main', step, 'turn', "#{controller}_exchange"].map do |name|
      table[/^(\h+) \w #{name}(?:_#{controller}_controller)?$/, 1] or raise Host::Failure, "no #{name} in #{program}"
    end
  end
end

# A PIC in gpsim, whose RAM is garbage when main begins.
class PicRun < MeteredRun
  private

  def kind
    :pic
  end

  def build(output)
    chip = CHIPS.find { |one| one.name == family.name }
    Host.output('tools/lib/build/build_pic', chip.name, output, *chip.build_pic, *options, '-Iport', '-Iport/pic',
                "-I#{chip.board}", '--all-banks', *asking, *library)
  end

  def library
    super + Dir["#{source}/#{controller}/fixpid_#{controller}_pic*.c"]
  end

  def arguments(output)
    ["#{output}.cod", controller, step]
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../../../tools/lib/measure/host'

# What a run of one controller on one family has shown. `different`
# counts answers, missing ones among them; cycles are of a step, `mean` of the
# recorded rows; flash is of the controller's own file, RAM in all.
Result = Struct.new(:rows, :steps, :different, :least, :mean, :worst, :flash, :ram, keyword_init: true) do
  def to_s
    figures = %i[least mean worst flash ram].select { |figure| self[figure] }.map { |figure| "#{figure} #{self[figure]}" }
    "rows #{rows} steps #{steps} different #{different} #{figures.join(' ')}".strip
  end
end

# Questions for all families, as files.
class Questions
  SOURCES = %w[test/chips/families/questions.c test/chips/target/cases.c test/support/reference.c test/support/reference_pid.c
               test/support/numbers.c test/support/numbers_pid.c test/support/vectors.c].freeze
  FLAGS = %w[-std=c99 -O2 -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -Iinclude -Isrc -Itest/support
             -Itest/chips/target].freeze
  # A set of questions: its files, and what is in them.
  Asked = Struct.new(:questions, :answers, :rows, :steps, :question, :answer, :object, keyword_init: true) do
    def count
      rows + steps
    end

    def expected
      File.binread(answers)
    end

    # Answers that are wrong or missing.
    def different(given)
      raise Host::Failure, 'no answer at all' if given.empty?

      wanted = expected
      (0...count).count { |at| given.byteslice(at * answer, answer) != wanted.byteslice(at * answer, answer) }
    end
  end

  def initialize(folder, steps)
    @folder = folder
    @steps = steps
    @mutex = Mutex.new
    @written = {}
    Host.output('gcc', *FLAGS, *SOURCES, '-o', "#{folder}/questions")
  end

  def of(controller, order)
    @mutex.synchronize { @written[[controller, order]] ||= write(controller, order) }
  end

  private

  def write(controller, order)
    base = "#{@folder}/#{controller}.#{order}"
    text = Host.output("#{@folder}/questions", controller, order, @steps.to_s, "#{base}.asked", "#{base}.expected")
    numbers = text.scan(/(\w+) (\d+)/).to_h { |name, number| [name.to_sym, number.to_i] }
    Asked.new(questions: "#{base}.asked", answers: "#{base}.expected", **numbers)
  end
end

# One controller, by its object's name, on one family. `source` is the folder of the library.
class Run
  def initialize(family, controller, source, folder)
    @family = family
    @controller = controller
    @source = source
    @folder = folder
    FileUtils.rm_rf(folder)
    FileUtils.mkdir_p(folder)
  end

  private

  attr_reader :family, :controller, :source, :folder

  def options
    %w[include test/chips/target test/chips/families].map { |path| "-I#{path}" } +
      ["-I#{source}", "-DCONTROLLER=#{controller}", "-DASKED_#{controller.upcase}", "-DFIXPID_#{controller.upcase}_OBJECT=#{controller}_controller"]
  end

  # The driver, which calls the meter's step.
  def redirected
    file = "#{folder}/driver.c"
    File.write(file, <<~TEXT)
      #include "asked.h"
      STEP_RESULT metered_step(STEP_PARAMETERS);
      #undef fixpid_#{controller}_step
      #define fixpid_#{controller}_step metered_step
      #include "driver_#{controller}.c"
    TEXT
    file
  end

  def library
    %w[_more _track].reduce(["#{source}/#{controller}/fixpid_#{controller}.c"]) do |files, part|
      file = "#{source}/#{controller}/fixpid_#{controller}#{part}.c"
      File.exist?(file) ? files + [file] : files
    end
  end

  # The steps that AN937 takes in percent are not metered.
  def statistics(costs, asked)
    raise Host::Failure, "#{costs.size} steps were metered of #{asked.count}" if costs.size < 0.9 * asked.count

    { least: costs.min, mean: costs.first(asked.rows).sum / asked.rows, worst: costs.max }
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'cores'
require_relative 'kept'
require_relative '../../bound/bound'

RANDOM_STEPS = 5000
SEARCH = [30_000, 1, 1].freeze # steps of a run of the search, runs, and the first one's seed
LONG_SEARCH = [200_000, 3].freeze
QUESTIONS = [nil, 'REDUCED'].freeze # of enum search_questions

# What one subject costs; `most` is over all questions, `mean` over the
# recorded rows, `bound`, `levels` and `stack` from the code, and so are `cycles`, the
# bounds in cycles where the others are in instructions. Flash of the step, of all functions that
# an application needs, and as the linker takes it; RAM of a controller, besides,
# and of that the step's own variables on a PIC16, which SDCC keeps in RAM.
Figures = Struct.new(:least, :mean, :most, :bound, :cycles, :step_flash, :needed, :linked, :instance, :fixed, :step_variables,
                     :levels, :stack, keyword_init: true)

# What a run prints, one line for each set of questions.
class Answers
  # What the kept sequence of the row costs, or 0, and a dearer one with its steps, or 0 and none.
  Found = Struct.new(:own, :best, :steps)

  def initialize(text, subject)
    @sets = text.scan(/^(rows|random|kept|search) (.*)$/).to_h do |name, numbers|
      [name, numbers.scan(/(\w+) (\d+)/).to_h { |key, value| [key, value.to_i] }]
    end
    @found = Found.new(text[/^own cost (\d+)/, 1].to_i, text[/^best cost (\d+)/, 1].to_i, Kept.printed(text))
    @stack = text[/^stack (\d+)/, 1]&.to_i
    raise Host::Failure, "#{subject}: no figures:\n#{text}" if @sets.size != 4
    return if different.zero?

    raise Host::Failure, "#{subject}: #{different} answers differ from the definition's"
  end

  attr_reader :found

  # Bytes, of what has a stack in RAM and counts it.
  attr_reader :stack

  def different
    @sets.values.sum { |set| set['different'] }
  end

  def least
    @sets.values.map { |set| set['least'] }.min
  end

  def most
    @sets.values.map { |set| set['most'] }.max
  end

  def mean
    @sets['rows']['total'].fdiv(@sets['rows']['steps'])
  end
end

# The harness: programs for this machine and objects for the others.
module Harness
  SHARED = %w[test/tools/cost/search.c test/tools/cost/sequence.c test/chips/target/cases.c test/support/reference.c test/support/reference_pid.c
              test/support/numbers.c test/support/numbers_pid.c].freeze
  INCLUDES = %w[include src test/support test/chips/target test/tools/cost].map { |folder| "-I#{folder}" }.freeze
  WARNINGS = %w[-Wall -Wextra -Werror].freeze

  class << self
    # The program for a kind of chips, built once.
    def build(kind)
      Host.once(kind) do
        kept_table
        { pic: -> { pic(host_objects) }, avr: -> { avr(host_objects) }, arm: -> { vectors_table }, riscv: -> { vectors_table } }[kind].call
        true
      end
    end

    def build_function
      Host.output('g++', '-std=c++17', '-O2', *WARNINGS, '-Isim/chip', 'test/tools/cost/function.cc',
                  'build/gpsim/libchip.a', '-lgpsim', '-o', "#{Host.folder}/function")
    end

    # Objects that all programs of a core share.
    def objects_of(core)
      files = SHARED + CORES.fetch(core).sources + %W[#{Host.folder}/vectors_table.c #{Host.folder}/kept.c]
      files.map do |file|
        object = "#{Host.folder}/#{core}-#{File.basename(file, '.c')}.o"
        CORES.fetch(core).compile('-O2', *WARNINGS, *INCLUDES, '-c', file, '-o', object)
        object
      end
    end

    private

    def host_objects
      @host_objects ||= (SHARED + %W[test/support/vectors.c #{Host.folder}/kept.c]).map { |file| compile(file) }
    end

    def compile(file)
      object = "#{Host.folder}/#{File.basename(file, '.c')}.o"
      Host.output('gcc', '-std=c99', '-O2', *WARNINGS, *INCLUDES, '-c', file, '-o', object)
      object
    end

    def avr(objects)
      Host.output('gcc', '-std=c99', '-O2', *WARNINGS, *INCLUDES, 'test/tools/cost/avr/meter.c', *objects, '-lsimavr',
                  '-o', "#{Host.folder}/avr")
    end

    def pic(objects)
      Host.output('g++', '-std=c++17', '-O2', *WARNINGS, '-Isim/chip', *INCLUDES, 'test/tools/cost/pic.cc',
                  'test/chips/target/driver.cc', *objects, 'build/gpsim/libchip.a', '-lgpsim', '-o', "#{Host.folder}/pic")
    end

    def kept_table
      File.write("#{Host.folder}/kept.c", Kept.table)
    end

    def vectors_table
      tables = %w[an937_firmware an964_firmware pid_definition track].map { |name| "test/support/vectors/#{name}.csv" }
      File.write("#{Host.folder}/vectors_table.c", Host.output('ruby', 'test/chips/cores/vectors_table.rb', *tables))
    end
  end
end

# Builds a subject and measures it.
class Meter
  def self.of(subject)
    { pic: PicMeter, avr: AvrMeter, arm: QemuMeter, riscv: QemuMeter }.fetch(subject.chip.kind).new(subject)
  end

  def initialize(subject)
    @subject = subject
    @controller = subject.controller
    @path = "#{Host.folder}/#{subject.key}"
    @step = subject.step
    @search = SEARCH
  end

  # Without a run: the longest path of a step, and the flash with init.
  def of_code
    Harness.build(@subject.chip.kind)
    build
    code = read_code
    [longest(code).cost, needed(code)]
  end

  # The worst step and no more.
  def most
    Harness.build(@subject.chip.kind)
    build
    Answers.new(run, @subject).most
  end

  # The answers of a long search.
  def search(seed)
    @search = [*LONG_SEARCH, seed]
    Harness.build(@subject.chip.kind)
    build
    Answers.new(run, @subject)
  end

  def figures
    Harness.build(@subject.chip.kind)
    build
    answers = Answers.new(run, @subject)
    code = read_code
    step = longest(code)
    stack = code.stack(@step).bytes # with the return address where that is in RAM
    check_bound(answers.most, step.cost)
    check_stack(answers.stack, stack)
    Figures.new(least: answers.least, mean: answers.mean, most: answers.most, bound: step.cost, cycles: cycles,
                step_flash: code.size_of(step.addresses), needed: needed(code), levels: step.levels + 1,
                stack: stack, **sizes(code))
  rescue Bound::Failure => e
    raise Host::Failure, "#{@subject}: #{e.message}"
  end

  private

  def check_bound(most, bound)
    raise Host::Failure, "#{@subject}: #{most} measured, but #{bound} is the bound" if most > bound
  end

  # QEMU's meter does not count it.
  def check_stack(most, stack)
    return if most.nil? ? is_a?(QemuMeter) : most <= stack

    raise Host::Failure, "#{@subject}: a stack of #{most || 'no'} bytes measured, but #{stack} are the bound"
  end

  def driver
    @subject.driver
  end

  # A straightforward form has neither flags nor refusals: only the outputs of
  # the rows are compared.
  def numbers
    [RANDOM_STEPS, *@search, @subject.plain_c? ? 1 : 0, QUESTIONS.index(@controller.questions)].map(&:to_s)
  end

  def needed(code)
    code.flash_of(*@controller.calls.map { |verb| @controller.function(verb) })
  end

  def longest(code)
    code.longest(@step, @controller.turns || {})
  end

  # What is counted is in cycles.
  def cycles
    nil
  end
end

# In gpsim.
class PicMeter < Meter
  private

  def build
    asks = ['test/chips/target/driver_main.c', driver]
    link(@path, "-DREPLY=#{@controller.name}_reply",
         *(words? ? [*@subject.all_sources, '--all-banks', *asks] : asks + @subject.all_sources))
  end

  # Two more for the sizes: one with only the calls that every application has,
  # and one with none, which is the same for all of a chip.
  def sizes_from
    bare = "#{@path}-bare"
    link(bare, "-DBARE_#{@controller.name.upcase}", *together('test/tools/cost/bare.c', *@subject.sources))
    nothing = Host.once("#{Host.folder}/nothing-#{[@subject.chip.name, *banks].join}") do |path|
      link(path, *together('test/tools/cost/bare.c'))
      path
    end
    [bare, nothing].map { |path| code_of(path) }
  end

  # A PIC16's as tools/firmware does it: compiled as one file, functions share
  # their RAM.
  def together(*sources)
    return sources unless words?

    one = "#{File.dirname(@path)}/#{File.basename(@path).tr('-', '_')}_#{sources.size}.c"
    File.write(one, sources.map { |source| "#include \"#{source}\"\n" }.join)
    [one]
  end

  def link(output, *arguments)
    chip = @subject.chip
    paths = %W[. include src test/chips/target test/tools/cost port port/pic #{chip.board}].map { |folder| "-I#{folder}" }
    Host.output('tools/lib/build/build_pic', chip.name, output, *chip.build_pic, *banks, *paths, *@subject.defines, *arguments)
  end

  # In pointer mode a PIC16's variables fill both; others have four and more.
  def banks
    words? && (@subject.build == 'pointer' || @subject.chip.like) ? ['--all-banks'] : []
  end

  def run
    Host.output("#{Host.folder}/pic", "#{@path}.cod", @controller.name, @step, @subject.key, *numbers)
  end

  def read_code
    @read_code ||= code_of(@path)
  end

  def code_of(path)
    Bound.code(@subject.chip.name, path)
  end

  def words?
    @subject.chip.flash == 'words'
  end

  # What a firmware grows by.
  def sizes(_code)
    bare, nothing = sizes_from
    instance = bare.object_size("#{@controller.name}_controller")
    { linked: bare.library_flash - nothing.library_flash, instance: instance,
      fixed: bare.ram_bytes - nothing.ram_bytes - instance, step_variables: step_variables }
  end

  # Those that its assembly names.
  def step_variables
    return unless words?

    assembly = File.read("#{@path}.d/fixpid_#{@controller.name}.asm")
    step = assembly[/^_(#{@step}\w*):.*?^; exit point of _\1$/m] or raise Host::Failure, "#{@subject}: no #{@step}"
    step.scan(/\br0x\h+/).uniq.size
  end
end

# In simavr.
class AvrMeter < Meter
  FLAGS = %w[-std=c99 -ffreestanding -ffunction-sections -Wl,--gc-sections].freeze

  private

  def build
    flags = ["-mmcu=#{@subject.chip.name}", @subject.build, *FLAGS, *Harness::WARNINGS, *Harness::INCLUDES,
             '-Itest/tools/cost/avr', *@subject.defines]
    objects = @subject.all_sources.map do |file|
      object = "#{@path}-#{File.basename(file, '.*')}.o"
      Host.output('avr-gcc', *flags, '-c', file, '-o', object)
      object
    end
    @objects = objects
    Host.output('avr-gcc', *flags, "-DREPLY=#{@controller.name}_reply", 'test/chips/target/driver_main.c', driver,
                *objects, '-o', "#{@path}.elf")
  end

  def run
    symbols = ['main', @step, 'turn', "#{@controller.name}_exchange"].map { |name| read_code.symbol(name).to_s(16) }
    Host.output("#{Host.folder}/avr", "#{@path}.elf", @subject.chip.name, @controller.name, *symbols, @subject.key,
                *numbers)
  end

  def read_code
    @read_code ||= Bound.code(@subject.chip.name, @path)
  end

  def sizes(code)
    { linked: needed(code), instance: code.object_size("#{@controller.name}_controller"),
      fixed: code.static_bytes(@objects) }
  end
end

# In QEMU.
class QemuMeter < AvrMeter
  private

  def core
    CORES.fetch(@subject.chip.name)
  end

  def build
    shared = Host.once(@subject.chip.name) { |core| Harness.objects_of(core) }
    flags = [@subject.build, *Harness::WARNINGS, *Harness::INCLUDES, *@subject.defines]
    @objects = @subject.all_sources.map do |file|
      object = "#{@path}-#{File.basename(file, '.*')}.o"
      core.compile(*flags, '-c', file, '-o', object)
      object
    end
    core.link("#{@path}.elf", *flags, *definitions, "-Wl,--wrap=#{@step}", 'test/tools/cost/qemu/meter.c', driver,
              *@objects, *shared)
  end

  def definitions
    random, directed, runs, seed, outputs, questions = numbers
    ["-DCONTROLLER=\"#{@controller.name}\"", "-DREPLY=#{@controller.name}_reply",
     "-DEXCHANGE=#{@controller.name}_exchange", "-DSTEP=\"#{@step}\"",
     "-DROW=\"#{@subject.key}\"", "-DRUNS=#{runs}", "-DSEED=#{seed}",
     "-DRANDOM_STEPS=#{random}", "-DDIRECTED_STEPS=#{directed}", "-DOUTPUTS_ONLY=#{outputs}",
     "-DQUESTIONS=#{questions}"]
  end

  def run
    core.run("#{@path}.elf", @search == SEARCH ? 300 : 3600)
  end

  # The bound in cycles, by each of the core's timings.
  def cycles
    Bound.cycles(@subject.chip.name, read_code, @step, @controller.turns || {})
  end
end

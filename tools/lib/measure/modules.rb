# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../modules'
require_relative 'meters'

# What stands beside a controller, and its functions that are measured: the
# program of test/chips/modules makes all recorded and many random calls of them.
# `turns` are those of loops that count no constant down, by function, as a
# Controller's; of functions in `unbounded` no bound can be told.
# Objects that match `without` are left out where their flash is counted. It takes those of the
# module's sources that match `takes`, if that is told, else what most programs link.
# A PIC16 has room for the first `rows` recorded rows; only what names it is measured there.
# On a PIC it is measured in the modes of `pic`: through a pointer, if nothing else is told.
CalledModule = Struct.new(:id, :functions, :object, :calls, :program, :flags, :kinds, :turns, :unbounded, :pic, :part, :without, :rows, :takes,
                          keyword_init: true) do
  # The name of calls_x.c and of its recorded rows: the module's, or that of a part.
  def caller
    part || id
  end

  # Of the library, without the check, the record, the rule of a guard, the state, the step by the error and tracked
  # steps of a link, which only a program that calls them links.
  def files
    return Modules.sources(id, Host.root).grep(takes) if takes

    Modules.sources(id, Host.root).grep_v(part ? /_check\.c\z/ : /_check\.c\z|_autotune_record\.c\z|_guard_more\.c\z|_pid_(?:error|state)\.c\z|_link_tracked\.c\z/)
  end

  # Of the modules that it uses, what a program needs of them; they do not count.
  def used
    (Modules.linked(id, Host.root) - Modules.sources(id, Host.root)).grep_v(/_pid_(?:check|error|track)\.c\z/)
  end

  # Of its recorded rows.
  def columns
    Modules.entry(caller)[:rows]
  end

  # Whether it is measured on this chip.
  def on?(chip)
    kind = chip.flash == 'words' ? :pic16 : chip.kind
    kinds.nil? ? kind != :pic16 : kinds.include?(kind)
  end

  # What makes the calls.
  def callers
    (program || %w[test/support/numbers_control.c] + Modules.numbers(id)) + used
  end
end

CALLED_MODULES = Modules::ALL.flat_map do |id, entry|
  entry.fetch(:calls, []).map { |call| CalledModule.new(id: id, **call) }
end.freeze

# One of them in one build on one chip.
ModuleSubject = Struct.new(:called, :chip, :build) do
  def key
    "module-#{called.functions.keys.first}-#{chip.name}-#{build.delete('-')}"
  end

  def to_s
    [called.id, chip.title, build].join(', ')
  end

  # Of a function of it.
  def title_of(function)
    function == 'step' ? called.id : "#{called.id}, #{function}"
  end

  def matches?(words)
    own = [called.id, chip.name, build, chip.kind.to_s]
    words.empty? || words.group_by { |word| Subject.kind_of_word(word) }
                         .all? { |_, group| group.any? { |word| own.include?(word) } }
  end

  MEASURED = %w[pic16f1788 pic18f4520 atmega328p cortex-m0 cortex-m4].freeze

  def self.all
    MEASURED.map { |name| CHIPS.find { |chip| chip.name == name } }.flat_map do |chip|
      CALLED_MODULES.select { |called| called.on?(chip) }.flat_map do |called|
        builds_of(called, chip).map { |build| new(called, chip, build) }
      end
    end
  end

  def self.builds_of(called, chip)
    return chip.builds unless chip.kind == :pic

    called.pic || %w[pointer]
  end
end

# Figures of one function, with its bound, also in cycles by each of the core's
# timings where the others are in instructions; flash is that of the whole module, without the
# compiler's own routines.
ModuleFigures = Struct.new(:least, :mean, :most, :bound, :cycles, :flash, :instance, keyword_init: true)

# Builds the program of a module and meters its calls.
class ModuleMeter
  INCLUDES = %w[include src test/support test/chips/modules].map { |folder| "-I#{folder}" }.freeze

  def self.of(subject)
    { pic: ModulePicMeter, avr: ModuleAvrMeter, arm: ModuleArmMeter }.fetch(subject.chip.kind).new(subject)
  end

  def initialize(subject)
    @subject = subject
    @called = subject.called
    @path = "#{Host.folder}/#{subject.key}"
    @rows = "#{@path}.rows"
  end

  # By function.
  def figures
    FileUtils.mkdir_p(@rows)
    if @called.columns
      File.write("#{@rows}/rows_#{@called.caller}.h",
                 Host.output('ruby', 'test/chips/modules/rows.rb', "test/support/vectors/#{@called.caller}.csv", *@called.rows&.to_s))
    end
    build
    text = run
    @called.functions.keys.to_h { |name| [name, figures_of(name, text)] }
  end

  private

  def figures_of(name, text)
    calls, least, most, total = text.match(/^#{name} calls (\d+) least (\d+) most (\d+) total (\d+)$/)&.captures
                                    &.map(&:to_i)
    raise Host::Failure, "#{@subject}: no figures of #{name}:\n#{text}" unless calls&.positive?

    bound = bound_of(name)
    raise Host::Failure, "#{@subject}, #{name}: #{most} measured, but #{bound} is the bound" if bound && most > bound

    ModuleFigures.new(least: least, mean: total.fdiv(calls).round, most: most, bound: bound, cycles: cycles_of(name),
                      flash: flash, instance: instance)
  rescue Bound::Failure => e
    raise Host::Failure, "#{@subject}: #{e.message}"
  end

  # From the code.
  def bound_of(name)
    return if @called.unbounded&.include?(name)

    code.longest(name, @called.turns || {}).cost
  end

  # What is counted is in cycles.
  def cycles_of(_name)
    nil
  end

  def program
    ['test/chips/modules/main.c', "test/chips/modules/calls_#{@called.caller}.c", 'test/support/numbers.c', *@called.callers]
  end

  def flags
    ["-DCALLS=#{@called.calls}", "-I#{@rows}", *INCLUDES, *@called.flags, *mode]
  end

  def mode
    @subject.build == 'object' ? ["-DFIXPID_#{@called.id.upcase}_OBJECT=#{@called.object}"] : []
  end

  # The library's objects, compiled alone.
  def objects(compiler, *options)
    @called.files.map do |file|
      "#{@path}_#{File.basename(file, '.c')}.o".tap do |object|
        Host.output(compiler, *options, '-c', file, '-o', object)
      end
    end
  end
end

# In gpsim.
class ModulePicMeter < ModuleMeter
  private

  def build
    chip = @subject.chip
    paths = %W[port port/pic #{chip.board}].map { |folder| "-I#{folder}" }
    Host.output('tools/lib/build/build_pic', chip.name, @path, *chip.build_pic, *('--all-banks' if words?), '-DCALLS_SILENT', *flags,
                *paths, *program, *@called.files)
  end

  def run
    harness = Host.once("#{Host.folder}/calls_pic") do |path|
      Host.output('g++', '-std=c++17', '-O2', *Harness::WARNINGS, '-Isim/chip', 'test/chips/modules/chip.cc',
                  'build/gpsim/libchip.a', '-lgpsim', '-o', path)
      path
    end
    Host.output(harness, "#{@path}.cod", *@called.functions.keys)
  end

  def flash
    Bound.sections("#{@path}.map").select { |one| one.place == 'program' && one.name.match?(/\AS_fixpid_#{@called.id}_/) }
           .sum(&:bytes) / (words? ? 2 : 1)
  end

  def words?
    @subject.chip.flash == 'words'
  end

  def instance
    @called.object ? code.object_size(@called.object) : 0
  end

  def code
    @code ||= Bound.code(@subject.chip.name, @path)
  end
end

# In simavr.
class ModuleAvrMeter < ModuleMeter
  private

  def build
    options = ["-mmcu=#{@subject.chip.name}", @subject.build, *AvrMeter::FLAGS, '-std=gnu99', *Harness::WARNINGS,
               '-Itest/tools/cost/avr', *flags]
    @objects = objects('avr-gcc', *options)
    Host.output('avr-gcc', *options, '-DCALLS_SILENT', *program, *@objects, '-o', "#{@path}.elf")
  end

  def run
    meter = Host.once("#{Host.folder}/calls_avr") do |path|
      Host.output('gcc', '-std=c99', '-O2', *Harness::WARNINGS, 'test/tools/cost/avr/calls.c', '-lsimavr', '-o', path)
      path
    end
    addresses = @called.functions.keys.flat_map { |name| [name, code.symbol(name).to_s(16)] }
    Host.output(meter, "#{@path}.elf", @subject.chip.name, code.symbol('done').to_s(16), *addresses)
  end

  def tools
    'avr'
  end

  def code
    @code ||= Bound.code(@subject.chip.name, @path)
  end

  def flash
    @objects.reject { |object| @called.without&.match?(object) }.sum { |object| Host.output("#{tools}-size", object).lines.last.split.first.to_i }
  end

  def instance
    @called.object ? code.object_size(@called.object) : 0
  end
end

# In QEMU.
class ModuleArmMeter < ModuleAvrMeter
  private

  def core
    CORES.fetch(@subject.chip.name)
  end

  def build
    options = [*Harness::WARNINGS, *flags]
    names = @called.functions.keys.zip(%w[FIRST SECOND])
    @objects = objects("#{tools}-gcc", *core.options, *Core::OPTIONS, *options, @subject.build)
    core.link("#{@path}.elf", *options, '-O2', '-DCALLS_METERED',
              *names.flat_map { |name, which| ["-D#{which}=\"#{name}\"", "-Wl,--wrap=#{name}"] },
              *program, 'test/tools/cost/qemu/calls.c', *core.sources, *@objects)
  end

  def run
    core.run("#{@path}.elf")
  end

  def tools
    core.tools
  end

  def cycles_of(name)
    return if @called.unbounded&.include?(name)

    Bound.cycles(@subject.chip.name, code, name, @called.turns || {})
  end
end

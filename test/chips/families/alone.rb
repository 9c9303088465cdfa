# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../../../tools/lib/data_tables'

require_relative 'harness'
require_relative '../../../tools/lib/measure/meters'

# The experiment of fixpid_autotune alone, for chips that are too small for what makes
# gains of it: the same experiments there and here, bit for bit, and what the library
# adds to a program, with the experiment alone and with all of it.
module Alone
  FOLDER = 'test/chips/families/alone'
  BARE = "#{FOLDER}/bare.c".freeze
  EXPERIMENT = %w[autotune autotune_cycle autotune_more autotune_relay].freeze
  ALONE = [*EXPERIMENT, 'autotune_record'].freeze
  WHOLE = [*EXPERIMENT, 'autotune_result'].freeze
  PARTS = { 'nothing' => [%w[-DBARE_NOTHING], []], 'alone' => [[], ALONE], 'whole' => [%w[-DBARE_WHOLE], WHOLE] }.freeze
  MODES = { 'pointer' => [], 'object' => %w[-DFIXPID_AUTOTUNE_OBJECT=tuner] }.freeze
  INCLUDES = %W[-Iinclude -I#{FOLDER}].freeze

  # Files of the library.
  def self.sources(names, folder = 'src')
    names.map { |name| "#{folder}/autotune/fixpid_#{name}.c" }
  end

  # Bytes that a program takes.
  Size = Struct.new(:flash, :ram)

  # One chip.
  Chip = Struct.new(:name, :title, :flash, :runs, :most, :mode, keyword_init: true) do
    # What the library adds, of each part; nil where the chip's linker refuses.
    def added(parts, folder)
      nothing, *sizes = ['nothing', *parts].map { |part| build(part, "#{folder}/#{part}") }
      sizes.map { |size| size && Size.new(size.flash - nothing.flash, size.ram - nothing.ram) }
    end

    private

    def build(part, folder)
      FileUtils.mkdir_p(folder)
      flags, names = PARTS.fetch(part)
      size([*flags, *MODES.fetch(mode), *INCLUDES], [BARE, *Alone.sources(names)], folder)
    end

    # Only bare.c asks what is in the program: all others are the same for each part, and
    # compiled once.
    def objects(sources, flags, folder, extension)
      sources.map do |source|
        own = source == BARE ? flags : flags.grep_v(/\A-DBARE/)
        Host.once([name, source, own]) do
          "#{folder}/#{File.basename(source, '.c')}.#{extension}".tap { |object| yield(source, own, object) }
        end
      end
    end

    # What was written of the bytes below the stack's top.
    def of_stack(bytes)
      raise Host::Failure, "#{title}: its stack was not seen" unless bytes.size == 256

      bytes.drop_while { |byte| byte == 0xA5 }.size
    end

    # Of an ELF file by its tools.
    def elf_size(program, tool)
      text, data, bss = Host.output(tool, program).lines.last.split.first(3).map(&:to_i)
      Size.new(text + data, data + bss)
    end
  end

  # An AVR, by avr-gcc and in simavr.
  class Avr < Chip
    OPTIONS = %w[-Os -std=c99 -Wall -Wextra -Werror -ffunction-sections -fdata-sections -Wl,--gc-sections].freeze

    def size(flags, sources, folder)
      compile(flags, sources, "#{folder}/bare.elf")
      elf_size("#{folder}/bare.elf", 'avr-size')
    rescue Host::Failure => e
      raise unless e.message.match?(/region `text' overflowed/)
    end

    def run(flags, sources, folder)
      compile(flags, ["#{FOLDER}/chip_avr.c", *sources], "#{folder}/alone.elf")
      table = Host.output('avr-nm', "#{folder}/alone.elf")
      addresses = %w[over program_bytes].map { |symbol| table[/^(\h+) \w #{symbol}$/, 1] }
      Host.output('gcc', '-std=c99', '-O2', *Harness::WARNINGS, '-Itest/tools/cost/avr', *flags.grep(/\A-[DI]/), "#{FOLDER}/avr.c", '-lsimavr',
                  '-o', "#{folder}/runner")
      Host.output("#{folder}/runner", "#{folder}/alone.elf", name, *addresses, "#{folder}/results")[/^stack (\d+)/, 1].to_i
    end

    private

    def compile(flags, sources, output)
      Host.output('avr-gcc', "-mmcu=#{name}", *OPTIONS, *flags, *sources, '-o', output)
    end
  end

  # An STM8, by SDCC and in ucsim.
  class Stm8 < Chip
    STACK = %w[0x1700 0x17ff].freeze # with its top, in the simulator
    OPTIONS = %w[-mstm8 --std-c99 --opt-code-size --Werror --disable-warning 126].freeze

    def size(flags, sources, folder)
      found = link(flags, sources, "#{folder}/bare.ihx", folder)
      bytes = File.readlines("#{folder}/bare.ihx").sum { |line| line[7, 2] == '00' ? line[1, 2].hex : 0 }
      Size.new(bytes, found.sum { |object| File.read(object).scan(/^A (?:DATA|INITIALIZED) size (\h+)/).flatten.sum(&:hex) })
    end

    def run(flags, sources, folder)
      link(flags, ["#{FOLDER}/chip_ucsim.c", *sources], "#{folder}/alone.ihx", folder)
      lines = ["file \"#{folder}/alone.ihx\"", 'reset', "fill rom #{STACK.join(' ')} 0xa5", 'run', "dump rom #{STACK.join(' ')}", 'kill']
      File.write("#{folder}/commands", lines.map { |line| "#{line}\n" }.join)
      text = Host.output('timeout', '600', 'sstm8', '-t', 'S208', '-I', "if=rom[0x57ff],out=#{folder}/results", '-C', "#{folder}/commands")
      of_stack(text.scan(/^0x\h+\s+((?:\h\h )+)/).flatten.flat_map(&:split).map(&:hex))
    end

    private

    # The first source has main.
    def link(flags, sources, output, folder)
      found = objects(sources, flags, folder, 'rel') { |source, own, object| Host.output('sdcc', *OPTIONS, *own, '-c', source, '-o', object) }
      Host.output('sdcc', '-mstm8', '--out-fmt-ihx', *found, '-o', output)
      found
    end
  end

  # An MSP430 without a multiplier, by clang and in mspdebug.
  class Msp430 < Chip
    OPTIONS = %w[--target=msp430 -mhwmult=none -std=gnu99 -ffreestanding -fno-builtin -Os -ffunction-sections -Wall -Wextra -Werror
                 -Itest/chips/target/qemu].freeze
    SUPPORT = 'test/chips/families/msp430'

    def size(flags, sources, folder)
      link(flags, sources, "#{folder}/bare.elf", folder, 'main')
      elf_size("#{folder}/bare.elf", 'size')
    end

    def run(flags, sources, folder)
      link(flags, ["#{FOLDER}/chip_msp430.c", *sources], "#{folder}/alone.elf", folder, 'start')
      start, wait = %w[start wait].map { |name| "0x#{Host.output('nm', "#{folder}/alone.elf")[/^(\h+) \w #{name}$/, 1]}" }
      lines = ["load #{folder}/alone.elf", 'reset', 'fill 0x2e00 0x100 0xa5', "set pc #{start}", "setbreak #{wait}", 'run',
               "save_raw 0x4000 0x800 #{folder}/results", "save_raw 0x2e00 0x100 #{folder}/stack"]
      File.write("#{folder}/commands", lines.map { |line| "#{line}\n" }.join)
      Host.output('timeout', '600', 'mspdebug', '-q', 'sim', "read #{folder}/commands")
      of_stack(File.binread("#{folder}/stack").bytes)
    end

    private

    def link(flags, sources, output, folder, entry)
      found = objects([*sources, "#{SUPPORT}/runtime.c"], flags, folder, 'o') do |source, own, object|
        Host.output('clang', *OPTIONS, *own, '-c', source, '-o', object)
      end
      Host.output('ld.lld', '-T', "#{SUPPORT}/flash.ld", '-e', entry, '--gc-sections', *found, '-o', output)
    end
  end

  # A PIC18, by build_pic; tools/demo chip runs its experiment.
  class Pic18 < Chip
    def size(flags, sources, folder)
      given = sources.map { |source| compiled(source, folder) || source }
      Host.output('tools/lib/build/build_pic', name, "#{folder}/bare", *flags, '-Iport', '-Iport/pic', "-Iport/pic/#{name}", '--all-banks', *given)
      sections = Bound.sections("#{folder}/bare.map")
      Size.new(*%w[program data].map { |place| sections.select { |one| one.place == place }.sum(&:bytes) })
    end

    private

    # By the part that was built before it.
    def compiled(source, folder)
      Dir["#{File.dirname(folder)}/*/bare.d/#{File.basename(source, '.c')}.o"].first unless source == BARE
    end
  end

  # A Cortex-M0, which test/chips/cores runs.
  class CortexM0 < Chip
    OPTIONS = %w[-mcpu=cortex-m0 -mthumb -Os -std=c99 -ffreestanding -Wall -Wextra -Werror -ffunction-sections -fdata-sections
                 -Wl,--gc-sections -nostdlib -Wl,-e,main].freeze

    def size(flags, sources, folder)
      Host.output('arm-none-eabi-gcc', *OPTIONS, *flags, *sources, '-lgcc', '-o', "#{folder}/bare.elf")
      elf_size("#{folder}/bare.elf", 'arm-none-eabi-size')
    end
  end

  # `most` is what the experiment alone may add to the flash, in the mode where it adds
  # less; the flash is the chip's. What runs, does so in this test.
  CHIPS = [
    Avr.new(name: 'attiny85', title: 'ATtiny85', flash: 8192, runs: true, most: 3600, mode: 'pointer'),
    Avr.new(name: 'atmega328p', title: 'ATmega328P', flash: 32_768, runs: true, most: 3600, mode: 'pointer'),
    Stm8.new(name: 'stm8', title: 'STM8S103', flash: 8192, runs: true, most: 4700, mode: 'object'),
    Msp430.new(name: 'msp430', title: 'MSP430G2553', flash: 16_384, runs: true, most: 4000, mode: 'object'),
    Pic18.new(name: 'pic18f4520', title: 'PIC18F4520', flash: 32_768, runs: false, most: 17_200, mode: 'object'),
    Pic18.new(name: 'pic18f26k22', title: 'PIC18F26K22', flash: 65_536, runs: false, most: 17_200, mode: 'object'),
    CortexM0.new(name: 'cortex-m0', title: 'Cortex-M0 with 16 KB', flash: 16_384, runs: false, most: 2500, mode: 'pointer')
  ].freeze

  # What a chip's runs and builds have shown.
  Found = Struct.new(:alone, :whole, :stack)

  # The tests, and what they have found.
  class Tests
    TABLE = 'tuner_alone'
    # Of the flash; an application wants the rest.
    WHOLE_MOST = 0.6
    HEAD = ['chip', 'flash', 'experiment alone adds', 'its RAM, and stack', 'the whole tuner adds', 'take', 'the whole tuner from'].freeze

    def initialize(folder, update)
      @folder = folder
      @update = update
      @found = {}
      @mutex = Mutex.new
    end

    def add(tests)
      CHIPS.each { |chip| tests.add("alone #{chip.name}") { try(chip) } }
      tests.add('seeded alone') { notice(CHIPS.first, Faults.of('alone').first) }
      tests.add('alone document', needs: tests.names.grep(/\Aalone /)) { @update ? rewrite : check }
    end

    private

    def try(chip)
      folder = "#{@folder}/alone-#{chip.name}"
      found = Found.new(*chip.added(%w[alone whole], folder))
      text = compare(chip, "#{folder}/run", found) if chip.runs
      @mutex.synchronize { @found[chip.name] = found }
      "#{text} alone #{found.alone.flash} whole #{found.whole&.flash || 'none'} of #{chip.flash}".strip
    end

    def compare(chip, folder, found)
      text = ran(chip, 'src', folder, found)
      raise Host::Failure, text unless text.match?(/ different 0 gains 3$/)

      "#{text} stack #{found.stack}"
    end

    def ran(chip, source, folder, found)
      FileUtils.mkdir_p(folder)
      flags = [*MODES.fetch(chip.mode), *INCLUDES]
      found.stack = chip.run(flags, ["#{FOLDER}/alone.c", *Alone.sources(ALONE, source)], folder)
      Host.output(host, "#{folder}/results").strip
    end

    def host
      @mutex.synchronize do
        @host ||= "#{@folder}/alone-host".tap do |path|
          FileUtils.mkdir_p(@folder)
          Host.output('gcc', '-std=c99', '-O2', *Harness::WARNINGS, *INCLUDES, "#{FOLDER}/host.c", "#{FOLDER}/alone.c",
                      *Alone.sources([*ALONE, 'autotune_result']), '-o', path)
        end
      end
    end

    def notice(chip, fault)
      text = ran(chip, Families.broken("#{@folder}/faulty-alone", fault), "#{@folder}/alone-seeded", Found.new)
      raise Host::Failure, "not noticed: #{text}" if text.include?('different 0')

      text
    end

    def table
      [HEAD, *CHIPS.map { |chip| row(chip, @found.fetch(chip.name)) }]
    end

    def row(chip, found)
      raise Host::Failure, "#{chip.title}: #{found.alone.flash} bytes, at most #{chip.most} allowed" if found.alone.flash > chip.most

      whole = found.whole&.flash
      fits = whole && whole <= WHOLE_MOST * chip.flash
      [chip.title, "#{chip.flash / 1024} KB", found.alone.flash, [found.alone.ram, found.stack].compact.join(' + '), whole || 'does not link',
       fits ? 'the whole tuner' : 'the experiment alone', whole ? "#{least(whole)} KB" : '']
    end

    # The smallest power of two of which it takes no more.
    def least(whole)
      kilobytes = 1
      kilobytes *= 2 while whole > WHOLE_MOST * kilobytes * 1024
      kilobytes
    end

    def rewrite
      DataTables.write(TABLE, table)
      "#{DataTables.path(TABLE)} is rewritten"
    end

    def check
      return DataTables.path(TABLE) unless DataTables.difference(TABLE, table)

      raise Host::Failure, "#{DataTables.path(TABLE)} is stale; test/chips/families/run --update alone renews it"
    end
  end
end

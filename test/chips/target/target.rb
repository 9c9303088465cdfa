# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The compiled library on simulated chips, bit for bit: see test/chips/target/run.
require_relative '../../../tools/lib/measure/subjects'
require_relative '../../../tools/lib/test/named'
require_relative 'firmware_limits'
require_relative 'interrupted'

ROOT = File.expand_path('../../..', __dir__)
VECTORS = 'test/support/vectors'
LOGS = "#{WORK}/logs"
BOTH = MODES.reverse.freeze
# Controller and chip of each firmware, and those with members at fixed addresses.
ON_CHIPS = CONTROLLERS.flat_map { |one| [one.name].product(one.pics) }.uniq.freeze
PLACED = [%w[an937 pic18f4520], %w[pid pic18f4520]].freeze
# Those whose ticks come from an interrupt; and whose tick an interrupt may call.
INTERRUPTED = (ON_CHIPS + CONTROLLERS.map(&:name).uniq.product(%w[atmega328p])).freeze
TICKING = %w[an937 pic18f4520].freeze
PORTS = %w[pic16f684 pic18f4520 pic18f26k22 pic18f4431 atmega328p].freeze
EXAMPLES = { 'pendulum' => 'an964', 'pendulum_8bit' => 'an964_8bit', 'motor' => 'an937', 'oven' => 'an937',
             'motor_pic18f26k22' => 'an937', 'oven_pic18f26k22' => 'an937',
             'motor_atmega328p' => 'an937', 'oven_atmega328p' => 'an937' }.freeze
# A source as XC8 preprocesses it for a class of PICs.
AS_XC8 = %w[avr-gcc -mmcu=atmega2560 -std=c99 -ffreestanding -funsigned-char -include test/support/as_xc8.h -E -P -Iinclude].freeze
XC8_CLASSES = File.read('test/support/as_xc8.h').scan(/\bdefined\((_PIC\w+)\)/).flatten.freeze
DIFFERENT = /rows [0-9]+ different [1-9]|random 1000 different [1-9]/.freeze

# How much is asked.
Amount = Struct.new(:random, :rows_apart, :placed_apart, :streamed)
SHORT = Amount.new(20_000, 31, 7, 5000).freeze
LONG = Amount.new(500_000, 1, 1, 200_000).freeze

# The programs of this machine that ask: test/chips/target/NAME.cc.
module Programs
  C = %W[gcc -std=c99 -O2 -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -Iinclude -Isrc -Isim/link -Itest/support -I#{HERE}].freeze
  CC = %W[g++ -std=c++17 -O2 -Wall -Wextra -Wpedantic -Wshadow -Werror -Isim/chip -Isim/link -Iinclude -Itest/support -I#{HERE}].freeze
  ASKING = [*%w[cases arith arith_an937 arith_an964 arith_an964_8bit arith_pid].map { |name| "#{HERE}/#{name}.c" },
            *%w[numbers numbers_pid reference reference_pid vectors].map { |name| "test/support/#{name}.c" }].freeze
  SIMULATORS = { 'gpsim' => %w[build/gpsim/libchip.a -lgpsim], 'simavr' => %w[build/gpsim/libchip_avr.a -lsimavr] }.freeze
  # Of examples/kept: all of it is one object, which exports only what is asked.
  KEPT = %W[gcc -std=c99 -O2 -Wall -Wextra -Wpedantic -Werror -I. -Iinclude -Isrc -Iport -Iport/pic/pic18f4520 -r
            #{HERE}/kept_host.c src/pid/fixpid_pid.c src/pid/fixpid_pid_more.c src/record/fixpid_record.c].freeze

  # The other end of a link: the library and what makes each step again.
  TWIN = %w[src/link/fixpid_link.c src/link/fixpid_link_commands.c src/pid/fixpid_pid.c src/pid/fixpid_pid_more.c
            src/pid/fixpid_pid_state.c src/pid/fixpid_pid_track.c src/record/fixpid_record.c test/support/link_session.c
            sim/link/link_twin.c sim/link/link_frames.c test/support/numbers.c].freeze

  class << self
    def of(name, simulator = 'gpsim')
      objects = objects_of(name)
      output = "#{WORK}/#{name}.#{simulator}"
      BUILT.command(output, 'g++', '-o', output, object(CC, "#{HERE}/#{name}.cc"), *objects, *SIMULATORS.fetch(simulator))
    end

    private

    def objects_of(name)
      case name
      when 'kept' then [kept]
      when 'link' then TWIN.map { |file| object(C, file) }
      else [object(CC, "#{HERE}/driver.cc"), *ASKING.map { |file| object(C, file) }]
      end
    end

    def object(compiler, source)
      output = "#{WORK}/#{File.basename(source)}.o"
      BUILT.command(output, *compiler, '-c', source, '-o', output)
    end

    def kept
      BUILT.command("#{WORK}/kept_host.o", *KEPT, '-o', "#{WORK}/kept_host.o")
    end
  end
end

# What the tests do.
module Target
  class << self
    attr_accessor :amount

    # The command fails, and says so.
    def noticed(pattern)
      text = yield
    rescue Host::Failure => e
      raise unless e.message.match?(pattern)

      e.message
    else
      raise Host::Failure, "#{text}not noticed"
    end

    # The one comparison of two machines' lines.
    def same(expected, found)
      lines = [found, expected].map(&:lines)
      at = (0...lines.map(&:size).max).find { |line| lines.first[line] != lines.last[line] }
      return found unless at

      raise Host::Failure, "#{found}line #{at + 1}: #{lines.map { |all| all[at].to_s.chomp.inspect }.join(', expected ')}"
    end

    # --- on a PIC ---

    def recordings(controller)
      names = controller == 'pid' ? %w[pid_definition track rest] : ["#{controller.delete_suffix('_8bit')}_firmware"]
      names.map { |name| "#{VECTORS}/#{name}.csv" }
    end

    # Its recordings, then random steps. Each mode has its own: half of what a
    # controller is to do.
    def replay(image, controller, steps, mode: 'object', rows: recordings(controller))
      said(Programs.of('replay'), image, controller, steps.to_s, mode == 'object' ? '1' : '2', *rows)
    end

    def digests(image, controller, apart = 1)
      said(Programs.of('digests'), image, controller, apart.to_s)
    end

    def interrupts(image, controller, *words)
      on_simulator('interrupts', image, controller, *words)
    end

    # gpsim has no PIC18F4431: a PIC18F4520 stands in, whose core, timers, PWM and ports
    # are the same.
    def port(image, chip, check = nil)
      return said('ruby', "#{HERE}/port_configuration.rb", chip, image.sub(/cod\z/, 'hex')) if check == 'configuration'
      return on_simulator('kept', image) if check == 'kept'
      return said(Programs.of('port', 'simavr'), image, *check) if chip == 'atmega328p'

      image = written(image.sub(/cod\z/, 'as_4520.cod'), File.binread(image).gsub('18f4431', '18f4520')) if chip == 'pic18f4431'
      said(Programs.of('port'), image, *check)
    end

    def on_simulator(name, image, *words)
      said(Programs.of(name, image.end_with?('.elf') ? 'simavr' : 'gpsim'), image, *words)
    end

    def kept(chip)
      Images.firmware
      on_simulator('kept', chip == 'atmega328p' ? "build/firmware/kept_#{chip}.elf" : 'build/firmware/kept.cod')
    end

    # The steps of each part, and the one before which a bit flips, if there is one.
    def watched(chip, *steps)
      Images.firmware
      image = chip == 'pic18f4520' ? 'watched.cod' : "watched_#{chip}.#{chip.start_with?('pic') ? 'cod' : 'elf'}"
      on_simulator('link', "build/firmware/#{image}", *steps.map(&:to_s))
    end

    def firmware(name)
      Images.firmware
      on_simulator('firmware', "build/firmware/#{name}.#{name.end_with?('_atmega328p') ? 'elf' : 'cod'}", EXAMPLES.fetch(name), '3000')
    end

    # A copy of a recording that the block has changed, as answered by the chip.
    def with_rows(name)
      lines = File.readlines("#{VECTORS}/an964_firmware.csv")
      yield lines
      rows = written("#{WORK}/#{name}.csv", lines.join)
      replay(Images.driver('an964', 'pic16f684', 'object'), 'an964', 1000, rows: [rows])
    end

    # --- here ---

    # What XC8 makes of a source for a class is what it makes for one that test/chips/cores
    # runs, and has no other compiler's words.
    def xc8_classes
      Dir.glob('src/**/fixpid_*.c').sort.map { |source| classes_of(source, XC8_CLASSES.to_h { |one| [one, said(*AS_XC8, "-D#{one}", source)] }) }.join
    end

    def classes_of(source, texts)
      words = texts.values.flat_map { |text| text.scan(/\b__\w+/) }.uniq
      raise Host::Failure, "#{source} has #{words.join(' ')}" unless words.empty?

      others = texts.keys.reject { |one| texts[one] == texts['_PIC14'] }
      raise Host::Failure, "#{source} is another one for #{others.join(', ')}, which does not run" unless [[], %w[_PIC18]].include?(others)

      "#{source} #{others.join}\n"
    end
  end
end

require_relative 'modules'

# The table of tests. Each line has the name, which says what differs, the part, and
# what is done.
class Table
  attr_reader :tests

  def initialize(update)
    @tests = NamedTests.new('test/chips/target/run')
    @update = update
    %i[replays arithmetic interrupts ports host seeded modules].each { |part| send(part) }
    figures unless Target.amount == LONG
  end

  private

  # What a test prints is in a file of its own. Most tests are weekly.
  def test(part, *name, needs: [], daily: false)
    name = name.join('-')
    @tests.add(name, part, *('weekly' unless daily), needs: needs) do
      FileUtils.rm_f("#{LOGS}/#{name}.log")
      text = begin
        yield
      rescue Host::Failure => e
        written("#{LOGS}/#{name}.log", e.message)
        raise
      end
      written("#{LOGS}/#{name}.log", text)
      nil
    end
  end

  # Each controller on each chip in each mode.
  def in_modes(modes = BOTH, pairs = ON_CHIPS)
    pairs.product(modes) { |(controller, chip), mode| yield controller, chip, mode }
  end

  def replays
    { 'replay' => ['', ON_CHIPS, BOTH, 1], 'replay_plain' => ['plain', ON_CHIPS, BOTH, 4], # which is slower
      'replay_placed' => ['placed', PLACED, %w[object], 1] }.each do |name, (form, pairs, modes, part)|
      in_modes(modes, pairs) do |controller, chip, mode|
        test('replay', name, controller, chip, mode, daily: name == 'replay' && mode == 'object') do
          Target.replay(Images.driver(controller, chip, mode, form: form), controller, Target.amount.random / part, mode: mode)
        end
      end
    end
  end

  # Each row of what the chip does in assembly, some of what its compiler makes and of the
  # same assembly at other addresses.
  def arithmetic
    amount = Target.amount
    { '' => [ON_CHIPS, 1], 'plain' => [ON_CHIPS, amount.rows_apart], 'placed' => [PLACED, amount.placed_apart] }.each do |form, (pairs, apart)|
      in_modes(%w[object], pairs) do |controller, chip, mode|
        test('arith', "arith#{form}", controller, chip, mode) do
          Target.digests(Images.arithmetic(controller, chip, form: form), controller, apart)
        end
      end
    end
  end

  def interrupts
    { '' => [INTERRUPTED, BOTH], 'plain' => [ON_CHIPS.select { |_, chip| chip.start_with?('pic18') }, %w[object]],
      'placed' => [PLACED, %w[object]] }.each do |form, (pairs, modes)|
      in_modes(modes, pairs) do |controller, chip, mode|
        test('interrupts', "interrupts_tick#{form}", controller, chip, mode) do
          Target.interrupts(Images.driver(controller, chip, mode, form: form, asks: :tick), controller)
        end
      end
    end
    ['', 'plain'].product(BOTH) do |form, mode|
      test('interrupts', "interrupts_ticking#{form}", *TICKING, mode) do
        Target.interrupts(Images.driver(*TICKING, mode, form: form, asks: :racy, calls: 'an937_tick'), TICKING.first, 'ticking')
      end
    end
    bad_interrupts
    Interrupted::MACHINES.keys.product(BOTH, Interrupted::OPTIMISED.to_a) do |name, mode, (optimised, option)|
      test('interrupts', 'interrupted', name, mode, optimised) { Interrupted.run(name, mode, option) }
    end
    test('interrupts', 'interrupts_unmasked') { Interrupted.unmasked }
  end

  # A port that loses ticks; and an interrupt that calls the controller a second time,
  # which may also leave the chip's memory or stack: gpsim 0.31 crashes where a pointer
  # of a PIC16 selects banks that the chip has not.
  def bad_interrupts
    { 'racy' => [/lost [1-9]/, INTERRUPTED],
      'replying' => [/changed [1-9]|access outside the chip's RAM|stack overflow|SIGSEGV/, INTERRUPTED.first(1)] }.each do |name, (pattern, pairs)|
      in_modes(%w[object], pairs) do |controller, chip, mode|
        test('interrupts', "interrupts_#{name}", controller, chip, mode) do
          image = Images.driver(controller, chip, mode, asks: :racy, calls: ("#{controller}_reply" if name == 'replying'))
          Target.noticed(pattern) { Target.interrupts(image, controller) }
        end
      end
    end
  end

  def ports
    PORTS.each do |chip|
      test('port', 'port', chip, daily: chip == 'pic16f684') { Target.port(Images.port(chip), chip) }
      test('port', 'port_unfed', chip) { Target.port(Images.port(chip), chip, 'unfed') }
      next if chip == 'atmega328p' # an AVR has fuses

      test('port', 'port_configuration', chip) { Target.port(Images.port(chip), chip, 'configuration') }
    end
    %w[pic18f4520 atmega328p].each { |chip| test('port', 'kept', chip) { Target.kept(chip) } }
    { 'pic18f4520' => 1, 'pic18f26k22' => 10, 'atmega328p' => 2 }.each do |chip, part|
      test('port', 'watched', chip) { Target.watched(chip, Target.amount.streamed / part, 1500, 500) }
    end
    needs = @tests.names.grep(/\Aport(_configuration)?-/)
    test('port', 'port_page', needs: needs) { said('ruby', "#{HERE}/port_page.rb", WORK, 'docs/ports.md') }
  end

  def host
    test('host', 'xc8_classes') { Target.xc8_classes }
  end

  # Each goes the way of the test that must notice it.
  def seeded
    in_modes(%w[object]) do |controller, chip, mode|
      test('seeded', 'seeded_driver', controller, chip, mode, daily: [controller, chip] == %w[an937 pic18f4520]) do
        image = Images.driver(controller, chip, mode, source: Broken.library)
        Target.noticed(DIFFERENT) { Target.replay(image, controller, 1000) }
      end
    end
    test('seeded', 'seeded_arith', *TICKING) do
      image = Images.arithmetic(*TICKING, source: Broken.library)
      Target.noticed(/different [1-9]/) { Target.digests(image, TICKING.first, Target.amount.rows_apart) }
    end
    test('seeded', 'seeded_losing', *TICKING) do
      image = Images.driver(*TICKING, 'object', asks: :racy, calls: 'an937_tick', source: Broken.losing)
      Target.noticed(/changed [1-9]/) { Target.interrupts(image, TICKING.first, 'ticking') }
    end
    seeded_interrupted
    seeded_ports
    seeded_links
    seeded_rows
  end

  # A step that races with its tick; and a run that does not come to every instruction.
  def seeded_interrupted
    %w[atmega328p cortex-m0].each do |name|
      test('seeded', 'seeded_interrupted', name) do
        Target.noticed(/^step .* neither [1-9]/) { Interrupted.run(name, 'pointer', source: Broken.racing) }
      end
    end
    test('seeded', 'seeded_uninterrupted') do
      Target.noticed(/instructions were never interrupted/) { Interrupted.run('cortex-m0', 'pointer', '-DSTATES=2u') }
    end
  end

  def seeded_ports
    Faults.of('port').each do |fault|
      name, check = fault.words(1)
      chip = name[/\w+\z/]
      test('seeded', 'seeded_port', name) do
        image = Images.public_send(check == 'kept' ? :kept : :port, chip, Broken.port(fault))
        Target.noticed(/^#{check}: /) { Target.port(image, chip, check) }
      end
    end
  end

  # A bit of the library, the rate of the UART, and a bit of the controller in RAM.
  def seeded_links
    Faults.of('watched').each_with_index do |fault, number|
      test('seeded', 'seeded_watched', fault.words(1).first, (number + 1).to_s) do
        image = Images.watched(fault.words(1).first, Broken.link(fault, number))
        Target.noticed(/^link: /) { Target.on_simulator('link', image, '1000', '100', '400') }
      end
    end
    test('seeded', 'seeded_watched_flip', 'atmega328p') do
      Target.noticed(/^link: clean: a step is different/) { Target.watched('atmega328p', 1000, 100, 400, 500) }
    end
  end

  # One number of one row, one more than it was; and a row that is missing.
  def seeded_rows
    test('seeded', 'seeded_row') do
      Target.noticed(/rows 2000 different 1 random 1000 different 0/) do
        Target.with_rows('wrong_row') { |lines| lines[1000] = lines[1000].chomp.split(',').tap { |row| row[8] = row[8].to_i + 1 }.join(',') << "\n" }
      end
    end
    test('seeded', 'seeded_length') do
      Target.noticed(/has not 2000 rows/) { Target.with_rows('row_missing') { |lines| lines.delete_at(1000) } }
    end
  end

  def modules
    CalledModule.all.each do |module_|
      module_.modes.each { |mode, options| test('modules', "pic18#{mode}", module_.name, daily: mode.empty? && module_.name != 'guard') { module_.on_pic18(mode, *options) } }
    end
    CalledModule::ON_CORES.each { |core, names| names.each { |name| test('modules', core, name, daily: true) { CalledModule.new(name).on_core(core) } } }
    test('seeded', 'seeded_module') { Target.noticed(/line 1: .*expected/) { CalledModule.new('slew').on_pic18('-broken', source: Broken.module('slew')) } }
  end

  def figures
    FirmwareLimits::FAULTS.each_key { |fault| test('seeded', 'seeded_limit', fault) { FirmwareLimits.notice(fault) } }
    EXAMPLES.each_key { |name| test('figures', 'firmware', name) { Target.firmware(name) } }
    needs = @tests.names.grep(/\A(replay|interrupts_\w+|interrupted|firmware)-/)
    test('figures', 'figures', needs: needs) do
      Images.firmware
      said('ruby', "#{HERE}/figures.rb", LOGS, 'build/firmware/sizes.json', *@update)
    end
  end
end

Dir.chdir(ROOT)
Host.setup(ROOT)
Encoding.default_external = Encoding::UTF_8
update = ARGV.delete('--update')
Target.amount = ARGV.delete('--long') ? LONG : SHORT
exit Table.new(update).tests.run(ARGV)

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../../../tools/lib/build/built'
require_relative '../../../tools/lib/faults/faults'
require_relative '../../../tools/lib/measure/host'

HERE = 'test/chips/target'
WORK = 'build/target'

# Runs a command; what it prints, or Failure with that.
def said(*command)
  text, status = Open3.capture2e(*command, stdin_data: '')
  return text if status.success?

  raise Host::Failure, "#{text}#{"SIG#{Signal.signame(status.termsig)}\n" if status.signaled?}in: #{command.join(' ')}"
end

BUILT = Built.new { |*command| said(*command) }

# A file of ours, if it has another content by now.
def written(path, text)
  FileUtils.mkdir_p(File.dirname(path))
  File.write(path, text) unless File.exist?(path) && File.read(path) == text
  path
end

# Copies of the library and the ports, with the faults of test/faults.txt.
module Broken
  @mutex = Mutex.new
  @made = {}

  class << self
    # src/ with a fault in each form of the arithmetic.
    def library
      "#{with('broken', Faults.of('forms'))}/src"
    end

    # src/ with a step that loses ticks.
    def losing
      "#{with('losing', Faults.of('losing'))}/src"
    end

    # src/ with a step that races with its tick.
    def racing
      "#{with('racing', Faults.of('racing'))}/src"
    end

    # src/ with the first fault that fuzzing finds in one of the other modules.
    def module(name)
      "#{with("modules/#{name}", Faults.of("fuzz #{name}").first(1))}/src"
    end

    # port/ with one fault.
    def port(fault)
      "#{with("faults/#{fault.words(1).first}", [fault])}/port"
    end

    # All of them with a fault of the link's firmware.
    def link(fault, number)
      with("links/#{number}", [fault])
    end

    private

    def with(name, faults)
      @mutex.synchronize { @made[name] ||= copy("#{WORK}/#{name}", faults) }
    end

    def copy(folder, faults)
      FileUtils.rm_rf(folder)
      FileUtils.mkdir_p(folder)
      FileUtils.cp_r(%w[include src port], folder)
      faults.each { |fault| fault.seed(folder) }
      folder
    end
  end
end

# Firmware for PICs and AVRs: a controller or a port, and what asks it.
module Images
  # The narrow products look at the bits that their limits leave: so at all.
  EVERY_BIT = %w[-DFIXPID_AN964_TERM_LIMIT=255 -DFIXPID_AN964_8BIT_TERM_LIMIT=127].freeze
  # As it is; in plain C; with members at fixed addresses.
  FORMS = {
    '' => [], 'plain' => %w[-DFIXPID_NO_ASSEMBLY],
    'placed' => %w[-DFIXPID_AN937_PLACE=__at(0x20) -DFIXPID_AN937_SIGNALS_PLACE=__at(0x38) -DFIXPID_PID_PLACE=__at(0x58)
                   -DFIXPID_PID_SIGNALS_PLACE=__at(0x3D) -DFIXPID_PID_OPERANDS_PLACE=__at(0x4C)]
  }.freeze

  class << self
    # A controller with its driver. `asks` is what calls it: driver_main.c, which waits
    # for questions; :tick with the chip's port, or :racy with one that loses ticks.
    # `calls` is what the interrupt calls.
    def driver(controller, chip, mode, form: '', asks: :main, calls: nil, source: 'src')
      name = [asks, *(source[%r{(\w+)/src\z}, 1]), form, calls, controller, chip, mode].compact.join('-').squeeze('-')
      definitions = ["-DREPLY=#{controller}_reply", *FORMS.fetch(form)]
      definitions << object(controller) if mode == 'object'
      definitions << "-DINTERRUPT_CALL=#{calls}" if calls
      # What asks and the port know all banks of a PIC16, the library one, but for
      # pointer mode, which fills both.
      build(chip, name, 'port', *definitions, *('--all-banks' if mode == 'pointer'), *library(controller, source),
            '--all-banks', "#{HERE}/driver_#{controller}.c", *asking(asks, chip, mode))
    end

    # A controller's arithmetic alone.
    def arithmetic(controller, chip, form: '', source: 'src')
      name = ['arith', *(source[%r{(\w+)/src\z}, 1]), form, controller, chip].join('-').squeeze('-')
      build(chip, name, 'port', "-DREPLY=#{controller}_arith", object(controller), *FORMS.fetch(form), *EVERY_BIT, "-I#{source}",
            "#{HERE}/driver_main.c", "#{HERE}/arith.c", "#{HERE}/arith_#{controller}.c",
            *Dir.glob("#{source}/#{controller}/fixpid_#{controller}_pic1[48].c"))
    end

    # The port below `ports` with what calls its functions.
    def port(chip, ports = 'port')
      name = ports == 'port' ? "port-#{chip}" : "fault-#{ports.split('/')[-2]}"
      build(chip, name, ports, '-DREPLY=none_reply', "#{HERE}/driver_port.c", 'port/port_wait_ticks.c', '--all-banks',
            "#{board(ports, chip)}/port.c")
    end

    # examples/kept with the port below `ports`; --all-banks is before the port's file.
    def kept(chip, ports)
      folder = board(ports, chip)
      eeprom = [folder, "#{ports}/pic/pic18"].map { |place| "#{place}/port_eeprom.c" }.find { |file| File.exist?(file) }
      build(chip, "fault-#{ports.split('/')[-2]}", ports, '-I.', *('-DFIXPID_PID_OBJECT=oven' unless chip == 'atmega328p'),
            *library('pid', 'src'), 'src/record/fixpid_record.c', "#{ports}/port_wait_ticks.c", eeprom, 'examples/kept/kept.c',
            '--all-banks', "#{folder}/port.c")
    end

    # examples/watched on a PIC18, with the library and the port of that folder.
    def watched(chip, folder)
      ports = "#{folder}/port"
      sources = %w[pid/fixpid_pid pid/fixpid_pid_more pid/fixpid_pid_state record/fixpid_record link/fixpid_link]
      sources += ['pid/fixpid_pid_pic18'].select { |name| File.exist?("#{folder}/src/#{name}.c") }
      build(chip, "watched-#{File.basename(folder)}", ports, '-I.', '-DFIXPID_PID_OBJECT=motor', '-DFIXPID_LINK_OBJECT=wire',
            '-DFIXPID_PID_FEATURES=0xDF', '-DPORT_UART', *sources.map { |name| "#{folder}/src/#{name}.c" },
            "#{ports}/port_wait_ticks.c", "#{ports}/pic/pic18/port_uart.c", 'examples/watched/watched.c',
            '--all-banks', "#{board(ports, chip)}/port.c")
    end

    # Any other program for a PIC18.
    def program(name, words, chip = 'pic18f4520')
      build(chip, name, 'port', '-Itest/support', *words)
    end

    # All examples, as tools/firmware builds them.
    def firmware
      inputs = %w[include/* src/**/* port/**/* examples/*/*.[ch] tools/firmware].flat_map { |pattern| Dir.glob(pattern).sort }
      made = Inputs.digest(inputs + Built.own + Inputs.sdcc + Inputs.tool('avr-gcc'))
      BUILT.make('build/firmware/sizes.json', [made], 'build/firmware/*.{cod,elf}') { said('tools/firmware') }
    end

    def object(controller)
      "-DFIXPID_#{controller.upcase}_OBJECT=#{controller}_controller"
    end

    private

    def build(chip, name, ports, *words)
      folders = ['include', HERE, ports, "#{ports}/pic", board(ports, chip)].map { |folder| "-I#{folder}" }
      builder, kind = chip == 'atmega328p' ? %w[build_avr elf] : %w[build_pic cod]
      BUILT.command("#{WORK}/#{name}.#{kind}", "tools/lib/build/#{builder}", chip, "#{WORK}/#{name}", *folders, *words)
    end

    def board(ports, chip)
      Dir.glob("#{ports}/*/#{chip}").first
    end

    def library(controller, source)
      ['', '_more', '_track', '_pic14', '_pic18'].map { |part| "#{source}/#{controller}/fixpid_#{controller}#{part}.c" }
                                                .select { |file| File.exist?(file) }
    end

    def asking(asks, chip, mode)
      case asks
      when :main then ["#{HERE}/driver_main.c"]
      when :racy then ["#{HERE}/driver_tick.c", "#{HERE}/port_racy#{'_avr' if chip == 'atmega328p'}.c"]
      else ["#{HERE}/driver_tick.c", port_with_ticks(chip, mode)]
      end
    end

    # In pointer mode a PIC16 has no room for what reads and drives.
    def port_with_ticks(chip, mode)
      port = "#{board('port', chip)}/port.c"
      return port unless [mode, chip] == %w[pointer pic16f684]

      written("#{WORK}/port_of_ticks.c", File.read(port).sub(/^uint16_t port_read.*/m, ''))
    end
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'images'

# Programs for machines that can print: this one, an AVR, and those of QEMU.
class Machine
  SHARED = %W[-std=c99 -O2 -Wall -Wextra -Werror -Iinclude -Itest/support -I#{HERE}].freeze
  SHIM = "-I#{HERE}/shim"
  BARE = ['-ffreestanding', '-nostdlib', "-I#{HERE}/qemu", SHIM].freeze

  attr_reader :name

  # `after` are words of the compiler that come last.
  def initialize(name, compiler, after = [], &run)
    @name = name
    @compiler = compiler
    @after = after
    @run = run
  end

  # Addresses of a program's instructions and their text, by function.
  def instructions(program)
    functions = Hash.new { |all, name| all[name] = {} }
    name = nil
    said(@compiler.first.sub(/gcc\z/, 'objdump'), '-d', program).each_line do |line|
      name = Regexp.last_match(1) if line =~ /\A\h+ <(.+)>:/
      functions[name][Regexp.last_match(1).hex] = Regexp.last_match(2) if line =~ /\A *(\h+):\t[\h ]+\t(\S.*)/
    end
    functions
  end

  # A program of these words, which are sources and options.
  def program(name, words)
    output = "#{WORK}/#{name}.#{@name}.elf"
    compiler, *options = @compiler
    BUILT.command(output, compiler, *SHARED, *options, *words, '-o', output, *@after)
  end

  # What it prints, with more words for its simulator. Some answer may be wrong: then
  # its exit status says so, and whoever compares sees it.
  def printed(program, *words)
    Open3.capture2e('timeout', '600', *@run.call(program), *words, stdin_data: '').first.lines.grep_v(/^Timer with period zero/).join
  end

  def self.qemu(name, compiler, folder, *system)
    new(name, [*compiler, *BARE], ["#{HERE}/#{folder}/start.c", "#{HERE}/qemu/runtime.c", '-T', "#{HERE}/#{folder}/flash.ld", '-lgcc']) do |program|
      ["qemu-system-#{system.first}", *system.drop(1), '-nographic', '-semihosting', '-kernel', program]
    end
  end

  def self.arm(core, board)
    qemu(core, ['arm-none-eabi-gcc', "-mcpu=#{core}", '-mthumb'], 'arm', 'arm', '-M', board)
  end

  def self.riscv(core, abi, *options)
    qemu(core, ['riscv64-unknown-elf-gcc', "-march=#{core}", "-mabi=#{abi}"], 'riscv', 'riscv32', '-M', 'virt', '-bios', 'none', *options)
  end

  # An AVR whose library is XC8's for a PIC of that class: its text, as XC8 preprocesses
  # it, by avr-gcc, whose types are the same, without inlining.
  class AsXc8 < Machine
    CHIP = 'atmega2560'
    CLASSES = %w[_PIC14 _PIC14E _PIC14EX _PIC18].freeze
    TEXT = %W[-mmcu=#{CHIP} -std=c99 -ffreestanding -funsigned-char -include test/support/as_xc8.h].freeze

    def initialize(of_chip)
      @of_chip = of_chip
      super("xc8#{of_chip.downcase}", %W[avr-gcc -mmcu=#{CHIP} -std=gnu99 -D__XC8], %w[test/chips/avr/avr_stdio.c]) { |program| ['test/chips/avr/run', program, CHIP] }
    end

    # The sources of the library apart, once for all programs that define the same of it.
    def program(name, words)
      library, others = words.partition { |word| File.basename(word).match?(/\Afixpid_\w+\.c\z/) }
      super(name, others + library.map { |source| object(source, others.grep(/\A-(I|DFIXPID_)/)) })
    end

    # What XC8's compiler proper gets of a source for a chip of that class.
    def self.text(source, of_chip)
      said('avr-gcc', *TEXT, "-D#{of_chip}", '-E', '-P', '-Iinclude', source)
    end

    private

    def object(source, options)
      folder = written("#{WORK}/#{name}/#{Digest::SHA256.hexdigest(options.join(' '))[0, 12]}/options", options.join(' ')).delete_suffix('/options')
      output = "#{folder}/#{File.basename(source, '.c')}.o"
      BUILT.command(output, 'avr-gcc', *TEXT, "-D#{@of_chip}", '-O2', '-fno-inline', '-Wall', '-Wextra', '-Werror', '-Iinclude', *options, '-c', source, '-o', output)
    end
  end

  ALL = [
    arm('cortex-m0', 'microbit'), arm('cortex-m3', 'lm3s6965evb'), arm('cortex-m4', 'mps2-an386'),
    riscv('rv32imc', 'ilp32'), riscv('rv32ec', 'ilp32e', '-cpu', 'rv32,m=false'),
    *{ 'avr' => 'atmega2560', 'atmega328p' => 'atmega328p' }.map do |name, chip|
      new(name, ['avr-gcc', "-mmcu=#{chip}"], %w[test/chips/avr/avr_stdio.c]) { |program| ['test/chips/avr/run', program, chip] }
    end,
    *%w[_PIC14 _PIC18].map { |of_chip| AsXc8.new(of_chip) },
    new('host', ['gcc', SHIM]) { |program| [program] },
    new('sanitized', ['gcc', '-fsanitize=undefined', '-fno-sanitize-recover=all', SHIM]) { |program| [program] }
  ].to_h { |machine| [machine.name, machine] }.freeze
end

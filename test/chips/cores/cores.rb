# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The unit tests on cores: see test/chips/cores/run.
require 'fileutils'
require 'open3'
require_relative '../../../tools/lib/faults/faults'
require_relative '../../../tools/lib/test/named'

# A core: its compiler with its options, what is linked to each program, its simulator, which
# gets the program as its last word, and how much is tried on it.
Core = Struct.new(:compiler, :options, :program, :simulator, :amount) do
  # picolibc has the start-up, and QEMU what a program prints and its end.
  def self.qemu(compiler, options, memory, system)
    sizes = %w[flash flash_size ram ram_size stack_size].zip(memory).map { |name, value| "-Wl,--defsym=__#{name}=#{value}" }
    new(compiler, "#{options} --specs=picolibc.specs", "--oslib=semihost --crt0=hosted #{sizes.join(' ')}",
        "qemu-system-#{system} -nographic -semihosting -kernel", '-DTEST_STRIDE=251 -DTEST_STEPS_MAX=1000')
  end

  def self.arm(core, board)
    qemu('arm-none-eabi-gcc', "-mcpu=#{core} -mthumb", %w[0x00000000 256K 0x20000000 16K 4K], "arm -M #{board}")
  end

  def self.riscv(core, abi, more = '')
    qemu('riscv64-unknown-elf-gcc', "-march=#{core} -mabi=#{abi}", %w[0x80000000 2M 0x80200000 16K 4K], "riscv32 -M virt -bios none#{more}")
  end
end

# The table of tests.
module Cores
  FOLDER = 'test/chips/cores'
  WORK = 'build/cores'
  # One with 8 KB of RAM, and one with 16: XC8's text has no PROGMEM, and the autotuner's tables
  # are in RAM then.
  AVRS = %w[atmega2560 atmega1284p].to_h do |chip|
    [chip, Core.new('avr-gcc', "-mmcu=#{chip}", "#{FOLDER}/avr_stdio.c", "#{FOLDER}/simavr #{chip}", '-DTEST_STRIDE=2039 -DTEST_MEMORIES=1000u -DTEST_STEPS_MAX=400')]
  end.freeze
  ALL = {
    'atmega2560' => AVRS['atmega2560'],
    'cortex-m0' => Core.arm('cortex-m0', 'microbit'),
    'cortex-m3' => Core.arm('cortex-m3', 'lm3s6965evb'),
    'cortex-m4' => Core.arm('cortex-m4', 'mps2-an386'),
    'rv32imc' => Core.riscv('rv32imc', 'ilp32'),
    'rv32ec' => Core.riscv('rv32ec', 'ilp32e', ' -cpu rv32,m=false')
  }.freeze
  DAILY = %w[atmega2560 cortex-m0 rv32imc].freeze
  # What XC8 chooses for a PIC16 and a PIC18: its text of the library, whose types are an AVR's.
  # (With it port.h has macros where the examples' tests have functions.)
  XC8 = %w[_PIC14 _PIC18].to_h do |of_chip|
    ["xc8#{of_chip.downcase}", "-include test/support/as_xc8.h -D#{of_chip} -ffreestanding -funsigned-char -fno-inline"]
  end.freeze

  class << self
    def tests
      tests = NamedTests.new("#{FOLDER}/run", 1) # Ceedling does more at a time
      ALL.keys.product(%w[object pointer]) do |core, mode|
        tests.add("#{core}-#{mode}", *('weekly' unless mode == 'object' && DAILY.include?(core))) { run(core, mode) }
      end
      tests.add('atmega2560-narrow', 'weekly') { run('atmega2560', 'pointer', form: 'narrow') }
      XC8.each do |name, options|
        tests.add(name, 'weekly') { run('atmega2560', 'object', library: options, pattern: 'test_fixpid_(?!autotune(_result|_rows)?[.]c)') }
        tests.add("#{name}-autotune", 'weekly') { run('atmega1284p', 'object', library: options, pattern: 'test_fixpid_autotune(_result|_rows)?[.]c') }
      end
      Faults.of('cores').each_with_index do |fault, number|
        core, mod = fault.words(1)
        tests.add("seeded-#{core}-#{number + 1}", 'seeded', 'weekly') { seeded(fault, core, "test_fixpid_#{mod}[.]c") }
      end
      tests
    end

    private

    # How many tests there are, if all pass.
    def run(name, mode, form: 'wide', library: '', pattern: nil, tree: '.')
      build = "build/ceedling-#{[name, mode, form, *library[/_PIC\d+/], *('faulty' unless tree == '.')].join('-')}"
      vectors
      core = ALL.fetch(name, AVRS[name]).to_h
      core[:amount] = "#{core[:amount]} -D__XC8" unless library.empty?
      mixins = { 'core' => format(File.read("#{FOLDER}/core.yml"), build: build, **core), 'mode' => text(mode, form) }.map do |part, said|
        File.write("#{WORK}/#{part}.yml", said)
        "#{WORK}/#{part}.yml"
      end
      mixins << 'test/unit/object.yml' if mode == 'object'
      asked = pattern ? "test:pattern[#{pattern}]" : 'test:all'
      said, status = Open3.capture2e({ 'LIBRARY_OPTIONS' => library }, 'tools/lib/test/ceedling', build, *mixins.map { |mixin| "--mixin=#{mixin}" }, asked,
                                     stdin_data: '', chdir: tree)
      raise why(said) unless status.success? && said[/^failures (\d+)$/, 1] == '0'

      "#{said[/^tests (\d+)$/, 1]} unit tests"
    end

    def text(mode, form)
      Open3.capture2('sh', '-c', ". tools/lib/test/parts.sh && mode_and_form #{mode} #{form} test").first
    end

    def why(said)
      said[/FAILED TEST SUMMARY.*?OVERALL/m] || said.lines.grep(/EXCEPTION|ERROR|error:|undefined reference|region/).first(20).join
    end

    # The recorded rows as C, but those of heat-ups, which are no numbers only.
    def vectors
      files = Dir.glob('test/support/vectors/*.csv').grep_v(/reaction/).sort
      FileUtils.mkdir_p("#{WORK}/vectors")
      File.write("#{WORK}/vectors/vectors.c", Open3.capture2('ruby', "#{FOLDER}/vectors_table.rb", *files).first)
    end

    # A project whose src/ has the fault; the rest of it is this one.
    def seeded(fault, core, pattern)
      tree = "#{WORK}/faulty"
      FileUtils.rm_rf(tree)
      FileUtils.mkdir_p(tree)
      (Dir.children('.') - %w[src .git]).each { |entry| File.symlink(File.expand_path(entry), "#{tree}/#{entry}") }
      FileUtils.cp_r('src', tree)
      fault.seed(tree)
      begin
        passed = run(core, 'object', pattern: pattern, tree: tree)
      rescue RuntimeError => e
        raise unless e.message.include?('FAILED TEST SUMMARY')

        return e.message[/Test: (\w+)/, 1]
      end
      raise "#{fault}: not noticed by #{passed}"
    end
  end
end

Dir.chdir(File.expand_path('../../..', __dir__))
Encoding.default_external = Encoding::UTF_8
exit Cores.tests.run(ARGV)

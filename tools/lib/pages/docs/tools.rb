# SPDX-License-Identifier: MIT
# The tables of docs/tools.md: what judges fixpid, in which version, and which errors are
# planted for it; and which compiler was compared on which target. The versions stay those that
# the page has; called as a program with --update, this writes those of this machine.
require 'open3'
require_relative 'commands'
require_relative 'packages'

module Tools
  PAGE = 'docs/tools.md'.freeze
  # tool, Debian's package, what it judges, which planted errors must be noticed.
  JUDGES = [
    ['gcc', 'gcc', 'warnings; everything that runs on a PC', 'tools/test gates'],
    ['clang', 'clang', 'warnings; sanitizers; fuzzing; the MSP430', 'tools/test fuzz'],
    ['avr-gcc', 'gcc-avr', 'the AVR', 'test/chips/target/run seeded'],
    ['arm-none-eabi-gcc', 'gcc-arm-none-eabi', 'the Cortex-M', 'test/chips/target/run seeded'],
    ['riscv64-unknown-elf-gcc', 'gcc-riscv64-unknown-elf', 'RISC-V', 'test/chips/target/run seeded'],
    ['SDCC', 'sdcc', 'STM8, 8051 and Z80; built anew from its source, PIC and Padauk', 'test/chips/families/run'],
    ['gputils', 'gputils', 'PIC: assembles, links, and knows registers', 'test/chips/target/run seeded'],
    ['gpsim', 'gpsim-dev', 'simulates PICs', 'test/chips/target/run seeded'],
    ['simavr', 'simavr', 'simulates AVRs', 'test/chips/target/run seeded'],
    ['QEMU', 'qemu-system-arm', 'simulates Cortex-M; its like, RISC-V', 'test/chips/target/run seeded'],
    ['ucsim', 'sdcc-ucsim', 'simulates STM8, 8051 and Z80', 'test/chips/families/run'],
    ['mspdebug', 'mspdebug', 'simulates an MSP430', 'test/chips/families/run'],
    ['CBMC', nil, 'proofs; `tools/lib/build/fetch_cbmc` fetches it', 'test/proof/run'],
    ['cppcheck', 'cppcheck', "MISRA's rules", 'tools/test gates'],
    ['clang-tidy', 'clang-tidy', 'patterns that are known to be wrong', 'tools/test gates'],
    ["Frama-C's Eva", nil, 'memory that is read before it was written', nil],
    ['pmccabe', 'pmccabe', 'length and complexity of functions', 'tools/test gates'],
    ['Ceedling', nil, 'unit tests; `tools/lib/setup.sh` installs the gem', 'tools/test mutants'],
    ['gcovr', 'gcovr', 'lines and branches that unit tests reach', nil]
  ].freeze
  # target, compiler, where it ran, command.
  TARGETS = [
    ['PC, 64 bits', 'gcc', 'here', 'test/chips/target/run host'],
    ['PC, Windows', 'MinGW', 'Wine', 'test/use/windows/run'],
    ['PC, newest compilers', 'gcc and clang of Debian testing', 'a chroot', 'test/tools/newest/run'],
    ['PIC16, PIC18', 'SDCC', 'gpsim', 'test/chips/target/run replay'],
    ['AVR', 'avr-gcc', 'simavr', 'test/chips/target/run machines'],
    ['Cortex-M0, M3, M4', 'arm-none-eabi-gcc', 'QEMU', 'test/chips/target/run machines'],
    ['RV32IMC, RV32EC', 'riscv64-unknown-elf-gcc', 'QEMU', 'test/chips/target/run machines'],
    ['STM8, 8051, Z80, Padauk', 'SDCC', 'ucsim', 'test/chips/families/run exact'],
    ['MSP430', 'clang', 'mspdebug', 'test/chips/families/run exact'],
    ["a PIC16 and a PIC18 with XC8's choices, on an AVR", 'avr-gcc', 'simavr', 'test/chips/target/run machines'],
    ['PIC, with XC8', 'none: clang reads the sources as XC8 does', 'nothing ran', 'test/use/xc8_check/run']
  ].freeze
  ROW = /^\| (.+?) \| (.*?) \| /.freeze

  class << self
    def renewed(text, known = versions_of(text))
      part(part(text, 'tools', judges(known)), 'targets', targets)
    end

    def failures
      packages = JUDGES.map { |_, package, _, _| package }.compact
      commands = JUDGES.map(&:last).compact + TARGETS.map(&:last)
      (packages - Packages.wanted).map { |name| "#{PAGE}: no tool asks for #{name}" } +
        commands.uniq.reject { |command| Commands.known?(command) }.map { |command| "#{PAGE}: no #{command}" }
    end

    # Of this machine's packages.
    def installed
      JUDGES.to_h { |tool, package, _, _| [tool, package ? version(package) : ''] }
    end

    private

    def version(package)
      Open3.capture2('dpkg-query', '-W', '-f', '${Version}', package).first
    end

    def versions_of(text)
      text[/<!-- tools:begin -->.*?<!-- tools:end -->/m].to_s.scan(ROW).to_h
    end

    def judges(known)
      rows = JUDGES.map { |tool, _, what, command| "| #{tool} | #{known.fetch(tool, '')} | #{what} | #{command ? "`#{command}`" : 'none'} |\n" }
      "| tool | Debian's version | judges | planted errors in |\n|---|---|---|---|\n#{rows.join}"
    end

    def targets
      "| target | compiler | ran in | command |\n|---|---|---|---|\n" +
        TARGETS.map { |target, compiler, where, command| "| #{target} | #{compiler} | #{where} | `#{command}` |\n" }.join
    end

    def part(text, name, content)
      text.sub(/(<!-- #{name}:begin -->\n).*?(<!-- #{name}:end -->)/m) { "#{$1}#{content}#{$2}" }
    end
  end
end

if __FILE__ == $PROGRAM_NAME && ARGV == ['--update']
  File.write(Tools::PAGE, Tools.renewed(File.read(Tools::PAGE), Tools.installed))
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'host'

# A core in QEMU: its compiler, by the beginning of its programs' names and by
# its options, its folder of test/chips/target and of test/tools/cost, and its simulator.
Core = Struct.new(:tools, :options, :folder, :qemu, keyword_init: true) do
  def compile(*arguments)
    Host.output("#{tools}-gcc", *options, *Core::OPTIONS, "-Itest/tools/cost/#{folder}", *arguments)
  end

  # With the harness.
  def link(program, *arguments)
    compile('-nostdlib', *arguments, '-T', "test/chips/target/#{folder}/flash.ld", '-Wl,--gc-sections', '-lgcc', '-o', program)
  end

  # Every program needs them.
  def sources
    ["test/chips/target/#{folder}/start.c", 'test/chips/target/qemu/runtime.c']
  end

  # Its note about a timer that is off is not ours.
  def run(program, seconds = 300)
    Host.output('timeout', seconds.to_s, *qemu, '-nographic', '-semihosting', '-kernel', program)
  end
end

Core::OPTIONS = %w[-std=c99 -ffreestanding -ffunction-sections -Itest/chips/target/qemu
                   -Itest/tools/cost/qemu].freeze

# Each instruction takes the same virtual time, which the counter of a Cortex-M
# reads; that of a RISC-V counts the instructions then.
CORES = {
  arm: { 'cortex-m0' => 'microbit', 'cortex-m4' => 'mps2-an386' }.map do |name, board|
    [name, Core.new(tools: 'arm-none-eabi', options: ["-mcpu=#{name}", '-mthumb'], folder: 'arm',
                    qemu: ['qemu-system-arm', '-M', board, '-icount', 'shift=10,sleep=off'])]
  end,
  riscv: { 'rv32imc' => %w[ilp32 m=true], 'rv32ec' => %w[ilp32e m=false] }.map do |name, (abi, multiplier)|
    [name, Core.new(tools: 'riscv64-unknown-elf', options: ["-march=#{name}", "-mabi=#{abi}"], folder: 'riscv',
                    qemu: ['qemu-system-riscv32', '-M', 'virt', '-bios', 'none', '-cpu', "rv32,#{multiplier}",
                           '-icount', 'shift=0,sleep=off'])]
  end
}.values.flatten(1).to_h.freeze

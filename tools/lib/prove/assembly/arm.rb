# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'elf'

# What a Cortex-M's instructions do to the registers of test/proof/assembly/arm.h: only
# those that the functions come to, or their breaks. A wide form of one that has a narrow
# one ends in `.w`, and is refused.
class ArmTranslation < ElfTranslation
  STATEMENTS = {
    'mov' => '$1 = $2;',
    'movs' => '$1 = sign_and_zero(cpu, $2);',
    'adds' => '$1 = added(cpu, $2, $3, 0);',
    'adcs' => '$1 = added(cpu, $1, $2, cpu->c);',
    'subs' => '$1 = added(cpu, $2, ~$3, 1);',
    'sbcs' => '$1 = added(cpu, $1, ~$2, cpu->c);',
    'eors' => '$1 = sign_and_zero(cpu, $1 ^ $2);',
    'orrs' => '$1 = sign_and_zero(cpu, $1 | $2);',
    'lsls' => '$1 = moved_left(cpu, $2, $3);',
    'lsrs' => '$1 = moved_right(cpu, $2, $3);',
    'qadd' => '$1 = saturated(cpu, (int64_t)(int32_t)$2 + (int32_t)$3, 32);',
    'ssat' => '$1 = saturated(cpu, (int32_t)$3, $2);',
    'nop' => ''
  }.freeze
  BRANCHES = { 'bvc' => '!cpu->v', 'bvs' => 'cpu->v' }.freeze
  RETURNS = { 'bx' => 'must($1 == cpu->caller, "it returns to its caller");' }.freeze
  MODEL = 'arm.h'
  NAME = 'an ARM'
  BARE = %w[-mthumb -ffreestanding].freeze
  COMPILE = ['arm-none-eabi-gcc', '-std=c99', '-mcpu=cortex-m4', *BARE, '-nostdlib'].freeze
  SIMULATOR = %w[-Itest/support -Itest/chips/target/qemu test/proof/assembly/qemu.c test/chips/target/arm/start.c
                 test/chips/target/qemu/runtime.c -T test/chips/target/arm/flash.ld -lgcc].freeze
  TOOLS = 'arm-none-eabi'
  # Behind the program that compares them, in the simulator's flash.
  BEHIND = %w[-Wl,-Ttext=0x20000 -Wl,--nmagic -Wl,--entry=0x20000].freeze
  OPTIONS = { 'arm_thumb1' => 'cortex-m0', 'arm_dsp' => 'cortex-m4' }.transform_values { |core| ["-mcpu=#{core}", *BARE, *BEHIND] }.freeze
  WITH_ALL = 'arm_dsp'
  EXAMPLES = {
    ['%s r0, r1', '%s r2, r2', '%s r7, r3'] => %w[mov movs],
    ['%s r0, #0', '%s r3, #128', '%s r7, #255'] => %w[movs],
    ['%s r0, r1, r2', '%s r3, r3, r4', '%s r5, r5, r5'] => %w[adds subs qadd],
    ['%s r0, r1', '%s r3, r3', '%s r7, r2'] => %w[adcs sbcs eors orrs],
    ['%s r0, r1, #1', '%s r3, r3, #24', '%s r7, r2, #31'] => %w[lsls lsrs],
    ['%s r0, r1, #32'] => %w[lsrs],
    ['%s r0, #1, r1', '%s r3, #16, r3', '%s r7, #32, r2'] => %w[ssat],
    ['%s'] => %w[nop],
    ['%s lr'] => %w[bx],
    ['%s 1f'] => BRANCHES.keys
  }.freeze
  HEAD = ".syntax unified\n.thumb\n"
  FUNCTION = ".global %<name>s\n.thumb_func\n"
  FOLLOWER = 'mov r8, r9'
  LAST = 'bx lr'
  SPECIAL = { 'sp' => 13, 'lr' => 14 }.freeze

  class << self
    # The files of src/ that have its assembly.
    def sources
      /_arm\.h\z/
    end

    # What runs the program that compares the instructions with QEMU's.
    def compared(folder)
      ['qemu-system-arm', '-M', 'mps2-an386', '-nographic', '-semihosting', '-kernel', "#{folder}/compared",
       '-device', "loader,file=#{program(folder)}"]
    end

    private

    def disassembled(address, code, name, operands)
      super(address, code, name.delete_suffix('.n'), operands)
    end
  end

  # Of bytes from the lowest one on.
  def place(text, index)
    "cpu->r[#{text.delete_prefix('r')}].bytes[#{index}]"
  end

  # What `kept` must know of a claim.
  def places(_claim)
    ''
  end

  private

  def operand(text)
    return "#{text.delete_prefix('#')}u" if text.start_with?('#')

    "R(#{SPECIAL.fetch(text) { Integer(text.delete_prefix('r'), 10) }})"
  end

  # One that has more operands does something else, too.
  def filled(table, one)
    known = table == BRANCHES ? 1 : table.fetch(one.name).scan(/\$(\d)/).flatten.map(&:to_i).max.to_i
    one.operands.size > known and raise Unknown, format('%s at 0x%04x has %d operands', one.name, one.address, one.operands.size)
    super
  end

  def target(one)
    one.operands.last.hex
  end
end

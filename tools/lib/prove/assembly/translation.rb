# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require 'open3'

# An instruction as a disassembler prints it. `bytes` are in units of the addresses.
Disassembled = Struct.new(:address, :bytes, :name, :operands)

# C that does what the functions of linked code do, made of its disassembly. A class for
# each instruction set has tables of what the instructions do, in C, where $1, $2, ... are
# their operands, as `operand` writes them:
#
#   STATEMENTS  name => what it does before the next one
#   SKIPS       name => if this holds, the next one is left out
#   BRANCHES    name => if this holds, it goes on at its target
#   JUMPS       those that always do
#   CALLS       those that come back from there
#   RETURNS     name => what it does before it returns
class Translation
  # What cannot be translated, and why; or what no compiler or assembler takes.
  class Unknown < StandardError; end

  SKIPS = {}.freeze
  CALLS = [].freeze
  JUMPS = [].freeze

  attr_reader :entries

  # `entries` are addresses by name.
  def initialize(disassembled, entries)
    @instructions = disassembled.to_h { |one| [one.address, one] }
    @entries = entries
  end

  # The C of functions, by what they are called there, and of those that they call.
  def c_of(entries)
    starts = entries.transform_values { |entry| @entries[entry] or raise Unknown, "there is no function #{entry}" }
    found = starts.values.uniq
    texts = {}
    while (at = (found - texts.keys).first)
      body = reached(at)
      texts[at] = function(at, body)
      found |= body.select { |one| calls?(one) }.map { |one| target(one) }
    end
    "#{texts.keys.map { |at| "static void #{name(at)}(struct cpu *cpu);\n" }.join}\n#{texts.values.join("\n")}" \
      "#{starts.map { |called, at| "\nstatic void #{called}(struct cpu *cpu)\n{\n    #{name(at)}(cpu);\n}\n" }.join}"
  end

  # What runs the program that compares the instructions with the simulator's.
  def self.compared(folder)
    ["#{folder}/compared", program(folder)]
  end

  # Every instruction that the tables have.
  def self.names
    self::STATEMENTS.keys + self::SKIPS.keys + self::BRANCHES.keys + self::JUMPS + self::CALLS + self::RETURNS.keys
  end

  private

  def name(address)
    format('at_%04x', address)
  end

  def calls?(one)
    self.class::CALLS.include?(one.name)
  end

  # The instructions that a function comes to, by address.
  def reached(start)
    found = {}
    open = [start]
    while (at = open.pop)
      next if found[at]

      found[at] = one = instruction(at)
      open.concat(followers(one))
    end
    found.values.sort_by(&:address)
  end

  def instruction(address)
    @instructions[address] or raise Unknown, format('there is no instruction at 0x%04x', address)
  end

  def after(one)
    one.address + one.bytes
  end

  def skipped_to(one)
    after(instruction(after(one)))
  end

  def followers(one)
    case one.name
    when *self.class::STATEMENTS.keys, *self.class::CALLS then [after(one)]
    when *self.class::SKIPS.keys then [after(one), skipped_to(one)]
    when *self.class::BRANCHES.keys then [after(one), target(one)]
    when *self.class::JUMPS then [target(one)]
    when *self.class::RETURNS.keys then []
    else raise Unknown, format('no table says what %s does, at 0x%04x', one.name, one.address)
    end
  end

  def function(start, body)
    first = body.first.address == start ? [] : [go(start, -1)]
    lines = body.map { |one| "#{name(one.address)}: // #{one.name} #{one.operands.join(', ')}\n    #{c(one)}\n" }
    "static void #{name(start)}(struct cpu *cpu)\n{\n#{first.map { |line| "    #{line}\n" }.join}#{lines.join}}\n"
  end

  # A way back is counted: nothing turns for ever.
  def go(address, from)
    address > from ? "goto #{name(address)};" : "{ turned(); goto #{name(address)}; }"
  end

  def c(one)
    on = go(after(one), one.address)
    tables = self.class
    case one.name
    when *tables::STATEMENTS.keys then "#{filled(tables::STATEMENTS, one)} #{on}"
    when *tables::SKIPS.keys then "if (#{filled(tables::SKIPS, one)}) { #{go(skipped_to(one), one.address)} } #{on}"
    when *tables::BRANCHES.keys then "if (#{filled(tables::BRANCHES, one)}) #{go(target(one), one.address)} #{on}"
    when *tables::JUMPS then go(target(one), one.address)
    when *tables::CALLS then "#{name(target(one))}(cpu); #{on}"
    else "#{filled(tables::RETURNS, one)} return;"
    end
  end

  def filled(table, one)
    table.fetch(one.name).gsub(/\$(\d)/) do
      text = one.operands[Regexp.last_match(1).to_i - 1] or
        raise Unknown, format('%s at 0x%04x has %d operands', one.name, one.address, one.operands.size)
      operand(text)
    end
  end

  # What an operand is in C.
  def operand(text)
    text
  end

  # Where a branch, jump or call leads.
  def target(one)
    Integer(one.operands.last)
  end

  # What a program prints.
  def self.said(*command)
    output, status = Open3.capture2e(*command)
    status.success? or raise Unknown, "#{command.join(' ')}\n#{output}"
    output
  end
end

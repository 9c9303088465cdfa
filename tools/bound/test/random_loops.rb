# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Random loops for the 14-bit core, run from random states: none that has a bound
# takes longer, or more levels of the stack. Prints `ok` or `FAILED` for each check.
#
#   ruby tools/bound/test/random_loops.rb [PROGRAMS [FIRST]] [NAME]... | --failed | --list
require_relative 'programs'

# A program of words at 0, with one function.
class Words < Pic14Code
  attr_reader :words

  def initialize(words)
    @words = words
    @bytes = words.each_with_index.flat_map { |word, at| [[2 * at, word & 0xFF], [2 * at + 1, word >> 8]] }.to_h
    @sections = []
    @decoded = {}
    @functions = { 'function' => 0 }
  end
end

# The core, as its data sheet has it, with two banks and a random pin.
class Machine
  STATUS = 3
  FSR = 4
  PORTA = 5
  Z = 4
  SHARED = [0x02, 0x03, 0x04, 0x0A, 0x0B, *0x70..0x7F].freeze
  # What the generator uses: by the high byte, of the operand and W.
  ALU = { 0x03 => ->(x, _) { x - 1 }, 0x0B => ->(x, _) { x - 1 }, 0x0F => ->(x, _) { x + 1 }, 0x0A => ->(x, _) { x + 1 },
          0x08 => ->(x, _) { x }, 0x07 => ->(x, w) { x + w } }.freeze
  SKIPPING = [0x0B, 0x0F].freeze

  attr_reader :cycles, :levels

  def initialize(words, random)
    @words = words
    @random = random
    @memory = Array.new(256) { random.rand(256) }
    @memory[FSR] = 0x20 + random.rand(4)
    @w = random.rand(256)
    @pc = @cycles = @levels = 0
    @stack = []
  end

  # Until it returns, or has taken more than this.
  def run(most)
    step until @pc.nil? || @cycles > most || @stack.size > 20
    self
  end

  private

  def step
    word = @words.fetch(@pc)
    @pc += 1
    @cycles += 1
    case word
    when 0x0000 then nil
    when 0x0008 then leave
    when 0x2000..0x27FF then enter(word & 0x7FF)
    when 0x2800..0x2FFF then go(word & 0x7FF)
    when 0x3000..0x33FF then @w = word & 0xFF
    when 0x3E00..0x3EFF then @w = flagged(@w + (word & 0xFF))
    when 0x0080..0x00FF then write(word & 0x7F, @w)
    when 0x0180..0x01FF then write(word & 0x7F, flagged(0))
    when 0x1000..0x1FFF then on_bit(word, 1 << ((word >> 7) & 7))
    else on_byte(word)
    end
  end

  def leave
    @pc = @stack.pop
    @cycles += 1
  end

  def enter(address)
    @stack << @pc
    @levels = [@levels, @stack.size].max
    go(address)
  end

  def go(address)
    @pc = address
    @cycles += 1
  end

  def on_bit(word, bit)
    file = word & 0x7F
    case word >> 10
    when 4 then write(file, read(file) & ~bit)
    when 5 then write(file, read(file) | bit)
    else go(@pc + 1) if (read(file) & bit).zero? == (word < 0x1C00)
    end
  end

  def on_byte(word)
    result = ALU.fetch(word >> 8).call(read(word & 0x7F), @w) & 0xFF
    (word & 0x80).zero? ? @w = result : write(word & 0x7F, result)
    return flagged(result) unless SKIPPING.include?(word >> 8)

    go(@pc + 1) if result.zero?
  end

  def flagged(result)
    @memory[STATUS] = @memory[STATUS] & ~Z | ((result & 0xFF).zero? ? Z : 0)
    result & 0xFF
  end

  def read(file)
    at = address(file)
    at == PORTA ? @random.rand(256) : @memory.fetch(at)
  end

  def write(file, value)
    @memory[address(file)] = value & 0xFF
  end

  def address(file)
    whole = file.zero? ? @memory[FSR] : file | (@memory[STATUS] << 2 & 0x80)
    SHARED.include?(whole & 0x7F) ? whole & 0x7F : whole
  end
end

# Loops that count down, with whatever may spoil them.
class Generator
  SIZE = 24 # words of the function, before two that it may call
  FILES = [0x20, 0x20, 0x20, 0x21, 0x22].freeze
  COUNTS = [0, 1, 2, 3, 7, 10, 200].freeze
  SKIPS = [0x1903, 0x1D03, 0x1805, 0x1C05, 0x1821, 0x1C21].freeze # of Z, a pin and a register

  def initialize(random)
    @random = random
  end

  def program
    words = []
    words.concat(@random.rand(3).zero? ? one : a_loop(words.size)) while words.size < SIZE - 8
    [*words.take(SIZE - 1), *Array.new([SIZE - 1 - words.size, 0].max, 0), 0x0008, *callees]
  end

  private

  def pick(from)
    from.sample(random: @random)
  end

  def a_loop(start)
    counter = pick(FILES)
    before = [0x3000 | pick(COUNTS), 0x0080 | counter, *some(1)]
    head = start + before.size
    before + some(2) + pick([[0x0B80 | counter], [0x0380 | counter, 0x1D03],
                             [0x0380 | counter, 0x0800 | pick([counter, 0x22]), 0x1D03]]) + [0x2800 | head]
  end

  def some(most)
    Array.new(@random.rand(most + 1)) { one }.flatten(1)
  end

  def one
    file = pick(FILES)
    into = pick([0, 0x80])
    pick([[0x3000 | pick(COUNTS)], [0x3000 | pick(COUNTS), 0x0080 | file], [0x0080 | file], [0x0180 | file],
          [0x0800 | file | into], [0x0A00 | file | into], [0x0300 | file | into], [0x0700 | file | into], [0x0B80 | file],
          [0x0F80 | file], [pick(SKIPS)], [pick(SKIPS)], [0x1283], [0x1683], [0x1003], [0x0A80], [0x3E00 | pick(COUNTS)],
          [0x2800 | @random.rand(SIZE)], [0x2000 | SIZE], [0x2000 | (SIZE + 4)], [0x0008], [0x0000]])
  end

  # One that changes a register and W, one that may select a bank.
  def callees
    [0x0A80 | pick(FILES), 0x3000 | pick(COUNTS), 0x0000, 0x0008, 0x0000, pick([0x0000, 0x1283, 0x1683]), 0x0000, 0x0008]
  end
end

RUNS = 15

# How long the function takes at most, by its code and from random states.
def judged(seed)
  code = Words.new(Generator.new(Random.new(seed)).program)
  bound = LongestPath.new(code).function(0)
  seen = Array.new(RUNS) { |run| Machine.new(code.words, Random.new(seed * RUNS + run)).run(bound.cost) }
  [bound, seen, Stack.new(code).function(0).levels]
rescue LongestPath::Failure, Stack::Failure
  nil
end

AMOUNT, FIRST = [4000, 0].map { |usual| ARGV.first.to_s.match?(/\A\d+\z/) ? ARGV.shift.to_i : usual }

# Of the programs that have a bound.
def found
  @found ||= (FIRST...FIRST + AMOUNT).to_h { |seed| [seed, judged(seed)] }.compact
end

def longer
  found.select { |_, (bound, seen, levels)| seen.any? { |one| one.cycles > bound.cost || one.levels > levels } }
end

def reached
  found.count { |_, (bound, seen)| bound.cost > 40 && seen.any? { |one| one.cycles == bound.cost } }
end

Gate.expect('random programs are bounded', -> { found.size }, 800..)
Gate.expect('none takes longer or more levels', -> { longer.keys }, [])
Gate.expect('loops take as long as their bound', -> { reached }, 200..)
Gate.finish

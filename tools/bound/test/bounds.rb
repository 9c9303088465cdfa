# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The longest path of routines whose lengths are known. Those of cycles14.asm and
# cycles18.asm hold gpsim to them: each says its length in a comment, and all of
# its paths are equally long. Those of bounds/ are loops, also such that may not
# be bounded, which are measured here. Prints `ok` or `FAILED` for each:
#
#   ruby tools/bound/test/bounds.rb [NAME]... | --failed | --list
require_relative 'programs'

# Code without a linker's map.
module Assembled
  def initialize(path, labels)
    @path = path
    @sections = []
    @decoded = {}
    @functions = labels
    @bytes = read_hex("#{path}.hex")
  end
end

class Assembled14 < Pic14Code
  include Assembled
end

class Assembled14Enhanced < Pic14EnhancedCode
  include Assembled
end

class Assembled18 < Pic18Code
  include Assembled
end

def assemble(source)
  path = "#{Host.folder}/#{File.basename(source, '.asm')}"
  Host.output('gpasm', '-w1', '-o', "#{path}.hex", source)
  path
end

# name => address
def labels(path)
  File.read("#{path}.lst", encoding: 'BINARY').scan(/^(\w+)\s+(\h{8})\r?$/).to_h { |name, at| [name, at.hex] }
end

# name => length: the first number in a comment after a label.
def lengths(source)
  File.read(source)[/^forever:.*/m].scan(/^(\w+):(?:[^;\n]*|\s*\n\s+[^;\n]*);\s*(\d+)/).to_h { |name, length| [name, length.to_i] }
end

def bound(code, name, turns = {})
  LongestPath.new(code, turns).function(code.entry(name)).cost
rescue Bound::Failure => e
  e.message
end

REFUSED = { 'computed' => /computed/, 'turns' => /does not count down from a constant/ }.freeze

KINDS = { 'cycles14' => Assembled14, 'cycles14e' => Assembled14Enhanced, 'cycles18' => Assembled18 }.freeze

KINDS.each do |name, kind|
  source = "#{PROJECT}/test/chips/target/simulator/#{name}.asm"
  code = nil
  assembled = -> { code ||= assemble(source).then { |path| kind.new(path, labels(path)) } }
  known = lengths(source)
  known.each { |routine, length| Gate.expect("bound of #{name} #{routine}", -> { bound(assembled.call, routine) }, REFUSED[routine] || length) }
  Gate.expect("bound of #{name} turns, as stated", -> { bound(assembled.call, 'turns', { 'turns' => 5 }) }, known.fetch('turns'))
  Gate.expect("lengths of #{name}", known.size, 8..99)
end

# A routine of bounds/ says what it takes, or a part of why it is refused.
Expected = Struct.new(:name, :cost, :refusal) do
  def self.of(source)
    File.read(source).scan(/^(\w+):[^;\n]*; (?:(\d+)|refused: (.*))$/).map do |name, cost, refusal|
      new(name, cost&.to_i, refusal && /#{Regexp.escape(refusal)}/)
    end
  end
end

def judge(chip, program, expected)
  found = -> { bound(program.code, expected.name) }
  return Gate.expect("#{chip} #{expected.name} is refused", found, expected.refusal) if expected.refusal

  Gate.expect("#{chip} #{expected.name} measured", -> { program.most(expected.name) }, expected.cost)
  Gate.expect("bound of #{chip} #{expected.name}", found, expected.cost)
end

Programs.all('bounds').each do |chip, program|
  Expected.of(program.source).each { |one| judge(chip, program, one) }
  next unless chip == 'avr'

  Gate.expect('bound of a loop in a loop, as stated', -> { bound(program.code, 'stated', { 'stated' => [3, 2] }) }, 30)
end

def judge_core(program, one)
  what = "#{program.name} #{one.name}"
  cycles = -> { program.timings.map { |timing| bound(program.code(timing), one.name) } }
  return Gate.expect("bound of #{what} is refused", -> { cycles.call.first }, /#{Regexp.escape(one.refusal)}/) if one.refusal

  Gate.expect("instructions of #{what} measured", -> { program.measured(one.name).first }, one.measured)
  Gate.expect("bound of #{what} in instructions", -> { bound(program.code, one.name) }, one.instructions)
  Gate.expect("bound of #{what} in cycles", cycles, one.cycles.cycle.take(program.timings.size))
end

Programs.cores.each do |program|
  program.routines.each { |one| judge_core(program, one) unless one.refusal&.match?(/stack|paths|returns/) }
end

CORES_OF_CHIPS = { 'pic16f684' => Pic14Code, 'p16f887' => Pic14Code, 'p12f629' => Pic14Code, 'p16f1788' => Pic14EnhancedCode,
                   'p12lf1822' => Pic14EnhancedCode, 'p18f26k22' => Pic18Code, 'p12f509' => nil, 'p10f200' => nil }.freeze
CORES_OF_CHIPS.each { |chip, core| Gate.expect("core of #{chip}", [PicCode.of(chip)], [core]) }
Gate.finish

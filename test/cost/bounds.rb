# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The longest path of routines whose lengths are known. Those of cycles14.asm and
# cycles18.asm hold gpsim to them: each says its length in a comment, and all of
# its paths are equally long. Those of bounds/ are loops, also such that may not
# be bounded, which are measured here. Prints `ok` or `FAILED` for each.
require 'fileutils'
require 'open3'

root = File.expand_path('../..', __dir__)
%w[host meters].each { |name| require "#{root}/tools/lib/cost/#{name}" }

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

Host.setup(root)
FOLDER = "#{root}/build/cost/bounds"
FileUtils.mkdir_p(FOLDER)

def assemble(source)
  path = "#{FOLDER}/#{File.basename(source, '.asm')}"
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
rescue LongestPath::Failure, Code::Failure => e
  e.message
end

def expect(what, found, wanted)
  good = wanted === found
  puts good ? "ok #{what}" : "FAILED #{what}: #{found}, not #{wanted}"
  good
end

REFUSED = { 'computed' => /computed/, 'turns' => /counts no constant/ }.freeze

KINDS = { 'cycles14' => Assembled14, 'cycles14e' => Assembled14Enhanced, 'cycles18' => Assembled18 }.freeze

good = KINDS.flat_map do |name, kind|
  source = "#{root}/test/target/simulator/#{name}.asm"
  path = assemble(source)
  code = kind.new(path, labels(path))
  known = lengths(source)
  checks = known.map { |routine, length| expect("bound of #{name} #{routine}", bound(code, routine), REFUSED[routine] || length) }
  checks << expect("bound of #{name} turns, as stated", bound(code, 'turns', { 'turns' => 5 }), known.fetch('turns'))
  checks << expect("lengths of #{name}", known.size, 8..99)
end

# A routine of bounds/ says what it takes, or a part of why it is refused.
Expected = Struct.new(:name, :cost, :refusal) do
  def self.of(source)
    File.read(source).scan(/^(\w+):[^;\n]*; (?:(\d+)|refused: (.*))$/).map do |name, cost, refusal|
      new(name, cost&.to_i, refusal && /#{Regexp.escape(refusal)}/)
    end
  end
end

# PIC programs in gpsim, with a map as gplink writes it.
class OnPic
  def initialize(source, kind)
    @path = "#{FOLDER}/#{File.basename(source, '.asm')}"
    Host.output('gpasm', '-w1', '-c', '-o', "#{@path}.o", source)
    Host.output('gplink', '-m', '-o', "#{@path}.hex", "#{@path}.o")
    @kind = kind
    Harness.build_function
  end

  def code
    @code ||= @kind.new(@path)
  end

  def measured(name)
    Host.output("#{Host.folder}/function", "#{@path}.cod", name, '10000')[/most (\d+)/, 1].to_i
  end
end

# An AVR program in simavr.
class OnAvr
  def initialize(source)
    @path = "#{FOLDER}/#{File.basename(source, '.s')}"
    Host.output('avr-gcc', '-mmcu=atmega328p', '-nostartfiles', '-o', "#{@path}.elf", source)
    Host.output('gcc', '-std=c99', '-O2', *Harness::WARNINGS, 'test/cost/avr/calls.c', '-lsimavr', '-o', "#{FOLDER}/calls")
  end

  def code
    @code ||= AvrCode.new("#{@path}.elf")
  end

  def measured(name)
    addresses = %w[done].push(name).map { |symbol| code.symbol(symbol).to_s(16) }
    Host.output("#{FOLDER}/calls", "#{@path}.elf", 'atmega328p', addresses[0], name, addresses[1])[/most (\d+)/, 1].to_i
  end
end

def judge(chip, program, expected)
  found = bound(program.code, expected.name)
  return [expect("#{chip} #{expected.name} is refused", found, expected.refusal)] if expected.refusal

  [expect("#{chip} #{expected.name} measured", program.measured(expected.name), expected.cost),
   expect("bound of #{chip} #{expected.name}", found, expected.cost)]
end

LOOPS = "#{root}/test/cost/bounds"
programs = { 'pic14.asm' => ->(source) { OnPic.new(source, Pic14Code) }, 'pic18.asm' => ->(source) { OnPic.new(source, Pic18Code) },
             'avr.s' => ->(source) { OnAvr.new(source) } }
good += programs.flat_map do |name, program|
  source = "#{LOOPS}/#{name}"
  all = Expected.of(source)
  on_chip = program.call(source)
  all.flat_map { |one| judge(name[/\w+/], on_chip, one) }
end

CORES_OF_CHIPS = { 'pic16f684' => Pic14Code, 'p16f887' => Pic14Code, 'p12f629' => Pic14Code, 'p16f1788' => Pic14EnhancedCode,
                   'p12lf1822' => Pic14EnhancedCode, 'p18f26k22' => Pic18Code, 'p12f509' => nil, 'p10f200' => nil }.freeze
good += CORES_OF_CHIPS.map { |chip, core| expect("core of #{chip}", [PicCode.of(chip)], [core]) }
exit(good.all? ? 0 : 1)

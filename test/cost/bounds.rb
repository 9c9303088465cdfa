# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The longest path of routines whose lengths are known, in the firmwares that
# hold gpsim to them: each says its length in a comment, and all of its paths
# are equally long. Prints `ok` or `FAILED` for each.
require 'fileutils'
require 'open3'

root = File.expand_path('../..', __dir__)
require "#{root}/tools/lib/cost/pic_code"
require "#{root}/tools/lib/cost/longest_path"

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

FOLDER = "#{root}/build/cost/bounds"
FileUtils.mkdir_p(FOLDER)

def assemble(source)
  path = "#{FOLDER}/#{File.basename(source, '.asm')}"
  text, status = Open3.capture2e('gpasm', '-w1', '-o', "#{path}.hex", source)
  abort text unless status.success?
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
CORES = { 'pic16f684' => Pic14Code, 'p16f887' => Pic14Code, 'p12f629' => Pic14Code, 'p16f1788' => Pic14EnhancedCode,
          'p12lf1822' => Pic14EnhancedCode, 'p18f26k22' => Pic18Code, 'p12f509' => nil, 'p10f200' => nil }.freeze
good += CORES.map { |chip, core| expect("core of #{chip}", [PicCode.of(chip)], [core]) }
exit(good.all? ? 0 : 1)

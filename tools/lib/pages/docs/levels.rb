# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require 'fileutils'
require 'open3'
require_relative '../../data_tables'

# How many return addresses a call takes where nothing is inlined, for a PIC16's stack of
# eight: from the object files of the library as XC8 preprocesses it for one, which
# avr-gcc compiles without optimization. A call to the compiler's own helper, such as a
# product of 32 bits, takes one. The last column is what exceeds the stack from main.
class Levels
  FILE = 'docs/data/levels.csv'
  STACK = 8
  INTERRUPT = 1 # one that calls nothing
  FOLDER = 'build/test/levels'
  COMPILE = %w[avr-gcc -mmcu=atmega2560 -std=c99 -ffreestanding -funsigned-char -include test/support/as_xc8.h
               -D_PIC14 -O0 -ffunction-sections -Iinclude -c].freeze

  class << self
    def csv
      FileUtils.mkdir_p(FOLDER)
      rows = Dir['include/fixpid_*.h'].sort.map { |header| new(File.basename(header, '.h')).row }
      DataTables.text([['module', 'step', 'deepest call', 'does not fit'], *rows])
    end
  end

  def initialize(noun)
    @noun = noun
    @called = {}
    @below = {}
    Dir["src/#{noun.delete_prefix('fixpid_')}/*.c"].sort.each { |source| read(source) }
  end

  def row
    levels = functions.to_h { |one| [one, 1 + below(one)] }
    deepest = levels.values.max
    too_deep = levels.select { |_, level| level + INTERRUPT > STACK }.keys.sort
    [@noun, levels["#{@noun}_step"], "#{deepest}: #{levels.select { |_, level| level == deepest }.keys.join(', ')}", too_deep.join(', ')]
  end

  private

  # Those that the header declares and a source has.
  def functions
    File.read("include/#{@noun}.h").scan(/^\w[^#\n]*?\b(#{@noun}_\w+)\(/).flatten.uniq & @called.keys
  end

  def below(function)
    raise "#{function} calls itself" if @below[function] == :open
    return @below[function] if @below.key?(function)

    @below[function] = :open
    @below[function] = @called.fetch(function, []).map { |one| one.start_with?('__') ? 1 : 1 + below(one) }.max || 0
  end

  # A call is an instruction that the linker has to complete, by the line below it.
  def read(source)
    object = "#{FOLDER}/#{File.basename(source, '.c')}.o"
    said, compiled = Open3.capture2e(*COMPILE, source, '-o', object)
    abort said unless compiled.success?
    function = nil
    `avr-objdump -dr #{object}`.lines.each_cons(2) do |line, after|
      function = @called[Regexp.last_match(1)] = [] if line =~ /^\h+ <(\w+)>:/
      function << Regexp.last_match(1) if line.match?(/\tr?call\t/) && after =~ /R_AVR_\w+\s+(?:\.text\.)?(\w+)$/
    end
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require 'fileutils'
require_relative 'inputs'

# Files that are made only when what they are made of has changed: their sources with
# all that these include, the words of the command, or the compiler. What each was made
# of is beside it, in OUTPUT.made.
class Built
  BUILDERS = { 'tools/lib/build/build_pic' => -> { Inputs.sdcc + Inputs.tool('gpasm') + Inputs.tool('gplink') + own },
               'tools/lib/build/build_avr' => -> { Inputs.tool('avr-gcc') + own } }.freeze
  # A builder of firmware takes these by itself.
  OWN = 'tools/lib/setup.sh', 'tools/lib/{build,code}/*', 'port/pic/{pic16f684,pic18}/support/*'

  def self.own
    OWN.flat_map { |pattern| Dir.glob(pattern).sort }
  end

  # `run` runs a command, and raises where it fails.
  def initialize(&run)
    @run = run
    @locks = Hash.new { |locks, output| locks[output] = Mutex.new }
    @mutex = Mutex.new
    @tools = {}
  end

  # `output`, which the command makes; it is among its words, or their beginning.
  def command(output, *words)
    folders = words.grep(/\A-I/) { |word| word.delete_prefix('-I') }
    files = (words.drop(1) - [output]).select { |word| File.file?(word) }
    make(output, [words.join(' '), tool(words.first), Inputs.digest(Inputs.with_included(files, folders))]) { @run.call(*words) }
  end

  # `output`, which the block makes with what the pattern `also` finds, unless all of it
  # stands there made of `inputs`.
  def make(output, inputs, also = output)
    @mutex.synchronize { @locks[output] }.synchronize do
      made = [*inputs, ''].join("\n")
      unless same?(output, made, also)
        FileUtils.rm_f("#{output}.made")
        yield
        File.write("#{output}.made", made + state(output, also))
      end
    end
    output
  end

  private

  def same?(output, made, also)
    File.file?(output) && File.read("#{output}.made") == made + state(output, also)
  rescue Errno::ENOENT
    false
  end

  def state(output, also)
    Inputs.digest([output, *Dir.glob(also).sort])
  end

  def tool(name)
    @mutex.synchronize { @tools[name] ||= Inputs.digest(BUILDERS.key?(name) ? BUILDERS[name].call : Inputs.tool(name)) }
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What the loops measured when somebody last asked for it to be kept: a value
# that is as it was, and that nobody requires. What is required has a limit and
# a reason in the loop's own file.
module Regression
  FILE = 'test/tools/demo/regression.txt'
  HEAD = <<~TEXT
    # What tools/demo measured. Nobody requires these values: they show that
    # something changed. `tools/demo --renew LOOP` takes those of a loop anew and
    # says what is different. LOOP | WHAT | VALUE
  TEXT
  LINE = /\A([^|]+) \| ([^|]+) \| (\S+)\z/.freeze

  class << self
    def setup(root)
      @path = "#{root}/#{FILE}"
      @known = {}
      File.readlines(@path, chomp: true).grep_v(/\A#/).each { |line| take(line) }
      @found = {}
    end

    # The value of old, or nil. Remembers the new one.
    def of(loop, what, value)
      key = [loop, what]
      @found.key?(key) and raise Host::Failure, "#{loop}, #{what}: measured twice"
      @found[key] = value.to_s
      @known[key]
    end

    # What a loop that ran did not measure.
    def missing(loop)
      @known.keys.select { |known, what| known == loop && !@found.key?([loop, what]) }.map(&:last)
    end

    # Keeps what these loops measured, and prints what is different.
    def renew(loops)
      kept = @known.reject { |(loop, _), _| loops.include?(loop) }.merge(@found)
      changes = (@known.keys | kept.keys).reject { |key| @known[key] == kept[key] }
      changes.each { |key| puts "#{key.join(', ')}: #{@known[key] || 'new'} -> #{kept[key] || 'gone'}" }
      puts "#{changes.size} of #{kept.size} values in #{FILE} changed."
      lines = kept.sort.map { |key, value| "#{[*key, value].join(' | ')}\n" }
      Report.replace(@path, HEAD + lines.join)
    end

    private

    def take(line)
      found = LINE.match(line) or raise Host::Failure, "#{@path}: #{line}"
      key = found.captures.first(2)
      @known.key?(key) and raise Host::Failure, "#{@path} has twice: #{key.join(', ')}"
      @known[key] = found[3]
    end
  end
end

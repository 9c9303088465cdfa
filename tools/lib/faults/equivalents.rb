# SPDX-License-Identifier: MIT
# frozen_string_literal: true
require_relative '../c_functions'

# The mutants that nobody need notice. Each line of the file names one:
#   FILE, FUNCTION: TEXT OF THE LINE: `from` -> `to` (2 of 3)
# A macro has no function, and what is alike otherwise is counted from above.
class EquivalentMutants
  attr_reader :known

  def initialize(path)
    @path = path
    lines = File.readlines(path, chomp: true)
    @known = lines.grep(%r{\A(?:src|include)/})
    strange = lines.grep_v(%r{\A(?:src/|include/|#|\z)})
    strange.empty? or abort "#{path}: not an equivalent: #{strange.first}"
    twice = @known.tally.select { |_, times| times > 1 }.keys
    twice.empty? or abort "#{path}: named twice: #{twice.first}"
  end

  def cover?(key)
    @known.include?(key)
  end

  def of(file)
    @known.select { |line| line.start_with?("#{file}:", "#{file},") }
  end

  # The equivalents for a file that none of these keys is.
  def stale(file, keys)
    of(file) - keys
  end

  # EquivalentMutants for files that are not broken.
  def strangers(files)
    @known.grep_v(/\A(?:#{Regexp.union(files).source})[:,]/)
  end

  # What each of a file's mutants is called here.
  def self.keys(mutants, text)
    lines = text.lines
    functions = CFunctions.of_lines(lines)
    names = mutants.to_h { |mutant| [mutant, name(mutant, lines, functions)] }
    names.to_a.group_by(&:last).values.flat_map do |alike|
      alike.sort_by { |mutant, _| mutant.place }.each_with_index.map do |(mutant, name), index|
        [mutant, alike.size == 1 ? name : "#{name} (#{index + 1} of #{alike.size})"]
      end
    end.to_h
  end

  class << self
    private

    def name(mutant, lines, functions)
      text = lines[mutant.line - 1].sub(%r{//.*}, '').gsub(/(?:\\[nt])+/, ' ').delete('\\').strip.gsub(/\s+/, ' ')
      function = functions[mutant.line - 1]
      "#{mutant.file}#{", #{function}" if function}: #{text}: `#{mutant.from}` -> `#{mutant.to}`"
    end
  end
end

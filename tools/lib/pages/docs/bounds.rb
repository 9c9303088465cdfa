# SPDX-License-Identifier: MIT
require_relative '../../c_functions'

# The bounds that stand in comments of the library's C, each with the line that it is
# of: a comment behind the line, or above it within its function. Numbers and powers
# in them are computed again by Sums; the proofs show that nothing overflows.
module Bounds
  SOURCES = (Dir['src/*/*.[ch]'] - Dir['src/*/*_{arm,avr,pic14,pic18,sdcc}.[ch]']).sort.freeze
  STATED = /(?:<=?|\bwithin|\bat most|\bbelow) \S*\d/.freeze
  COMMENT = %r{^(\s*)//\s*(.*)}.freeze
  BEHIND = %r{^(\s*\S.*?)\s*//\s*(.*)}.freeze

  module_function

  def table
    rows = SOURCES.flat_map { |file| of(file).map { |function, code, bound| "| `#{function}` | `#{code}` | #{bound} |\n" } }
    "| function | line | bound |\n|---|---|---|\n#{rows.join}"
  end

  # [function, line of code, bound]
  def of(file)
    lines = File.readlines(file, chomp: true)
    CFunctions.of_lines(lines.map { |line| "#{line}\n" }).zip(lines).each_with_index.map do |(function, line), at|
      next unless function && (bound = above(lines, at) || behind(line)) && bound.match?(STATED) && !bound.start_with?('Deviation')

      [function, statement(lines, at), bound].map { |text| text.gsub('|') { '\\|' } }
    end.compact
  end

  # From this line to its semicolon or brace.
  def statement(lines, at)
    bare = lines.drop(at).map { |line| line.sub(%r{\s*//.*}, '').strip }
    (bare.take_while { |line| !line.match?(/[;{]\z/) } + [bare.find { |line| line.match?(/[;{]\z/) }]).join(' ')
  end

  def behind(line)
    line.match?(COMMENT) ? nil : line[BEHIND, 2]
  end

  # The comment that ends just above the line, inside a function.
  def above(lines, at)
    return if lines[at].match?(COMMENT)

    block = lines[0...at].reverse.take_while { |line| line.match?(COMMENT) && line.start_with?(' ') }.reverse
    block.empty? ? nil : block.map { |line| line[COMMENT, 2] }.join(' ')
  end
end

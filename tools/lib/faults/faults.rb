# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The faults of test/faults.txt, each with the check that must notice it.
#
#   Faults.of('port')            those whose check begins with these whole words
#   fault.check, fault.words(1)  its check, and the words of it after so many
#   fault.seed(tree)             seeds it in a copy of the project, which needs to
#                                have the fault's files and may have other faults
#   fault.sources                { file => its whole text with the fault }
#   Faults.misplaced             a sentence for each that can no longer be seeded
#
# A fault whose text does not stand in its function as often as its row says is an
# error, Faults::Gone, which names the nearest line.
# tools/lib/faults/seed.rb does this for scripts.
require_relative '../c_functions'

module Faults
  FILE = 'test/faults.txt'
  ROW = /\A(?<check>[^`]+): (?<file>[\w.\/-]+)(?:, (?<function>\w+))?: `(?<from>.+?)` -> `(?<to>.*)`(?: \((?<which>\d+) of (?<times>\d+)\))?\z/.freeze

  Gone = Class.new(StandardError)

  # One text in the place of another; `place` is that of its row.
  Change = Struct.new(:place, :file, :function, :from, :to, :which, :times) do
    # Where it begins in a file's text.
    def position(text)
      found = positions(text)
      raise Gone, complaint(text, found) unless found.size == times

      found[which - 1]
    end

    def to_s
      "#{[file, function].compact.join(', ')}: `#{from}` -> `#{to}`#{" (#{which} of #{times})" if times > 1}"
    end

    private

    def positions(text)
      lines_within(text).flat_map do |_, begins, line|
        line.to_enum(:scan, from).map { begins + Regexp.last_match.begin(0) }
      end
    end

    # [number, where it begins, text] of the lines of its function, or of none.
    def lines_within(text)
      lines = text.lines
      begins = 0
      all = lines.each_with_index.map do |line, at|
        begins += line.size
        [at + 1, begins - line.size, line]
      end
      all.zip(CFunctions.of_lines(lines)).select { |_, name| name == function }.map(&:first)
    end

    def complaint(text, found)
      said = "#{place}: `#{from}` stands #{found.size} times in #{function || 'no function'} of #{file}, not #{times}"
      found.empty? ? "#{said}; the nearest is #{nearest(text)}" : said
    end

    # Of its function, or of the file if there is none.
    def nearest(text)
      within = lines_within(text)
      within = text.lines.each_with_index.map { |line, at| [at + 1, nil, line] } if within.empty?
      number, _, line = within.min_by { |_, _, other| Faults.distance(from, other) }
      "#{file}:#{number}: `#{line.to_s.strip}`"
    end
  end

  # What a check must notice; most are one change.
  Fault = Struct.new(:check, :changes) do
    def file
      changes.first.file
    end

    def function
      changes.first.function
    end

    def words(count)
      check.split.drop(count)
    end

    def to_s
      changes.join(' and ')
    end

    def sources(tree = '.')
      changes.group_by(&:file).to_h do |file, of_file|
        raise Gone, "#{of_file.first.place}: there is no #{file}" unless File.file?("#{tree}/#{file}")

        [file, changed(File.read("#{tree}/#{file}"), of_file)]
      end
    end

    def seed(tree)
      sources(tree).each { |file, text| File.write("#{tree}/#{file}", text) }
    end

    private

    # The last one first, so that the others stay where they are.
    def changed(text, of_file)
      of_file.map { |change| [change.position(text), change] }.sort_by(&:first).reverse
             .reduce(text) { |whole, (at, change)| whole[0...at] + change.to + whole[(at + change.from.size)..] }
    end
  end

  class << self
    def of(words)
      all.select { |fault| "#{fault.check} ".start_with?("#{words} ") }
    end

    def all
      @all ||= read(File.exist?(FILE) ? File.readlines(FILE, chomp: true) : [])
    end

    def misplaced
      all.map do |fault|
        fault.sources && nil
      rescue Gone => e
        e.message
      end.compact
    end

    # How many letters of a text must be others for it to stand in a line.
    def distance(text, line)
      row = [0] * (line.size + 1)
      text.each_char.with_index(1) do |letter, at|
        before = row
        row = [at]
        line.each_char.with_index(1) do |other, column|
          row << [before[column - 1] + (letter == other ? 0 : 1), before[column] + 1, row.last + 1].min
        end
      end
      row.min
    end

    private

    # A row whose check is `and` belongs to the fault above.
    def read(lines)
      lines.each_with_index.reject { |line, _| line.match?(/\A(?:#|\s*\z)/) }.each_with_object([]) do |(line, at), faults|
        row = line.match(ROW) or raise Gone, "#{FILE}:#{at + 1}: not a fault: #{line}"
        change = Change.new("#{FILE}:#{at + 1}", *row.values_at(:file, :function, :from), row[:to].gsub('<newline>', "\n"),
                            (row[:which] || 1).to_i, (row[:times] || 1).to_i)
        row[:check] == 'and' ? faults.last.changes << change : faults << Fault.new(row[:check], [change])
      end
    end
  end
end

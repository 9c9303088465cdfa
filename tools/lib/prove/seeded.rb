# SPDX-License-Identifier: MIT
# The breaks of src/, each with the proof that must notice it.
require 'fileutils'
require_relative '../c_functions'
require_relative 'proofs'

# `function` is nil for a macro.
Broken = Struct.new(:proof, :file, :function, :whole, :instead, :number) do
  def name
    "#{proof.name}, #{[File.basename(file), function].compact.join(', ')} broken at `#{whole.strip}`"
  end

  def row
    "#{proof.name.sub(/ \d+\z/, '')}: #{[file, function].compact.join(', ')}: `#{whole}` -> `#{instead}`"
  end

  # The numbers of the lines where it can stand: it must be one.
  def places
    lines = Seeded.lines(file)
    of_lines = Seeded.functions(file)
    lines.each_index.select { |at| of_lines[at] == function && lines[at].include?(whole) }
  end

  def source
    lines = Seeded.lines(file).dup
    lines[places.first] = lines[places.first].sub(whole) { instead }
    lines.join
  end

  # Gives the block a tree of sources in which it is broken.
  def in_tree(build, &block)
    Seeded.in_tree(build, number, file, source, &block)
  end
end

# All of them.
module Seeded
  FILE = "#{FOLDER}/breaks.txt".freeze
  UNPROVED = "#{FOLDER}/unproved.txt".freeze
  STATEMENTS = 5 # a function of more
  BREAKS = 5 # has as many breaks

  module_function

  def lines(file)
    @lines ||= {}
    @lines[file] ||= File.readlines(file)
  end

  def functions(file)
    @functions ||= {}
    @functions[file] ||= CFunctions.of_lines(lines(file))
  end

  # Gives the block a tree of sources in which a file is another.
  def in_tree(build, number, file, source)
    tree = "#{build}/broken_#{number}"
    FileUtils.rm_rf(tree)
    FileUtils.mkdir_p(tree)
    FileUtils.cp_r(%w[include src], tree)
    File.write("#{tree}/#{file}", source)
    yield tree
  ensure
    FileUtils.rm_rf(tree)
  end

  # Of each row `module form what: file, function: `whole` -> `instead``.
  def all(proofs)
    File.readlines(FILE, chomp: true).grep_v(/^#|^\s*$/).each_with_index.map do |line, number|
      fields = line.match(/\A(\w+ \w+ \w+): (\S+?)(?:, (\w+))?: `(.*)` -> `(.*)`\z/) or abort "prove: #{FILE}: #{line}"
      proof = Proofs.find(proofs, fields[1]) or abort "prove: #{FILE}: no #{fields[1]}"
      File.exist?(fields[2]) or abort "prove: #{FILE}: no #{fields[2]}"
      Broken.new(proof, *fields[2..5], number)
    end
  end

  # The functions of which nothing is proved, or not enough for five breaks: of
  # each row `file, function: reason` and `file: reason`.
  def unproved
    @unproved ||= File.readlines(UNPROVED, chomp: true).grep_v(/^#|^\s*$/).map do |line|
      line[/\A(src\S+?(?:, \w+)?): \S/, 1] or abort "prove: #{UNPROVED}: #{line}"
    end
  end

  # [file, function] of all that must have so many.
  def long_functions
    Dir['src/*.[ch]'].sort.flat_map do |file|
      CFunctions.statements(file).select { |_, statements| statements > STATEMENTS }.keys.map { |function| [file, function] }
    end
  end

  # [file, function] => how many more it needs.
  def lacking(breaks)
    there = breaks.map { |broken| [broken.file, broken.function] }.tally
    long_functions.to_h { |place| [place, BREAKS - there.fetch(place, 0)] }.select { |_, more| more.positive? }
  end

  def complaints(proofs, breaks)
    misplaced(breaks) + untried(proofs, breaks) + uneven(breaks)
  end

  # What is not once where it should be, or names no function inside one, or is
  # there twice.
  def misplaced(breaks)
    elsewhere = breaks.reject { |broken| broken.places.size == 1 }
    twice = breaks.map(&:row).tally.select { |_, times| times > 1 }.keys
    elsewhere.map { |broken| "#{FILE}: not once in its function: #{broken.row}" } +
      twice.map { |row| "#{FILE}: twice: #{row}" }
  end

  # Proofs that no break is for.
  def untried(proofs, breaks)
    tried = breaks.map { |broken| [broken.proof.group, broken.proof.what] }
    names = proofs.map { |proof| [proof.group, proof.what] }.uniq - tried - [%w[model model]]
    names.map { |group, what| "#{FILE}: nothing for #{group} #{what}" }
  end

  # Functions with too few, and those that are named as unproved and have enough.
  def uneven(breaks)
    lacking = lacking(breaks)
    few = lacking.reject { |place, _| unproved?(*place) }
    needed = lacking.keys.flat_map { |file, function| [file, "#{file}, #{function}"] }
    few.map { |(file, function), more| "#{FILE}: #{file}, #{function} needs #{more} more (see --choose)" } +
      (unproved - needed).map { |name| "#{UNPROVED}: no longer true: #{name}" }
  end

  def unproved?(file, function)
    unproved.include?(file) || unproved.include?("#{file}, #{function}")
  end
end

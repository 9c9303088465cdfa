# SPDX-License-Identifier: MIT
# The breaks of src/ that the proofs must notice: those of test/faults.txt, each with its
# proof, and what choice.rb draws.
require 'digest/sha2' # of threads, only the first may load it
require 'fileutils'
require_relative '../c_functions'
require_relative '../faults/faults'
require_relative 'proofs'

# A break for a proof: `source` is its file's text with it, `words` names it.
Broken = Struct.new(:proof, :file, :source, :words) do
  def name
    "#{proof.name} broken: #{words}"
  end

  def in_tree(build, &block)
    Seeded.in_tree(build, name, file, source, &block)
  end
end

module Seeded
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
  def in_tree(build, name, file, source)
    tree = "#{build}/broken_#{Digest::SHA256.hexdigest(name)[0, 16]}"
    FileUtils.rm_rf(tree)
    FileUtils.mkdir_p(tree)
    FileUtils.cp_r(%w[include src], tree)
    File.write("#{tree}/#{file}", source)
    yield tree
  ensure
    FileUtils.rm_rf(tree)
  end

  # [mutant, name] in an order that is always the same: one of each line before the
  # second ones.
  def shuffled(named)
    named.sort_by { |_, key| Digest::SHA256.hexdigest(key) }.group_by { |mutant, _| [mutant.file, mutant.line] }.values
         .flat_map { |of_line| of_line.each_with_index.to_a }.sort_by { |(_, key), round| [round, Digest::SHA256.hexdigest(key)] }.map(&:first)
  end

  # Of each row `proof MODULE FORM WHAT: ...`, for the first of its machines.
  def all(proofs)
    named = proofs.reverse.to_h { |proof| [[proof.group, proof.form, proof.what].join(' '), proof] }
    Faults.of('proof').map do |fault|
      name = fault.words(1).join(' ')
      proof = named[name] or abort "prove: #{Faults::FILE}: no #{name}"
      Broken.new(proof, fault.file, fault.sources.fetch(fault.file), fault.to_s)
    end
  rescue Faults::Gone => e
    abort "prove: #{e.message}"
  end

  # The functions of which nothing is proved, or not enough for five breaks: of
  # each row `file, function: reason` and `file: reason`.
  def unproved
    @unproved ||= File.readlines(UNPROVED, chomp: true).grep_v(/^#|^\s*$/).map do |line|
      line[/\A(src\S+?(?:, \w+)?): \S/, 1] or abort "prove: #{UNPROVED}: #{line}"
    end
  end

  def unproved?(file, function)
    unproved.include?(file) || unproved.include?("#{file}, #{function}")
  end

  # [file, function] of all that must have so many.
  def long_functions
    @long_functions ||= (Dir['src/*/*.[ch]'] - Dir['src/*/*_{arm,avr,pic14,pic18,sdcc}.[ch]']).sort.flat_map do |file|
      CFunctions.statements(file).select { |_, statements| statements > STATEMENTS }.keys.map { |function| [file, function] }
    end
  end

  # Proofs that no row is for, and what is named as unproved and need not be.
  def complaints(proofs, breaks)
    tried = breaks.map { |broken| [broken.proof.group, broken.proof.what] }
    untried = proofs.map { |proof| [proof.group, proof.what] }.uniq - tried - [%w[model model]]
    needless = unproved - long_functions.flat_map { |file, function| [file, "#{file}, #{function}"] }
    untried.map { |group, what| "#{Faults::FILE}: nothing for #{group} #{what}" } +
      needless.map { |name| "#{UNPROVED}: no longer true: #{name}" }
  end
end

# SPDX-License-Identifier: MIT
# Finds breaks that a proof notices, for the functions that have too few.
require 'open3'
require_relative '../mutants/breaks'
require_relative 'exhaustion'
require_relative 'seeded'

# Takes the breaks of tools/lib/mutants and asks the proofs that reach a
# function, those first that reach the fewest others.
class Choice
  TRIES = 20
  SECONDS = 12
  FAILURES = 3
  WORD = WORDS.first

  def initialize(proofs, breaks, build)
    @build = build
    @breaks = breaks
    @reached = {}
    @proofs = proofs.select { |proof| proof.exhausted? || (proof.word == WORD && !SLOW.include?(proof.what)) }
    @proofs.each { |proof| [Proofs.sources(proof), reaches(proof)] } # before several ask at a time
  end

  def lacking
    Seeded.lacking(@breaks).keys.reject { |place| Seeded.unproved?(*place) }
  end

  # What is noticed of a function's breaks: the rows that are to be added.
  def of(file, function)
    needed = Seeded.lacking(@breaks).fetch([file, function])
    proofs = proofs_of(file, function)
    failures = Hash.new(0)
    found = []
    candidates(file, function).first(TRIES).each do |whole, instead|
      break if found.size == needed

      broken = proofs.map { |proof| Broken.new(proof, file, function, whole, instead, "#{function}_#{file.hash}") }
                     .find { |one| noticed?(one, failures) }
      found << broken.row if broken
      proofs = better(proofs, broken, failures)
    end
    found
  end

  private

  def noticed?(broken, failures)
    answer = broken.in_tree(@build) { |tree| judge_of(broken.proof).new(broken.proof, @build, tree, SECONDS).run }
    failures[broken.proof] += 1 unless answer.verdict == :refuted
    answer.verdict == :refuted
  end

  # The proof that noticed comes first; those that never did go.
  def better(proofs, broken, failures)
    failures[broken.proof] = -TRIES * TRIES if broken
    [broken&.proof, *proofs].compact.uniq.reject { |proof| failures[proof] >= FAILURES }
  end

  # In the first form that comes to it; to try all operands is the last means.
  def proofs_of(file, function)
    reached = @proofs.select { |proof| Proofs.sources(proof).include?(file) && reaches(proof).include?(function) }
    tried, asked = reached.uniq { |proof| [proof.group, proof.what, proof.exhausted? && proof.form] }.partition(&:exhausted?)
    asked.sort_by { |proof| reaches(proof).size } + tried
  end

  def reaches(proof)
    @reached[proof] ||= proof.exhausted? ? in_leaves(proof) : Cbmc.new(proof, @build).functions
  end

  def in_leaves(proof)
    text, = Open3.capture2('cc', '-std=c99', '-E', '-P', *proof.options, '-Iinclude', '-Isrc', proof.harness)
    text.scan(/(\w+)\(/).flatten.uniq
  end

  # [whole, instead] of each line that can be broken, one of each line before the
  # second ones.
  def candidates(file, function)
    lines = Seeded.lines(file)
    there = @breaks.map { |broken| [broken.file, broken.whole, broken.instead] }
    of_lines = Breaks.of(file).select { |mutant| Seeded.functions(file)[mutant.line - 1] == function }.group_by(&:line)
    rounds = of_lines.flat_map { |line, mutants| mutants.each_with_index.map { |mutant, round| [round, line, mutant] } }
    rounds.sort_by { |round, line, _| [round, line] }.map { |_, _, mutant| change(lines, mutant) }.compact.uniq
          .reject { |change| there.include?([file, *change]) }
          .select { |whole, _| Broken.new(nil, file, function, whole).places.size == 1 }
  end

  # What it changes, if that is one line.
  def change(lines, mutant)
    now = mutant.source.lines
    differ = lines.each_index.reject { |at| lines[at] == now[at] }
    return unless now.size == lines.size && differ.size == 1

    [lines, now].map { |text| text[differ.first].sub(%r{//.*}, '').strip }
  end
end

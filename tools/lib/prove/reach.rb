# SPDX-License-Identifier: MIT
# Whether a proof comes to its end, and to each of its claims.
require_relative 'cbmc'
require_relative 'proofs'

# A proof whose assumptions exclude each other holds of everything, and so does a claim
# behind them. It is asked in the shortest words. The claims that a form lacks the feature for
# stand in unreached.txt below the reason, as PROOF: CLAIM; a line that begins with a folder
# is no claim's.
class Reach
  FILE = "#{FOLDER}/unreached.txt".freeze
  WORD = WORDS.first

  def self.chosen(proofs)
    proofs.select { |proof| proof.word == WORD && !proof.exhausted? }.map { |proof| new(proof) }
  end

  # [proof, claim] of each line.
  def self.pinned
    @pinned ||= File.readlines(FILE, chomp: true).grep_v(%r{\A(?:#|src/|\s*\z)}).map { |line| line.split(': ', 2) }
  end

  # The lines that name none of all proofs.
  def self.complaints(proofs)
    names = chosen(proofs).map(&:pinned_name)
    pinned.reject { |name, _| names.include?(name) }.map { |name, _| "#{FILE}: no proof is named #{name}" }
  end

  def initialize(proof)
    @proof = proof
  end

  # In a line.
  def pinned_name
    @proof.name.delete_suffix(" #{WORD}")
  end

  # Whether it does, and what to print.
  def judge(build)
    found = Cbmc.new(@proof, build).claims or return [false, "#{@proof.name}: no answer about its claims"]
    missed = found.reject { |_, reached| reached }.keys
    return [false, "#{@proof.name}: no values come to its end: what it assumes cannot be, or it never returns"] if missed.include?(Cbmc::ITS_END)

    strange = missed.reject { |_, claim| pinned.include?(claim) }.map { |place, claim| "#{place}: #{claim}" }
    return [false, "#{@proof.name}: nothing comes to #{strange.join(', nor to ')}"] unless strange.empty?

    stale = pinned - missed.map(&:last)
    return [false, *stale.map { |claim| "#{pinned_name}: #{FILE}: no longer true: #{claim}" }] unless stale.empty?

    [true, "#{@proof.name} reaches its claims: its end and #{found.size - 1 - missed.size}"]
  end

  private

  def pinned
    self.class.pinned.select { |name, _| name == pinned_name }.map(&:last)
  end
end

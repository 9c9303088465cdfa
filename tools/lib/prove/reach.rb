# SPDX-License-Identifier: MIT
# Whether a proof comes to its end, and to each of its claims.
require_relative 'about_claims'
require_relative 'cbmc'

# A proof whose assumptions exclude each other holds of everything, and so does a claim
# behind them. The claims that a form lacks the feature for stand in unreached.txt.
class Reach < AboutClaims
  FILE = "#{FOLDER}/unreached.txt".freeze

  def self.chosen(proofs)
    asked(proofs).map { |proof| new(proof) }
  end

  def name
    "#{@proof.name} reaches its claims"
  end

  def options
    @proof.options
  end

  # Whether it does, and what to print.
  def judge(build)
    found = Cbmc.new(@proof, build).claims or return [false, "#{@proof.name}: no answer about its claims"]
    missed = found.reject { |_, reached| reached }.keys
    return [false, "#{@proof.name}: no values come to its end: what it assumes cannot be, or it never returns"] if missed.include?(Cbmc::ITS_END)

    strange = missed.reject { |_, claim| pinned.include?(claim) }.map { |place, claim| "#{place}: #{claim}" }
    return [false, "#{@proof.name}: nothing comes to #{strange.join(', nor to ')}"] unless strange.empty?

    wrong = stale(missed.map(&:last))
    return [false, *wrong.map { |line| "#{pinned_name}: #{line}" }] unless wrong.empty?

    [true, "#{name}: its end and #{found.size - 1 - missed.size}"]
  end
end

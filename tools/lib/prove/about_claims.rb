# SPDX-License-Identifier: MIT
# A question about each claim of a proof.
require_relative 'proofs'

# It is asked in the shortest words. The claims of which the answer may be no stand in the
# FILE of who asks, below the reason, as PROOF: CLAIM; a line that begins with a folder is no
# claim's.
class AboutClaims
  WORD = WORDS.first

  # Those of these proofs that can be asked.
  def self.asked(proofs)
    proofs.select { |proof| proof.word == WORD && !proof.exhausted? }
  end

  # [proof, claim] of each line.
  def self.pinned
    @pinned ||= File.readlines(self::FILE, chomp: true).grep_v(%r{\A(?:#|src/|\s*\z)}).map { |line| line.split(': ', 2) }
  end

  # The lines that name none of all proofs.
  def self.complaints(proofs)
    names = asked(proofs).map { |proof| name_of(proof) }
    pinned.reject { |name, _| names.include?(name) }.map { |name, _| "#{self::FILE}: no proof is named #{name}" }
  end

  # In a line.
  def self.name_of(proof)
    proof.name.delete_suffix(" #{WORD}")
  end

  def initialize(proof)
    @proof = proof
  end

  private

  def pinned_name
    self.class.name_of(@proof)
  end

  def pinned
    self.class.pinned.select { |name, _| name == pinned_name }.map(&:last)
  end

  # What to say of the lines that name none of the claims of which the answer is no.
  def stale(claims)
    (pinned - claims).map { |claim| "#{self.class::FILE}: no longer true: #{claim}" }
  end
end

# SPDX-License-Identifier: MIT
# Whether each claim of a proof is needed.
require_relative '../faults/breaks'
require_relative '../faults/equivalents'
require_relative 'about_claims'
require_relative 'cbmc'
require_relative 'equivalents'
require_relative 'seeded'

# A claim is needed if some break makes it fail and nothing else of the proof: without
# the claim that break is unnoticed. The proof's breaks of test/faults.txt are tried, and as
# many as are allowed of those that a machine draws, always the same ones. A claim that none
# of them needs stands in unneeded.txt.
class Claims < AboutClaims
  FILE = "#{FOLDER}/unneeded.txt".freeze
  DRAWN_MOST = 40
  SECONDS = 20 # for one that is drawn

  # Another property that fails with a break, or nil.
  Failure = Struct.new(:other, :broken) do
    def alone?
      other.nil?
    end
  end

  # The first form of each proof that is asked.
  def self.chosen(proofs, words, breaks)
    breakable(proofs).uniq { |proof| [proof.harness, proof.what] }.select { |proof| proof.matches?(words) }
                     .map { |proof| new(proof, breaks.select { |broken| broken.proof == proof }) }
  end

  # Of a proof in which no source is nothing can be broken.
  def self.breakable(proofs)
    asked(proofs).reject { |proof| Proofs.sources(proof).grep(%r{\A(?:src|include)/}).empty? }
  end

  def initialize(proof, breaks)
    super(proof)
    @breaks = breaks
  end

  def name
    "#{@proof.name} needs its claims"
  end

  # What the answer depends on beside the sources and the proofs.
  def words
    [@proof.options, @breaks.map(&:source), File.read(Equivalents::FILE)]
  end

  # Whether they are, and what to print of each, or of those that are not.
  def judge(build)
    claims = named(Cbmc.new(@proof, build).properties)
    found = failures(claims, build)
    needless = claims.reject { |property, _| found[property]&.alone? }
    wrong = needless.reject { |_, claim| pinned.include?(claim) }.map { |property, claim| "no break needs: #{claim}: #{why(found[property], claims)}" } +
            stale(needless.values)
    good = claims.map { |property, claim| "#{claim}: #{needless.key?(property) ? "unneeded, as #{FILE} says" : found[property].broken}" }
    [wrong.empty?, (wrong.empty? ? good : wrong).map { |line| "#{pinned_name}: #{line}" }]
  end

  private

  # Of properties with their texts those that are claims, with names that differ.
  def named(properties)
    claims = properties.reject { |_, text| text.start_with?('pre: ') }.to_a
    claims.group_by(&:last).values.flat_map do |alike|
      alike.each_with_index.map { |(property, text), at| [property, alike.size == 1 ? text : "#{text} (#{at + 1} of #{alike.size})"] }
    end.to_h
  end

  def why(failure, claims)
    return 'none makes it fail' unless failure

    "where it fails, another does: #{claims.fetch(failure.other, failure.other)}: #{failure.broken}"
  end

  # For each claim that fails with a break, the first of those with which no other does, if any.
  # A machine draws until all are alone but those that are said to be unneeded.
  def failures(claims, build)
    found = {}
    @breaks.each { |broken| try(found, build, broken.words, broken.file, broken.source) }
    drawn(build).first(DRAWN_MOST).each do |mutant|
      break if claims.all? { |property, claim| pinned.include?(claim) || found[property]&.alone? }

      try(found, build, *mutant)
    end
    found
  end

  # Notes what fails with a break, which may be limited in time.
  def try(found, build, name, file, source, seconds = nil)
    failing = Seeded.in_tree(build, "#{@proof.name} #{name}", file, source) { |tree| Cbmc.new(@proof, build, tree, seconds).failing }
    failing&.each do |property|
      failure = Failure.new((failing - [property]).first, name)
      found[property] = failure if !found.key?(property) || (failure.alone? && !found[property].alone?)
    end
  end

  # Names, files, sources, and for how long each is tried.
  def drawn(build)
    functions = [nil, *Cbmc.new(@proof, build).functions]
    equivalents = EquivalentMutants.new(Equivalents::FILE)
    keys = Proofs.sources(@proof).grep(%r{\Asrc/}).flat_map do |file|
      EquivalentMutants.keys(Breaks.of(file), File.read(file)).to_a.select do |mutant, key|
        functions.include?(Seeded.functions(file)[mutant.line - 1]) && !equivalents.cover?(key)
      end
    end
    Seeded.shuffled(keys).map { |mutant, key| [key, mutant.file, mutant.source, SECONDS] }
  end
end

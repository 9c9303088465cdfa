# SPDX-License-Identifier: MIT
# Whether the proofs notice what a machine breaks.
require 'open3'
require_relative '../faults/breaks'
require_relative '../faults/equivalents'
require_relative 'exhaustion'
require_relative 'seeded'

# Of each function of more than five statements breaks of tools/lib/faults are drawn,
# always the same, one of each line before the second ones: five of them, or all if there
# are fewer, must be noticed before fifteen were missed. What is known to change nothing is not drawn. A break is
# shown to the proofs that come to the function, first to those that come to the fewest
# others.
class Choice
  EQUIVALENT = 'test/tools/mutants/equivalent.txt'.freeze
  # They say that nothing bad follows, and not what must.
  WEAK = %w[total total_rest refused errors_rise derivative_rises candidate_rises limit_rises held_rises].freeze
  MISSED_MOST = 15
  SECONDS = [2, 12].freeze # who notices, does so soon: all proofs have a short time before one has a long one
  FAILURES = 3 # as often a proof may notice nothing, unless it is the only one
  WORD = WORDS.first

  def initialize(proofs, chosen, build)
    @build = build
    @proofs = proofs.select { |proof| proof.exhausted? || (proof.word == WORD && !proof.theorem?) }
    @places = Seeded.long_functions.select { |file, _| whole?(file, proofs, chosen) }
    files = @places.map(&:first).uniq
    asked = files.empty? ? [] : @proofs.select { |proof| Proofs.from_any?(proof, files) }
    @reached = Hash[asked.each_slice([asked.size / 2, 1].max).map { |some| Thread.new { some.map { |proof| [proof, reaches(proof)] } } }
                         .flat_map(&:value)]
    @equivalents = EquivalentMutants.new(EQUIVALENT)
  end

  attr_reader :places

  # Whether enough is noticed, and what to print. Of a function that is said to be
  # unproved, so many in a row would be enough to refute that.
  def judge(place)
    unproved = Seeded.unproved?(*place)
    noticed, tried, drawn = draw(*place, unproved ? 0 : MISSED_MOST)
    wanted = drawn.clamp(1, Seeded::BREAKS)
    enough = noticed.size == wanted
    return [true, unproved ? [] : noticed] if enough ^ unproved

    where = place.join(', ')
    [false, unproved ? "#{Seeded::UNPROVED}: no longer true: #{where}" : "#{where}: #{noticed.size} breaks noticed of #{tried}, not #{wanted}"]
  end

  private

  # Those of a module of which all is to be proved, those of no module with everything.
  def whole?(file, proofs, chosen)
    of_module = proofs.select { |proof| proof.group == file.split('/')[1] }
    ((of_module.empty? ? proofs : of_module) - chosen).empty?
  end

  # The lines about those that are noticed, how many were tried, until as many as are
  # allowed were missed, and how many there are.
  def draw(file, function, missed_most)
    proofs = proofs_of(file, function)
    proofs = proofs.reject { |proof| WEAK.include?(proof.what) } if missed_most.zero?
    failures = Hash.new(0)
    noticed = []
    drawn = proofs.empty? ? [] : candidates(file, function)
    tried = drawn.take_while.with_index do |(mutant, key), at|
      next if noticed.size == Seeded::BREAKS || at - noticed.size > missed_most

      proof, line = ask(proofs, mutant, key, failures)
      noticed << line if proof
      proofs = better(proofs, proof, failures)
    end
    [noticed, tried.size, drawn.size]
  end

  # The one that noticed a break first; those that never did not any more.
  def better(proofs, proof, failures)
    failures[proof] = -Float::INFINITY if proof
    kept = [proof, *proofs].compact.uniq.reject { |one| failures[one] >= FAILURES }
    kept.empty? ? proofs : kept
  end

  # The proof that notices a break, and the line about it.
  def ask(proofs, mutant, key, failures)
    Seeded.in_tree(@build, key, mutant.file, mutant.source) do |tree|
      SECONDS.each do |seconds|
        proofs = proofs.select do |proof|
          answer = judge_of(proof).new(proof, @build, tree, seconds).run
          return [proof, "#{Broken.new(proof, nil, nil, key).name}: noticed, #{answer.seconds.round(1)} s"] if answer.verdict == :refuted

          more = seconds != SECONDS.last && answer.verdict == :none && !answer.why.start_with?('it does not compile')
          failures[proof] += 1 unless more
          more
        end
      end
    end
    nil
  end

  # In the first form that comes to it. Those that say little, those that are slow, and
  # those that try all operands are the last means.
  def proofs_of(file, function)
    reached = @reached.select { |proof, functions| Proofs.from_any?(proof, [file]) && functions.include?(function) }.keys
    reached.uniq { |proof| [proof.group, proof.what, proof.exhausted? && proof.form] }.sort_by do |proof|
      last = [WEAK.include?(proof.what), SLOW.include?(proof.what), proof.exhausted?].count(true)
      [last, @reached[proof].size]
    end
  end

  def reaches(proof)
    return Cbmc.new(proof, @build).functions unless proof.exhausted?

    text, = Open3.capture2(*proof.compiler, '-E', '-P', *proof.options, '-Iinclude', '-Isrc', proof.harness)
    text.scan(/(\w+)\(/).flatten.uniq
  end

  # [mutant, its name] in the order in which they are tried.
  def candidates(file, function)
    keys = EquivalentMutants.keys(Breaks.of(file), Seeded.lines(file).join)
    named = keys.select { |mutant, key| Seeded.functions(file)[mutant.line - 1] == function && !@equivalents.cover?(key) }
    Seeded.shuffled(named)
  end
end

# SPDX-License-Identifier: MIT
# Whether what test/tools/mutants/equivalent.txt says to change nothing is proved to.
require_relative '../faults/breaks'
require_relative '../faults/equivalents'
require_relative 'alike'
require_relative 'exhaustion'
require_relative 'seeded'

# A mutant is shown to change nothing if each function that it changes does the same as it
# did (alike.rb), or if each proof whose program it changes still holds, and there is one
# that says what must follow. Where neither is so, the line must stand in `argued.txt`, below
# the reason. What unproved.txt names, and macros of headers, are argued anyway.
class Equivalents
  # They say that nothing bad follows, and not what must.
  WEAK = %w[total total_rest refused errors_rise derivative_rises candidate_rises limit_rises held_rises].freeze
  FILE = 'test/tools/mutants/equivalent.txt'.freeze
  ARGUED = "#{FOLDER}/argued.txt".freeze
  WORD = WORDS.first

  def initialize(proofs, build)
    @build = build
    @proofs = proofs.select { |proof| proof.exhausted? || proof.word == WORD }
    @equivalents = EquivalentMutants.new(FILE)
    @argued = EquivalentMutants.new(ARGUED)
    @programs = {}
    @reached = {}
    @alike = {}
    @answers = {}
    @lock = Mutex.new
  end

  # The mutants that are asked about, by their lines.
  def chosen(words)
    @equivalents.known.select { |key| words.all? { |word| key.include?(word) } }
  end

  # Lines of `argued.txt` that nothing else has.
  def complaints
    (@argued.known - @equivalents.known).map { |key| "#{ARGUED}: not in #{FILE}: #{key}" }
  end

  # Whether what is said of a line is true, and what to print.
  def judge(key)
    file = key[/\A[^:,]+/]
    mutant = mutants(file)[key] or return [false, "#{key}: there is no such line"]
    return [true, "#{key}: argued, as nothing is proved of it"] if unproved?(mutant)

    held, why = Seeded.in_tree(@build, key, file, mutant.source) { |tree| shown(mutant, key, tree) }
    if @argued.cover?(key)
      [!held, held ? "#{key}: argued in #{ARGUED}, and proved: #{why}" : "#{key}: argued, as #{why}"]
    else
      [held, "#{key}: #{why}"]
    end
  end

  private

  # Whether all proofs that it changes hold, and by which, or why not.
  def shown(mutant, key, tree)
    return [true, 'the function does the same as it did'] if alike?(mutant, tree)

    macro = key[/: #define (\w+)/, 1]
    changed = proofs_of(mutant).select { |proof| program(proof, '.') != program(proof, tree) }
    return [false, 'no proof of what it does comes to it'] if changed.all? { |proof| WEAK.include?(proof.what) }

    defined = changed.find { |proof| macro && defines_by?(proof.harness, macro, mutant.file) }
    return [false, "the definition in #{defined.harness} has it, too"] if defined

    changed.sort_by { |proof| reaches(proof).size }.each do |proof|
      answer = judge_of(proof).new(proof, @build, tree).run
      return [false, "#{proof.name} is not proved of it: #{answer.why}"] unless answer.verdict == :proved
    end
    [true, "proved by #{changed.map(&:name).join(', ')}"]
  end

  # Whether all that it changes is, in each form of the proofs of its file; of what is
  # exhausted a solver is not asked.
  def alike?(mutant, tree)
    exhausted, proved = @proofs.select { |proof| Proofs.from_any?(proof, [mutant.file]) }.partition(&:exhausted?)
    return false if exhausted.any? { |proof| program(proof, '.') != program(proof, tree) }

    forms = proved.select { |proof| Alike.can_ask?(proof) }.uniq { |proof| [proof.harness, proof.options] }
    answers = forms.lazy.map { |proof| alike(proof).answer(tree) }.take_while { |answer| answer != :nothing }.to_a
    answers.size == forms.size && answers.include?(:alike)
  end

  def alike(proof)
    @lock.synchronize { @alike[[proof.harness, proof.options]] ||= Alike.new(proof, @build, @answers) }
  end

  def mutants(file)
    @lock.synchronize do
      @mutants ||= {}
      @mutants[file] ||= EquivalentMutants.keys(Breaks.of(file), File.read(file)).invert
    end
  end

  # Named so, or a macro that only a compiler folds.
  def unproved?(mutant)
    mutant.file.start_with?('include/') || Seeded.unproved?(mutant.file, function_of(mutant))
  end

  def function_of(mutant)
    @lock.synchronize { Seeded.functions(mutant.file)[mutant.line - 1] }
  end

  # The proofs that come to its function, of a macro those of its files.
  def proofs_of(mutant)
    function = function_of(mutant)
    @proofs.select { |proof| Proofs.from_any?(proof, [mutant.file]) && (function.nil? || reaches(proof).include?(function)) }
  end

  def reaches(proof)
    @lock.synchronize { @reached[proof] ||= proof.exhausted? ? words_of(proof) : Cbmc.new(proof, @build).functions }
  end

  def words_of(proof)
    of_tree(proof, '.').scan(/\w+/).uniq
  end

  # What is proved of the sources of a tree.
  def program(proof, tree)
    return of_tree(proof, tree) unless tree == '.'

    @lock.synchronize { @programs[proof] ||= of_tree(proof, tree) }
  end

  def of_tree(proof, tree)
    judge_of(proof).new(proof, @build, tree).instructions
  end

  # Whether a harness uses a macro of a file, or one that is made with it.
  def defines_by?(harness, macro, file)
    folder = File.dirname(file)
    noun = File.basename(file)[/\Afixpid_[a-z0-9]+/]
    macros = Dir["#{folder}/#{noun}*.[ch]"].flat_map { |other| File.read(other).gsub("\\\n", ' ').scan(/^#define (\w+)(.*)$/) }
    names = [macro]
    loop do
      more = macros.select { |_, body| names.any? { |name| body.match?(/\b#{name}\b/) } }.map(&:first) - names
      break if more.empty?

      names += more
    end
    File.read(harness).match?(/\b(?:#{names.join('|')})\b/)
  end
end

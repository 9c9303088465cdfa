# SPDX-License-Identifier: MIT
# Whether the proofs come to every place of what they are proofs of.
require_relative 'cbmc'
require_relative 'proofs'

# A proof that assumes too much says nothing of what its assumptions leave out.
# So each place of src/ in a function that the proofs of a form come to must be
# reached, for some values, by one of them. What cannot be stands in
# unreached.txt, below the reason, as FILE, FUNCTION: LINE.
class Coverage
  FILE = "#{FOLDER}/unreached.txt".freeze
  WORD = WORDS.first
  # The first assume nothing or too much on purpose; the parts of the last have
  # proofs of their own.
  NOT_ASKED = %w[total total_rest refused composed].freeze
  # Nothing comes to the places of a feature that a form has not.
  FEATURES = /\A-DFIXPID_PID_FEATURES=/.freeze

  attr_reader :unreached

  # Those forms with all these words in their names.
  def self.chosen(proofs, words)
    asked = proofs.reject { |proof| proof.exhausted? || proof.theorem? || proof.word != WORD || NOT_ASKED.include?(proof.what) }
    asked = asked.reject { |proof| proof.options.grep(FEATURES).any? }
    forms = asked.group_by { |proof| [proof.group, proof.form] }
    forms.select { |name, _| (words - name).empty? }.map { |name, of_form| new(name.join(' '), of_form) }
  end

  def self.pinned
    @pinned ||= File.readlines(FILE, chomp: true).grep(/\Asrc/)
  end

  def initialize(name, proofs)
    @name = name
    @proofs = proofs
    @unreached = []
  end

  # Whether all is reached but what is pinned, and what to print.
  def judge(build)
    places = Hash.new(false)
    @proofs.each do |proof|
      found = Cbmc.new(proof, build).places or return [false, "#{@name}: #{proof.name} has no answer"]
      found.each { |place, reached| places[place] |= reached }
    end
    @unreached = places.reject { |_, reached| reached }.keys.map { |file, line, function| "#{file}, #{function}: #{text(file, line)}" }.uniq
    verdict(places.size)
  end

  private

  def text(file, line)
    File.readlines(file)[line.to_i - 1].sub(%r{//.*}, '').strip
  end

  def verdict(count)
    strange = @unreached - Coverage.pinned
    return [true, "#{@name}: #{count} places, #{@unreached.size} of them not reached"] if strange.empty?

    [false, "#{@name}: not reached, and not in #{FILE}:\n#{strange.join("\n")}"]
  end
end

# Whether a proof comes to its end, and to each of its claims.
#
# A proof whose assumptions exclude each other holds of everything, and so does a claim
# behind them. It is asked in the shortest words. The claims that a form lacks the feature for
# stand in unreached.txt below the reason, as PROOF: CLAIM; a line that begins with a folder
# is no claim's.
class Reach
  FILE = Coverage::FILE
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

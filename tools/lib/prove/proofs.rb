# SPDX-License-Identifier: MIT
# The proofs, as test/proof/proofs.txt and the harnesses in test/proof/ have them.
require 'open3'
require 'pathname'
require_relative '../build/inputs'

FOLDER = 'test/proof'.freeze
WORDS = [16, 32, 64].freeze
PRIMITIVES = 'primitives'.freeze # the harness that tries all cases, on this machine
HOST = 64
INT_16 = '-DPRIMITIVES_INT_16'.freeze # with an int of 16 bits: test/proof/int16.hh
THEOREMS = 'theorems'.freeze # of these each module has a harness of its own
SLOW = %w[modes noise step_exact integrate ends candidate_rises receive limit_rises turn set_limits track valid cycle at relay slew_reaches composed disorder integral_inside set_integral_limits differentiate derivative_rises held_rises bumpless tpo_exact level lost kept whole].freeze # they take many seconds
# Beside these, what tools/prove --quick leaves out.
LONG = ['an937 step', 'an964_8bit step', 'autotune make', 'autotune minus', 'autotune plus', 'autotune step',
        'autotune sum', 'autotune unpack', 'guard step', 'pid errors_rise', 'pid limit', 'pid restore', 'pid special_errors', 'reaction model',
        'record unpack', 'theorems monotone', 'tpo owed'].freeze

# Of what CBMC is asked: how its harness is compiled.
module Compiled
  # What goto-cc takes for it, with the sources of a tree.
  def flags(tree)
    ["--#{word}", "-DPROOF_WORD=#{word}", *options, "-I#{FOLDER}", "-I#{FOLDER}/model", "-I#{tree}/include", "-I#{tree}/src"]
  end

  # The module whose functions are those of one object, `c`, or nil.
  def object
    options.join(' ')[/-DFIXPID_(\w+)_OBJECT=c\b/, 1]&.downcase
  end
end

# One function of a harness, in one form, for one machine.
Proof = Struct.new(:group, :form, :options, :what, :word, :first) do
  include Compiled

  def name
    "#{group} #{form} #{what} #{word}"
  end

  def matches?(words)
    words.all? { |word| name.split.include?(word) }
  end

  # Short, and of the first form of a harness with words of 16 bits.
  def quick?
    first && word == WORDS.first && !SLOW.include?(what) && !LONG.include?("#{group} #{what}")
  end

  def exhausted?
    group == PRIMITIVES
  end

  # What compiles one that is tried: where an int has 16 bits, its integers are classes.
  def compiler
    options.include?(INT_16) ? %w[g++ -std=c++20 -xc++] : %w[cc -std=c99]
  end

  def theorem?
    group == THEOREMS
  end

  def harness
    theorem? ? "#{FOLDER}/#{THEOREMS}/#{form}.c" : Proofs.harness(group, what)
  end

  def function
    "prove_#{what}"
  end

  # The functions for which others stand, which do what is proved of them elsewhere: the
  # line `By contract: a, b (c).` of the comment above the proof says that for `a` its
  # `a_contract` does, and for `b` it is `c`.
  def contracts
    comment[/By contract: ([\w, ()]+)\./, 1].to_s.split(', ').to_h do |text|
      function, other = text.delete('()').split
      [function, other || "#{function}_contract"]
    end
  end

  # What the comment above says after `Theorem: `, up to the next word with a colon.
  def sentence
    comment[/Theorem: (.*?)(?= By contract:| Assumed:|\z)/, 1]
  end

  # And after `Assumed: `, or nil.
  def assumed
    comment[/Assumed: (.*?)(?= By contract:|\z)/, 1]
  end

  private

  def comment
    Proofs.text(harness)[%r{((?://.*\n)+)void #{function}\(void\)$}, 1].to_s.gsub(%r{^// }, '').tr("\n", ' ').strip
  end
end

# All of them.
module Proofs
  module_function

  def text(file)
    @texts ||= {}
    @texts[file] ||= File.read(file)
  end

  # The file with a proof: MODULE.c, or a part of it, MODULE_PART.c, which is no module.
  def harness(group, what)
    @harnesses ||= {}
    @harnesses[[group, what]] ||=
      parts(group).find { |part| text(part).include?("void prove_#{what}(void)") } || "#{FOLDER}/#{group}.c"
  end

  def parts(group)
    @parts ||= {}
    @parts[group] ||= Dir["#{FOLDER}/#{group}_*.c"].sort - rows.map { |left,| "#{FOLDER}/#{left.split.first}.c" }
  end

  # The files that a harness is compiled from, in a form.
  def sources(proof)
    @sources ||= {}
    @sources[[proof.harness, proof.options]] ||=
      Open3.capture2(*proof.compiler, '-MM', *proof.options, "-I#{FOLDER}", '-Iinclude', '-Isrc', proof.harness).first.split
           .map { |file| Pathname(file).cleanpath.to_s } # of src/pid/../common/
  end

  # Whether one of these is among them. Most harnesses do not even name it in a header that
  # they include under any condition, and of these no compiler is asked.
  def from_any?(proof, files)
    @named ||= {}
    named = @named[proof.harness] ||= Inputs.with_included([proof.harness], [FOLDER, 'include', 'src'])
    (named & files).any? && (sources(proof) & files).any?
  end

  # Of each row `module form [option]... : what...`.
  def all
    groups = []
    rows.flat_map do |left, right|
      group, form, *options = left.split
      first = group == THEOREMS || !groups.include?(group)
      groups << group
      words = group == PRIMITIVES ? [HOST] : WORDS
      right.split.flat_map { |what| words.map { |word| Proof.new(group, form, options, what, word, first) } }
    end
  end

  def rows
    @rows ||= text("#{FOLDER}/proofs.txt").lines(chomp: true).grep_v(/^#|^\s*$/).map { |line| line.split(' : ', 2) }
  end

  # What a harness proves and nobody runs, the other way round, and what is slow and no proof.
  def complaints(proofs)
    named = proofs.reject { |proof| proof.exhausted? && proof.what == 'all' }.map { |proof| [proof.harness, proof.what] }.uniq
    there = Dir["#{FOLDER}/{,#{THEOREMS}/}*.c"].sort.flat_map do |harness|
      text(harness).scan(/^void prove_(\w+)\(void\)$/).flatten.map { |what| [harness, what] }
    end
    (there - named).map { |harness, what| "#{harness}: #{FOLDER}/proofs.txt does not name #{what}" } +
      (named - there).map { |harness, what| "#{harness}: there is no proof of #{what}" } +
      (SLOW - named.map(&:last) + LONG - proofs.map { |proof| "#{proof.group} #{proof.what}" }).map { |what| "a slow proof that is none: #{what}" }
  end
end

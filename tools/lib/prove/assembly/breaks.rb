# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../../faults/equivalents'
require_relative '../../faults/instructions'
require_relative '../seeded'

# Whether the claims notice a broken instruction. Of each function of assembly some breaks
# of tools/lib/faults/instructions.rb are drawn, always the same, but none that is known to
# change nothing.
class AssemblyBreaks
  BREAKS = 3
  SECONDS = 60 # what is broken shows soon
  EQUIVALENTS = 'test/tools/mutants/assembly.txt'

  attr_reader :drawn

  # Of the files whose code is only in images all of whose claims are chosen.
  def initialize(chosen, build)
    @build = build
    @asked = Assembly.claims.group_by(&:image).select { |_, claims| (claims - chosen).empty? }
    @whole = @asked.keys.to_h { |image| [image, texts(image, Assembly.image(image, build))] }
    known = EquivalentMutants.new(EQUIVALENTS)
    @drawn = files.flat_map do |file|
      EquivalentMutants.keys(Instructions.breaks(file), File.read(file)).reject { |_, key| known.cover?(key) }
                       .group_by { |_, key| key[/\A[^:]+/] }.values
                       .flat_map { |some| some.sort_by { |_, key| Digest::SHA256.hexdigest(key) }.first(BREAKS) }
    end
  end

  # Whether a claim does not hold any more, and which, or why no claim can be made of it.
  def judge(mutant, key)
    Seeded.in_tree(@build, key, mutant.file, mutant.source) do |tree|
      changed(mutant, tree).each do |claim, text|
        answer = ClaimRun.new(claim, text, "#{@build}/claim_#{File.basename(tree)}", SECONDS).run
        return [true, "#{claim.name} broken: #{key}: noticed"] if answer.verdict == :refuted
      end
    end
    [false, "#{key}: nobody noticed"]
  rescue Translation::Unknown => e # of what is not broken, all is known
    [true, "#{key}: refused: #{e.message.lines.first.chomp}"]
  end

  private

  def files
    Instructions.files.select { |file| Assembly::SETS.any? { |set| set.sources.match?(file) && (set.images - @asked.keys).empty? } }
  end

  # The claims' programs by claim.
  def texts(image, translated)
    @asked.fetch(image).to_h { |claim| [claim, ClaimText.new(claim, translated)] }
  end

  # The claims whose functions are other ones in a tree.
  def changed(mutant, tree)
    images = @asked.keys.select { |image| Assembly.set_of(image).sources.match?(mutant.file) }
    images.flat_map do |image|
      texts(image, Assembly.image(image, @build, tree)).reject { |claim, text| text.functions == @whole[image][claim].functions }.to_a
    end
  end
end

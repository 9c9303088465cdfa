# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../../faults/breaks'
require_relative '../../faults/equivalents'
require_relative '../seeded'

# Whether the claims notice an instruction that is left out. Of each function of assembly
# some are drawn, always the same: so many must be noticed, or all if there are fewer, before
# as many were missed.
class AssemblyBreaks
  BREAKS = 3
  SECONDS = 60 # what is broken shows soon
  # A block for SDCC, and the strings of an __asm__ up to its operands.
  BLOCK = /__asm$.*?__endasm|__asm__\((?:"(?:[^"\\]|\\.)*"|[\s\\]|# *\w+)+/m.freeze
  # On a line of its own, or in a string that ends behind it. A bank says nothing of a result.
  INSTRUCTION = /(?:^ +|"|\\n|\\t)(?<what>(?!banksel|pagesel|nop|cc")[a-z]\w+(?:[ \t][^:;\n"\\]*)?)(?=\s*;|\n|\\n|"(?!\s*#))/.freeze

  attr_reader :functions # each with its breaks by their names

  # Of the files whose code is only in images all of whose claims are chosen.
  def initialize(chosen, build)
    @build = build
    @asked = Assembly.claims.group_by(&:image).select { |_, claims| (claims - chosen).empty? }
    @whole = @asked.keys.to_h { |image| [image, texts(image, Assembly.image(image, build))] }
    keys = files.flat_map { |file| EquivalentMutants.keys(left_out(file, File.read(file)), File.read(file)).to_a }
    @functions = keys.group_by { |_, key| key[/\A[^:]+/] }.transform_values { |drawn| Seeded.shuffled(drawn) }.to_a
  end

  # Whether enough is noticed of a function, and what to print.
  def judge(function, drawn)
    wanted = [BREAKS, drawn.size].min
    noticed = []
    drawn.first(2 * BREAKS).each do |mutant, key|
      line = noticed.size < wanted && ask(mutant, key)
      noticed << line if line
    end
    noticed.size == wanted ? [true, noticed] : [false, "#{function}: without #{noticed.size} of its instructions a claim fails, not #{wanted}"]
  end

  private

  def files
    Dir['src/**/*.[ch]'].sort.select do |file|
      File.read(file).match?(Assembly::TEXT) && Assembly::SETS.any? { |set| set.sources.match?(file) && (set.images - @asked.keys).empty? }
    end
  end

  def left_out(file, text)
    text.to_enum(:scan, BLOCK).map { Regexp.last_match }.flat_map do |block|
      block[0].to_enum(:scan, INSTRUCTION).map do
        match = Regexp.last_match
        place = block.begin(0) + match.begin(:what)
        Mutant.new(file, text[0...place].count("\n") + 1, place, match[:what].squeeze(' '), 'nop', text[0...place] + 'nop' + text[(place + match[:what].size)..])
      end
    end
  end

  # The line about a claim that does not hold any more, or of which no program can be made; nil
  # if all hold.
  def ask(mutant, key)
    Seeded.in_tree(@build, key, mutant.file, mutant.source) do |tree|
      changed(mutant, tree).each do |claim, text|
        answer = ClaimRun.new(claim, text, "#{@build}/claim_#{File.basename(tree)}", SECONDS).run
        return "#{claim.name} broken: #{key}: noticed" if answer.verdict == :refuted
      end
    end
    nil
  rescue Translation::Unknown => e # of what is not broken, all is known
    "#{key}: refused: #{e.message.lines.first.chomp}"
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

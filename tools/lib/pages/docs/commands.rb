# SPDX-License-Identifier: MIT
# Whether the commands that documents cite are there: that a proof has the words behind
# `tools/prove`, that `tools/test` has the part, and that `test/fuzz/run` has a target of which a
# document says that it shows something.
require_relative '../../prove/proofs'

module Commands
  DOCUMENTS = Dir['*.md', 'docs/*.md'].sort.freeze
  CITED = /`((?:\S+\/)+\w+(?: [^`]+)?)`/.freeze
  TARGETS = /\btargets? ((?:`\w+`(?:, | and )?)+)/.freeze
  FUZZ = 'test/fuzz/run'.freeze

  class << self
    def failures
      DOCUMENTS.flat_map { |path| unknown(path, File.read(path)) }
    end

    # Other programs only need to have the option, or the word.
    def known?(command)
      program, *words = command.split
      return false unless File.file?(program) && File.executable?(program)

      options, names = words.partition { |word| word.start_with?('-') }
      return false unless options.all? { |option| File.read(program).include?(option) }

      case program
      when 'tools/test' then (names - parts).empty?
      when 'tools/prove' then options.any? || proofs.any? { |proof| proof.matches?(names) }
      else names.all? { |name| File.read(program).match?(/\b#{name}\b/) }
      end
    end

    private

    def unknown(path, text)
      cited = text.scan(CITED).flatten.uniq.select { |command| command.match?(%r{\Atools/(?:test|prove)\b}) }
      targets = text.scan(TARGETS).flatten.flat_map { |names| names.scan(/`(?!test_)(\w+)`/).flatten }.uniq
      (cited.reject { |command| known?(command) } + (targets - fuzz_targets).map { |name| "#{FUZZ} #{name}" })
        .map { |command| "#{path}: no #{command}" }
    end

    def proofs
      @proofs ||= Proofs.all
    end

    def parts
      @parts ||= File.readlines('test/parts.txt').grep(/^[a-z]/).map { |line| line.split.first }
    end

    def fuzz_targets
      @fuzz_targets ||= `#{FUZZ} --list`.split
    end
  end
end

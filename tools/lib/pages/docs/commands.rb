# SPDX-License-Identifier: MIT
# Whether the commands that documents cite are there: that a proof has the words behind
# `tools/prove`, that `tools/test` has the part, and that `test/fuzz/run` has a target of which a
# document says that it shows something.
require_relative '../../prove/proofs'

module Commands
  DOCUMENTS = Dir['*.md', 'docs/**/*.md', 'docs/data/*.csv'].sort.freeze
  CITED = /`((?:\S+\/)+\w+(?: [^`]+)?)`/.freeze
  RUNS = %r{\A(?:tools/(?:test|prove|demo|cost|firmware)|test/\S+/run)\b}.freeze
  TARGETS = /\btargets? ((?:`\w+`(?:, | and )?)+)/.freeze
  # Where the names of what a program runs stand, besides in itself.
  NAMES = { 'tools/demo' => 'tools/lib/demo/*.rb', 'tools/cost' => 'tools/lib/measure/*', 'tools/firmware' => 'port/*/*/port_board.h' }.freeze
  PLACE = /\A[A-Z]+\z|[.\/*=<]|\A\d+\z/.freeze # in a command, what the reader puts in
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
      when %r{\Atest/use/(?:consumers|packages|firmware|notes|python|xc8_check)/} then (names.grep_v(PLACE) - %w[daily weekly] - tests(program)).empty?
      else names.all? { |name| name.match?(PLACE) || named?(program, name.delete("'")) }
      end
    end

    private

    def named?(program, name)
      files = Dir[NAMES.fetch(program, "#{File.dirname(program)}/**/*")].select { |path| File.file?(path) }
      @texts ||= Hash.new { |texts, path| texts[path] = "#{path}\n#{File.binread(path)}" }
      [program, *files].any? { |path| @texts[path].match?(/(?<![A-Za-z0-9])#{name}(?![A-Za-z0-9])/n) }
    end

    def unknown(path, text)
      cited = text.scan(CITED).flatten.map { |command| command.split.join(' ') }.uniq.grep(RUNS)
      targets = text.scan(TARGETS).flatten.flat_map { |names| names.scan(/`(?!test_)(\w+)`/).flatten }.uniq
      (cited.reject { |command| known?(command) } + (targets - fuzz_targets).map { |name| "#{FUZZ} #{name}" })
        .map { |command| "#{path}: no #{command}" }
    end

    def tests(runner)
      @tests ||= Hash.new { |lists, one| lists[one] = `#{one} --list`.split }
      @tests[runner]
    end

    def proofs
      @proofs ||= Proofs.all
    end

    def parts
      @parts ||= File.readlines('test/parts.txt').grep(/^[a-z]/).map { |line| line.split.first }
    end

    def fuzz_targets
      tests(FUZZ)
    end
  end
end

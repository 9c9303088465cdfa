# SPDX-License-Identifier: MIT
# docs/requirements.csv: a sentence of a header, the test and the proof that hold it to it, and a
# fault that one of them must notice. The sentences, tests and proofs are chosen by hand and
# looked for here; the faults are those of test/faults.txt. Numbers that begin with C are
# the conditions of docs/conditions.md, which has a heading for each. A number is never given to
# another sentence.
require 'csv'
require_relative 'commands'
require_relative '../../faults/faults'

module Requirements
  FILE = 'docs/requirements.csv'.freeze
  PAGE = 'docs/conditions.md'.freeze
  HEADING = /^## (C\d+)\b/.freeze
  NUMBER = /\A(?:C\d+|[A-Z\d-]+-\d+)\z/.freeze

  class << self
    # With the faults as they are now.
    def csv
      DataTables.text([rows.headers, *rows.map { |row| row.to_h.merge('fault' => fault(row)).values }])
    end

    # What shows the library's side of a condition.
    def shown(number)
      rows.select { |row| row['number'] == number }.map do |row|
        "* `#{row['header']}`: `#{row['test']}`#{", `tools/prove #{row['proof']}`" if row['proof']}\n"
      end.join
    end

    # A page's text with what shows its conditions.
    def renewed(text)
      text.gsub(/(<!-- condition (C\d+):begin -->\n).*?(<!-- condition \2:end -->)/m) { "#{$1}#{shown($2)}#{$3}" }
    end

    def failures
      rows.flat_map { |row| of_row(row).map { |fault| "#{FILE}, #{row['number']}: #{fault}" } } + of_page +
        (rows.map(&:to_s).tally.select { |_, count| count > 1 }.keys.map { |row| "#{FILE} has twice: #{row}" }) +
        numbered_twice + without_any
    end

    # How many there are of each.
    def counts
      { 'sentences' => rows.size, 'sentences with a proof' => rows.count { |row| row['proof'] } }
    end

    private

    def rows
      @rows ||= CSV.read(FILE, headers: true).each { |row| row['proof'] = nil if row['proof'].to_s.empty? }
    end

    def of_row(row)
      wrong = []
      wrong << "#{row['number'].inspect} is no number" unless row['number'].to_s.match?(NUMBER)
      wrong << "#{row['header']} does not say \"#{row['sentence']}\"" unless comments(row['header']).include?(row['sentence'].to_s) && row['sentence'].to_s.end_with?('.', ';')
      wrong << "no test #{row['test']}" unless test?(row)
      wrong << "no tools/prove #{row['proof']}" if row['proof'] && !Commands.known?("tools/prove #{row['proof']}")
      wrong
    end

    # A condition may stand in several headers; any other number is of one sentence.
    def numbered_twice
      rows.map { |row| row['number'] }.grep_v(/\AC\d/).tally.select { |_, count| count > 1 }.keys.map { |number| "#{FILE} has #{number} twice" }
    end

    # Each header promises something.
    def without_any
      (Dir['include/*.h'].map { |path| File.basename(path) } - rows.map { |row| row['header'] }).sort.map { |header| "#{FILE} has no sentence of #{header}" }
    end

    def of_page
      headings = File.read(PAGE).scan(HEADING).flatten
      conditions = rows.map { |row| row['number'] }.grep(/\AC\d/).uniq
      marked = File.read(PAGE).scan(/<!-- condition (C\d+):begin -->/).flatten
      (headings - conditions).map { |number| "#{FILE} has no #{number}, which #{PAGE} has" } +
        (conditions - headings).map { |number| "#{PAGE} has no #{number}" } + (conditions - marked).map { |number| "#{PAGE} has no mark of #{number}" }
    end

    # The prose of a header's comments in one line.
    def comments(header)
      @comments ||= Hash.new do |texts, name|
        path = ["include/#{name}", "port/#{name}"].find { |one| File.exist?(one) }
        texts[name] = path ? File.read(path).scan(%r{//(.*)}).flatten.join(' ').squeeze(' ') : ''
      end
      @comments[header.to_s]
    end

    # Of the module, by its name; or a command.
    def test?(row)
      name = row['test'].to_s
      return Commands.known?(name) if name.include?('/')

      module_name = row['header'].to_s[/\Afixpid_(\w+)\.h\z/, 1]
      files = module_name ? Dir["test/unit/test_fixpid_#{module_name}*.c", 'test/unit/test_kept.c', 'test/unit/test_fixpid_constants.c'] : Dir['test/unit/*.c']
      files.any? { |path| tests(path).include?(name) }
    end

    def tests(path)
      @tests ||= Hash.new { |texts, file| texts[file] = File.read(file).scan(/^void (test_\w+)\(/).flatten }
      @tests[path]
    end

    # The first one that its test or its proof must notice.
    def fault(row)
      group, what = row['proof'].to_s.split
      wanted = ["unit #{row['test']}", row['proof'] && /\Aproof #{group} \w+ #{what}\z/]
      wanted.compact.each do |check|
        found = faults.find { |one| check === one.check }
        return found.to_s if found
      end
      nil
    end

    def faults
      @faults ||= Faults.all
    end
  end
end

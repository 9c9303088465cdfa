# SPDX-License-Identifier: MIT
# docs/misra.csv: the rules of MISRA C:2012, the category of each, what looks for it, and
# where the library deviates from it, with the reason that stands there. UNSEEN has those that
# cppcheck's addon has no code for, with what looks for them instead, and nothing if nobody
# does. Called as a program it holds them against the addon that is installed.
require_relative '../../data_tables'

module Misra
  FILE = 'docs/misra.csv'.freeze
  CPPCHECK = 'cppcheck itself'.freeze
  WARNINGS = 'gcc and clang, -Wall -Wextra -Wpedantic'.freeze
  CBMC = 'CBMC, in what is proved'.freeze
  NO_LIBRARY = 'rules 21.3 and 21.6, which the addon has: there is no heap and no file'.freeze
  UNSEEN = {
    '1.1' => WARNINGS, '1.2' => WARNINGS, '1.3' => "#{CPPCHECK}; clang's sanitizers; #{CBMC}",
    '2.1' => "#{CPPCHECK}; the unit tests, which reach every line and branch", '2.6' => "#{CPPCHECK}; #{WARNINGS}",
    '5.3' => "#{CPPCHECK}; -Wshadow", '8.3' => "#{CPPCHECK}; the compilers refuse other types", '8.13' => nil,
    '9.1' => "#{CPPCHECK}; gcc's -fanalyzer; Frama-C's Eva", '13.2' => "#{CPPCHECK}; #{WARNINGS}", '14.3' => 'the unit tests, which take every branch',
    '17.4' => "#{CPPCHECK}; #{WARNINGS}", '17.5' => "#{CPPCHECK}; #{CBMC}", '18.1' => "#{CPPCHECK}; #{CBMC}",
    '18.2' => "#{CPPCHECK}; #{CBMC}", '18.3' => "#{CPPCHECK}; #{CBMC}", '18.6' => "#{CPPCHECK}; #{WARNINGS}",
    '19.1' => nil, '20.6' => "#{CPPCHECK}; #{WARNINGS}",
    '22.1' => NO_LIBRARY, '22.2' => NO_LIBRARY, '22.3' => NO_LIBRARY, '22.4' => NO_LIBRARY, '22.6' => NO_LIBRARY
  }.freeze
  ADDON = Dir['/usr/{lib,share}/**/cppcheck/addons/misra.py'].min

  MANDATORY = %w[9.1 13.6 17.3 17.4 17.6 19.1 22.2 22.4 22.5 22.6].freeze
  ADVISORY = %w[1.2 2.3 2.4 2.5 2.6 2.7 4.2 5.9 8.7 8.9 8.11 8.13 10.5 11.4 11.5 12.1 12.3 12.4 13.3 13.4 15.1 15.4 15.5
                17.5 17.8 18.4 18.5 19.2 20.1 20.5 20.10 21.12].freeze

  # Where rules are not followed in whole files, and what one compiler's words bring.
  LISTED = 'tools/lib/cppcheck.txt'.freeze
  SYSTEMS = 'tools/lib/lint.rb'.freeze
  OF_A_SYSTEM = /^  '([\w-]+)' => \[.*, %w\[([\d. ]+)\]\]/.freeze
  AT_A_LINE = %r{// Deviation (\d+\.\d+): (.*)}.freeze
  AGAIN = /\A(?:as above|likewise)/.freeze # the reason is the one before

  class << self
    def csv
      rows = RULES_OF_2012.map { |rule| [rule, category(rule), UNSEEN.fetch(rule, "cppcheck's addon") || 'nobody', deviations(rule).join('; ').tr('`', '')] }
      DataTables.text([['rule', 'category', 'looked for by', 'deviations'], *rows])
    end

    def category(rule)
      return 'mandatory' if MANDATORY.include?(rule)

      ADVISORY.include?(rule) ? 'advisory' : 'required'
    end

    # In the library: a sentence each, with its reason.
    def deviations(rule)
      listed.select { |one, _, _| one == rule }.map { |_, place, reason| "#{place}: #{reason}" } +
        at_lines.select { |one, _, _| one == rule }.group_by(&:last).map { |reason, all| "at its line in #{all.map { |_, file, _| "`#{file}`" }.uniq.join(', ')}: #{reason}" } +
        of_systems.select { |_, rules| rules.include?(rule) }.map { |system, _| "as #{system} takes it: the reason is in `#{SYSTEMS}`" }
    end

    # [rule, where, reason] of the library; what is listed for examples and the bench is not
    # here. A reason is the comment above, without the rule's number. An asterisk of cppcheck's
    # stands for folders, too.
    def listed
      reason = ''
      File.readlines(LISTED, chomp: true).each_cons(2).map do |before, line|
        reason = '' if line.start_with?('//') && (!before.start_with?('//') || line.match?(%r{\A// [\d.]+: }))
        reason = "#{reason} #{line.delete_prefix('//').strip}".strip if line.start_with?('//')
        rule, place = line.match(/\Amisra-c2012-([\d.]+)(?::(.*))?\z/)&.captures
        [rule, place ? "in `#{place.sub('src/*_', 'src/*/*_')}`" : 'everywhere', reason.sub(/\A(?:[\d.]+: |And )/, '').chomp('.')] if rule && !place&.match?(/\A(?:sim|examples)\//)
      end.compact
    end

    def at_lines
      Dir['{include,src}/**/*.[ch]'].sort.flat_map do |file|
        found = File.read(file).scan(AT_A_LINE)
        found.each_with_index.map { |(rule, reason), at| [rule, file, reason.match?(AGAIN) ? first_of(rule, found.first(at)) : reason.strip.chomp('.')] }
      end
    end

    def first_of(rule, before)
      before.reverse.find { |other, reason| other == rule && !reason.match?(AGAIN) }&.last&.chomp('.') || 'as the comment above it says'
    end

    def of_systems
      File.read(SYSTEMS).scan(OF_A_SYSTEM).map { |system, rules| [system, rules.split] }
    end

    # In which the list differs from the addon.
    def failures
      return ['no addon misra.py of cppcheck'] unless ADDON

      has = File.read(ADDON).scan(/def misra_(\d+_\d+)\(/).flatten.map { |rule| rule.tr('_', '.') }
      UNSEEN.keys.select { |rule| has.include?(rule) }.map { |rule| "#{ADDON} has rule #{rule}, which misra.rb says that it has not" } +
        (RULES_OF_2012 - has - UNSEEN.keys).map { |rule| "#{ADDON} has no rule #{rule}, and misra.rb does not say who looks for it" }
    end
  end

  # How many each chapter has.
  CHAPTERS = { 1 => 3, 2 => 7, 3 => 2, 4 => 2, 5 => 9, 6 => 2, 7 => 4, 8 => 14, 9 => 5, 10 => 8, 11 => 9, 12 => 4, 13 => 6, 14 => 4,
               15 => 7, 16 => 7, 17 => 8, 18 => 8, 19 => 2, 20 => 14, 21 => 12, 22 => 6 }.freeze
  RULES_OF_2012 = CHAPTERS.flat_map { |chapter, rules| (1..rules).map { |rule| "#{chapter}.#{rule}" } }.freeze
end

if __FILE__ == $PROGRAM_NAME
  puts Misra.failures
  exit(Misra.failures.empty? ? 0 : 1)
end

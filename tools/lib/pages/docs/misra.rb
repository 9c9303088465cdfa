# SPDX-License-Identifier: MIT
# The rules of MISRA C:2012 that cppcheck's addon has no code for, what looks for them
# instead, and nothing if nobody does. Called as a program it holds them against the addon
# that is installed.
module Misra
  RULES = 143
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

  class << self
    def table
      rows = UNSEEN.group_by(&:last).map { |by, rules| "| #{rules.map(&:first).join(', ')} | #{by || 'nobody'} |\n" }
      "| rule | looked for by |\n|---|---|\n#{rows.join}"
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

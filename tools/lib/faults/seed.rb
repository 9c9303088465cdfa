# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Seeds the faults of test/faults.txt whose check begins with these words in a copy of
# the project, TREE, or only the one of that NUMBER. Without TREE it prints them, a line
# each; without anything it says which of the table can no longer be seeded.
#
#   ruby tools/lib/faults/seed.rb [CHECK [TREE [NUMBER]]]
require_relative 'faults'

check, tree, number = ARGV
tree &&= File.expand_path(tree)
Dir.chdir(File.expand_path('../../..', __dir__))
begin
  abort Faults.misplaced.join("\n") if check.nil? && !Faults.misplaced.empty?
  faults = check.nil? ? [] : Faults.of(check)
  faults = faults[number.to_i - 1, 1] if number
  abort "#{Faults::FILE}: nothing for #{check}" if check && faults.empty?
  tree ? faults.each { |fault| fault.seed(tree) } : faults.each { |fault| puts "#{fault.check}: #{fault}" }
rescue Faults::Gone => e
  abort e.message
end

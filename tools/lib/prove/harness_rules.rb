# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'domains'

# A harness states a claim in the numbers of the header and of the note. A macro of src/
# would change with the source that is to be proved, and the proof would hold of a wrong
# number, too: no harness uses one. It may ask which form was included, which is a
# header's guard. What it may assume is in domains.rb.
GUARD = /\AFIXPID_\w+_H\z/.freeze
DEFINED = /^\s*#\s*define\s+([A-Z]\w*)/.freeze # those in lower case are functions

macros = Dir['src/**/*.[ch]'].sort.flat_map { |file| File.read(file).scan(DEFINED).flatten.map { |name| [name, file] } }.to_h
macros.reject! { |name, _| GUARD.match?(name) }
abort 'harness_rules: src/ defines no macro' if macros.empty?

borrowed = Dir['test/proof/{,theorems/}*.{c,h,hh}'].sort.flat_map do |harness|
  text = File.read(harness).gsub(%r{//.*}, '')
  own = text.scan(DEFINED).flatten
  text.lines.each_with_index.flat_map do |line, at|
    (line.scan(/\w+/).uniq & macros.keys - own).map do |name|
      "#{harness}:#{at + 1}: #{name} is a macro of #{macros[name]}; a harness states the number itself"
    end
  end
end
complaints = borrowed + Domains.complaints
puts complaints
exit(complaints.empty? ? 0 : 1)

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Whether each unit test asserts something: `void test_...` has a TEST_ASSERT or
# TEST_FAIL, or uses a function or a macro that has one, of its own file or of
# test/support/, or that uses one in its turn. Without, it passes whatever the code
# does. Names those that do not; exit status 1 if there are any.
require_relative '../c_functions'

module Asserts
  ASSERTION = /\bTEST_(?:ASSERT|FAIL)/.freeze
  # What is called, or handed on to be called.
  USED = /\b(\w+)\s*\(|(?<=[(,])\s*&?(\w+)\s*(?=[,)])/.freeze
  SHARED = 'test/support/*.[ch]'
  MACRO = /^#\s*define (\w+)[ (](?:.*\\\n)*.*/.freeze

  module_function

  # { name => text } of the functions and macros of a file. One that has several forms
  # has the text of all.
  def definitions(file)
    text = File.read(file).gsub(%r{//.*}, '')
    lines = text.lines
    functions = lines.zip(CFunctions.of_lines(lines)).select(&:last).group_by(&:last)
                     .transform_values { |pairs| pairs.map(&:first).join.sub(/\A[^{]*/, '') }
    text.to_enum(:scan, MACRO).each { functions[$1] = "#{functions[$1]}#{$&.sub(/\A#\s*define \w+/, '')}" }
    functions
  end

  # Whether what has this name asserts.
  def reached?(name, known, seen = {})
    return false if seen[name] || !known.key?(name)

    seen[name] = true
    known[name].match?(ASSERTION) || known[name].scan(USED).flatten.compact.uniq.any? { |other| reached?(other, known, seen) }
  end

  # The tests of a file that assert nothing.
  def empty(file, shared)
    own = definitions(file)
    known = shared.merge(own) { |_, one, other| one + other }
    tests(file).reject { |name| reached?(name, known) }
  end

  def tests(file)
    File.read(file).scan(/^void (test_\w+)\(/).flatten.uniq
  end
end

files = Dir.glob('test/**/test_*.c').sort.reject { |file| Asserts.tests(file).empty? }
abort 'no unit tests to check' if files.empty?
shared = Dir.glob(Asserts::SHARED).sort.map { |file| Asserts.definitions(file) }.reduce({}) { |all, one| all.merge(one) { |_, a, b| a + b } }
found = files.flat_map { |file| Asserts.empty(file, shared).map { |name| [file, name] } }
found.each { |file, name| puts "#{file}: #{name} reaches no TEST_ASSERT and no TEST_FAIL, so it cannot fail" }
exit(found.empty?)

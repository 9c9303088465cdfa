# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The functions of a C source that is formatted as ours are.
module CFunctions
  # What is no statement of a function: an assertion, and a variable that is
  # declared only.
  ASSERTION = /\bFIXPID_ASSERT\([^;]*;/.freeze
  DECLARATION = /^ +(?!return\b)(?:\w+ )+\*?\w+(?:\[\w+\])?;$/.freeze

  module_function

  # The function in which each line is, or nil.
  def of_lines(lines)
    function = nil
    lines.map do |line|
      function = line[/(\w+)\(/, 1] || function if line.match?(/\A\w/) && !line.match?(/;$/)
      now = line.start_with?('#') ? nil : function
      function = nil if line.match?(/\A(?:}|.*;$)/) && !line.start_with?(' ')
      now
    end
  end

  # How many statements each function has: decisions, loops, and what ends with
  # a semicolon. One that has several forms in a file counts with all of them.
  def statements(file)
    lines = File.readlines(file).map { |line| line.sub(%r{//.*}, '') }
    with_function = lines.zip(of_lines(lines)).select(&:last).group_by(&:last)
    with_function.transform_values do |pairs|
      text = pairs.map(&:first).join.sub(/\A[^{]*/, '').gsub(ASSERTION, '').gsub(DECLARATION, '')
      text.gsub(/\bfor \([^{]*\{/, 'for {').scan(/;|\b(?:if|for|while|switch)\b/).size
    end
  end
end

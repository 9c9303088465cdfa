# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# A break of a file. `source` is the whole text with the break in it.
Mutant = Struct.new(:file, :line, :place, :from, :to, :source) do
  def to_s
    "#{file}:#{line}: `#{from}` -> `#{to}`"
  end
end

# Every small break of a file: an operator, a number, a name, a bound moved by
# one, a statement left out.
module Breaks
  OPERATORS = { '<' => %w[<= >], '<=' => %w[< >], '>' => %w[>= <], '>=' => %w[> <], '==' => %w[!=],
                '!=' => %w[==], '+' => %w[-], '-' => %w[+], '*' => %w[+], '/' => %w[*], '<<' => %w[>>], '>>' => %w[<<],
                '&' => %w[|], '|' => %w[&], '^' => %w[|], '|=' => %w[=], '&=' => %w[|=], '^=' => %w[=], '--' => %w[++],
                '>>=' => %w[<<=], '<<=' => %w[>>=], '+=' => %w[-=], '-=' => %w[+=], '~' => [''], '!' => [''],
                '&&' => %w[||], '||' => %w[&&],
                'kp' => %w[ki], 'ki' => %w[kd], 'kd' => %w[kp], 'kp_q4' => %w[ki_q4], 'ki_q4' => %w[kd_q4],
                'kd_q4' => %w[kp_q4], 'left' => %w[right], 'right' => %w[left], 'low' => %w[high], 'high' => %w[low],
                'true' => %w[false], 'false' => %w[true], 'TIMES' => %w[OVER], 'OVER' => %w[TIMES],
                'PLUS' => %w[MINUS], 'MINUS' => %w[PLUS], 'LESSER' => %w[GREATER], 'GREATER' => %w[LESSER] }.freeze
  TOKEN = %r{//[^\n]*|->|<<=|>>=|<<|>>|<=|>=|==|!=|&&|\|\||[|&^+-]=|--|[A-Za-z_]\w*|\d+\.\d+|\d\w*|\n|.}m.freeze

  # A comparison's other side, one off: with `<` above, the others are here.
  # `-1 + limit` is `limit - 1` whatever follows.
  MOVED = { '<' => '< -1 +', '<=' => '<= 1 +', '>' => '> 1 +', '>=' => '>= -1 +' }.freeze

  ASSIGNMENT = /[A-Za-z_*.\[\]0-9>-]+ [|&^+-]?= [^;{}\\]+;/.freeze
  CALL = /(?!(?:if|for|while|switch|return|sizeof|FIXPID_ASSERT)\b)\w+\([^;{}\\]*\);/.freeze
  STATEMENT = /^ +(?<what>#{ASSIGNMENT}|#{CALL})$/.freeze
  # Of an equation that is a line or more of a table: a verb with its number, and the whole.
  OPERATION = /(?<what>(?:TIMES|OVER|PLUS|MINUS|LESSER|GREATER), \w+,)/.freeze
  EQUATION = /^ {4}(?<what>[A-Z]\w*, +\w+,(?:\s+(?:TIMES|OVER|PLUS|MINUS|LESSER|GREATER), \w+,)*)/.freeze

  class << self
    def of(file, text = File.read(file))
      skipped = skipped_lines(file, text.lines)
      of_tokens(file, text, skipped) + left_out(file, text, skipped, STATEMENT, ';') +
        [OPERATION, EQUATION].flat_map { |pattern| left_out(file, text, skipped, pattern, '') }
    end

    private

    def of_tokens(file, text, skipped)
      position = 0
      line = 0
      found = []
      text.scan(TOKEN) do |token|
        unless skipped[line] || token.start_with?('//') || unary?(text, position, token)
          found.concat(replacements(token, text[(position + token.size)..]).map do |other|
            changed = text[0...position] + other + text[(position + token.size)..]
            Mutant.new(file, line + 1, position, token, other, changed)
          end)
        end
        position += token.size
        line += token.count("\n")
      end
      found
    end

    def replacements(token, rest)
      found = OPERATORS.fetch(token, []) + numbers(token)
      # The neighbours of a number are there anyway.
      MOVED.key?(token) && !rest.match?(/\A\s*\d/) ? found + [MOVED.fetch(token)] : found
    end

    def numbers(token)
      return [-1.0, 1.0].map { |off| (token.to_f + off).to_s } if token.match?(/\A\d+\.\d+\z/)

      match = token.match(/\A(0x\h+|\d+)([uU]?)\z/) or return []
      value = Integer(match[1])
      [value + 1, value - 1].reject(&:negative?).map { |other| "#{other}#{match[2]}" }
    end

    # For each line whether it is not arithmetic: preprocessor outside of macros
    # with its continuations, assertions, parameter lists. Of a header for users
    # all but its macros with parameters.
    def skipped_lines(file, lines)
      macros = /^#define (?!FIXPID_CHECKED|FIXPID_ASSERT|FIXPID_JOINED|FIXPID_SUFFIXED|FIXPID_PLACE_SUFFIX|FIXPID_CAST|FIXPID_REAL|FIXPID_UNSIGNED)\w+\(/
      starts = if file.start_with?('include/') then /^(?!#{macros.source[1..]})/
               else /^\s*#\s*(?:include|if|el|endif|error|ifndef|ifdef|undef)|FIXPID_MULTIPLIER_BITS/
               end
      continued = macro = false
      lines.map do |line|
        macro = line.match?(macros) unless macro
        skipped = continued || (!macro && line.match?(starts))
        continued = skipped && line.end_with?("\\\n")
        macro &&= line.end_with?("\\\n")
        skipped || line.match?(/FIXPID_ASSERT|struct fixpid_|define VALID|define SELF/)
      end
    end

    # `*pointer` and `&object`, which only the compiler would notice.
    def unary?(text, position, token)
      %w[* &].include?(token) && text[0...position] =~ /(?:[(,=?:&|{;+-]|return)\s*\z/
    end

    def left_out(file, text, skipped, pattern, instead)
      text.to_enum(:scan, pattern).map do
        match = Regexp.last_match
        range = match.begin(:what)...match.end(:what)
        line = text[0...range.begin].count("\n")
        next if skipped[line] && file.start_with?('include/')

        changed = text[0...range.begin] + instead + text[range.end..]
        Mutant.new(file, line + 1, range.begin, match[:what].gsub(/\s+/, ' '), '', changed)
      end.compact
    end
  end
end

# SPDX-License-Identifier: MIT
# The sentences of prose_numbers.txt, in documents and in comments of the public headers: each
# stands in its file, and a number of it that is computed is what it must be.
require 'open3'
require_relative '../../data_tables'
require_relative '../../named_figures'

Encoding.default_external = 'UTF-8'

module ProseNumbers
  TABLE = 'tools/lib/pages/docs/prose_numbers.txt'.freeze
  NUMBER = /-?(?:0x\h+|\d+(?: \d{3})+(?!\d)|\d+(?:\.\d+)*)/.freeze

  # What is said in words: counts, and parts, and how far from a part what is computed may be.
  COUNTS = %w[two three four five six seven eight nine ten].each_with_index.to_h { |word, i| [word, (i + 2).to_r] }.freeze
  PARTS = { 'a quarter' => 1 / 4r, 'a third' => 1 / 3r, 'half' => 1 / 2r, 'two thirds' => 2 / 3r, 'a fifth' => 1 / 5r }.freeze
  WORDS = { **PARTS, **COUNTS }.freeze
  NEAR = 0.1
  IN_WORDS = /\A"(.*)" (.*)\z/.freeze

  class << self
    def failures
      table.flat_map do |file, sentences|
        prose = prose(file)
        sentences.flat_map { |sentence| of(file, prose, sentence) }
      end
    end

    private

    # The sentences of each file.
    def table
      File.readlines(TABLE, chomp: true).grep_v(/\A(?:# |\s*\z)/).slice_before(/\A\[/).to_h { |head, *lines| [head[1...-1], lines] }
    end

    # Without the marks of comments; of a document neither what is generated nor what is code.
    def prose(file)
      text = File.read(file)
      return text.gsub('//', '') if file.end_with?('.h')

      [/<!-- ([\w .-]+):begin -->.*?<!-- \1:end -->/m, /^```.*?^```$/m].reduce(text) { |so_far, pattern| so_far.gsub(pattern, '') }
    end

    def of(file, prose, sentence)
      parts = sentence.split(/(\{[^}]*\})/)
      pattern = parts.map { |part| part.start_with?('{') ? "(#{number_or_words(part)})" : literal(part) }.join
      expressions = parts.grep(/\A\{/).map { |part| part[1...-1] }
      found = prose.to_enum(:scan, /#{pattern}/).map { Regexp.last_match }
      return ["#{TABLE}: #{file} does not say \"#{sentence}\", with a number for each brace"] if found.empty?

      found.flat_map { |match| expressions.zip(match.captures).map { |expression, said| wrong(file, match[0], expression, said) } }.compact
    end

    def number_or_words(part)
      part[1...-1].match?(IN_WORDS) ? WORDS.keys.map { |one| literal(one) }.join('|') : NUMBER
    end

    def literal(part)
      part.split(/(\s+)/).map { |word| word.match?(/\A\s+\z/) ? '\s+' : Regexp.escape(word) }.join
    end

    def wrong(file, sentence, expression, said)
      in_words, inner = expression.match(IN_WORDS)&.captures
      inner ||= expression
      value = Values.of(inner, file)
      return if in_words ? about?(said.split.join(' '), value) : same?(said.delete(' '), value)

      "#{file}: #{said} in \"#{sentence.split.join(' ')}\", but #{inner} is #{value.denominator == 1 ? value.to_i : value.to_f.round(6)}"
    end

    def about?(words, value)
      ((value / WORDS.fetch(words)) - 1).abs <= (PARTS.key?(words) ? NEAR : 0)
    end

    # To the decimals that are written, rounded or cut.
    def same?(number, value)
      return Integer(number, 16) == value if number.start_with?('0x')

      decimals = number[/\.(\d+)/, 1].to_s.size
      [value.truncate(decimals), value.round(decimals)].include?(number.to_r)
    end
  end

  # What the expressions of the table are made of.
  module Values
    PREFIX = 'FIXPID_'.freeze

    class << self
      # Names in capitals are macros of the headers, without FIXPID_.
      def of(expression, file)
        @file = file
        eval(expression.gsub(/'[^']*'|\b[A-Z][A-Z0-9_]+\b/) { |word| word.start_with?("'") ? word : "macro('#{word}')" }
                       .gsub('^', '**'), binding).to_r
      rescue StandardError, SyntaxError => e
        abort "#{TABLE}: #{expression}: #{e.message}"
      end

      private

      def macro(name)
        text = macros[name] || macros["#{PREFIX}#{name}"] || of_the_sources(name)
        text or abort "#{TABLE}: no macro #{name}"
        eval(text.gsub(/UINT\d+_C\(([^)]*)\)/, '\1').gsub(/\b(0x\h+|\d+)[uU]?[lL]*\b/, '\1')
                 .gsub(/\b[A-Z][A-Z0-9_]+\b/) { |inner| "macro('#{inner}')" }, binding).to_r
      end

      # A macro of src/, which is not two things in two files.
      def of_the_sources(name)
        @sources ||= Dir['src/*/*.[ch]'].sort.map { |path| File.read(path) }.join
        values = @sources.scan(/^#define #{name} +([^\s\/].*?)\s*(?:\/\/.*)?$/).flatten.uniq
        values.size < 2 or abort "#{TABLE}: #{name} is #{values.join(' and ')}"
        values.first
      end

      # How many bytes a type has on an AVR.
      def bytes_avr(type)
        headers = Dir['include/*.h'].sort.map { |header| "#include \"#{File.basename(header)}\"\n" }.join
        code = "#{headers}char object[sizeof(#{type})] = {1};\n"
        output, status = Open3.capture2('avr-gcc', '-std=c99', '-Iinclude', '-x', 'c', '-S', '-o', '-', '-', stdin_data: code)
        status.success? or abort "#{TABLE}: avr-gcc knows no #{type}"
        output[/\.size\s+object, (\d+)/, 1].to_r
      end

      # The number of the analog input that a port's board has for a signal.
      def input(port, name)
        at = File.read("#{port}/port_board.h")[/^#define PORT_#{name} 0x(\h+)u/, 1] or abort "#{TABLE}: #{port} has no #{name}"
        (port.include?('/avr/') ? at.hex & 7 : at.hex >> 2 & 15).to_r
      end

      # The number of the highest bit in a mask, and in one that a file defines.
      def top(mask)
        mask.to_i.bit_length - 1
      end

      def bit(path, name)
        mask = File.read(path)[/^#define #{name} 0x(\h+)u/, 1] or abort "#{TABLE}: #{path} has no #{name}"
        top(mask.hex)
      end

      # Of all public headers, with all features.
      def macros
        @macros ||= macros_of(Dir['include/*.h'].sort)
      end

      def macros_of(headers, *definitions)
        text = headers.map { |header| "#include \"#{File.basename(header)}\"\n" }.join
        output, status = Open3.capture2('cc', '-E', '-dM', '-Iinclude', '-Isrc', *definitions, '-', stdin_data: text)
        status.success? or abort 'the public headers do not compile'
        output.scan(/^#define (FIXPID_\w+) (.+)$/).to_h
      end

      # What a macro is with other definitions, such as 'PID_FEATURES=0'.
      def macro_with(name, *definitions)
        before = macros
        @macros = macros_of(Dir['include/*.h'].sort, *definitions.map { |one| "-D#{PREFIX}#{one}" })
        macro(name)
      ensure
        @macros = before
      end

      # The number that stands in a file where the pattern, a text, has its parentheses.
      def in_file(path, pattern)
        found = File.read(path)[/#{pattern}/m, 1] or abort "#{TABLE}: #{path} has nothing like #{pattern}"
        Integer(found, exception: false)&.to_r || found.to_r
      end

      # Elsewhere in the same document.
      def here(pattern)
        in_file(@file, pattern)
      end

      # Of docs/figures.json.
      def figure(name)
        NamedFigures.all.fetch(name).to_r
      end

      # Of a table of docs/data: the first number of a cell, by the text that its row begins with and the column.
      def data(name, row, column)
        found = DataTables.hashes(name).find { |one| one.values.first.start_with?(row) } or abort "#{TABLE}: #{name}: no row #{row}"
        found.fetch(column)[/-?\d+(?:\.\d+)?/].to_r
      end
    end
  end
end

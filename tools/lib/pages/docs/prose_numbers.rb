# SPDX-License-Identifier: MIT
# The numbers in the prose of the documents and in the comments of the public headers, and
# those in words where a picture's text says what is seen in it.
# Each one is generated (it stands between markers, or behind its name), part of a sum
# that is written out, a name or a citation (NAMES), computed by a sentence of
# prose_numbers.txt, or counted there among those that no program can know, with the
# reason. Called as a program it lists all numbers that are not, and how many are what.
require 'open3'
require_relative 'sums'

Encoding.default_external = 'UTF-8'

module ProseNumbers
  TABLE = 'tools/lib/pages/docs/prose_numbers.txt'.freeze
  FILES = Dir['include/*.h', 'docs/**/*.md', 'README.md', 'SECURITY.md', 'web/site/home.md'].sort.freeze
  NUMBER = /(?<!\w)(?<!\w\.)(?:0x\h+|\d+(?: \d{3})+(?!\d)|\d+(?:\.\d+)*)/.freeze
  IN_TABLE = /(?:0x\h+|\d+(?: \d{3})+(?!\d)|\d+(?:\.\d+)*)/.freeze # in a sentence of the table

  # What is a name or a citation and no quantity.
  NAMES = [
    /[A-Za-z_][\w-]*\d\w*/,                                     # of a chip, a type, a note, a language
    /\b(?:8051|4431|4331|\d+K\d+)s?\b|\bDDI \w+|\bARM 100166\b/,                                      # of chips
    /\b(?:Equation|Figure|Register|Example|Table)s? \d+(?:(?:, | to | and )\d+)*/,
    /\bC\+\+\d+|\bMISRA C:\d+|\bDeviation [\d.]+|\b(?:Python|C)'s? \d+\b/,
    /(?<![\d.])(?:8|16|32|64)[- ]bits?\b|(?<![\d.])8 x 8\b|\b16 by 16 bits\b/, # of types
    /\b(?:SDCC|avr-gcc|GCC|gcc|gpsim|simavr|clang|Debian|Python|CBMC|QEMU|Kconfig|PID|XC8|XC16|Arduino|Ceedling|CMSIS-DSP) \d+(?:\.\d+)*(?: to \d+)?/,
    /\b(?:19|20)\d\d(?:-\d\d-\d\d)?\b(?! (?:steps|counts|runs|ticks|cycles|bytes|loops|plants|random|edges))/,
    /^ *\d+\. /                                                 # an item of a list
  ].freeze

  # What is said in words: counts, and parts, and how far from a part what is computed may be.
  COUNTS = %w[two three four five six seven eight nine ten].each_with_index.to_h { |word, i| [word, (i + 2).to_r] }.freeze
  PARTS = { 'a quarter' => 1 / 4r, 'a third' => 1 / 3r, 'half' => 1 / 2r, 'two thirds' => 2 / 3r, 'a fifth' => 1 / 5r }.freeze
  WORDS = { **PARTS, **COUNTS }.freeze
  ALT = /!\[[^\]\n]*/.freeze # of a picture
  WORD = /\b(?:#{WORDS.keys.join('|')})\b/.freeze
  NEAR = 0.1
  IN_WORDS = /\A"(.*)" (.*)\z/.freeze

  # A number of the prose; `as` is how it is known, nil if it is not.
  Found = Struct.new(:file, :section, :line, :text, :around, :as)

  # What stands in the table for a part of a file: sentences with expressions, and
  # numbers with a reason.
  Entry = Struct.new(:file, :section, :sentences, :excused)

  class << self
    def failures
      numbers # adds what is wrong with sentences
      wrong + uncovered.map { |found| unknown(found) } + surplus
    end

    def count
      numbers.group_by { |found| found.as || 'not covered' }.transform_values(&:size)
    end

    def uncovered
      numbers.reject(&:as)
    end

    def unknown(found)
      "#{found.file}:#{found.line}: nothing checks #{found.text} in \"#{found.around}\": write a sum, or its sentence " \
        "in #{TABLE} below [#{[found.file, found.section].compact.join(' # ')}]"
    end

    private

    # Those that an entry excuses and nobody has.
    def surplus
      numbers
      @surplus
    end

    def wrong
      @wrong ||= []
    end

    def numbers
      @numbers ||= begin
        @surplus = []
        FILES.flat_map { |file| of(file) }
      end
    end

    def of(file)
      prose = prose(file)
      covered = cover(file, prose)
      found = places(prose).map do |at, text|
        Found.new(file, section(file, prose, at), prose[0...at].count("\n") + 1, text, around(prose, at), covered[at])
      end
      excuse(file, found)
      found
    end

    # Of each number, and of each word for one in a picture's text: where it is, and what.
    def places(prose)
      numbers = matches(prose, NUMBER)
      words = matches(prose, ALT).flat_map { |at, alt| matches(alt, WORD).map { |within, word| [at + within, word] } }
      (numbers + words).sort
    end

    def matches(text, pattern)
      text.to_enum(:scan, pattern).map { [Regexp.last_match.begin(0), Regexp.last_match[0]] }
    end

    def around(prose, at)
      prose[[at - 30, 0].max...(at + 30)].split(/\s+/)[1...-1].join(' ')
    end

    # The heading above, of a document.
    def section(file, prose, at)
      file.end_with?('.md') ? prose[0...(prose.index("\n", at) || -1)].scan(/^##+ (.*)$/).flatten.last&.strip : nil
    end

    # The text with the same places and nothing but prose: comments of a header, and of
    # a document what is not generated and not code.
    def prose(file)
      text = File.read(file)
      return text.lines.map { |line| comment(line) }.join if file.end_with?('.h')

      blank(text, /<!-- ([\w .-]+):begin -->.*?<!-- \1:end -->/m, /^```.*?^```$/m, /<!-- .*? -->\d*/m, /\]\([^)]*\)/,
            %r{https?://\S+})
    end

    def comment(line)
      at = line.index('//')
      at ? "#{' ' * (at + 2)}#{line[(at + 2)..-1]}" : line.gsub(/[^\n]/, ' ')
    end

    def blank(text, *patterns)
      patterns.reduce(text) { |so_far, pattern| so_far.gsub(pattern) { |part| part.gsub(/[^\n]/, ' ') } }
    end

    # A sentence of a header may begin with the code before its comment.
    def with_code(file, prose)
      file.end_with?('.h') ? File.read(file).gsub('//', '  ') : prose
    end

    # How each place of the prose is known.
    def cover(file, prose)
      covered = {}
      NAMES.each { |pattern| mark(covered, prose, pattern, 'a name or a citation') }
      Sums.places(prose).each { |range| range.each { |at| covered[at] = 'in a sum' } }
      entries.select { |entry| entry.file == file }.each do |entry|
        entry.sentences.each { |sentence| hold(sentence, entry, with_code(file, prose), covered) }
      end
      covered
    end

    def mark(covered, prose, pattern, how)
      prose.scan(pattern) { (Regexp.last_match.begin(0)...Regexp.last_match.end(0)).each { |at| covered[at] = how } }
    end

    # A sentence of the table: `{...}` in it is what the document's number must be.
    def hold(sentence, entry, prose, covered)
      parts = sentence.split(/(\{[^}]*\})/)
      pattern = parts.map { |part| part.start_with?('{') ? "(#{number_or_words(part)})" : literal(part) }.join
      seen = false
      prose.scan(/#{pattern}/) do
        match = Regexp.last_match
        next unless section(entry.file, prose, match.begin(0)) == entry.section

        seen = true
        (match.begin(0)...match.end(0)).each { |at| covered[at] ||= 'in a sentence of the table' }
        parts.grep(/\A\{/).each.with_index(1) do |expression, at|
          (match.begin(at)...match.end(at)).each { |place| covered[place] = 'computed' }
          compare(entry.file, around(prose, match.begin(at)), expression[1...-1], match[at])
        end
      end
      wrong << "#{TABLE}: #{entry.file} does not say \"#{sentence}\", with a number for each brace" unless seen
    end

    def number_or_words(part)
      words = part[1...-1][IN_WORDS, 1]
      words ? WORDS.keys.map { |one| literal(one) }.join('|') : "-?#{IN_TABLE}"
    end

    def literal(part)
      words = part.split(/(\s+)/)
      words.map { |word| word.match?(/\A\s+\z/) ? '\s+' : Regexp.escape(word) }.join
    end

    def compare_words(file, around, expression, words)
      value = Values.of(expression[IN_WORDS, 2])
      said = WORDS.fetch(words.split.join(' '))
      near = PARTS.value?(said) ? NEAR : 0
      wrong << "#{file}: #{words} in \"#{around}\", but #{expression[IN_WORDS, 2]} is #{value.to_f.round(3)}" if ((value / said) - 1).abs > near
    end

    def compare(file, around, expression, number)
      return compare_words(file, around, expression, number) if expression.match?(IN_WORDS)

      value = Values.of(expression)
      return if same?(number.delete(' '), value)

      shown = value.denominator == 1 ? value.to_i : value.to_f.round(6)
      wrong << "#{file}: #{number} in \"#{around}\", but #{expression} is #{shown}"
    end

    # To the decimals that are written, rounded or cut.
    def same?(number, value)
      return Integer(number, 16) == value if number.start_with?('0x')

      decimals = number[/\.(\d+)/, 1].to_s.size
      [value.truncate(decimals), value.round(decimals)].include?(number.to_r)
    end

    def excuse(file, found)
      entries.select { |entry| entry.file == file && entry.excused.any? }.each do |entry|
        name = [file, entry.section].compact.join(' # ')
        open = found.select { |one| one.as.nil? && one.section == entry.section }
        others = entry.excused.flatten.reject { |text| take(open, text) }
        @surplus.concat(others.map { |text| "#{TABLE}: [#{name}] has no number #{text} that nothing else checks" })
        @surplus << "#{TABLE}: [#{name}] has its numbers in another order" if others.empty? && entry.excused.size == 1 && moved?(open, entry)
      end
    end

    def take(open, text)
      one = open.find { |candidate| candidate.text.delete(' ') == text && candidate.as.nil? }
      one.as = 'excused with a reason' if one
      one
    end

    # With one reason for all, a number that changes its place with another is seen.
    def moved?(open, entry)
      open.all?(&:as) && open.map { |one| one.text.delete(' ') } != entry.excused.first
    end

    def entries
      @entries ||= File.readlines(TABLE, chomp: true).grep_v(/\A(?:# |\s*\z)/).slice_before(/\A\[/).map do |head, *lines|
        file, section = head[1...-1].split(' # ', 2)
        reasons, sentences = lines.partition { |line| line.start_with?('- ') }
        Entry.new(file, section, sentences, reasons.map { |line| excused(line) })
      end
    end

    # `- REASON: NUMBER NUMBER ...`
    def excused(line)
      reason, numbers = line.match(/\A- (\S.*): ((?:0x\h+|[\d.]+)(?: (?:0x\h+|[\d.]+))*)\z/)&.captures
      reason or abort "#{TABLE}: no reason and numbers: #{line}"
      numbers.split
    end
  end

  # What the expressions of the table are made of.
  module Values
    PREFIX = 'FIXPID_'.freeze

    class << self
      # Names in capitals are macros of the headers, without FIXPID_.
      def of(expression)
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

      # How many bytes a type has, on a PC and on an AVR.
      def bytes(type, compiler = 'cc')
        headers = Dir['include/*.h'].sort.map { |header| "#include \"#{File.basename(header)}\"\n" }.join
        code = "#{headers}char object[sizeof(#{type})] = {1};\n"
        output, status = Open3.capture2(compiler, '-std=c99', '-Iinclude', '-x', 'c', '-S', '-o', '-', '-', stdin_data: code)
        status.success? or abort "#{TABLE}: #{compiler} knows no #{type}"
        output[/\.size\s+object, (\d+)/, 1].to_r
      end

      def bytes_avr(type)
        bytes(type, 'avr-gcc')
      end

      # The number of the analog input that a port's board has for a signal.
      def input(port, name)
        at = File.read("#{port}/port_board.h")[/^#define PORT_#{name} 0x(\h+)u/, 1] or abort "#{TABLE}: #{port} has no #{name}"
        (port.include?('/avr/') ? at.hex & 7 : at.hex >> 2 & 15).to_r
      end

      # The number of the highest bit in a mask that a file defines.
      def bit(path, name)
        mask = File.read(path)[/^#define #{name} 0x(\h+)u/, 1] or abort "#{TABLE}: #{path} has no #{name}"
        (mask.hex.bit_length - 1).to_r
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

      # How many rows of a generated table have what the pattern says.
      def rows(page, name, pattern)
        text = File.read(page)[/<!-- #{name}:begin -->\n(.*?)<!-- #{name}:end -->/m, 1] or abort "#{TABLE}: #{page} has no #{name}"
        text.lines.grep(/\A\|/).drop(2).grep(/#{pattern}/).size.to_r
      end

      # How often a file has what the pattern says.
      def times(path, pattern)
        File.read(path).scan(/#{pattern}/).size.to_r
      end

      # Of a generated table: the first number of a cell, chosen by the text that its row begins with
      # and the head of its column.
      def cell(page, name, row, column)
        text = File.read(page)[/<!-- #{name}:begin -->\n(.*?)<!-- #{name}:end -->/m, 1] or abort "#{TABLE}: #{page} has no #{name}"
        head, _, *rows = text.lines.grep(/\A\|/).map { |line| line.split('|')[1...-1].map(&:strip) }
        cells = rows.find { |one| one.join(' | ').start_with?(row) } or abort "#{TABLE}: #{page}, #{name}: no row #{row}"
        head.zip(cells).to_h.fetch(column)[/-?\d+(?:\.\d+)?/].to_r
      end
    end
  end
end

if __FILE__ == $PROGRAM_NAME
  puts ProseNumbers.failures
  ProseNumbers.count.sort_by { |_, many| -many }.each { |how, many| puts "#{many} #{how}" }
  exit(ProseNumbers.failures.empty? ? 0 : 1)
end

# SPDX-License-Identifier: MIT
require 'cgi'
require_relative 'blocks'
require_relative 'functions'
require_relative 'names'

# A header as a page: its comments are the prose, what stands between them is the code, in its
# order, without what is private. Each function, structure and enumeration has a heading, and so
# has each comment about macros. Names are links. A function's declaration comes first.
class Header
  NAME = /\b(?:(?:struct|union|enum) )?(?:fixpid|FIXPID)_\w+(?:\.h\b)?|\bfixpid\.h\b/.freeze
  TOKEN = %r{//[^\n]*|^#(?:[^\n]*\\\n)*[^\n]*|"[^"\n]*"|#{NAME}|\b[A-Za-z_]\w*\b}.freeze
  TYPES = /\A(?:u?int\d+_t|bool|void|char|unsigned|int)\z/.freeze
  KEYWORDS = /\A(?:struct|union|enum|const|volatile|extern|template|static|inline)\z/.freeze
  TYPE = /\A(struct|union|enum) /.freeze

  def initialize(path, names, functions)
    @file = File.basename(path)
    @names = names
    @functions = functions
    @blocks = Blocks.of(path)
    @own = [] # names that need no link where they are explained
  end

  def page
    first, *rest = @blocks
    ["# #{@file}\n", prose(first[0]), *rest.map { |comment, code| section(comment, code) }].join("\n")
  end

  # What it says of itself first.
  def about
    @blocks[0][0].map { |line| line.delete_prefix('//').delete_prefix(' ') }.join("\n")
  end

  private

  # A block with its headings. Each function of several under one comment has its own.
  def section(comment, code)
    @own = Names.declared(code).map(&:last)
    parts = functions(code)
    titles = parts.map { |part| Names.declared(part).find { |kind, _| kind == :function } }
    return ["#{heading(comment, code)}\n", prose(comment), listing(shortened(code))].join("\n") unless titles.all? && parts.any?

    parts.each_with_index.map do |part, i|
      "## `#{titles[i][1]}` { ##{titles[i][1]} }\n\n#{listing(part)}\n#{prose(comment)}\n#{@functions.about(part, comment)}\n"
    end.join
  end

  # Of a macro with arguments, how it is called.
  def shortened(code)
    code.map { |line| line.match?(/\A# *define \w+\([^)]*\) *\\\n/) ? "#{line[/\A[^\n]*?\)/]} ..." : line }
  end

  # The code cut after each declaration; what follows the last one belongs to it.
  def functions(code)
    parts = code.slice_after { |line| line.match?(%r{;\s*(?://.*)?\z}) }.to_a
    parts.pop if parts.size > 1 && parts[-1].all? { |line| line.start_with?('#endif') }
    parts[-2..] = [parts[-2] + parts[-1]] if parts.size > 1 && parts[-1].all? { |line| line.start_with?('#') }
    parts
  end

  def heading(comment, code)
    declared = Names.declared(code)
    type = declared.find { |kind, _| Names::TYPES.include?(kind) }
    return anchored("#{type[0]} `#{type[1]}`", type, declared) if type

    function = declared.find { |kind, _| kind == :function }
    return anchored("`#{function[1]}`", function, declared) if function

    macros = declared.select { |kind, _| kind == :macro }
    return '' if macros.empty?
    return anchored("`#{macros[0][1]}`", macros[0], declared) if macros.size == 1
    return places(declared) if comment.empty?

    clause = comment.map { |line| line.delete_prefix('//').strip }.join(' ')[/\A[^.,:;(]+/].strip
    anchored(clause.delete_prefix('These are ').sub(/\A./, &:upcase), nil, declared)
  end

  # A heading, and behind it a place for each further name to link to.
  def anchored(title, first, declared)
    "## #{title}#{first && " { ##{Names.anchor(*first)} }"}\n\n#{places(declared - [first])}"
  end

  def places(declared)
    return '' if declared.empty?

    "<div>#{declared.map { |name| "<span id=\"#{Names.anchor(*name)}\"></span>" }.join}</div>\n"
  end

  # A comment as paragraphs, lists and, where it is indented, as it stands.
  def prose(comment)
    lines = comment.map { |line| line.delete_prefix('//').delete_prefix(' ') }
    lines.slice_when { |one, other| one.empty? || other.empty? || kind(one) != kind(other) && !continues?(one, other) }
         .reject { |part| part == [''] }.map { |part| paragraph(part) }.join("\n")
  end

  def kind(line)
    return :item if line.match?(/\A *(?:- |\d+\. )/)

    line.start_with?('  ') ? :as_it_stands : :text
  end

  # The further lines of an item are indented.
  def continues?(one, other)
    @item = true if kind(one) == :item
    @item = false if kind(one) == :text
    @item && kind(other) != :text
  end

  def paragraph(part)
    case kind(part.first)
    when :item
      items = part.slice_before { |line| kind(line) == :item }.map { |item| item.map(&:strip).join(' ') }
      list = items[0].match?(/\A\d/) ? 'ol' : 'ul'
      "<#{list}>#{items.map { |item| "<li>#{inline(item.sub(/\A(?:- |\d+\. )/, ''))}</li>" }.join("\n")}</#{list}>\n"
    when :as_it_stands
      "<pre><code>#{linked(part.map { |line| line.delete_prefix('  ') }.join("\n"))}</code></pre>\n"
    else
      "<p>#{inline(part.join("\n"))}</p>\n"
    end
  end

  # Names and what is quoted as code.
  def inline(text)
    text.split(/(`[^`]*`)/).map do |piece|
      next "<code>#{linked(piece[1..-2])}</code>" if piece.start_with?('`')

      piece.split(/(#{NAME})/).map { |word| word.match?(/\A#{NAME}\z/) ? "<code>#{linked(word)}</code>" : CGI.escapeHTML(word) }.join
    end.join
  end

  def linked(text)
    text.split(/(#{NAME})/).map { |word| link(word) || CGI.escapeHTML(word) }.join
  end

  # Nothing is linked where it is explained.
  def link(words)
    name = words.split.last
    address = @names.address(words, @file) unless @own.include?(name)
    address && CGI.escapeHTML(words).sub(name) { "<a href=\"#{address}\">#{name}</a>" }
  end

  def listing(code)
    return '' if code.empty?

    text = code.join("\n")
    colored = +''
    place = 0
    text.to_enum(:scan, TOKEN).each do
      match = Regexp.last_match
      colored << CGI.escapeHTML(text[place...match.begin(0)]) << token(match[0])
      place = match.end(0)
    end
    colored << CGI.escapeHTML(text[place..])
    # An empty line would end the HTML.
    "<div class=\"highlight\"><pre><code>#{colored.gsub("\n\n", "\n&#8203;\n")}</code></pre></div>\n"
  end

  def token(word)
    return linked(word).sub(TYPE, '<span class="k">\1</span> ') if word.match?(TYPE)

    style = case word
            when %r{\A//} then 'c1'
            when /\A#/ then 'cp'
            when TYPES then 'kt'
            when KEYWORDS then 'k'
            end
    style ? "<span class=\"#{style}\">#{linked(word)}</span>" : linked(word)
  end
end

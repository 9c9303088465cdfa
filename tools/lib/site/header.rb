# SPDX-License-Identifier: MIT
require 'cgi'
require_relative 'names'

# A header as a page: its comments are the prose, what stands between them is the code,
# all in its order. Each function, structure and enumeration has a heading, and so has
# each comment about macros. Names are links. Nothing in the header changes.
class Header
  # What only the compiler needs.
  SKIPPED = %r{^(?:// SPDX.*|#include .*|FIXPID_C_(?:BEGIN|END)|#ifndef FIXPID\w*_H|#define FIXPID\w*_H|#endif)$}.freeze
  NAME = /\b(?:fixpid|FIXPID)_\w+(?:\.h\b)?|\bfixpid\.h\b/.freeze
  TOKEN = %r{//[^\n]*|^#(?:[^\n]*\\\n)*[^\n]*|"[^"\n]*"|\b[A-Za-z_]\w*\b}.freeze
  TYPES = /\A(?:u?int\d+_t|bool|void|char|unsigned|int)\z/.freeze
  KEYWORDS = /\A(?:struct|union|enum|const|volatile|extern|template|static|inline)\z/.freeze

  def initialize(path, names)
    @file = File.basename(path)
    @names = names
    @text = File.read(path)
  end

  def page
    first, *rest = blocks
    ["# #{@file}\n", prose(first[0]), *rest.map { |comment, code| section(comment, code) }].join("\n")
  end

  private

  # [lines of comment, lines of code] in the header's order. The code ends where the next
  # comment at the left edge begins, or at an empty line outside of braces.
  def blocks
    found = [[[], []]]
    depth = 0
    @text.each_line(chomp: true) do |line|
      next if depth.zero? && line.match?(SKIPPED)

      comment = depth.zero? && line.start_with?('//')
      found << [[], []] if depth.zero? && (line.empty? || (comment && found.last[1].any?))
      found.last[comment ? 0 : 1] << line unless line.empty? && depth.zero?
      depth += line.count('{') - line.count('}') unless line.match?(/\A *#|\\\z/)
    end
    found.reject { |pair| pair.all?(&:empty?) }
  end

  # A block with its headings. Each function of several under one comment has its own.
  def section(comment, code)
    parts = functions(code)
    titles = parts.map { |part| Names.declared("#{part.join("\n")}\n").find { |kind, _| kind == :function } }
    return ["#{heading(comment, code)}\n", prose(comment), listing(code)].join("\n") unless titles.all? && parts.any?

    parts.each_with_index.map do |part, i|
      "### `#{titles[i][1]}` { ##{titles[i][1]} }\n\n#{prose(comment) if i.zero?}\n#{listing(part)}\n"
    end.join
  end

  # The code cut after each declaration.
  def functions(code)
    code.slice_after { |line| line.match?(/;\s*(?:\/\/.*)?\z/) }.to_a
  end

  def heading(comment, code)
    declared = Names.declared("#{code.join("\n")}\n")
    type = declared.find { |kind, _| %i[struct enum].include?(kind) }
    anchors = declared.map(&:last)
    return anchored("### #{type[0]} `#{type[1]}`", type[1], anchors) if type
    return '' if comment.empty?

    macros = declared.select { |kind, _| kind == :macro }.map(&:last)
    return anchored("### `#{macros[0]}`", macros[0], anchors) if macros.size == 1

    clause = comment.map { |line| line.delete_prefix('//').strip }.join(' ')[/\A[^.,:;]+/]
    return '' if macros.empty?

    anchored("### #{clause}", nil, anchors)
  end

  # A heading, and behind it a place for each further name to link to.
  def anchored(text, id, names)
    places = (names - [id]).map { |name| "<span id=\"#{name}\"></span>" }.join
    "#{text}#{id && " { ##{id} }"}\n\n#{places.empty? ? '' : "<div>#{places}</div>\n"}"
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

  def link(word)
    address = @names.address(word, @file)
    address && "<a href=\"#{address}\">#{CGI.escapeHTML(word)}</a>"
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
    style = case word
            when %r{\A//} then 'c1'
            when /\A#/ then 'cp'
            when TYPES then 'kt'
            when KEYWORDS then 'k'
            end
    style ? "<span class=\"#{style}\">#{linked(word)}</span>" : linked(word)
  end
end

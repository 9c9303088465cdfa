# SPDX-License-Identifier: MIT
# A header cut into what it explains: [lines of comment, lines of code] in its order. The
# code ends where the next comment at the left edge begins, or at an empty line outside of braces.
# What is private is left out.
module Blocks
  # What only the compiler needs.
  SKIPPED = %r{^(?:#include (?!"fixpid_config).*|FIXPID_C_(?:BEGIN|END)|#ifndef FIXPID\w*_H|#define FIXPID\w*_H)$}.freeze
  # Where fixpid.h comes to what only the linker and the sources need.
  PRIVATE_END = %r{^// The rest is private.*}m.freeze
  # A comment that says so speaks of all its macros; a structure is private inside, and has a name.
  PRIVATE = /\A.{0,60}\bprivate\b/i.freeze
  # In fixpid.h one comment speaks of these.
  INNER = /\AFIXPID_(?:CAST|UNSIGNED|REAL|FOLDED|CHECKED|EXTENSION|C_BEGIN|C_END)\z/.freeze
  MACRO = /^# *define (\w+)/.freeze
  TYPE = /^(?:struct|union|enum) \w+ \{/.freeze

  class << self
    def of(path)
      text = File.read(path).sub(%r{\A/\*.*?(?=^//)}m, '').sub(PRIVATE_END, '').delete_suffix("#endif\n")
      all(logical_lines(text)).reject { |comment, code| (comment + code).empty? || hidden?(comment, code) }
    end

    def comment(lines)
      lines.map { |line| line.delete_prefix('//').strip }.join(' ')
    end

    private

    # A macro of several lines is one.
    def logical_lines(text)
      text.split("\n").slice_when { |line, _| !line.end_with?('\\') }.map { |lines| lines.join("\n") }
    end

    def all(lines)
      found = [[[], []]]
      depth = 0
      lines.each do |line|
        next if depth.zero? && line.match?(SKIPPED)

        comment = depth.zero? && line.start_with?('//')
        found << [[], []] if depth.zero? && (line.empty? || (comment && found.last[1].any?))
        found.last[comment ? 0 : 1] << line unless line.empty? && depth.zero?
        code = line.start_with?('#') ? '' : line.sub(%r{//.*}, '')
        depth += code.count('{') - code.count('}')
      end
      found
    end

    def hidden?(comment, code)
      return false if code.any? { |line| line.match?(TYPE) }

      macros = code.map { |line| line[MACRO, 1] }.compact
      inner = macros.any? && macros.all? { |name| name.match?(INNER) }
      inner || (comment(comment).match?(PRIVATE) && code.any?) || (comment.empty? && macros.empty? && code.all? { |line| line.start_with?('#') })
    end
  end
end

# SPDX-License-Identifier: MIT
require_relative 'blocks'

# Every name of the headers that is not private, and where the site explains it.
class Names
  # A declaration at the beginning of a line.
  FORMS = { function: /^(?!static)[\w ]*?[ *](fixpid_\w+)\(/, struct: /^struct (fixpid_\w+) \{/,
            union: /^union (fixpid_\w+) \{/, enum: /^enum (fixpid_\w+) \{/, value: /^    (FIXPID_\w+),?$/,
            macro: /^# *define (FIXPID_\w+)/ }.freeze
  TYPES = %i[struct union enum].freeze

  # [kind, name] of all that these lines declare, each once.
  def self.declared(lines)
    lines.join("\n").each_line.flat_map { |line| FORMS.map { |kind, form| [kind, line[form, 1]] if line.match?(form) } }
         .compact.uniq
  end

  # A function may have the name of a structure.
  def self.anchor(kind, name)
    TYPES.include?(kind) ? "#{kind}-#{name}" : name
  end

  def initialize(headers)
    @places = {}
    headers.each do |path|
      file = File.basename(path)
      @places[file] = [file, nil]
      Blocks.of(path).flat_map { |_, code| Names.declared(code) }.each { |kind, name| explain(kind, name, [file, Names.anchor(kind, name)]) }
    end
  end

  # The address of a name, which may stand behind `struct` or the like, from a page of
  # `header`.
  def address(words, header)
    file, anchor = @places[words] || @places[words.split.last]
    return unless file

    "#{file == header ? '' : "#{file}.html"}#{anchor && "##{anchor}"}"
  end

  private

  def explain(kind, name, place)
    @places["#{kind} #{name}"] = place if TYPES.include?(kind)
    @places[name] = place if kind == :function
    @places[name] ||= place
  end
end

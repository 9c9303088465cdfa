# SPDX-License-Identifier: MIT
# Every public name of the headers, and where the site explains it.
class Names
  # A declaration at the beginning of a line: what it names, and its kind.
  FORMS = { function: /^(?!static)[\w ]*?[ *](fixpid_\w+)\(/, struct: /^(?:struct|union) (fixpid_\w+) \{/,
            enum: /^enum (fixpid_\w+) \{/, value: /^    (FIXPID_\w+),?$/, macro: /^# *define (FIXPID_\w+)/ }.freeze
  # A guard against a second inclusion.
  GUARD = /\A#ifndef (\w+_H)\n#define \1\n\z/.freeze

  # [kind, name] of all that these lines declare, each once.
  def self.declared(text)
    found = text.each_line.flat_map do |line|
      FORMS.map { |kind, form| [kind, line[form, 1]] if line.match?(form) }.compact
    end
    found.reject { |_, name| name.end_with?('_H') }.uniq(&:last)
  end

  def initialize(headers)
    @places = {}
    headers.each do |path|
      Names.declared(File.read(path)).each { |_, name| @places[name] ||= File.basename(path) }
      @places[File.basename(path)] = File.basename(path)
    end
  end

  # The address of a name, from a page of `header`.
  def address(name, header)
    place = @places[name]
    return unless place

    page = place == header ? '' : "#{place}.html"
    name == place ? "#{place}.html" : "#{page}##{name}"
  end
end

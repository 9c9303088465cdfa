# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require 'json'

# docs/figures.json: the numbers that sentences of the documents say, by their names, and the tables
# of costs that pages show. A document has `<!-- NAME -->` before a number. `tools/cost --update`,
# `tools/demo --long` and `ruby tools/lib/pages/check_docs.rb --update` write what they measure or
# count; nothing else may be read out of a page by a tool.
module NamedFigures
  FILE = 'docs/figures.json'
  NAMED = /<!-- (\w+) -->\K\d+/.freeze

  class << self
    def all(root = '.')
      JSON.parse(File.read("#{root}/#{FILE}"))
    end

    # A table's rows by the names of its head; a name that comes again has its place behind it.
    def table(name)
      head, *rows = all.fetch(name)
      head = head.each_with_index.map { |title, at| head.index(title) == at ? title : "#{title} #{at}" }
      rows.map { |row| head.zip(row).to_h }
    end

    # A line for each that the file has otherwise.
    def stale(found, root = '.')
      old = all(root)
      texts(found).reject { |name, value| old[name] == value }.map do |name, value|
        value.is_a?(Array) ? "#{FILE}: the table #{name} is another one" : "#{FILE}: #{name} is #{old.fetch(name, 'missing')}, but #{value} was found"
      end
    end

    # A line for each number and each row.
    def keep(found, root = '.')
      lines = all(root).merge(texts(found)).sort.map do |name, value|
        "  #{name.to_json}: #{value.is_a?(Array) ? "[\n    #{value.map(&:to_json).join(",\n    ")}\n  ]" : value.to_json}"
      end
      File.write("#{root}/#{FILE}", "{\n#{lines.join(",\n")}\n}\n")
    end

    # A document's text with the numbers of its names.
    def renewed(text)
      text.gsub(NAMED) { |old| all.fetch($1, old).to_s }
    end

    # The names that no tool has written, of a document.
    def unknown(text)
      text.scan(NAMED).flatten.uniq - all.keys
    end

    private

    # The cells of tables as the pages have them.
    def texts(found)
      found.transform_values { |value| value.is_a?(Array) ? value.map { |row| row.map(&:to_s) } : value }
    end
  end
end

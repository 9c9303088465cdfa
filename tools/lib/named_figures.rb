# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require 'json'

# docs/figures.json: the numbers that sentences of the documents say, by their names. A document
# has `<!-- NAME -->` before a number. `tools/cost --update`, `tools/demo --long` and
# `ruby tools/lib/pages/check_docs.rb --update` write what they measure or count. Tables are in
# docs/data; nothing else may be read out of a page by a tool.
module NamedFigures
  FILE = 'docs/figures.json'
  NAMED = /<!-- (\w+) -->\K\d+/.freeze

  class << self
    def all(root = '.')
      JSON.parse(File.read("#{root}/#{FILE}"))
    end

    # A line for each that the file has otherwise.
    def stale(found, root = '.')
      old = all(root)
      found.reject { |name, value| old[name] == value }
           .map { |name, value| "#{FILE}: #{name} is #{old.fetch(name, 'missing')}, but #{value} was found" }
    end

    def keep(found, root = '.')
      File.write("#{root}/#{FILE}", "#{JSON.pretty_generate(all(root).merge(found).sort.to_h)}\n")
    end

    # A document's text with the numbers of its names.
    def renewed(text)
      text.gsub(NAMED) { |old| all.fetch($1, old).to_s }
    end

    # The names that no tool has written, of a document.
    def unknown(text)
      text.scan(NAMED).flatten.uniq - all.keys
    end
  end
end

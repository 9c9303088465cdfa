# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# ES modules as one: each after those that it imports, without the lines that
# import, the word export, and what only people read: comments and indentation.
# Their names must differ: a second one is an error.
module Modules
  IMPORT = %r!^import (?:\{[^}]*\} from )?'\./([\w.]+)';\n!.freeze
  NAMED = %r!^import \{([^}]*)\} from '\./([\w.]+)';\n!.freeze
  NAME = /^(?:export )?(?:async )?(?:function\*?|const|let|class) (\w+)/.freeze

  class << self
    # `built` stands for the module of that name.
    def joined(first, built)
      texts = {}
      @imports = []
      collect(first, built, texts)
      twice = texts.values.flat_map { |text| text.scan(NAME).flatten }.tally.select { |_, times| times > 1 }.keys
      raise "names of two modules: #{twice.join(', ')}" unless twice.empty?

      check_imports(texts)
      texts.values.join("\n").gsub(%r{^ *//.*\n}, '').gsub(/^ +|^\n/, '')
    end

    private

    # Joined, a module finds each name of the others: imports are checked here.
    def check_imports(texts)
      exported = texts.to_h { |path, text| [File.basename(path), text.scan(NAME).flatten] }
      @imports.each do |path, names, from|
        wrong = names.reject { |name| exported.fetch(from).include?(name) && texts[path].match?(/\b#{name}\b/) }
        raise "#{path} imports from #{from} what is not there or not used: #{wrong.join(', ')}" unless wrong.empty?
      end
    end

    def collect(path, built, texts)
      return if texts.key?(path)

      text = File.read(path)
      texts[path] = nil # in the work: a circle would never end
      @imports += text.scan(NAMED).map { |names, from| [path, names.scan(/\w+/), from] }
      text.scan(IMPORT).flatten.each do |name|
        collect(name == File.basename(built) ? built : File.join(File.dirname(path), name), built, texts)
      end
      texts.delete(path)
      texts[path] = text.gsub(IMPORT, '').gsub(/^export /, '')
    end
  end
end

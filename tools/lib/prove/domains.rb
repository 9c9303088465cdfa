# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'proofs'

# What the proofs assume. An assumption that holds of less than the module's header says
# would prove less, and every proof would stay green. So there are three kinds of them:
#
#   assume(tpo_is_legal(&config))   a domain: a function of the module whose comment says in
#                                   words, behind `Domain: `, of what it holds; docs/assurance.md
#                                   has them
#   assume(inside(kind, 3, 6))      the range of one value that is any: comparisons of a variable
#                                   that a nondet_ function gives with constants
#   assume(p <= most)               in a function assume_...: what is known of a product, or a
#                                   quotient, for which any function stands
module Domains
  Domain = Struct.new(:file, :name, :words) do
    # The module, or nil of what all proofs share.
    def group
      base = File.basename(file, '.*')
      Proofs.rows.map { |left, _| left.split.first }.select { |group| base == group || base.start_with?("#{group}_") }.max_by(&:size)
    end
  end

  HARNESSES = "#{FOLDER}/{,theorems/,assembly/}*.{c,h}"
  DOMAIN = %r{^// Domain: ((?:.*\n// )*.*)\nstatic bool (\w+)\(}.freeze
  FUNCTION = /^(?:static )?[\w *]*?\b(\w+)\(([^;{#]*)\)\n\{\n(.*?)^\}/m.freeze
  MACRO = /^#define (\w+)((?:.*\\\n)*.*)/.freeze
  ASSUMED = /\b(?:assume|__CPROVER_assume)\(/.freeze
  ANY = '__CPROVER_uninterpreted_'
  CONSTANT = /\A(?:[A-Z][A-Z0-9_]*|number|u?int\d+_t)\z/.freeze # a word of one
  COMPARISON = /\A(\w+) (?:[<>]=?|[!=]=) (.+)\z/.freeze
  RANGE = /\Ainside\((\w+), (.+)\)\z/.freeze

  module_function

  def all
    @all ||= texts.flat_map { |file, text| text.scan(DOMAIN).map { |words, name| Domain.new(file, name, words.gsub("\n// ", ' ')) } }
  end

  # What is neither of the three, a domain with another module's name, and one that nobody
  # assumes.
  def complaints
    assumed = texts.flat_map { |file, text| assumptions(file, text) }
    strange = assumed.reject { |_, _, said, function| known?(said, function) }
                     .map { |file, line, said, _| "#{file}:#{line}: assume(#{said}) is no domain (// Domain: ...), no range of one value, and not about a product in a function assume_..." }
    misnamed = all.reject { |domain| domain.group.nil? || domain.name.start_with?("#{domain.group}_") }
    unused = all.reject { |domain| assumed.any? { |_, _, said, _| said.start_with?("#{domain.name}(") } }
    strange + misnamed.map { |domain| "#{domain.file}: the domain #{domain.name} does not begin with #{domain.group}_" } +
      unused.map { |domain| "#{domain.file}: nobody assumes the domain #{domain.name}" }
  end

  def texts
    @texts ||= Dir[HARNESSES].sort_by { |file| [file.count('/'), file] }.to_h { |file| [file, File.read(file)] }
  end

  # [file, line, what is assumed, the function that it is in] of each assumption.
  def assumptions(file, text)
    bare = text.gsub(%r{//.*}) { |comment| ' ' * comment.size }.gsub(/^#define assume\(.*/) { |line| ' ' * line.size }
    functions = bare.to_enum(:scan, FUNCTION).map { Regexp.last_match }
    bare.to_enum(:scan, ASSUMED).map { Regexp.last_match }.map do |found|
      function = functions.find { |one| (one.begin(0)...one.end(0)).cover?(found.begin(0)) }
      [file, bare[0...found.begin(0)].count("\n") + 1, argument(bare, found.end(0)).gsub(/\s+/, ' '), function]
    end
  end

  # Up to the parenthesis that closes it.
  def argument(text, from)
    depth = 1
    length = text[from..].each_char.take_while { |letter| (depth += { '(' => 1, ')' => -1 }.fetch(letter, 0)).positive? }.size
    text[from, length]
  end

  def known?(said, function)
    function && (domain?(said) || range?(said, function[3]) || product?(said, *function.values_at(1, 3)))
  end

  # A call of one, and nothing behind it.
  def domain?(said)
    name, rest = said.match(/\A(\w+)\((.*)\z/m)&.captures
    all.map(&:name).include?(name) && argument(rest, 0).size == rest.size - 1
  end

  def range?(said, body)
    variables = conjuncts(said).map do |part|
      name, constants = (part.match(RANGE) || part.match(COMPARISON))&.captures
      name if name && constants.scan(/\b[A-Za-z_]\w*|->|\./).all? { |word| word.match?(CONSTANT) }
    end
    variables.uniq.size == 1 && variables.first && body.match?(/\b#{variables.first} = nondet_\w+\(\);/)
  end

  # Each part names what stands for a product, or a variable of which it is the value.
  def product?(said, name, body)
    return false unless name.start_with?('assume_')

    found = products + body.scan(/\b(\w+) = (\w+)\(/).select { |_, called| product_name?(called) }.map(&:first)
    conjuncts(said).all? { |part| part.scan(/\w+/).any? { |word| found.include?(word) } }
  end

  def product_name?(name)
    name.start_with?(ANY) || products.include?(name)
  end

  # The functions assume_... that know something of one, and what computes with it.
  def products
    @products ||= begin
      bodies = texts.values.flat_map { |text| text.scan(FUNCTION).map { |name, _, body| [name, body] } + text.scan(MACRO) }
      found = bodies.select { |name, body| name.start_with?('assume_') && body.include?(ANY) }.map(&:first)
      loop do
        more = bodies.select { |name, body| !name.start_with?('prove_') && (body.scan(/(\w+)\(/).flatten & found).any? }.map(&:first).uniq - found
        break found if more.empty?

        found += more
      end
    end
  end

  # Those of a && b, without the parentheses around each.
  def conjuncts(said)
    depth = 0
    parts = said.split(/(&&|[()])/).each_with_object([+'']) do |piece, so_far|
      depth += { '(' => 1, ')' => -1 }.fetch(piece, 0)
      piece == '&&' && depth.zero? ? so_far << +'' : so_far.last << piece
    end
    parts.map(&:strip).map { |part| part.start_with?('(') && argument(part, 1).size == part.size - 2 ? part[1..-2] : part }
  end
end

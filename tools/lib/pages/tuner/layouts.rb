# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Where the members of the C's structures are in WebAssembly's memory, from their headers: the
# page reads and writes them there, as Python does by cffi.
module Layouts
  SIZES = { 'bool' => 1, 'int' => 4, 'double' => 8, 'pointer' => 4 }.freeze

  class << self
    # { identify_plant: { size: 48, align: 8, members: { kind: ['int', 0], lag: ['double', 16], .. } }, .. };
    # of an array a member has its count, too.
    def of(*paths)
      @texts = paths.map { |path| File.read(path).gsub(%r{//.*}, '') }.join
      @known = {}
      @texts.scan(/^struct (\w+) \{(.*?)^\};/m) { |name, body| @known[name] = layout(body) }
      @known
    end

    private

    def layout(body)
      found = { size: 0, align: 1, members: {} }
      body.split(';').map(&:strip).reject(&:empty?).each do |declaration|
        type, names = declaration.match(/\A(?:const )?(?:struct )?(\w+) (.*)\z/m)&.captures || raise("no member: #{declaration}")
        names.split(',').each { |name| add(found, type, name.strip) }
      end
      found[:size] = aligned(found[:size], found[:align])
      found
    end

    def add(found, type, declarator)
      star, name, counts = declarator.match(/\A(\*?)(\w+)((?:\[\w+\])*)\z/)&.captures || raise("no member: #{declarator}")
      type = 'pointer' unless star.empty?
      size, align = SIZES[type] ? [SIZES[type]] * 2 : @known.fetch(type).values_at(:size, :align)
      count = counts.scan(/\w+/).map { |one| number(one) }.reduce(:*)
      at = aligned(found[:size], align)
      found[:members][camel(name)] = [type, at, *count]
      found.update(size: at + (size * (count || 1)), align: [found[:align], align].max)
    end

    def aligned(size, align)
      (size + align - 1) / align * align
    end

    # A macro, or the last name of an enumeration.
    def number(name)
      return @texts[/^#define #{name} (\d+)/, 1].to_i if @texts.match?(/^#define #{name} \d/)

      body = @texts[/^enum \w+ \{([^}]*\b#{name}\s*)\}/, 1] || raise("no #{name}")
      body.scan(/\w+/).index(name)
    end

    def camel(name)
      name.gsub(/_(\w)/) { Regexp.last_match(1).upcase }
    end
  end
end

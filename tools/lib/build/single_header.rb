# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# A controller, or what stands beside one, as one header: its header, and behind
# FIXPID_..._IMPLEMENTATION its sources, with all that they include written out. The
# files keep their include guards, so several such headers fit into one source.
#
#   ruby tools/lib/build/single_header.rb FOLDER    all of them, as fixpid_..._single.h
require_relative '../manifests'

class SingleHeader
  NOUNS = (Project::HEADERS.map { |header| File.basename(header, '.h') } - ['fixpid']).freeze

  # fixpid_an964_8bit of src/an964_8bit/fixpid_an964_8bit_more.c
  def self.noun_of(source)
    name = File.basename(source, '.c')
    NOUNS.select { |noun| "#{name}_".start_with?("#{noun}_") }.max_by(&:size)
  end

  def initialize(noun)
    @noun = noun
    @seen = []
  end

  def text
    implementation = "#{@noun.upcase}_IMPLEMENTATION"
    contract = expanded("include/#{@noun}.h")
    text = <<~TEXT
      // SPDX-License-Identifier: MIT
      // #{@noun} #{Project::VERSION} in one file. Include it wherever it is used; one source
      // of the program, best one of its own, has this before it:
      //   #define #{implementation}
      // Its switches, like -D#{@noun.upcase}_OBJECT, are for all of these sources.
      #if defined(__SDCC_pic14) || defined(__SDCC_pic16)
      #error "For SDCC on a PIC take the folders include and src: this file is without their assembly"
      #endif

      #{contract}
      #if defined(#{implementation}) && !defined(#{@noun.upcase}_IMPLEMENTED)
      #define #{@noun.upcase}_IMPLEMENTED

      #{sources.map { |source| expanded(source) }.join("\n")}
      #endif

      #{File.read('LICENSE').lines.map { |line| "// #{line}".rstrip }.join("\n")}
    TEXT
    text.gsub(/\n{3,}/, "\n\n")
  end

  private

  def sources
    Project::PORTABLE_SOURCES.select { |source| SingleHeader.noun_of(source) == @noun }
  end

  # Once is enough for a file with a guard, unless that once is in a branch of an #if of
  # the file that includes it: a compiler may skip it there.
  def expanded(path)
    return '' if @seen.include?(path)

    text = File.read(path).sub(%r{\A/[/*] SPDX.*\n}, '')
    guard = text[/^#ifndef FIXPID_\w*H$/]
    @seen += [path] if guard
    outer = [] # what was seen before each #if that is open
    text.lines.map do |line|
      outer.push(@seen) if line =~ /^#if/ && line.chomp != guard
      @seen = outer.last || @seen if line =~ /^#(elif|else|endif)/
      outer.pop if line.start_with?('#endif')
      line =~ /^#include "(.*)"/ ? included(path, $1) : line
    end.join
  end

  # The assembly of a PIC is in sources of its own, and one header is the user's.
  def included(path, name)
    return '' if name.match?(/_pic1[48]\.h/)
    return "#include \"#{name}\"\n" if name == 'fixpid_config.h'

    file = ["#{File.dirname(path)}/#{name}", "src/#{name}", "include/#{name}"].find do |found|
      File.exist?(found) && !Manifests::FORWARDS.key?(found)
    end
    expanded(file)
  end
end

if $PROGRAM_NAME == __FILE__
  SingleHeader::NOUNS.each { |noun| File.write("#{ARGV.fetch(0)}/#{noun}_single.h", SingleHeader.new(noun).text) }
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What Arduino's library manager demands of an installed library, as the rules of Arduino
# Lint and the library specification have it, as far as they need no network:
#
#   arduino_lint.rb FOLDER     what is wrong with the library there, a line each
Encoding.default_external = 'UTF-8'

class ArduinoLint
  REQUIRED = %w[name version author maintainer sentence paragraph category url architectures].freeze
  KNOWN = [*REQUIRED, *%w[includes depends dot_a_linkage precompiled ldflags license email]].freeze
  CATEGORIES = ['Display', 'Communication', 'Signal Input/Output', 'Sensors', 'Device Control', 'Timing', 'Data Storage', 'Data Processing',
                'Other'].freeze
  NAME = /\A[A-Za-z0-9][A-Za-z0-9_.-]{0,62}\z/.freeze
  KEYWORD = /\A\w+\t(?:KEYWORD[123]|LITERAL[12])\z/.freeze
  WRONG_FOLDERS = %w[example Example Examples source Source SRC utility].freeze

  def initialize(folder)
    @folder = folder
    lines = File.readlines("#{folder}/library.properties", chomp: true)
    @fields = lines.map { |line| line.split('=', 2) }.to_h
    @lines = lines
  end

  def faults
    fields + values + structure + sketches + keywords
  end

  private

  def wrong(condition, what)
    condition ? [what] : []
  end

  def fields
    (REQUIRED - @fields.reject { |_, value| value.to_s.strip.empty? }.keys).map { |name| "no #{name}" } +
      (@fields.keys - KNOWN).map { |name| "#{name} is no field" } + wrong(@lines.size != @fields.size, 'a field stands twice')
  end

  def values
    [*wrong(!@fields['name'].to_s.match?(NAME), 'the name has a character that folders may not have'),
     *wrong(@fields['name'].to_s.match?(/\Aarduino/i), "the name begins with Arduino's"),
     *wrong(!@fields['version'].to_s.match?(/\A\d+\.\d+\.\d+\z/), 'the version is not that of Semantic Versioning'),
     *wrong(@fields['maintainer'].to_s.match?(/\Aarduino/i), "the maintainer is Arduino's"),
     *wrong(@fields['paragraph'].to_s.include?(@fields['sentence'].to_s), 'the paragraph repeats the sentence'),
     *wrong(!CATEGORIES.include?(@fields['category']), "#{@fields['category']} is no category"),
     *wrong(!@fields['url'].to_s.match?(%r{\Ahttps?://[^\s/]+\S*\z}), 'the url is none'),
     *@fields['includes'].to_s.split(',').reject { |header| File.file?("#{@folder}/src/#{header}") }.map { |header| "src has no #{header}" }]
  end

  def structure
    there = Dir.children(@folder)
    everything = Dir.glob("#{@folder}/**/*", File::FNM_DOTMATCH)
    [*wrong(there.grep(/\AREADME(\.|\z)/).empty?, 'no README'), *wrong(there.grep(/\ALICENSE/).empty?, 'no LICENSE'),
     *(there & WRONG_FOLDERS).map { |name| "the folder #{name}" }, *wrong(there.include?('.development'), 'the mark .development'),
     *wrong(there.include?('.gitmodules'), 'a submodule'),
     *everything.select { |path| File.symlink?(path) }.map { |path| "the link #{path}" }, *everything.grep(/\.exe\z/i).map { |path| "the program #{path}" }]
  end

  def sketches
    found = Dir["#{@folder}/examples/**/*.ino"]
    wrong(found.empty?, 'no sketch') + found.flat_map do |path|
      name = File.basename(File.dirname(path))
      [*wrong(File.basename(path, '.ino') != name, "#{path} is not called as its folder"), *wrong(!name.match?(NAME), "#{path} has a name that is none")]
    end
  end

  def keywords
    lines = File.readlines("#{@folder}/keywords.txt", chomp: true)
    lines.grep_v(KEYWORD).map { |line| "keywords.txt: #{line.inspect}" } + wrong(lines.uniq.size != lines.size, 'a keyword stands twice')
  end
end

faults = ArduinoLint.new(ARGV.fetch(0)).faults
puts faults
exit(faults.empty? ? 0 : 1)

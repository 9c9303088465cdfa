# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What package managers read of this project, their manifests. They are written from
# tools/lib/project.rb, tools/lib/modules.rb, include/ and src/, some as a whole, some in
# parts: `--update` writes them. Without it each is compared, and for each there is
# `ok MANIFEST` or `FAILED MANIFEST` with the lines that differ.
require 'json'
require 'open3'
require_relative 'modules'
require_relative 'project'

Encoding.default_external = 'UTF-8'

# The text of each manifest.
module Manifests
  # Arduino looks for headers in src/ only. The first of them asks whether the others are there.
  ASKED = <<~TEXT.freeze
    #ifdef __has_include
    #if !__has_include("../include/fixpid.h")
    #error "fixpid: to have both in one folder copy src first, then include"
    #endif
    #endif
  TEXT
  FORWARDS = Project::HEADERS.to_h do |header|
    first = header == 'include/fixpid.h' ? ASKED : "#include \"fixpid.h\"\n\n"
    ["src/#{File.basename(header)}",
     "// SPDX-License-Identifier: MIT\n// For Arduino, which looks for headers in src/ only.\n#{first}#include \"../#{header}\"\n"]
  end.freeze

  module_function

  def whole
    FORWARDS.merge('keywords.txt' => keywords, 'library.properties' => arduino, 'library.json' => platformio,
                   'idf_component.yml' => esp_idf, 'fixpid.fixpid.pdsc' => cmsis_pack, 'vcpkg/fixpid/vcpkg.json' => vcpkg,
                   'zephyr/module.yml' => zephyr)
  end

  # Of files that are otherwise written by hand: [what, where it stands, its text].
  def parts
    { 'CMakeLists.txt' => [['sources', /(?<=set\(fixpid_sources\n).*?(?=\))/m, indented(Project::SOURCES, '    ')]],
      'meson.build' => [['sources', /(?<=fixpid_sources = files\(\n).*?(?=\))/m, indented(quoted(Project::SOURCES, "'"), '  ', ',')],
                        ['version', /(?<=version: ')[\d.]+/, Project::VERSION],
                        ['licence', /(?<= license: ')[^']*/, Project::LICENSE],
                        ['sentence', /(?<=description: ')[^']*/, Project::SENTENCE]],
      'fixpid.pc.in' => [['sentence', /(?<=^Description: ).*/, Project::SENTENCE]],
      'conanfile.py' => [['attributes', /(?<=^class Fixpid\(ConanFile\):\n).*?(?=^    package_type)/m, conan]],
      'zephyr/Kconfig' => [['all features', /(?<=range 0x00 )\w+\n\tdefault \w+/, "#{features}\n\tdefault #{features}"]],
      'CITATION.cff' => [['licence', /(?<=^license: ).*/, Project::LICENSE], ['version', /(?<=^version: ).*/, Project::VERSION]],
      'python/setup.py' => [['licence', /(?<=^    license=").*(?=",$)/, Project::LICENSE]] }
  end

  # Every manifest as it should be, by its path; nil for what has lost its place.
  def written
    whole.merge(parts.to_h do |path, pieces|
      text = File.exist?(path) ? File.read(path) : nil
      [path, pieces.reduce(text) { |so_far, (_, place, piece)| so_far&.match?(place) ? so_far.sub(place) { piece } : nil }]
    end)
  end

  def indented(items, indent, separator = '')
    items.map { |item| "#{indent}#{item}" }.join("#{separator}\n")
  end

  def quoted(items, quote = '"')
    items.map { |item| "#{quote}#{item}#{quote}" }
  end

  def examples(system)
    Dir["examples/#{system}/*"].sort
  end

  # The words that the editor colours: types, functions and what is called like one, and
  # the constants.
  def keywords
    text = Project::HEADERS.map { |header| File.read(header).gsub(%r{//.*}, '') }.join
    types = text.scan(/^(?:struct|enum) (fixpid_\w+) \{/)
    functions = text.scan(/^\w[\w *]*\b(fixpid_\w+)\(/)
    constants = text.scan(/^#define (FIXPID_\w+) \d/) + text.scan(/^ +(FIXPID_\w+)(?: = \w+)?,?\s*$/)
    { 'KEYWORD1' => types, 'KEYWORD2' => functions + called_macros, 'LITERAL1' => constants }.flat_map do |kind, words|
      words.flatten.uniq.sort.map { |word| "#{word}\t#{kind}\n" }
    end.join
  end

  # Macros with arguments for users: in a module's header all but those whose comment says
  # that they are private, and in fixpid.h, most of which are parts of others, those that
  # their comment shows in use.
  def called_macros
    Project::HEADERS.flat_map do |header|
      comment = ''
      File.readlines(header).each_cons(2).map do |before, line|
        comment = before.start_with?('//') ? comment : '' if line.start_with?('//')
        comment += line if line.start_with?('//')
        name = line[/^#define (FIXPID_\w+)\(/, 1]
        name if name && (header.end_with?('/fixpid.h') ? comment.include?("#{name}(") : !comment.match?(/\bprivate\b/i))
      end.compact
    end
  end

  # The specification demands a url, and the library manager refuses an empty one.
  def arduino
    { name: Project::NAME, version: Project::VERSION, author: Project::AUTHOR, maintainer: Project::AUTHOR,
      sentence: "#{Project::SENTENCE}.", paragraph: Project::PARAGRAPH, category: 'Signal Input/Output',
      url: Project::ADDRESS || Project::PLACEHOLDER, architectures: '*', includes: Project::FIRST_HEADERS.join(','),
      license: Project::LICENSE }.map { |name, value| "#{name}=#{value}\n" }.join
  end

  # `homepage` may be left out.
  def platformio
    json(name: Project::NAME, version: Project::VERSION, description: Project::SENTENCE, keywords: Project::KEYWORDS,
         homepage: Project::ADDRESS, license: Project::LICENSE, headers: Project::FIRST_HEADERS, frameworks: '*', platforms: '*',
         build: { includeDir: 'include', srcDir: 'src', flags: '-std=c99' }, export: { include: Project::USER_FILES },
         examples: examples('arduino').map { |base| { name: File.basename(base), base: base, files: Dir.children(base).sort } })
  end

  # `homepage` may be left out.
  def vcpkg
    json(name: Project::NAME, version: Project::VERSION, description: Project::SENTENCE, homepage: Project::ADDRESS,
         license: Project::LICENSE, dependencies: %w[vcpkg-cmake vcpkg-cmake-config].map { |name| { name: name, host: true } })
  end

  def json(fields)
    "#{JSON.pretty_generate(fields.compact)}\n"
  end

  # `url` may be left out.
  def esp_idf
    <<~TEXT.gsub(/^\n/, '')
      # SPDX-License-Identifier: MIT
      version: #{Project::VERSION}
      description: #{Project::SENTENCE}
      #{Project::ADDRESS && "url: #{Project::ADDRESS}"}
      license: #{Project::LICENSE}
      tags: [#{Project::KEYWORDS.join(', ')}]
      examples:
      #{indented(examples('esp-idf'), '  - path: ')}
      dependencies:
        idf: ">=4.4"
    TEXT
  end

  def zephyr
    <<~TEXT
      # SPDX-License-Identifier: MIT
      name: #{Project::NAME}
      build:
        cmake: zephyr
        kconfig: zephyr/Kconfig
      samples:
        - examples/zephyr
    TEXT
  end

  def features
    File.read('include/fixpid_pid.h')[/^#define FIXPID_PID_ALL (0x\h+)u$/, 1]
  end

  # `homepage` may be left out.
  def conan
    fields = { name: Project::NAME, version: Project::VERSION, description: Project::SENTENCE, homepage: Project::ADDRESS,
               license: Project::LICENSE }.compact
    files = Project::SMALL_FILES.map { |path| File.directory?(path) ? "#{path}/*" : path }
    fields.map { |name, value| "    #{name} = \"#{value}\"\n" }.join +
      { topics: Project::KEYWORDS, exports_sources: files }.map { |name, values| "    #{name} = (#{quoted(values).join(', ')})\n" }.join
  end

  # `url` may be empty for a pack that is on no server.
  def cmsis_pack
    <<~TEXT
      <?xml version="1.0" encoding="UTF-8"?>
      <!-- SPDX-License-Identifier: MIT -->
      <package schemaVersion="1.7.36" xmlns:xs="http://www.w3.org/2001/XMLSchema-instance" xs:noNamespaceSchemaLocation="PACK.xsd">
        <vendor>#{Project::NAME}</vendor>
        <name>#{Project::NAME}</name>
        <description>#{Project::SENTENCE}</description>
        <url>#{Project::ADDRESS}</url>
        <license>LICENSE</license>
        <licenseSets>
          <licenseSet id="all" default="true" gating="true">
            <license title="#{Project::LICENSE}" name="LICENSE" spdx="#{Project::LICENSE}"/>
          </licenseSet>
        </licenseSets>
        <releases>
          <release version="#{Project::VERSION}">CHANGELOG.md says what is new.</release>
        </releases>
        <keywords>
      #{Project::KEYWORDS.map { |word| "    <keyword>#{word}</keyword>" }.join("\n")}
        </keywords>
        <conditions>
      #{conditions}  </conditions>
        <taxonomy>
          <description Cclass="Control">Controllers</description>
        </taxonomy>
        <components>
      #{Modules::ALL.map { |name, entry| component(name, entry) }.join}  </components>
      </package>
    TEXT
  end

  # The components without which one does not compile, or does not link.
  def required(name)
    (Modules.needs(name) | Modules::ALL.fetch(name).fetch(:uses, [])).map { |other| Modules::ALL.fetch(other)[:title] }
  end

  def conditions
    Modules::ALL.keys.map { |name| required(name) }.reject(&:empty?).uniq.map do |titles|
      <<-TEXT
    <condition id="#{titles.join(' and ')}">
#{titles.map { |title| "      <require Cclass=\"Control\" Cgroup=\"fixpid\" Csub=\"#{title}\"/>\n" }.join}    </condition>
      TEXT
    end.join
  end

  def component(name, entry)
    titles = required(name)
    condition = " condition=\"#{titles.join(' and ')}\"" unless titles.empty?
    sources = Project::PORTABLE_SOURCES.grep(%r{\Asrc/#{name}/})
    <<-TEXT
    <component Cclass="Control" Cgroup="fixpid" Csub="#{entry[:title]}" Cversion="#{Project::VERSION}"#{condition}>
      <description>#{entry[:what]}</description>
      <files>
        <file category="include" name="include/"/>
        <file category="header" name="include/fixpid_#{name}.h"/>
#{sources.map { |source| "        <file category=\"source\" name=\"#{source}\"/>\n" }.join}      </files>
    </component>
    TEXT
  end
end

# What is wrong with the manifests, as lines that a person can read.
module ManifestFaults
  UPDATE = 'ruby tools/lib/manifests.rb --update'
  LINES_MOST = 10
  CHARACTERS_MOST = 120
  BY_HAND = %w[CHANGELOG.md README.md docs/installing.md zephyr/CMakeLists.txt].freeze

  module_function

  # {manifest => its faults}
  def all
    found = Hash.new { |hash, path| hash[path] = [] }
    Manifests.written.each { |path, text| found[path].concat(differences(path, text)) }
    missing(BY_HAND).each { |path| found[path] << 'it is gone' }
    found['tools/lib/modules.rb'].concat(Modules.lacks)
    by_hand.each { |path, what, faults| found[path].concat(faults.empty? ? [] : ["#{what}: #{faults.join(', ')}"]) }
    found
  end

  def text(path)
    File.exist?(path) ? File.read(path) : ''
  end

  def differences(path, wanted)
    return ["it is gone#{"; #{UPDATE}" if wanted}"] unless File.exist?(path)
    return lost(path) unless wanted
    return [] if File.read(path) == wanted

    output, = Open3.capture2('diff', '-U0', path, '-', stdin_data: wanted)
    lines = output.lines(chomp: true).drop(2).grep_v(/\A(?:@@|\\)/).map { |line| shown(line) }
    more = lines.size > LINES_MOST ? ["and #{lines.size - LINES_MOST} lines more"] : []
    [*lines.first(LINES_MOST), *more, UPDATE]
  end

  def shown(line)
    text = "#{line[0]} #{line[1..].strip.squeeze("\t ").tr("\t", ' ')}"
    text.size > CHARACTERS_MOST ? "#{text[0, CHARACTERS_MOST]}..." : text
  end

  # What --update finds no place for.
  def lost(path)
    text = File.read(path)
    Manifests.parts.fetch(path).reject { |_, place, _| text.match?(place) }
             .map { |what, place, _| "no place for the #{what}: nothing is like #{place.inspect}" }
  end

  # [file, what, what is wrong with that] of what no tool can write.
  def by_hand
    headers = Dir['src/*.h'] - Manifests::FORWARDS.keys
    sketches = Manifests.examples('arduino').map { |folder| "#{folder}/#{File.basename(folder)}.ino" }
    [*headers.map { |path| [path, 'not in include', [path]] },
     ['CMakeLists.txt', 'sources in no folder of src', Dir['src/**/*.c'] - Project::SOURCES],
     ['CHANGELOG.md', "newest version, which is not #{Project::VERSION}", [text('CHANGELOG.md')[/^## ([^\s,]+)/, 1]] - [Project::VERSION]],
     ['tools/lib/project.rb', 'files that are not there', missing([*Project::USER_FILES, *Project::FIRST_HEADERS.map { |name| "include/#{name}" }])],
     ['library.properties', 'sketches that are not there', missing(sketches)],
     ['library.properties', 'sketches without a folder of their name', Dir['examples/arduino/*/*.ino'] - sketches],
     ['zephyr/module.yml', 'files that are not there', missing(%w[zephyr/CMakeLists.txt zephyr/Kconfig examples/zephyr])],
     ['zephyr/CMakeLists.txt', 'options that it or zephyr/Kconfig does not have', options], *installing]
  end

  def without_the_other(some, others)
    (some | others) - (some & others)
  end

  def missing(paths)
    paths.reject { |path| File.exist?(path) }
  end

  # An option that a file reads is one.
  def options
    asked, read = [['zephyr/Kconfig', /^(?:menu)?config (\w+)$/], ['zephyr/CMakeLists.txt', /CONFIG_(\w+)/]].map do |path, name|
      text(path).scan(name).flatten.uniq
    end
    without_the_other(asked, read)
  end

  # Each way to install names tests that there are, and README.md has a line of each.
  def installing
    page = 'docs/installing.md'
    tests = `test/use/packages/run --list; test/use/consumers/run --list`.split
    named = ways(page).to_h { |cells| [cells.first, cells.last.scan(/`(\w+)`/).flatten] }
    [[page, 'ways to install', named.empty? ? ['none between the marks of its table'] : []],
     [page, 'ways to install without a test', named.select { |_, names| names.empty? }.keys],
     [page, 'tests that are not there', named.values.flatten - tests],
     ['README.md', "ways to install that it or #{page} does not have", without_the_other(named.keys, ways('README.md').map(&:first))]]
  end

  # The cells of its table, by rows.
  def ways(page)
    rows = text(page)[/<!-- install:begin -->.*?<!-- install:end -->/m].to_s.lines.grep(/^\| (?!with |-)/)
    rows.map { |row| row.split('|')[1...-1].map(&:strip) }
  end
end

if $PROGRAM_NAME == __FILE__
  Manifests.written.compact.each { |path, text| File.write(path, text) } if ARGV == ['--update']
  wrong = ManifestFaults.all
  wrong.each do |path, faults|
    puts faults.empty? ? "ok #{path}" : "FAILED #{path}: #{faults.join(faults.size > 2 ? "\n    " : '; ')}"
  end
  exit(wrong.values.all?(&:empty?) ? 0 : 1)
end

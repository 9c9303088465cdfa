# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What package managers read of this project, their manifests, says what the
# project itself says: the version of include/fixpid.h, the sources of
# CMakeLists.txt, the headers of include/, and what the library is as
# library.properties has it. Prints `ok MANIFEST` or `FAILED MANIFEST` and why. With
# --update it first writes those that are made from the headers.
require 'json'
require 'yaml'

Encoding.default_external = 'UTF-8'

module Manifests
  SOURCES = File.read('CMakeLists.txt')[/set\(fixpid_sources\s(.*?)\)/m, 1].split.freeze
  HEADERS = Dir['include/*.h'].sort.freeze
  VERSION = File.read('include/fixpid.h').scan(/^#define FIXPID_VERSION_\w+ (\d+)$/).join('.').freeze
  # What all manifests have in common is here once.
  PROPERTIES = File.readlines('library.properties', chomp: true).to_h { |line| line.split('=', 2) }.freeze
  DESCRIPTION = PROPERTIES['sentence'].chomp('.').freeze

  # What a program's sources take in, and below what a package manager's users get.
  SMALL_FILES = %w[CMakeLists.txt LICENSE fixpid.pc.in include meson.build src].freeze
  USER_FILES = JSON.parse(File.read('library.json'))['export']['include'].freeze

  # Arduino looks for headers in src/ only.
  FORWARDS = HEADERS.to_h do |header|
    ["src/#{File.basename(header)}", <<~TEXT]
      // SPDX-License-Identifier: MIT
      // For Arduino, which looks for headers in src/ only.
      #include "../#{header}"
    TEXT
  end.freeze

  class << self
    def written
      FORWARDS.merge('keywords.txt' => keywords)
    end

    # {manifest => what is wrong with it}
    def wrong
      @wrong = Hash.new { |hash, path| hash[path] = [] }
      version_and_sources
      written.each { |path, text| same(path, 'what --update writes', text, File.exist?(path) ? File.read(path) : nil) }
      arduino
      meson
      platformio
      esp_idf
      zephyr
      cmsis_pack
      conan_and_vcpkg
      readme
      @wrong
    end

    private

    def same(path, what, wanted, found)
      @wrong[path] << "#{what}: #{found.inspect}, not #{wanted.inspect}" unless found == wanted
      @wrong[path]
    end

    # Every file or folder is there.
    def there(path, what, files)
      missing = files.reject { |file| File.exist?(file) }
      same(path, "#{what} that are not there", [], missing)
    end

    def version_and_sources
      same('CMakeLists.txt', 'sources', Dir['src/**/*.c'].sort, SOURCES.sort)
      same('CHANGELOG.md', 'newest version', VERSION, File.read('CHANGELOG.md')[/^## ([^\s,]+)/, 1])
    end

    # The words that the editor colours: types, functions, and the constants.
    def keywords
      text = HEADERS.map { |header| File.read(header).gsub(%r{//.*}, '') }.join
      types = text.scan(/^(?:struct|enum) (fixpid_\w+) \{/)
      functions = text.scan(/^\w[\w *]*\b(fixpid_\w+)\(/)
      constants = text.scan(/^#define (FIXPID_\w+) (?:UINT32_C\()?\d/) + text.scan(/^ +(FIXPID_\w+)(?: = \w+)?,?\s*$/)
      { 'KEYWORD1' => types, 'KEYWORD2' => functions, 'LITERAL1' => constants }.flat_map do |kind, words|
        words.flatten.uniq.sort.map { |word| "#{word}\t#{kind}\n" }
      end.join
    end

    def arduino
      path = 'library.properties'
      same(path, 'version', VERSION, PROPERTIES['version'])
      there(path, 'headers', PROPERTIES['includes'].split(',').map { |header| "include/#{header}" })
      same(path, 'headers in src/', FORWARDS.keys, Dir['src/fixpid*.h'].select { |file| HEADERS.include?("include/#{File.basename(file)}") }.sort)
      sketches = Dir['examples/arduino/*']
      same(path, 'sketches', sketches.map { |folder| "#{folder}/#{File.basename(folder)}.ino" }, Dir['examples/arduino/*/*.ino'])
    end

    def common(path, version, description, url, license)
      same(path, 'version', VERSION, version)
      same(path, 'description', DESCRIPTION, description)
      same(path, 'URL', PROPERTIES['url'], url)
      same(path, 'licence', PROPERTIES['license'], license)
    end

    def meson
      path = 'meson.build'
      text = File.read(path)
      same(path, 'version', VERSION, text[/version: '([\d.]+)'/, 1])
      same(path, 'sources', SOURCES, text.scan(%r{'(src/\S+\.c)'}).flatten)
      same('fixpid.pc.in', 'description', DESCRIPTION, File.read('fixpid.pc.in')[/^Description: (.*)/, 1])
    end

    def platformio
      path = 'library.json'
      library = JSON.parse(File.read(path))
      common(path, *library.values_at('version', 'description', 'homepage', 'license'))
      same(path, 'headers', PROPERTIES['includes'].split(','), library['headers'])
      there(path, 'exported files', USER_FILES)
      same(path, 'examples', Dir['examples/arduino/*'].sort, library['examples'].map { |example| example['base'] }.sort)
      there(path, 'files of examples', library['examples'].flat_map { |example| example['files'].map { |file| "#{example['base']}/#{file}" } })
    end

    def esp_idf
      path = 'idf_component.yml'
      component = YAML.safe_load(File.read(path))
      common(path, *component.values_at('version', 'description', 'url', 'license'))
      same(path, 'examples', Dir['examples/esp-idf/*'].sort, component['examples'].map { |example| example['path'] })
    end

    # Its sources are all that there are; an option that a file reads is one.
    def zephyr
      path = 'zephyr/module.yml'
      parts = YAML.safe_load(File.read(path))
      same(path, 'keys', %w[name build samples], parts.keys)
      there(path, 'files', ["#{parts['build']['cmake']}/CMakeLists.txt", parts['build']['kconfig'], *parts['samples']])
      options = File.read('zephyr/Kconfig').scan(/^(?:menu)?config (\w+)$/).flatten
      same('zephyr/CMakeLists.txt', 'options', options.sort, File.read('zephyr/CMakeLists.txt').scan(/CONFIG_(\w+)/).flatten.uniq.sort)
    end

    # A component for each header. What is for SDCC on a PIC is in none.
    def cmsis_pack
      path = 'fixpid.fixpid.pdsc'
      text = File.read(path)
      common(path, text[/<release version="(.*?)"/, 1], *%w[description url].map { |tag| text[%r{<#{tag}>(.*?)</}, 1] }, text[/spdx="(.*?)"/, 1])
      same(path, 'versions of components', [VERSION], text.scan(/Cversion="(.*?)"/).flatten.uniq)
      files = text.scan(/<file category="(\w+)" name="(.*?)"/).group_by(&:first).transform_values { |pairs| pairs.map(&:last) }
      same(path, 'sources', SOURCES.grep_v(%r{/pic1[48]/}).sort, files['source'].sort)
      same(path, 'headers', HEADERS - ['include/fixpid.h'], files['header'].sort)
      there(path, 'files', files['include'].uniq)
    end

    def conan_and_vcpkg
      conan = File.read('conanfile.py')
      common('conanfile.py', *%w[version description homepage license].map { |name| conan[/^    #{name} = "(.*)"$/, 1] })
      same('conanfile.py', 'exported files', SMALL_FILES, conan[/exports_sources = \((.*?)\)/m, 1].scan(/"(.*?)"/).flatten.map { |name| name.chomp('/*') })
      port = JSON.parse(File.read('vcpkg/fixpid/vcpkg.json'))
      common('vcpkg/fixpid/vcpkg.json', *port.values_at('version', 'description', 'homepage', 'license'))
    end

    # Each way to install names tests that there are.
    def readme
      rows = File.read('README.md')[/<!-- install:begin -->(.*?)<!-- install:end -->/m, 1].lines.grep(/^\| (?!with |-)/)
      tests = `test/packages/run --list; test/consumers/run --list`.split
      named = rows.map { |row| row.split('|').last(2).first.scan(/`(\w+)`/).flatten }
      same('README.md', 'ways to install without a test', 0, named.count(&:empty?))
      same('README.md', 'tests that are not there', [], named.flatten - tests)
    end
  end
end

if $PROGRAM_NAME == __FILE__
  Manifests.written.each { |path, text| File.write(path, text) } if ARGV == ['--update']
  wrong = Manifests.wrong
  wrong.each { |path, faults| puts faults.empty? ? "ok #{path}" : "FAILED #{path}: #{faults.join("\n    ")}" }
  exit(wrong.values.all?(&:empty?) ? 0 : 1)
end

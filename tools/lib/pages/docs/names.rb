# SPDX-License-Identifier: MIT
require_relative '../../manifests'

# What is written down more than once, and what the documents name.
module DocumentNames
  FOLDERS = %w[docs examples include port python sim src test tools].freeze
  DOCUMENTS = Dir['*.md', 'docs/**/*.md', 'web/site/*.md', '*.yml', 'test/**/*.yml'].sort.freeze
  FILES = Dir["{#{FOLDERS.join(',')}}/**/*", '*'].sort.freeze
  SOURCES = FILES.grep(%r{\A(?:#{FOLDERS.join('|')})/}).grep_v(/\.(?:md|png|csv)\z/).select { |path| File.file?(path) }.freeze
  EXTENSIONS = 'c|h|cc|hh|asm|rb|sh|cmake|txt|csv|yml|md|json'.freeze

  # Names in documents of what is not among this project's files.
  ELSEWHERE = {
    'fixpid_pid_single.h' => 'made by tools/release',
    'fixpid_..._single.h' => 'made by tools/release',
    'fixpid-VERSION.spdx.json' => 'made by tools/release',
    'fixpid-VERSION-commit.txt' => 'made by tools/release',
    'build_flags' => 'of PlatformIO',
    'fixpid_config.h' => "the user's own",
    'arm_pid_q15' => 'of CMSIS-DSP',
    'arm_pid_init_q15' => 'of CMSIS-DSP',
    'arm_pid_reset_q15' => 'of CMSIS-DSP',
    'report_tests_pretty_stdout' => 'of Ceedling'
  }.freeze

  class << self
    def failures
      manifests + DOCUMENTS.flat_map { |path| names(path) + meson(path) }
    end

    private

    # The version and the sources are those of the manifests.
    def manifests
      ManifestFaults.all.flat_map { |path, faults| faults.map { |fault| "#{path}: #{fault}" } }
    end

    # What a project of Meson asks for is what meson.build gives.
    def meson(path)
      given = File.read('meson.build')[/override_dependency\('([^']+)'/, 1]
      (File.read(path).scan(/\bdependency\('([^']+)'/).flatten.uniq - [given]).map { |name| "#{path}: Meson has no dependency #{name}" }
    end

    # In a document what stands in backticks, in YAML everything.
    def names(path)
      text = File.read(path).gsub(/^```.*?^```$/m, '')
      words = path.end_with?('.yml') ? text : text.scan(/`([^`]+)`/).join("\n")
      words.split(/[\s"',;()]+/).uniq.map { |word| name(word.sub(/[.:]+\z/, '')) }.compact
           .map { |word| "#{path}: no #{word}" }
    end

    # The word, if it names a file, a function or a macro that does not exist. In
    # a name `...`, `*`, capitals and a single x, as in fixpid_x.h, are any part.
    def name(word)
      pattern = word.delete_prefix('-:').delete_prefix('+:').gsub('...', '*').gsub(/[A-Z]{4,}|(?<=_)x(?=[_.*])/, '*')
      macro = word[/FIXPID_\w+(?<!_)/]
      known = if ELSEWHERE.key?(word) then true
              elsif macro then identifiers.include?(macro)
              elsif pattern.match?(%r{\A(?:#{FOLDERS.join('|')})/}) then Dir[pattern].any?
              elsif pattern.match?(/\A[\w.*-]+\.(?:#{EXTENSIONS})\z/) then file?(pattern)
              elsif pattern.match?(/\A[a-z][a-z0-9]*(?:_[a-z0-9]+)+\z/) then identifiers.include?(pattern)
              else true
              end
      known ? nil : word
    end

    def file?(pattern)
      FILES.any? { |path| File.fnmatch(pattern, File.basename(path)) }
    end

    # Every identifier of the sources, and the tests that a row of test/matrix.txt stands for.
    def identifiers
      @identifiers ||= (SOURCES.flat_map { |path| File.read(path, encoding: 'BINARY').scan(/\w+/) } + `test/use/consumers/run --list`.split).to_h { |word| [word, true] }
    end
  end
end

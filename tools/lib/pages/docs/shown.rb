# SPDX-License-Identifier: MIT
require_relative '../../project'

# Files that a document shows whole, between markers that name them: what a page tells people to
# write is what a test builds. A page for beginners shows no other code but C, which is compiled.
module Shown
  MARKED = /^<!-- shown (\S+):begin -->\n.*?^<!-- shown \1:end -->\n/m.freeze
  GENERATED = /^<!-- (\w+):begin -->\n.*?^<!-- \1:end -->\n/m.freeze
  BEFORE = /<!-- shown \S+:begin -->\n\z/.freeze # a block that is a file's
  LANGUAGES = { '.c' => 'c', '.ino' => 'cpp', '.txt' => 'cmake', '.conf' => 'ini',
                '.asm' => 'nasm', '.yml' => 'yaml' }.freeze
  BEGINNERS = %r{\A(?:docs/start/|web/site/)}.freeze
  OF_THE_PROJECT = %w[python sim test tools web].freeze # folders that no archive for users has
  RELEASED = /^  (\S+) {2,}(.*(?:\n {33}.*)*)/.freeze # in the usage of tools/release

  class << self
    def renewed(text)
      text.gsub(MARKED) { "<!-- shown #{$1}:begin -->\n#{block($1)}<!-- shown #{$1}:end -->\n" }
    end

    def failures(path, text)
      return [] unless path.match?(BEGINNERS)

      text.gsub(MARKED, '').gsub(GENERATED, '').scan(/^```(\w*)$.*?^```$/m).flatten.reject { |language| language == 'c' }
          .map { |language| "#{path}: a block of #{language.empty? ? 'no language' : language} shows no file" }
    end

    # The newest heading of the changelog: version and day.
    def version
      "Version #{File.read('CHANGELOG.md')[/^## (.*)$/, 1]}: [what is new](%s).\n"
    end

    # What tools/release says that it makes.
    def released
      rows = File.read('tools/release')[/^Makes these files in .*?\n\n(.*?)\n\n/m, 1].scan(RELEASED)
      "| file | what it is |\n|---|---|\n#{rows.map { |name, what| "| `#{name}` | #{what.split.join(' ')} |\n" }.join}"
    end

    # Which archive has which folder: those of users, and the others of the project.
    def folders
      small = directories(Project::SMALL_FILES)
      users = directories(Project::USER_FILES) - small
      rows = { small => 'the .tar.xz, the .zip and the archive of the source', users => 'the .zip and the archive of the source',
               OF_THE_PROJECT => 'the archive of the source' }
      "| folders | are in |\n|---|---|\n#{rows.map { |names, where| "| #{names.sort.map { |name| "`#{name}/`" }.join(', ')} | #{where} |\n" }.join}"
    end

    private

    def directories(paths)
      paths.select { |path| File.directory?(path) }
    end

    # Without the line of the licence.
    def block(path)
      lines = File.readlines(path).reject { |line| line.match?(/\A(?:#|\/\/|;) SPDX-/) }
      "```#{LANGUAGES.fetch(File.extname(path))}\n#{lines.join}```\n"
    end
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# For the tests of the tools that judge: a small tree of files in which one of them
# runs, and `ok` or `FAILED` for each case. A result that is a Proc is of a case that
# runs only when it is asked for: see `ruby test/tools/gates/parts.rb --list`. The tests
# of tools/cost and tools/demo have their cases and their words from here, too.
require 'fileutils'
require 'open3'
require 'tmpdir'

PROJECT = File.expand_path('../../..', __dir__)
require "#{PROJECT}/tools/lib/test/named"

# As on a machine that no locale was chosen for.
Encoding.default_external = 'UTF-8'
ENV['LC_ALL'] = 'C'

module Gate
  @tests = NamedTests.new(File.expand_path($PROGRAM_NAME).delete_prefix("#{PROJECT}/"), 1)

  class << self
    # In a folder with these files, which is there while the block runs.
    def tree(files)
      Dir.mktmpdir do |folder|
        files.each { |path, text| write("#{folder}/#{path}", text) }
        Dir.chdir(folder) { yield folder }
      end
    end

    # The project, without what was built.
    def copy(folder)
      FileUtils.mkdir_p(folder)
      FileUtils.cp_r(Dir.children(PROJECT).reject { |name| %w[build .git].include?(name) }
                        .map { |name| "#{PROJECT}/#{name}" }, folder)
    end

    # Another text in a file.
    def seed(path, text, instead)
      before = File.read(path)
      after = before.sub(text) { instead }
      after == before and abort "FAILED nothing to seed in #{path}: #{text}"
      File.write(path, after)
    end

    def write(path, text)
      FileUtils.mkdir_p(File.dirname(path))
      FileUtils.rm_f(path) if File.symlink?(path) # to a program of the machine's
      File.write(path, text)
      File.chmod(0o755, path) if text.start_with?('#!')
    end

    # [what it said, whether it succeeded]; with these programs before all others.
    def run(*command, programs: nil)
      environment = programs ? { 'PATH' => "#{programs}:#{ENV.fetch('PATH')}" } : {}
      output, status = Open3.capture2e(environment, *command, close_others: true)
      [output, status.success?]
    end

    # It must have failed, and said why.
    def refused(what, result, *said)
      judge(what, result) { |output, success| success ? "it passed:\n#{output}" : unsaid(output, said) }
    end

    # Whether or not it failed.
    def said(what, result, *patterns)
      judge(what, result) { |output, _| unsaid(output, patterns) }
    end

    def passed(what, result)
      judge(what, result) { |output, success| output unless success }
    end

    # What is wanted is a value, a range, or a pattern of a text.
    def expect(what, found, wanted)
      judge(what, found.is_a?(Proc) ? -> { [found.call] } : [found]) { |one| "#{one.inspect}, not #{wanted.inspect}" unless wanted === one }
    end

    def finish
      Dir.chdir(PROJECT)
      exit @tests.run(ARGV)
    end

    private

    def unsaid(output, patterns)
      missing = patterns.reject { |pattern| output.match?(pattern) }
      "not said: #{missing.inspect} in\n#{output}" unless missing.empty?
    end

    # The block says what is wrong.
    def judge(what, result)
      @tests.add(what) do
        wrong = yield(*(result.is_a?(Proc) ? result.call : result))
        raise wrong if wrong
      end
    end
  end
end

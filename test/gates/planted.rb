# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# For the tests of the tools that judge: a small tree of files in which one of them
# runs, and `ok` or `FAILED` for each case.
require 'fileutils'
require 'open3'
require 'tmpdir'

PROJECT = File.expand_path('../..', __dir__)

module Planted
  @good = true

  class << self
    # In a folder with these files, which is there while the block runs.
    def tree(files)
      Dir.mktmpdir do |folder|
        files.each { |path, text| write("#{folder}/#{path}", text) }
        Dir.chdir(folder) { yield folder }
      end
    end

    def write(path, text)
      FileUtils.mkdir_p(File.dirname(path))
      File.write(path, text)
      File.chmod(0o755, path) if text.start_with?('#!')
    end

    # [what it said, whether it succeeded]; with these programs before all others.
    def run(*command, programs: nil)
      environment = programs ? { 'PATH' => "#{programs}:#{ENV.fetch('PATH')}" } : {}
      output, status = Open3.capture2e(environment, *command)
      [output, status.success?]
    end

    # It must have failed, and said why.
    def refused(what, result, *said)
      output, success = result
      missing = said.reject { |pattern| output.match?(pattern) }
      tell(what, !success && missing.empty?, success ? "it passed:\n#{output}" : "not said: #{missing.inspect} in\n#{output}")
    end

    def passed(what, result)
      output, success = result
      tell(what, success, output)
    end

    def expect(what, found, wanted)
      tell(what, found == wanted, "#{found.inspect}, not #{wanted.inspect}")
    end

    def finish
      exit(@good ? 0 : 1)
    end

    private

    def tell(what, good, why)
      puts good ? "ok #{what}" : "FAILED #{what}: #{why}"
      @good &&= good
    end
  end
end

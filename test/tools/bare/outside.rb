# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The scripts that may install something, and what a person sees of one whose programs
# are missing: what it installs, or what he has to, and a sentence at the end.
require 'open3'

module Outside
  # Of those that stop without any, before they ask for a program.
  ARGUMENTS = {
    'tools/release' => %w[--snapshot], 'tools/test' => %w[docs],
    'tools/lib/build/build_avr' => %w[atmega328p build/none none.c], 'tools/lib/build/build_pic' => %w[pic18f4520 build/none none.c],
    'tools/lib/build/build_sdcc' => %w[build/none],
    'tools/lib/test/kept' => %w[none true], 'tools/lib/build/one_bank' => %w[check build/none]
  }.freeze
  SHELL_ERROR = /: \d+: .*(?:not found|not set|bad |Bad |unexpected)|command not found/.freeze
  # What a tool says, or the end of a runner's list.
  SENTENCE = /\A(?:[a-z][\w.-]*: \w.*|FAILED .+|\d+ passed, \d+ failed.*)\z/.freeze

  Run = Struct.new(:output, :status, :asked, keyword_init: true)

  class << self
    # Those that ask for a program, or name a script that does.
    def scripts
      texts = Dir.glob('{.ci,tools,test}/**/*').select { |path| File.file?(path) }
                 .to_h { |path| [path, File.binread(path)] }
                 .select { |_, text| text.match?(%r{\A#!/bin/sh$|^# shellcheck shell=sh$}) }
                 .transform_values { |text| text.gsub(/^ *#.*/, '') }
      texts.delete('tools/lib/setup.sh') # which says how they ask
      found = texts.keys.select { |path| texts[path].match?(/^ *(?:need\w*|build_gpsim)\b/) }
      loop do
        more = (texts.keys - found).select { |path| found.any? { |other| texts[path].include?(other) } }
        return found.select { |path| File.executable?(path) }.sort if more.empty?

        found += more
      end
    end

    # Runs a script in dash by a command that begins with `into`, with the programs of `path`
    # and no Python. `record` is what the apt-get there writes.
    def run(script, path:, record:, into: [])
      File.write(record, '')
      environment = { 'PATH' => path, 'HOME' => '/nonexistent', 'PYTHON' => '/nonexistent' }
      output, status = Open3.capture2e(environment, *into, 'dash', script, *ARGUMENTS[script],
                                       8 => :close, unsetenv_others: true, in: '/dev/null')
      Run.new(output: output.scrub, status: status.exitstatus, asked: File.read(record))
    end

    # Records what it is asked for, and has nothing.
    def apt_get(record)
      "#!/bin/sh\necho \"$*\" >>#{record}\n[ \"$1\" = update ] || { echo 'E: not found' >&2; exit 100; }\n"
    end

    # Another program has the lock when it is asked so many times.
    def locked_apt_get(record, times)
      "#!/bin/sh\necho \"$*\" >>#{record}\n[ $(wc -l <#{record}) -gt #{times} ] || {\n" \
        "    echo 'E: Could not get lock /var/lib/apt/lists/lock. It is held by process 7 (apt)' >&2\n    exit 100\n}\n"
    end

    # What is wrong with what root saw: nothing may be installed that was not said.
    def complaints_of_root(run)
      said = run.output.scan(/^[\w.-]+: installing (.+) \(Debian packages\)$/).flatten
      wrong = complaints(run)
      wrong << 'does not say what it installs' if said.empty?
      asked = run.asked.scan(/^install .*--no-install-recommends (.+)$/).flatten
      wrong << "asks for other packages than it says: #{asked}, #{said}" unless (asked - said).empty?
      wrong << 'asks apt-get for nothing' if asked.empty?
      wrong
    end

    # And of what another user did, who cannot install.
    def complaints_of_user(run)
      wrong = complaints(run)
      wrong << "asks apt-get: #{run.asked}" unless run.asked.empty?
      run.output.match?(/: missing: .+; not root, so please run: sudo apt-get install|^skipped \w+: not root$/) or
        wrong << 'does not say what is missing'
      wrong
    end

    private

    def complaints(run)
      last = run.output.lines(chomp: true).last.to_s
      wrong = []
      wrong << "ends with status #{run.status.inspect}" unless [0, 1].include?(run.status)
      wrong << 'says nothing' if last.empty?
      wrong << "the shell says: #{run.output[/.*#{SHELL_ERROR}.*/]}" if run.output.match?(SHELL_ERROR)
      wrong << "no sentence at the end: #{last}" unless last.empty? || last.match?(SENTENCE) || last.start_with?('skipped ')
      wrong
    end
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../build/inputs'

# What is in the sight of a runner whose verdict tools/test remembers (once.rb): every file
# of the tree but those that no test can read, and the programs that it starts. There is no
# list of what a runner reads, which somebody would have to complete. In the sight `whole`
# are all files, what git has, and all that Debian and the user's cache have.
module Sights
  # What git has and what is built, of whatever folder; and what is only for people, for
  # Python and for a browser.
  UNSEEN = %w[.git build docs python web .github].freeze
  UNSEEN_NAMES = /\A(?:README|CHANGELOG|CONTRIBUTING|SECURITY)\.md\z/.freeze
  PROGRAMS = {
    'unit' => %w[ceedling gcc gcov gcovr python3],
    'avr' => %w[ceedling avr-gcc simavr],
    'sanitize' => %w[ceedling clang gcc ld],
    'target' => %w[gcc g++ gpasm gplink avr-gcc simavr arm-none-eabi-gcc qemu-system-arm riscv64-unknown-elf-gcc
                   qemu-system-riscv32],
    'families' => %w[gcc g++ gpasm gplink avr-gcc simavr sdcc clang ld.lld mspdebug],
    'whole' => %w[ceedling]
  }.freeze
  # Those whose simulators and tools are many take all that Debian has installed.
  OF_DEBIAN = %w[target families whole].freeze
  # What they read of what the others do not see.
  SEEN = { 'target' => %w[docs/chips.md], 'families' => %w[docs/chips.md], 'whole' => %w[*.md {docs,python,web,.github}/**/*] }.freeze
  # What parts.sh makes in build/ before it calls the runner; the runner's words name the rest.
  MADE = { 'avr' => %w[build/avr/**/*] }.freeze

  class << self
    # For Remembered.
    def of(sight)
      tools = PROGRAMS.fetch(sight).flat_map { |name| Inputs.tool(name) }
      tools += Inputs.gem('ceedling') if PROGRAMS.fetch(sight).include?('ceedling')
      tools += [*Inputs.sdcc, ENV['SPDK'], '/var/lib/dpkg/status'].compact if OF_DEBIAN.include?(sight)
      tools += Inputs.sealed if sight == 'whole'
      { files: tree + MADE.fetch(sight, []) + SEEN.fetch(sight, []), tools: tools + Inputs.c_library, words: [tracked(sight)] }
    end

    # A release has what git has.
    def tracked(sight)
      sight == 'whole' ? `git ls-files 2>/dev/null` : ''
    end

    # Patterns of all files that can be seen.
    def tree
      names = Dir.children('.').reject { |name| UNSEEN.include?(name) || UNSEEN_NAMES.match?(name) }
      names.sort.flat_map { |name| [name, "#{name}/**/*"] }
    end
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../build/inputs'

# What is in the sight of a runner whose verdict tools/test remembers (once.rb): the files
# that it reads and the programs that it starts. What is missing here changes, and nobody
# looks; so a folder is rather named as a whole.
module Sights
  LIBRARY = %w[include/**/* src/**/*].freeze
  UNIT = [*LIBRARY, *%w[project.yml port/**/* sim/**/* examples/**/* test/unit/**/* test/support/**/* test/tools/cost/**/* test/model/**/*
                        tools/lib/test/ceedling tools/lib/modules.rb]].freeze
  FILES = {
    'unit' => UNIT,
    'avr' => [*UNIT, 'test/chips/avr/**/*', 'tools/lib/setup.sh'],
    'sanitize' => UNIT
  }.freeze
  PROGRAMS = {
    'unit' => %w[ceedling gcc gcov gcovr],
    'avr' => %w[ceedling avr-gcc simavr],
    'sanitize' => %w[ceedling clang ld]
  }.freeze

  # For Remembered.
  def self.of(sight)
    tools = PROGRAMS.fetch(sight).flat_map { |name| Inputs.tool(name) }
    tools += Inputs.gem('ceedling') if PROGRAMS.fetch(sight).include?('ceedling')
    { files: FILES.fetch(sight), tools: tools + Inputs.c_library }
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What package managers say of fixpid, and what they take of it. It is written by hand
# here and nowhere else: `ruby tools/lib/manifests.rb --update` writes the manifests from
# it, the version from include/fixpid.h, and the sources from src/.
module Project
  NAME = 'fixpid'
  AUTHOR = 'The fixpid authors'
  LICENSE = 'MIT'
  SENTENCE = 'Fixed-point PID controllers with an autotuner, without float, for small chips'
  PARAGRAPH = "A general-purpose PID controller with anti-windup that follows the output's limits, manual and automatic " \
              'without a bump, a derivative filter and a setpoint weight; an autotuner that finds its gains on the plant; ' \
              "and the controllers of Microchip's application notes AN937 and AN964. Ramps, time-proportioned outputs for " \
              'relays, and tunings for the EEPROM stand beside them.'
  KEYWORDS = %w[pid control fixed-point autotune motor heater].freeze

  # Where the project is on the web. While that is nil, manifests leave it out, and the
  # one system that demands an address gets the placeholder.
  ADDRESS = nil
  PLACEHOLDER = 'https://example.org/fixpid'

  VERSION = File.read('include/fixpid.h').scan(/^#define FIXPID_VERSION_\w+ (\d+)$/).join('.').freeze
  HEADERS = Dir['include/*.h'].sort.freeze
  SOURCES = Dir['src/*/*.c'].sort.freeze
  # A PIC's assembly is for SDCC only, which knows none of these systems.
  PORTABLE_SOURCES = SOURCES.grep_v(/_pic1[48]\.c/).freeze

  # The headers that Arduino's "Include Library" writes into a sketch.
  FIRST_HEADERS = %w[fixpid_pid.h fixpid_autotune.h].freeze

  # What a program's sources take in, and below what a package manager's users get: with what
  # README.md links to.
  SMALL_FILES = %w[CMakeLists.txt LICENSE fixpid.pc.in include meson.build src].freeze
  NOT_SMALL = 'src/*.h'.freeze # of those: for Arduino only
  USER_FILES = [*SMALL_FILES, *%w[CHANGELOG.md CONTRIBUTING.md README.md SECURITY.md conanfile.py docs examples
                                  fixpid.fixpid.pdsc idf_component.yml keywords.txt library.json library.properties port
                                  python/README.md vcpkg zephyr]].sort.freeze
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The C that the page computes with, and how it is compiled to WebAssembly.
module Sources
  LIBRARY = (Dir['src/*/*.c'] - Dir['src/*/*_{pic14,pic18}.c']).sort.freeze
  PLANTS = Dir['sim/plant/plant_{motor,oven,pendulum,process}.c'].sort.freeze
  TUNER = ['sim/loops/pid_double.c', *Dir['sim/{identify,tuner}/*.c'].sort].freeze
  LINK = Dir['sim/link/*.c'].sort.freeze # the other end of a board
  PATHS = %w[-Isim/tuner/libm -Iinclude -Isrc -Isim/plant -Isim/loops -Isim/identify -Isim/tuner -Isim/link].freeze
  # Without contraction each operation rounds as IEEE 754 says, on every machine.
  EXACT = %w[-std=c99 -Wall -Wextra -Werror -ffp-contract=off].freeze

  INTERFACES = %w[sim/tuner/tuner.h sim/tuner/margins.h sim/identify/identify.h sim/identify/verdict.h sim/link/link_page.h].freeze

  class << self
    # Its functions are those of these headers.
    def wasm(output)
      exports = INTERFACES.flat_map { |path| File.read(path).scan(/^\w.*?((?:tuner_|live_|identify|verdict_sentence)\w*)\(/).flatten }
      ['clang', '--target=wasm32', '-O2', *EXACT, '-ffreestanding', '-nostdlib', '-mbulk-memory', *PATHS, *LIBRARY,
       *PLANTS, *TUNER, *LINK, '-Wl,--no-entry,--strip-all,--gc-sections',
       *exports.map { |name| "-Wl,--export=#{name}" }, '-o', output]
    end
  end
end

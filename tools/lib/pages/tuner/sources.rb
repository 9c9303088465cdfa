# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The C that the page computes with, and how it is compiled to WebAssembly.
module Sources
  LIBRARY = (Dir['src/*/*.c'] - Dir['src/*/*_{pic14,pic18}.c']).sort.freeze
  PLANTS = Dir['sim/plant/plant_{motor,oven,pendulum,process}.c'].sort.freeze
  TUNER = %w[sim/loops/pid_double.c sim/tuner/fit.c sim/tuner/params.c sim/tuner/scene.c sim/tuner/twin.c sim/tuner/tuner.c].freeze
  LINK = Dir['sim/link/*.c'].sort.freeze # the other end of a board
  PATHS = %w[-Isim/tuner/libm -Iinclude -Isrc -Isim/plant -Isim/loops -Isim/tuner -Isim/link].freeze
  # Without contraction each operation rounds as IEEE 754 says, on every machine.
  EXACT = %w[-std=c99 -Wall -Wextra -Werror -ffp-contract=off].freeze

  class << self
    # Its functions are those of tuner.h and link_page.h.
    def wasm(output)
      exports = %w[sim/tuner/tuner.h sim/link/link_page.h].flat_map { |path| File.read(path).scan(/^\S.*?((?:tuner|live)_\w+)\(/).flatten }
      ['clang', '--target=wasm32', '-O2', *EXACT, '-ffreestanding', '-nostdlib', '-mbulk-memory', *PATHS, *LIBRARY,
       *PLANTS, *TUNER, *LINK, '-Wl,--no-entry,--strip-all,--gc-sections',
       *exports.map { |name| "-Wl,--export=#{name}" }, '-o', output]
    end
  end
end

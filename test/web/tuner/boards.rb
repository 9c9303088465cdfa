# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Builds the board of the live card's test as WebAssembly: with the library, and with one
# whose sum of terms is 1/256 of a count less.
require 'fileutils'
require_relative '../../../tools/lib/pages/tuner/sources'

SUM = 'rounded_counts(SIGNALS.p_d_ff, SIGNALS.integral)'
EXPORTS = %w[in out begin run meddle retune kp setpoint].map { |name| "-Wl,--export=board_#{name}" }.freeze

def build(folder, source, output)
  system('clang', '--target=wasm32', '-O2', *Sources::EXACT, '-ffreestanding', '-nostdlib', '-mbulk-memory', "-I#{folder}/include", *Sources::PATHS,
         'test/web/tuner/board.c', *Dir["#{source}/{pid,link,record}/*.c"].grep_v(/_pic18/), '-Wl,--no-entry,--strip-all', *EXPORTS, '-o', output) || exit(1)
end

work = ARGV.fetch(0)
build('.', 'src', "#{work}/board.wasm")
FileUtils.rm_rf("#{work}/other")
FileUtils.mkdir_p("#{work}/other")
FileUtils.cp_r('src', "#{work}/other/src")
path = "#{work}/other/src/pid/fixpid_pid.c"
text = File.read(path)
raise "#{path}: no #{SUM}" unless text.include?(SUM)

File.write(path, text.sub(SUM, SUM.sub('p_d_ff', 'p_d_ff - 1')))
build('.', "#{work}/other/src", "#{work}/other.wasm")

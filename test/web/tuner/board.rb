# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Builds the board of the live card's test as WebAssembly: board.rb FOLDER
require_relative '../../../tools/lib/pages/tuner/sources'

exports = File.read('test/web/tuner/board.c').scan(/^\S.*?\b(board_\w+)\(/).flatten
system('clang', '--target=wasm32', '-O2', *Sources::EXACT, '-ffreestanding', '-nostdlib', '-mbulk-memory', *Sources::PATHS,
       'test/web/tuner/board.c', *Dir['src/{pid,link,record}/*.c'].grep_v(/_pic18/), '-Wl,--no-entry,--strip-all',
       *exports.map { |name| "-Wl,--export=#{name}" }, '-o', "#{ARGV.fetch(0)}/board.wasm") || exit(1)

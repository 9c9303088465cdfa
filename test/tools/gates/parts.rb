# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# tools/test with parts of its own: what it makes of checks that fail, that do not run, and
# that do not report.
require_relative 'gate'

SHELL = %w[tools/test tools/lib/setup.sh tools/lib/build/sdcc.sh tools/lib/build/gpsim.sh tools/lib/build/cbmc.sh tools/lib/build/cmake.sh
           tools/lib/test/checks.sh].freeze

# What tools/test says to each of these lines, with a part whose runner is this script and a
# part that runs weekly; a line that does not begin with a dash is a command.
def toy(runner, *lines, with: %w[env CI=], part: 'runner ./runner')
  files = SHELL.to_h { |path| [path, File.read("#{PROJECT}/#{path}")] }
  files['tools/lib/test/parts.sh'] = "part_toy() {\n    #{part}\n}\npart_long() {\n    count long '^ok ' '^FAILED ' echo ok long\n}\n"
  files['test/parts.txt'] = "toy daily 1 a part\nlong weekly 1 another part\n"
  files['runner'] = "#!/bin/sh\n[ \"$*\" != --list ] || exec printf 'a\\nb\\n'\n#{runner}\n"
  lines = ['-'] if lines.empty?
  -> { Gate.tree(files) { lines.map { |line| Gate.run(*with, 'sh', '-c', line.start_with?('-') ? "exec tools/test #{line.delete_prefix('-')}" : line) }.last } }
end

good = 'echo ok a; echo ok b: well'
Gate.said('a part that is well', toy(good), /^2 passed, 0 failed\n\z/)
Gate.refused('a check that failed, and an exit that does not say so', toy("#{good}; echo 'FAILED c; again: ./c'; seq 200"), /^FAILED c; again: .\/c$/, /^200$/, /^2 passed, 1 failed\n\z/)
Gate.refused('a runner that fails after its checks', toy("#{good}; exit 1"), /2 passed, 1 failed/)
Gate.refused('a test that is listed and does not report', toy('echo ok a'), /^FAILED .*runner: no word of b;/, /1 passed, 1 failed/)
Gate.refused('a runner that lists nothing', toy('[ "$1" = --list ]', part: 'runner ./runner daily; check a true'), /1 passed, 1 failed/)
Gate.refused('a runner that is not there', toy('', part: 'runner ./none'), /0 passed, 1 failed/)
Gate.refused('a part that ends before its checks', toy(good, part: 'exit 0'), /FAILED toy: nothing was checked/)
Gate.refused('a part that breaks off', toy(good, part: 'false'), /FAILED toy: it could not be run/)
Gate.refused('a command that fails', toy('', part: 'check a false; check b true'), /FAILED a/, /1 passed, 1 failed/)
skips = 'echo "skipped a: not root"; echo ok b'
Gate.passed('a test that is skipped', toy(skips))
Gate.refused('one where all must run', toy(skips, with: %w[env CI=true]), /skipped a: not root/, /FAILED toy: 1 skipped, with CI=true/)
Gate.refused('another run in the same folder', toy(good, "mkdir -p build/test; echo #{Process.pid} >build/test/lock", '-'), /another tools.test runs in this folder/)
Gate.passed('after a run that was killed', toy(good, 'sh -c "exit" & mkdir -p build/test; wait; echo $! >build/test/lock', '-'))
Gate.said('all parts', toy(good, '- --all'), /^3 passed, 0 failed\n\z/)
Gate.said('their names', toy(good, '- --all --list'), /\Atoy\nlong\n\z/)
Gate.said('only what failed last time', toy("#{good}; [ -e mended ] || exit 1", '- --all', 'touch mended', '- --failed'), /^2 passed, 0 failed\n\z/)
Gate.refused('no such part', Gate.run("#{PROJECT}/tools/test", 'nothing'), /no such part/)
Gate.finish

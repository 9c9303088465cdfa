# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# tools/test with a part of its own: what it makes of checks that fail, that do not
# run, and that are fewer than its table has.
require_relative 'gate'

SHELL = %w[tools/test tools/lib/setup.sh tools/lib/build/sdcc.sh tools/lib/build/gpsim.sh tools/lib/test/checks.sh].freeze

# A run of the part `toy`, of three checks, whose runner is this script; `with` is what
# stands before the command, `lock` whose the folder is.
def toy(runner, part = "count toy '^ok ' '^FAILED ' ./runner", with: %w[env CI=], lock: nil)
  files = SHELL.to_h { |path| [path, File.read("#{PROJECT}/#{path}")] }
  files['tools/lib/test/parts.sh'] = "part_toy() {\n    #{part}\n}\n"
  files['test/parts.txt'] = "toy 3 1 a part\n"
  files['runner'] = "#!/bin/sh\n#{runner}\n"
  files['build/test/lock'] = "#{lock}\n" if lock
  -> { Gate.tree(files) { Gate.run(*with, 'tools/test', 'toy') } }
end

# What tools/test says to each of these lines, in a project of two parts, of which `bad`
# fails as long as there is a file `fault`; other lines are commands.
def parts(*lines)
  files = SHELL.to_h { |path| [path, File.read("#{PROJECT}/#{path}")] }
  files['tools/lib/test/parts.sh'] = "part_good() {\n    count good '^ok ' '^FAILED ' echo ok a\n}\n" \
                                     "part_bad() {\n    count bad '^ok ' '^FAILED ' ./bad\n}\n"
  files['test/parts.txt'] = "good 1 1 a part\nbad 1 1 another part\n"
  files['bad'] = "#!/bin/sh\n[ -e fault ] || exec echo ok b\necho 'FAILED b; again: ./bad b'\nseq 200\nexit 1\n"
  files['fault'] = ''
  -> { Gate.tree(files) { [lines.map { |line| Gate.run('sh', '-c', line.start_with?('-') ? "tools/test #{line}" : line).first }.last, true] } }
end

three = 'echo ok a; echo ok b; echo ok c'
Gate.passed('a part with as many checks as it has', toy(three))
Gate.passed('a part with more', toy("#{three}; echo ok d"))
Gate.refused('a part with fewer', toy('echo ok a; echo ok b'), /FAILED toy: 2 checks ran, of at least 3/, /2 passed, 1 failed/)
Gate.refused('a part without checks', toy(':'), /0 passed, 1 failed/)
Gate.refused('a check that failed', toy('echo ok a; echo ok b; echo FAILED c; exit 1'), /2 passed, 1 failed/)
Gate.refused('a check that failed, and an exit that does not say so', toy("#{three}; echo FAILED d"), /1 failed/)
Gate.refused('a runner that fails after its checks', toy("#{three}; exit 1"), /3 passed, 1 failed/)
Gate.refused('a runner that is not there', toy('', "count toy '^ok ' '^FAILED ' ./no_runner"), /1 failed/)
Gate.refused('a part that ends before its checks', toy(three, 'exit 0'), /0 checks ran, of at least 3/)
Gate.refused('a part that breaks off', toy(three, 'false'), /FAILED toy: it could not be run/)
Gate.refused('a command that fails', toy('exit 1', "check a ./runner; check b true; check c true"), /FAILED a/, /2 passed, 1 failed/)
Gate.passed('a part that is skipped', toy('echo "skipped toy: not root"'))
Gate.refused('a part that is skipped where all must run', toy('echo "skipped toy: not root"', with: %w[env CI=true]),
             /skipped toy: not root/, /FAILED toy: 1 skipped, with CI=true/, /0 passed, 1 failed, 1 skipped/)
Gate.refused('a part that is skipped, and fails', toy('echo "skipped a: why"; exit 1'), /0 passed, 1 failed, 1 skipped/)
Gate.refused('another run in the same folder', toy(three, lock: Process.pid), /another tools.test runs in this folder, as process #{Process.pid}/)
Gate.passed('after a run that was killed', toy(three, lock: Process.spawn('true').tap { |gone| Process.wait(gone) }))
Gate.said('a failed line far above the end', parts('tools/test'), /^FAILED b; again: .\/bad b$/, /^200$/, /1 passed, 1 failed$/)
Gate.said('only what failed last time', parts('tools/test', '--failed'), /\A\[1\/1\] bad|\AFAILED bad/, /^0 passed, 1 failed$/)
Gate.said('what failed when it ran last', parts('tools/test', 'tools/test good', '--failed'), /^0 passed, 1 failed$/)
Gate.said('what is mended', parts('tools/test', 'rm fault', '--failed'), /^1 passed, 0 failed$/)
Gate.said('nothing left', parts('tools/test', 'rm fault', '--failed', '--failed'), /^nothing failed last time$/)
Gate.refused('no such part', Gate.run("#{PROJECT}/tools/test", 'nothing'), /no such part/)
Gate.finish

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# tools/test with a part of its own: what it makes of checks that fail, that do not
# run, and that are fewer than its table has.
require_relative 'planted'

SHELL = %w[tools/test tools/lib/setup.sh tools/lib/sdcc.sh tools/lib/gpsim.sh tools/lib/test/checks.sh].freeze

# A run of the part `toy`, of three checks, whose runner is this script.
def toy(runner, part = "count toy '^ok ' '^FAILED ' ./runner")
  files = SHELL.to_h { |path| [path, File.read("#{PROJECT}/#{path}")] }
  files['tools/lib/test/parts.sh'] = "part_toy() {\n    #{part}\n}\n"
  files['test/parts.txt'] = "toy 3 1 a part\n"
  files['runner'] = "#!/bin/sh\n#{runner}\n"
  Planted.tree(files) { Planted.run('tools/test', 'toy') }
end

three = 'echo ok a; echo ok b; echo ok c'
Planted.passed('a part with as many checks as it has', toy(three))
Planted.passed('a part with more', toy("#{three}; echo ok d"))
Planted.refused('a part with fewer', toy('echo ok a; echo ok b'), /FAILED toy: 2 checks ran, of at least 3/, /2 passed, 1 failed/)
Planted.refused('a part without checks', toy(':'), /0 passed, 1 failed/)
Planted.refused('a check that failed', toy('echo ok a; echo ok b; echo FAILED c; exit 1'), /2 passed, 1 failed/)
Planted.refused('a check that failed, and an exit that does not say so', toy("#{three}; echo FAILED d"), /1 failed/)
Planted.refused('a runner that fails after its checks', toy("#{three}; exit 1"), /3 passed, 1 failed/)
Planted.refused('a runner that is not there', toy('', "count toy '^ok ' '^FAILED ' ./no_runner"), /1 failed/)
Planted.refused('a part that ends before its checks', toy(three, 'exit 0'), /0 checks ran, of at least 3/)
Planted.refused('a part that breaks off', toy(three, 'false'), /FAILED toy: it could not be run/)
Planted.refused('a command that fails', toy('exit 1', "check a ./runner; check b true; check c true"), /FAILED a/, /2 passed, 1 failed/)
Planted.refused('no such part', Planted.run("#{PROJECT}/tools/test", 'nothing'), /no such part/)
Planted.finish

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# tools/test with a part of its own: what it makes of checks that fail, that do not
# run, and that are fewer than its table has.
require_relative 'gate'

SHELL = %w[tools/test tools/lib/setup.sh tools/lib/build/sdcc.sh tools/lib/build/gpsim.sh tools/lib/build/cbmc.sh tools/lib/build/cmake.sh
           tools/lib/test/checks.sh tools/lib/remembered.rb tools/lib/build/inputs.rb tools/lib/build/large_pages.rb tools/lib/test/once.rb tools/lib/test/sights.rb
           tools/lib/test/told.rb].freeze

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

# What the last of these lines says in a project with a part whose runner is remembered, and
# how often the runner ran: those that begin with a dash are tools/test's words, others
# commands. The runner prints to both its outputs.
def remembered(runner, *lines, with: %w[env CI=], sight: 'unit')
  files = SHELL.to_h { |path| [path, File.read("#{PROJECT}/#{path}")] }
  files['tools/lib/test/parts.sh'] = "part_toy() {\n    count toy '^ok ' '^FAILED ' once #{sight} ./runner word\n}\n"
  files['test/parts.txt'] = "toy 3 1 a part\n"
  files['runner'] = "#!/bin/sh\necho x >>build/runs\n#{runner}\n"
  files['README.md'] = files['docs/a.md'] = files['src/a.c'] = files['.hidden'] = "a\n"
  lambda do
    Gate.tree(files) do |folder|
      said = lines.map { |line| Gate.run(*with, "XDG_CACHE_HOME=#{folder}/build/cache", 'sh', '-c', line.start_with?('-') ? "tools/test #{line.delete_prefix('-')}" : line).first }
      ["#{said.last}ran #{File.readlines('build/runs').size} times\n", true]
    end
  end
end

# A runner as tools/test calls it: what it says and its exit status, then the same once more.
ONCE = 'FIXPID_TALLY=$PWD/build/tally ruby tools/lib/test/once.rb unit "^ok " "^FAILED " ./runner word'.freeze

three = 'echo ok a; echo ok b; echo ok c'
Gate.passed('a part with as many checks as it has', toy(three))
Gate.passed('a part with more', toy("#{three}; echo ok d"))
Gate.refused('a part with fewer', toy('echo ok a; echo ok b'), /FAILED toy: 2 checks ran, of at least 3/, /2 passed, 1 failed/)
# The count was right with three tests in a file of the commit.
Gate.said('a test file that is gone', parts('mkdir test/unit; printf "1\n2\n3\n" >test/unit/test_a.c; sed -i "s/^good 1/good 3/" test/parts.txt',
                                            'git init -q .; git add test; git -c user.name=a -c user.email=a commit -qm a',
                                            'mv test/unit/test_a.c test/unit/test_b.c; tools/test good'),
          %r{^FAILED good: 1 checks ran, of at least 3 \(test/parts\.txt\); fewer lines than in \h+: test/unit/test_a\.c \(-3 lines\)$})
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
Gate.said('a runner that passed is remembered', remembered(three, '-', '-'), /^3 passed, 0 failed$/, /^ran 1 times$/,
          /^remembered: 3 checks, the oldest \d+ seconds? old; all anew: tools.test --fresh$/)
Gate.said('and runs if all is asked for anew', remembered(three, '-', '---fresh'), /\A(?!.*remembered:).*^3 passed, 0 failed$/m, /^ran 2 times$/)
Gate.said('and is remembered then', remembered(three, '---fresh', '-'), /^remembered: 3 checks/, /^ran 1 times$/)
Gate.said('a runner that failed is not', remembered("#{three}; echo FAILED d; exit 1", '-', '-'), /^3 passed, 1 failed$/, /^ran 2 times$/)
Gate.said('nor one that only says so', remembered("#{three}; echo FAILED d", '-', '-'), /^3 passed, 1 failed$/, /^ran 2 times$/)
Gate.said('nor one that only ends so', remembered("#{three}; exit 1", '-', '-'), /^3 passed, 1 failed$/, /^ran 2 times$/)
Gate.said('nor one that is killed', remembered("#{three}; kill -9 $$", '-', '-'), /^3 passed, 1 failed$/, /^ran 2 times$/)
Gate.said('nor one without checks', remembered('echo nothing', '-', '-'), /^0 passed, 1 failed$/, /^ran 2 times$/)
Gate.said('nor one that is skipped in part', remembered("#{three}; echo skipped d: why", '-', '-'), /3 passed, 0 failed, 1 skipped$/, /^ran 2 times$/)
%w[src/a.c .hidden runner new.txt src/new/b.c tools/lib/remembered.rb].each do |path|
  Gate.said("and runs anew with another #{path}", remembered(three, '-', "mkdir -p src/new; echo '# more' >>#{path}", '-'), /^3 passed, 0 failed$/, /^ran 2 times$/)
end
Gate.said('and not with another page', remembered(three, '-', 'echo b >>docs/a.md; echo b >>README.md', '-'), /^ran 1 times$/)
Gate.said('but where the whole tree is seen', remembered(three, '-', '-', 'echo b >>docs/a.md', '-', sight: 'whole'), /^3 passed, 0 failed$/, /^ran 2 times$/)
Gate.said('and with another private compiler', remembered(three, '-', '-', 'mkdir build/cache/fixpid/cbmc-6; echo a >build/cache/fixpid/cbmc-6/SHA256SUMS', '-', sight: 'whole'),
          /^3 passed, 0 failed$/, /^ran 2 times$/)
Gate.said('nor in another folder', remembered(three, '-', 'mkdir build/copy; cp -r $(ls -A | grep -v build) build/copy; mkdir build/copy/build; cd build/copy; tools/test'),
          /^remembered: 3 checks/, /^ran 1 times$/)
Gate.said('and runs anew with another word of the environment', remembered(three, '-', 'CFLAGS=-O0 tools/test'), /^ran 2 times$/)
Gate.said('what it prints is the same',
          remembered('echo ok a; echo b >&2; echo "ok \303\244"; printf c', 'mkdir -p build', "#{ONCE} >build/one; #{ONCE} >build/two; cmp build/one build/two && echo same; cat build/two"),
          /^same\nok a\nb\nok .*\ncran 1 times$/m)
Gate.said('its exit status is kept', remembered('exit 7', 'mkdir -p build', "#{ONCE}; echo status $?; #{ONCE}; echo status $?"), /\Astatus 7\nstatus 7\nran 2 times/)
Gate.said('what is old is removed at the end', remembered(three, '-', 'touch -d "40 days ago" build/cache/fixpid/verdicts/unit/*; echo b >>src/a.c', '-', 'ls build/cache/fixpid/verdicts/unit | wc -l'),
          /\A1\n/)
Gate.refused('no such part', Gate.run("#{PROJECT}/tools/test", 'nothing'), /no such part/)
Gate.finish

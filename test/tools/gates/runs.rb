# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What all runners below test/ are asked for in the same words, in shell and in Ruby:
# --list, --help, names, --failed, and the command behind a FAILED line. And what is
# built: anew where it is made of something else, and only then.
require_relative 'gate'
require "#{PROJECT}/tools/lib/build/built"

SHELL = <<~TEXT
  #!/bin/sh
  # SPDX-License-Identifier: MIT
  # What it does.
  # shellcheck disable=SC2317
  set -u
  root=$PWD
  work=build/work
  . tools/lib/setup.sh
  . tools/lib/test/runs.sh
  mkdir -p "$work"
TEXT
BY_TABLE = <<~TEXT
  #{SHELL}
  names() {
      printf '%s\\n' good bad 'two words'
  }
  good() {
      echo seen
  }
  bad() {
      echo why
      [ ! -e fault ]
  }
  two() {
      echo why
      [ ! -e fault ]
  }
  asked runner "$@"
  each attempt
TEXT
IN_TURN = <<~TEXT
  #{SHELL}
  asked runner "$@"
  ! wanted good || passed good seen
  for name in bad 'two words'; do
      wanted "$name" || continue
      echo why >"$work/log"
      if [ -e fault ]; then failed "$name" "$work/log"; else passed "$name"; fi
  done
  finish
TEXT
RUBY = <<~TEXT
  #!/usr/bin/env ruby
  # SPDX-License-Identifier: MIT
  # What it does.

  require './tools/lib/test/named'

  tests = NamedTests.new('runner')
  tests.add('good') { 'seen' }
  ['bad', 'two words'].each { |name| tests.add(name) { raise 'why' if File.exist?('fault') } }
  exit tests.run(ARGV)
TEXT
NEEDS = RUBY.sub("exit tests", "tests.add('last', needs: %w[good bad]) { 'after' }\nexit tests")

LIBRARY = %w[tools/lib/setup.sh tools/lib/test/runs.sh tools/lib/test/named.rb].freeze

# What such a runner says to the last of these commands; one that begins with a dash or
# a quote is its arguments.
def said(runner, *commands)
  files = LIBRARY.to_h { |path| [path, File.read("#{PROJECT}/#{path}")] }.merge('runner' => runner, 'fault' => '')
  commands = commands.map { |command| command.match?(/\A(-|'|\z)/) ? "./runner #{command}" : command }
  -> { Gate.tree(files) { commands.map { |command| Gate.run('sh', '-c', command) }.last } }
end

{ 'by a table' => BY_TABLE, 'in turn' => IN_TURN, 'in Ruby' => RUBY }.each do |how, runner|
  Gate.passed("#{how}: names", said(runner, "[ \"$(./runner --list)\" = \"$(printf 'good\\nbad\\ntwo words')\" ]"))
  Gate.passed("#{how}: help", said(runner, "[ \"$(./runner --help)\" = 'What it does.' ]"))
  Gate.refused("#{how}: all", said(runner, ''), /^ok good: seen$/, /^FAILED bad; again: runner bad$/, /^    .*why/,
               /^FAILED two words; again: runner 'two words'$/)
  Gate.passed("#{how}: one", said(runner, "'good'"))
  Gate.refused("#{how}: two of three", said(runner, "'two words' good"), /\A(?!.*bad)/m, /^ok good: seen$/, /^FAILED two words;/)
  Gate.refused("#{how}: no such name", said(runner, "'goo'"), /no such test: goo; see --list/)
  Gate.refused("#{how}: no such option", said(runner, '--every'), /no such test: --every/)
  Gate.refused("#{how}: what failed last", said(runner, '', '--failed'), /\A(?!.*ok good)/m, /^FAILED bad;/, /^FAILED two words;/)
  Gate.refused("#{how}: less of it", said(runner, '', "'bad'", 'rm fault', "'bad'", '>fault', '--failed'), /\AFAILED two words;[^\n]*\n    [^\n]*\n\z/)
  Gate.said("#{how}: nothing failed", said(runner, '', 'rm fault', '--failed', '--failed'), /\Anothing failed last time\n\z/)
  Gate.refused("#{how}: the command behind a FAILED line", said(runner, "sh -c \"./$(./runner | sed -n 's/^FAILED two.*again: //p')\""),
               /\AFAILED two words;/)
end
{ 'by a table' => BY_TABLE, 'in Ruby' => RUBY }.each do |how, runner|
  Gate.passed("#{how}: daily", said(runner, 'mkdir test; echo "runner bad|two .*" >test/weekly.txt', '--daily'))
  Gate.refused("#{how}: weekly", said(runner, 'mkdir test; printf "another good\nrunner bad\n" >test/weekly.txt', '--weekly'),
               /\AFAILED bad;[^\n]*\n    [^\n]*\n\z/)
  Gate.refused("#{how}: a name within a name is another", said(runner, 'mkdir test; echo "runner ba|wo words" >test/weekly.txt', '--daily'),
               /^FAILED bad;/, /^FAILED two words;/)
end
WEEKLY = 'mkdir test; echo "runner good" >test/weekly.txt; rm fault'.freeze
Gate.said('what needs another runs with the daily ones', said(NEEDS, WEEKLY, '--daily'), /\A(?!.*ok good)/m, /^ok bad$/, /^ok last: after$/)
Gate.said('and with the weekly ones, after all that it needs', said(NEEDS, WEEKLY, '--weekly'), /\A(?!.*two words)/m,
          /^ok good: seen$/, /^ok bad$/, /^ok last: after$/)
Gate.refused('what needs another, which failed', said(NEEDS, "'last'"), /^ok good: seen$/, /^FAILED last;.*\n    bad failed, which it needs/)
Gate.passed('what needs another', said(NEEDS, 'rm fault', "'last'"))
Gate.said('comes after it', said(NEEDS, 'rm fault', "'last'"), /ok last: after\n\z/)

# By the lines of test/weekly.txt: those that name no test, and the names of a runner's tests
# that they leave for each day.
def names_of(runner)
  (@names ||= {})[runner] ||= Dir.chdir(PROJECT) { Gate.run(runner, '--list').first.lines(chomp: true) }
end

def weekly(text)
  text.lines.grep(/\Atest/).map { |line| line.chomp.split(' ', 2) }
end

def idle(text)
  weekly(text).reject { |runner, pattern| names_of(runner).grep(/\A(?:#{pattern})\z/).any? }.map(&:last)
end

def daily(text, runner)
  patterns = weekly(text).select { |name, _| name == runner }.map { |_, pattern| /\A(?:#{pattern})\z/ }
  names_of(runner).reject { |name| patterns.any? { |pattern| pattern.match?(name) } }
end

# All recorded rows on this machine, and on chips of each kind.
ROWS = %w[definition-object replay-an937-pic18f4520-object replay-an964-pic16f684-object replay-an964-pic18f4520-object
          replay-an964_8bit-pic16f684-object replay-an964_8bit-pic18f4520-object replay-pid-pic18f4520-object
          machine-avr-object machine-cortex-m0-object machine-cortex-m4-object].freeze
TEXT_WEEKLY = File.read("#{PROJECT}/test/weekly.txt").freeze
TARGET = 'test/chips/target/run'
Gate.expect('each line of test/weekly.txt names tests', -> { idle(TEXT_WEEKLY) }, [])
Gate.expect('one that names none', -> { idle("#{TEXT_WEEKLY}#{TARGET} nothing|replay\n") }, ['nothing|replay'])
Gate.expect('rows are asked daily on each kind of chip', -> { ROWS - daily(TEXT_WEEKLY, TARGET) }, [])
Gate.expect('rows that are not', -> { ROWS - daily("#{TEXT_WEEKLY}#{TARGET} machine-(avr|rv32ec)-.*\n", TARGET) }, %w[machine-avr-object])

# Two programs of three sources and two headers, made by a compiler that is a script, as
# often as it says in `made`.
COMPILER = "#!/bin/sh\nout=$1\nshift\necho \"$out\" >>made\n[ ! -e fault ] || exit 1\ncat \"$@\" 2>/dev/null >\"$out\"\nexit 0\n"
SOURCES = { 'bin/cc' => COMPILER, 'src/a.c' => "#include \"a.h\"\n", 'src/b.c' => "#include <deep/b.h>\n", 'src/a.h' => "#include \"../src/c.h\"\n",
            'inc/deep/b.h' => "#include \"b.h\" // itself\n", 'src/c.h' => "#include \"a.h\" // in a circle\n", 'src/d.h' => '' }.freeze

def build(*options)
  built = Built.new { |*command| system('bin/cc', *command.drop(1), exception: true) }
  built.command('one', 'bin/cc', 'one', 'src/a.c', *options)
  built.command('two', 'bin/cc', 'two', '-Iinc', 'src/b.c')
end

# What is made again after the block.
def made_again(*options)
  lambda do
    Gate.tree(SOURCES) do
      build
      File.delete('made')
      yield
      begin
        build(*options)
      rescue RuntimeError
        FileUtils.rm_f('fault')
        build(*options)
      end
      File.exist?('made') ? File.readlines('made', chomp: true) : []
    end
  end
end

def changed(path)
  made_again { File.write(path, "// more\n", mode: 'a') }
end

Gate.expect('nothing changed', made_again {}, [])
Gate.expect('another time, the same text', made_again { File.write('src/a.c', SOURCES['src/a.c']) }, [])
Gate.expect('another source', changed('src/a.c'), %w[one])
Gate.expect('another header', changed('src/a.h'), %w[one])
Gate.expect('another header of a header', changed('src/c.h'), %w[one])
Gate.expect('another header of a folder', changed('inc/deep/b.h'), %w[two])
Gate.expect('a header that nobody includes', changed('src/d.h'), [])
Gate.expect('a header that is new', made_again { Gate.write('inc/a.h', "\n") || Gate.write('src/deep/b.h', "\n") }, %w[two])
Gate.expect('another option', made_again('-DMORE') {}, %w[one])
Gate.expect('another output', changed('two'), %w[two])
Gate.expect('an output that is gone', made_again { File.delete('one') }, %w[one])
Gate.expect('one that could not be made', made_again { Gate.write('src/a.c', 'x') || Gate.write('fault', '') }, %w[one one])
ENV['PATH'] = "bin:#{ENV.fetch('PATH')}"
Gate.expect('another compiler', changed('bin/cc'), %w[one two])

# The kernel says so of each process, which has it of the one that started it.
Gate.expect('what is started may have large pages', -> { `sed -n 's/^THP_enabled:[[:space:]]*//p' /proc/self/status`.strip }, /\A1?\z/)

# A build by tools/lib/build/cmake.sh after one whose shell was killed, whose Ninja failed,
# that was complete, that was in another folder, or that was by make: whether it begins
# with what that left.
CMAKE = "#!/bin/sh\nprintf 'CMAKE_%s\\n' \"HOME_DIRECTORY:INTERNAL=$2\" GENERATOR:INTERNAL=\"$made_by\" >\"$4/CMakeCache.txt\"\n"
NINJA = "#!/bin/sh\n[ ! -e $2/left ] || touch again\ntouch \"$2/left\"\n. ./then\n"
TOYS = { 'bin/cmake' => CMAKE, 'bin/ninja' => NINJA, 'toy/CMakeLists.txt' => '', 'other/CMakeLists.txt' => '',
         'tools/lib/setup.sh' => File.read("#{PROJECT}/tools/lib/setup.sh"),
         'tools/lib/build/cmake.sh' => File.read("#{PROJECT}/tools/lib/build/cmake.sh") }.freeze

def again_after(how, folder = 'toy', generator = 'Ninja')
  lambda do
    Gate.tree(TOYS) do
      [[how, folder, generator], ['exit 0', 'toy', 'Ninja']].each do |last, source, by|
        File.write('then', last)
        Gate.run('env', "made_by=#{by}", 'sh', '-c', "root=$PWD; . tools/lib/setup.sh; . tools/lib/build/cmake.sh; cmake_build toy #{source} build/toy")
      end
      File.exist?('again')
    end
  end
end

Gate.expect('a build that was killed begins anew', again_after('kill -9 $PPID'), false)
Gate.expect('a build that failed goes on', again_after('exit 1'), true)
Gate.expect('a build that was complete goes on', again_after('exit 0'), true)
Gate.expect('a build of another folder begins anew', again_after('exit 0', 'other'), false)
Gate.expect('a build by make begins anew', again_after('exit 0', 'toy', 'Unix Makefiles'), false)
Gate.finish

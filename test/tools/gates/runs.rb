# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What all runners below test/ are asked for in the same words, in shell and in Ruby. And what
# is built: anew where it is made of something else, and only then.
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
  weekly_names() {
      echo bad
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
  weekly_names() {
      echo bad
  }
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
  [%w[bad weekly], ['two words']].each { |name| tests.add(*name) { raise 'why' if File.exist?('fault') } }
  exit tests.run(ARGV)
TEXT
NEEDS = RUBY.sub("exit tests", "tests.add('last', needs: %w[good bad]) { 'after' }\nexit tests")

LIBRARY = %w[tools/lib/setup.sh tools/lib/test/runs.sh tools/lib/test/named.rb].freeze

# What such a runner says to the last of these commands; one that begins with a dash or
# a quote is its arguments.
def said(runner, *commands)
  files = LIBRARY.to_h { |path| [path, File.read("#{PROJECT}/#{path}")] }.merge('runner' => runner, 'fault' => '')
  commands = commands.map { |command| command.match?(/\A(-|'|daily|weekly|\z)/) ? "./runner #{command}" : command }
  -> { Gate.tree(files) { commands.map { |command| Gate.run('sh', '-c', command) }.last } }
end

{ 'by a table' => BY_TABLE, 'in turn' => IN_TURN, 'in Ruby' => RUBY }.each do |how, runner|
  Gate.passed("#{how}: names", said(runner, "[ \"$(./runner --list)\" = \"$(printf 'good\\nbad\\ntwo words')\" ]"))
  Gate.passed("#{how}: help", said(runner, "[ \"$(./runner --help)\" = 'What it does.' ]"))
  Gate.refused("#{how}: daily", said(runner, 'daily'), /^ok good: seen$/, /^FAILED two words;/, /\A(?!.*bad)/m)
  Gate.refused("#{how}: weekly", said(runner, 'weekly'), /\AFAILED bad;[^\n]*\n    [^\n]*why/)
  Gate.passed("#{how}: names of the weekly ones", said(runner, '[ "$(./runner --list weekly)" = bad ]'))
  Gate.refused("#{how}: no such name", said(runner, "'goo'"), /no such test: goo; see --list/)
  Gate.refused("#{how}: what failed last", said(runner, '', '--failed'), /\A(?!.*ok good)/m, /^FAILED bad;/, /^FAILED two words;/)
  Gate.refused("#{how}: the command behind a FAILED line", said(runner, "sh -c \"./$(./runner | sed -n 's/^FAILED two.*again: //p')\""),
               /\AFAILED two words;/)
end
Gate.refused('what needs another, which failed', said(NEEDS, "'last'"), /^ok good: seen$/, /^FAILED last;.*\n    bad failed, which it needs/)
Gate.said('comes after it', said(NEEDS, 'rm fault', "'last'"), /ok bad\nok last: after\n\z/)

# Rows of test/matrix.txt: a step that is not quiet, and one of two that is refused for another reason.
MATRIX = <<~TEXT
  test/use/things/run
  good daily
      quiet true
  loud daily
      quiet echo noise
  refused_* daily sh weekly dash
      refused no $CC -c 'echo {no;yes}; exit 1'
TEXT
TABLE_FILES = Dir.chdir(PROJECT) { Dir['tools/lib/{setup.sh,build/*.sh,test/{matrix.rb,named.rb,*.sh}}'] }.freeze
Gate.refused('rows of the table', lambda {
  files = TABLE_FILES.to_h { |path| [path, File.read("#{PROJECT}/#{path}")] }
  Gate.tree(files.merge('test/matrix.txt' => MATRIX)) { Gate.run('ruby', 'tools/lib/test/matrix.rb', 'test/use/things/run', 'daily') }
}, /^ok good$/, /^FAILED loud;.*\n    noise\n    not silent: echo noise$/, /^FAILED refused_sh;.*\n    yes\n    failed, but without 'no'/, /\A(?!.*dash;)/m)

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
Gate.expect('another header of a header', changed('src/c.h'), %w[one])
Gate.expect('a header that is new', made_again { Gate.write('inc/a.h', "\n") || Gate.write('src/deep/b.h', "\n") }, %w[two])
Gate.expect('another option', made_again('-DMORE') {}, %w[one])
Gate.expect('an output that is gone', made_again { File.delete('one') }, %w[one])
Gate.expect('one that could not be made', made_again { Gate.write('src/a.c', 'x') || Gate.write('fault', '') }, %w[one one])
ENV['PATH'] = "bin:#{ENV.fetch('PATH')}"
Gate.expect('another compiler', changed('bin/cc'), %w[one two])

# Whether a build by tools/lib/build/cmake.sh begins with what the last one left, whose
# shell was killed, or whose Ninja failed.
CMAKE = "#!/bin/sh\nprintf 'CMAKE_%s\\n' \"HOME_DIRECTORY:INTERNAL=$2\" GENERATOR:INTERNAL=Ninja >\"$4/CMakeCache.txt\"\n"
NINJA = "#!/bin/sh\n[ ! -e $2/left ] || touch again\ntouch \"$2/left\"\n. ./then\n"
TOYS = { 'bin/cmake' => CMAKE, 'bin/ninja' => NINJA, 'toy/CMakeLists.txt' => '',
         'tools/lib/setup.sh' => File.read("#{PROJECT}/tools/lib/setup.sh"),
         'tools/lib/build/cmake.sh' => File.read("#{PROJECT}/tools/lib/build/cmake.sh") }.freeze

def again_after(how)
  lambda do
    Gate.tree(TOYS) do
      [how, 'exit 0'].each do |last|
        File.write('then', last)
        Gate.run('sh', '-c', 'root=$PWD; . tools/lib/setup.sh; . tools/lib/build/cmake.sh; cmake_build toy toy build/toy')
      end
      File.exist?('again')
    end
  end
end

Gate.expect('a build that was killed begins anew', again_after('kill -9 $PPID'), false)
Gate.expect('a build that failed goes on', again_after('exit 1'), true)
Gate.finish

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require 'etc'
require 'fileutils'

# Tests with names, for the runners in Ruby: what they are asked for in the same
# words as the runners in shell (runs.sh), as many at a time as there are processors.
#
#   tests = NamedTests.new('test/chips/target/run')
#   tests.add('replay-pid', 'replay') { 'what it tells in a line, or nil' }
#   exit tests.run(ARGV)
#
# A test fails by raising. A word picks the tests that have it as their name or among
# their other words; an argument of several words, those that have all of them. A test with
# the word `weekly` runs once a week, and all others have the word `daily`. With `daily` alone
# what needs a weekly test judges what ran; otherwise all that is needed runs, too.
class NamedTests
  Test = Struct.new(:name, :words, :needs, :body)
  LINES_MOST = 40 # of what a failure says

  # Names of what failed, and of what runs this time.
  attr_reader :failed, :running

  # From the project's folder; `script` has the help in its first comment.
  def initialize(script, at_a_time = Etc.nprocessors)
    @script = script
    @at_a_time = at_a_time
    @record = "build/failed/#{script.tr('/', '_')}"
    @tests = []
    @failed = []
    @mutex = Mutex.new
  end

  # `needs` are names of tests that run before it, also where only this is asked for.
  def add(name, *words, needs: [], &body)
    words |= ['daily'] unless words.include?('weekly')
    @tests << Test.new(name, [name, *name.split(/[ ,]+/), *words], needs, body)
  end

  def names
    @tests.map(&:name)
  end

  # Whether all that was asked for is well.
  def run(arguments)
    case arguments.first
    when '-h', '--help' then puts help
    when '--list' then puts asked_for(arguments.drop(1)).map(&:name)
    else return arguments == ['daily'] ? run_only(asked_for(arguments)) : run_all(asked_for(arguments))
    end
    true
  end

  private

  def help
    lines = File.readlines(@script).drop_while { |line| line.match?(/\A(#!|# SPDX|# frozen|$)/) }
    lines.take_while { |line| line.start_with?('#') && !line.include?('shellcheck') }.map { |line| line.sub(/\A# ?/, '') }
  end

  def asked_for(arguments)
    return failed_last if arguments == ['--failed']
    return @tests if arguments.empty?

    arguments.flat_map do |argument|
      found = @tests.select { |test| test.words.include?(argument) || (argument.split - test.words).empty? }
      found.empty? && !%w[daily weekly].include?(argument) ? refuse(argument) : found
    end
  end

  def refuse(argument)
    warn "#{@script}: no such test: #{argument}; see --list"
    exit 2
  end

  def remembered
    File.readlines(@record, chomp: true)
  rescue Errno::ENOENT
    []
  end

  def failed_last
    found = @tests.select { |test| remembered.include?(test.name) }
    puts 'nothing failed last time' if found.empty?
    found
  end

  # Those that need others come last, one after the other.
  def run_all(tests)
    needed = tests.flat_map(&:needs)
    run_only(@tests.select { |test| tests.include?(test) || needed.include?(test.name) })
  end

  def run_only(tests)
    @running = tests.map(&:name)
    first, last = tests.partition { |test| test.needs.empty? }
    in_parallel(first)
    last.each { |test| attempt(test) }
    failed.empty?
  end

  # What failed when it ran last, whenever that was.
  def remember(test)
    FileUtils.mkdir_p(File.dirname(@record))
    File.write(@record, (((remembered - [test.name]) | failed) & names).map { |name| "#{name}\n" }.join)
  end

  def in_parallel(tests)
    waiting = tests.dup
    threads = Array.new(@at_a_time) do
      Thread.new do
        while (test = @mutex.synchronize { waiting.shift })
          attempt(test)
        end
      end
    end
    threads.each(&:join)
  end

  def attempt(test)
    lost = test.needs & failed
    raise "#{lost.first} failed, which it needs" unless lost.empty?

    told = test.body.call
    tell(test, told ? "ok #{test.name}: #{told}" : "ok #{test.name}")
  rescue StandardError => e
    @mutex.synchronize { failed << test.name }
    why = e.message.lines(chomp: true).last(LINES_MOST)
    why << "(#{e.class}, #{e.backtrace.first})" unless e.instance_of?(RuntimeError) || e.class.name.end_with?('::Failure')
    tell(test, "FAILED #{test.name}; again: #{again(test)}", *why.map { |line| "    #{line}" })
  end

  def again(test)
    name = test.name.match?(/\A[\w.-]+\z/) ? test.name : "'#{test.name.gsub("'", %q('\\\\''))}'"
    "#{'ruby ' if @script.end_with?('.rb')}#{@script} #{name}"
  end

  def tell(test, *lines)
    @mutex.synchronize do
      remember(test)
      puts lines
      $stdout.flush
    end
  end
end

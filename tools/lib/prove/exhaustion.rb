# SPDX-License-Identifier: MIT
# A harness that tries all cases: a program for this machine.
require 'open3'
require_relative 'cbmc'

# Compiles it with the sources of a tree and runs it. Its properties are its cases.
class Exhaustion
  SECONDS_MOST = 120 # of a processor

  def initialize(proof, build, tree = '.', seconds = SECONDS_MOST)
    @proof = proof
    @tree = tree
    @seconds_most = seconds
    @program = "#{build}/#{proof.name.tr(' ', '_')}#{tree == '.' ? '' : "_#{File.basename(tree)}"}"
  end

  def run
    said, status = Open3.capture2e(*@proof.compiler, '-O2', '-w', *@proof.options, "-I#{@tree}/include",
                                   "-I#{@tree}/src", @proof.harness, '-o', @program)
    return Answer.new(:none, "it does not compile\n#{said}") unless status.success?

    began = Process.clock_gettime(Process::CLOCK_MONOTONIC)
    said, status = Open3.capture2e(@program, rlimit_cpu: [@seconds_most, @seconds_most + 1])
    judge(said, status, Process.clock_gettime(Process::CLOCK_MONOTONIC) - began)
  ensure
    File.delete(@program) if File.exist?(@program)
  end

  private

  def judge(said, status, seconds)
    cases = said[/\A(\d+) cases$/, 1].to_i
    return Answer.new(:proved, nil, cases, seconds, 0) if status.success? && cases.positive?

    Answer.new(status.exitstatus == 1 ? :refuted : :none, said, 0, seconds, 0)
  end
end

# What answers a proof.
def judge_of(proof)
  proof.exhausted? ? Exhaustion : Cbmc
end

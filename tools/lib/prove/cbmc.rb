# SPDX-License-Identifier: MIT
# One run of CBMC.
require 'fileutils'
require_relative 'asked_once'
require_relative 'proofs'
require 'open3'

# What a run came to: proved, refuted (a claim does not hold), or neither.
Answer = Struct.new(:verdict, :why, :properties, :seconds, :megabytes)

# Compiles a harness with the sources of a tree, puts contracts in place and asks.
class Cbmc
  SECONDS_MOST = 120 # of a processor
  COMPOSED_MOST = 600
  MEGABYTES_MOST = 1024
  CHECKS = %w[--bounds-check --pointer-check --pointer-overflow-check --signed-overflow-check --div-by-zero-check
              --undefined-shift-check --unwind 200 --unwinding-assertions --drop-unused-functions].freeze
  ITS_END = 'its end'.freeze
  TICKS = 100.0 # a second; the kernel's for /proc

  def initialize(proof, build, tree = '.', seconds = nil, options = [])
    @proof = proof
    @tree = tree
    @options = options
    @seconds_most = seconds || (proof.what == 'composed' ? COMPOSED_MOST : SECONDS_MOST)
    @folder = "#{build}/#{proof.name.tr(' ', '_')}#{tree == '.' ? '' : "_#{File.basename(tree)}"}"
  end

  def run
    program = compile or return Answer.new(:none, "it does not compile\n#{@said}")
    ask(program)
  end

  # The functions that the proof comes to.
  def functions
    program = compile or abort "prove: #{@proof.name} does not compile\n#{@said}"
    tool('goto-instrument', '--reachable-call-graph', program) or abort "prove: #{@proof.name}: #{@said}"
    @said.scan(/^\w+ -> (\w+)$/).flatten.map { |name| name.delete_suffix(mark(name)) }.uniq
  end

  # [place, condition] of each claim of its harness, and ITS_END => whether some values
  # come to it; nil without an answer. A contract's precondition is no claim.
  def claims
    program = compile(to_its_end: true) or return
    said = cover(program, 'assertion', '--no-standard-checks') or return

    found = Hash.new(true)
    said.scan(%r{^\[\S+\] file (?:\./)?(\S+) line (\d+) function \w+ (?!pre: )(.*): (SATISFIED|FAILED)$}) do |file, line, condition, answer|
      found[condition == ITS_END ? ITS_END : ["#{Pathname(file).cleanpath}:#{line}", condition]] &= answer == 'SATISFIED'
    end
    found if found.key?(ITS_END)
  end

  # [file, line, function, block] of each place of src/ => whether some values
  # come to it; nil without an answer.
  def places
    program = compile or return
    said = cover(program, 'location') or return

    said.scan(%r{^\[\S+\] file (?:\./)?(src/\S+) line (\d+) function (\w+) (block \d+) .*: (SATISFIED|FAILED)$})
        .to_h { |*place, found| [place, found == 'SATISFIED'] }
  end

  private

  # The harness, with a claim behind its end.
  def ended
    harness = "#{@folder}/ended.c"
    File.write(harness, <<~C)
      #include "#{@proof.harness.delete_prefix("#{FOLDER}/")}"

      void to_its_end(void)
      {
          #{@proof.function}();
          __CPROVER_assert(true, "#{ITS_END}");
      }
    C
    [harness, '--function', 'to_its_end']
  end

  # What CBMC says of each place or assertion, if it says something.
  def cover(program, what, *options)
    output = "#{@folder}/#{what}.txt"
    system(AskedOnce.environment, "#{ENV.fetch('CBMC')}/cbmc", program, '--cover', what, *options, '--unwind', '200', '--drop-unused-functions',
           in: File::NULL, %i[out err] => output, rlimit_cpu: [@seconds_most, @seconds_most + 1])
    said = File.read(output)
    said if said.match?(/^\*\* \d+ of \d+ covered/)
  end

  # What stands behind the names of a module's functions: FIXPID_SUFFIXED in
  # include/fixpid.h.
  def mark(name)
    @proof.object && name.start_with?("fixpid_#{@proof.object}_") ? '_c' : ''
  end

  def tool(name, *arguments)
    @said, status = Open3.capture2e(AskedOnce.environment, "#{ENV.fetch('CBMC')}/#{name}", *arguments)
    status.success?
  end

  # Gives the program, or nil.
  def compile(to_its_end: false)
    FileUtils.rm_rf(@folder)
    FileUtils.mkdir_p(@folder)
    program = "#{@folder}/program"
    tool('goto-cc', *@proof.flags(@tree), *(to_its_end ? ended : [@proof.harness, '--function', @proof.function]), '-o', program) or return nil
    @proof.contracts.each do |function, other|
      replaced = "#{program}-#{function}"
      tool('goto-instrument', '--replace-calls', "#{function}#{mark(function)}:#{other}", program, replaced) or return nil
      program = replaced
    end
    program
  end

  def ask(program, *options)
    output = "#{@folder}/output.txt"
    process = Process.spawn(AskedOnce.environment, "#{ENV.fetch('CBMC')}/cbmc", program, *CHECKS, '--stop-on-fail', *options, *@options,
                            in: File::NULL, %i[out err] => output, rlimit_cpu: [@seconds_most, @seconds_most + 1], rlimit_as: MEGABYTES_MOST << 20)
    status = watch(process)
    judge(@said = File.read(output), status)
  end

  # Waits for its end; the last looks at /proc are what it took.
  def watch(process)
    @megabytes = 0
    loop do
      figures = File.read("/proc/#{process}/stat").split(') ').last.split
      @seconds = figures[11..14].map(&:to_i).sum / TICKS
      break if figures.first == 'Z'

      @megabytes = [@megabytes, File.read("/proc/#{process}/status")[/VmHWM:\s+(\d+)/, 1].to_i / 1024].max
      sleep 0.02
    end
    Process.wait2(process).last
  end

  def judge(said, status)
    properties = said.scan(/: SUCCESS$/).size
    verdict, why =
      if status.termsig || @seconds >= @seconds_most
        [:none, "no answer in #{@seconds_most} s and #{MEGABYTES_MOST} MB"]
      elsif said.match?(/^VERIFICATION SUCCESSFUL$/) && status.success?
        properties.zero? ? [:none, 'it has no properties'] : [:proved, nil]
      elsif said.match?(/^VERIFICATION FAILED$/)
        [:refuted, said[/^Violated property:\n.*\n.*\n?/].to_s.strip]
      else
        [:none, said.lines.last(5).join]
      end
    Answer.new(verdict, why, properties, @seconds, @megabytes)
  end
end

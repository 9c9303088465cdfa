# SPDX-License-Identifier: MIT
# Breaks the sources in src/ and the macros of include/ in every small way, and
# in the ways of test/faults.txt that are for a unit test, and names the test that
# notices each break: build/test/mutants.txt. A break that no test notices must stand in
# test/tools/mutants/equivalent.txt with the reason why it changes nothing. What the
# compiler refuses, what crashes and what does not end counts as neither. With
# names of files only those are broken.
# The chips' own folders of src/ are not broken here: their files compile to
# nothing on this machine. test/chips/target breaks each once (`seeded`), and
# tools/prove --assembly leaves instructions out.
require 'fileutils'
require 'open3'
require_relative 'breaks'
require_relative 'equivalents'
require_relative 'faults'

Encoding.default_external = 'UTF-8' # of what Ceedling prints

ROOT = 'build/mutants'.freeze
REPORT = 'build/test/mutants.txt'.freeze
EQUIVALENT = 'test/tools/mutants/equivalent.txt'.freeze
UNITY = "#{ROOT}/ceedling/vendor/unity/src".freeze
WORKERS = 2
OF_LIBRARY = '/test_fixpid'.freeze # and of no example or port
LINKING = Mutex.new
SECONDS_MOST = 1 # of a processor's time: no test takes half of one
NARROW = %w[-D_PIC14].freeze
EVERY_BIT = %w[-DFIXPID_AN964_TERM_LIMIT=255 -DFIXPID_AN964_8BIT_TERM_LIMIT=127].freeze
# tcc does not fold real constants, and takes no branch for __GNUC__.
OF_GCC = %r{\Ainclude/|/fixpid_(?:bits|signed\w*)\.h\z}.freeze
OF_CHIPS = 'src/*/*_{arm,avr,pic14,pic18,sdcc}.[ch]'.freeze
FLAGS = %w[-std=gnu99 -O0 -w -DUNITY_SUPPORT_64 -DTEST_STRIDE=31 -Itest/support -Isim/link -Itest/tools/cost -DTEST_STEPS_MAX=1500].freeze
CONDITION = /\A[ \t]*#[ \t]*(?:if|el|endif)/.freeze
COMPLAINT = /: (?:fatal )?error: |: undefined reference to |: multiple definition of /.freeze

# fixpid_an964_8bit of fixpid_an964_8bit_more: what has a header.
def noun(name)
  words = name.split('_')
  words.size.downto(1).map { |count| words.first(count).join('_') }.find { |begun| File.exist?("include/#{begun}.h") } || name
end

# A test, what is compiled anew for it, and how: tcc takes a tenth of gcc's time.
Run = Struct.new(:test, :sources, :options, :compiler) do
  def initialize(test, sources, options = [], compiler = 'tcc')
    super
  end

  def by(compiler)
    Run.new(test, sources, options, compiler)
  end

  def objects
    fresh = sources.map { |source| "#{File.basename(source, '.c')}.o" }
    Dir["#{ROOT}/ceedling/test/out/**/#{test}/**/*.o"].reject { |object| fresh.include?(File.basename(object)) }
  end

  # All of them in one, which is linked to thousands of mutants.
  def rest
    "#{ROOT}/rest/#{[test, *sources.map { |source| File.basename(source, '.c') }].join('+')}.o" # of 255 characters at most
  end
end

def run_of(test, options = [])
  Run.new(test, ["test/unit/#{test}.c"], options)
end

# With all that it has of src/ compiled anew, too.
def whole_run_of(test)
  objects = Dir["#{ROOT}/ceedling/test/out/**/#{test}/**/*.o"].map { |object| File.basename(object, '.o') }
  Run.new(test, ["test/unit/#{test}.c", *Dir['src/*/*.c'].select { |file| objects.include?(File.basename(file, '.c')) }]).by('gcc')
end

# Of fixpid_autotune also the recorded experiments.
def autotune_runs(sources)
  %w[test_fixpid_autotune test_fixpid_autotune_result test_fixpid_autotune_rows].map { |test| Run.new(test, sources) }
end

# Of fixpid_pid with all features and with none.
def pid_runs(sources)
  [*%w[test_fixpid_pid test_fixpid_pid_rest test_fixpid_pid_error].map { |test| Run.new(test, sources) },
   Run.new('test_fixpid_pid_typical', sources, %w[-DFIXPID_PID_FEATURES=0x00])]
end

def state_runs(sources)
  [Run.new('test_fixpid_pid_state', sources), Run.new('test_fixpid_pid_typical', sources, %w[-DFIXPID_PID_FEATURES=0x00])]
end

# Of fixpid_link: a board and its twin, too, and what has no features.
def link_runs(sources)
  untracked = sources.grep_v(/_tracked\.c\z/)
  [Run.new('test_fixpid_link', sources), Run.new('test_fixpid_link_twin', sources),
   *(untracked.empty? ? [] : [Run.new('test_fixpid_link_typical', untracked, %w[-DFIXPID_PID_FEATURES=0x00])])]
end

# The runs in which a file is compiled: what tcc's do not notice or do not reach, gcc's
# are asked.
def runs_of(file)
  runs = runs_by_name(file)
  by_gcc = runs.map { |run| run.by('gcc') }
  file.match?(OF_GCC) ? by_gcc : runs | by_gcc
end

def runs_by_name(file)
  name = File.basename(file, '.*')
  return [run_of('test_fixpid_constants'), whole_run_of("test_#{name}")] if file.start_with?('include/')
  return autotune_runs([file]) if file.match?(/fixpid_autotune\w*\.c\z/)
  return link_runs([file]) if file.match?(/fixpid_link\w*\.c\z/)
  return state_runs([file]) if file.end_with?('fixpid_pid_state.c')
  return pid_runs([file]) if file.match?(/fixpid_pid\w*\.c\z/)
  return [Run.new("test_#{noun(name)}", [file])] if file.end_with?('.c')

  case name
  when 'fixpid_bits' then [run_of('test_fixpid_bits'), *runs_of('src/common/fixpid_signed.h')] # a shift of the second
  when 'fixpid_shift_add' then [run_of('test_fixpid_bits')]
  when 'fixpid_pid_private', 'fixpid_pid_accept', 'fixpid_pid_limit'
    pid_runs(Dir['src/pid/fixpid_pid{,_error,_more,_track}.c'])
  when 'fixpid_autotune_private' then autotune_runs(Dir['src/autotune/*.c'].sort)
  when 'fixpid_autotune_equations' then autotune_runs(%w[src/autotune/fixpid_autotune_result.c])
  when 'fixpid_autotune_constants' then [run_of('test_fixpid_autotune_arith'), *autotune_runs(%w[src/autotune/fixpid_autotune_result.c])]
  when 'fixpid_reaction_private' then [Run.new('test_fixpid_reaction', Dir['src/reaction/*.c'].sort)]
  when 'fixpid_table_text' then runs_of('src/table/fixpid_table.c')
  when 'fixpid_difference'
    %w[guard table].map { |noun| Run.new("test_fixpid_#{noun}", ["src/#{noun}/fixpid_#{noun}.c"]) }
  when 'fixpid_link_private' then link_runs(Dir['src/link/*.c'].sort)
  when 'fixpid_get' then [*runs_of('src/common/fixpid_bytes.h'), *link_runs(%w[src/link/fixpid_link.c src/link/fixpid_link_commands.c])]
  when 'fixpid_put' then [*runs_of('src/common/fixpid_bytes.h'), *link_runs(%w[src/link/fixpid_link.c src/link/fixpid_link_tracked.c])]
  when 'fixpid_bytes' then [*runs_of('src/common/fixpid_check.h'), *state_runs(%w[src/pid/fixpid_pid_state.c])]
  when 'fixpid_check' then [Run.new('test_fixpid_record', %w[src/record/fixpid_record.c]), *autotune_runs(%w[src/autotune/fixpid_autotune_record.c])]
  when 'fixpid_an937_arith' then [run_of('test_fixpid_an937_arith'), run_of('test_fixpid_an937_arith', %w[-D__riscv])]
  when 'fixpid_signed_riscv'
    [run_of('test_fixpid_pid_arith', %w[-D__riscv]), run_of('test_fixpid_pid_arith', %w[-D__riscv -D__riscv_mul])]
  when /\Afixpid_signed/
    [run_of('test_fixpid_pid_arith'), run_of('test_fixpid_pid_arith', NARROW), run_of('test_fixpid_pid_arith_portable')]
  when /_narrow$/ then [run_of("test_#{noun(name)}_arith", NARROW + EVERY_BIT), run_of("test_#{noun(name)}_arith", NARROW)]
  when /_bytes$/ then [run_of("test_#{noun(name)}_arith_bytes")]
  else [run_of("test_#{name}")]
  end
end

def program_of(test)
  Dir["test/unit/**/#{test}.c"].first
end

def build_objects
  FileUtils.mkdir_p('build/test')
  objects = "#{ROOT}/ceedling/test/out"
  # Those of another project.yml may be of files that are gone.
  FileUtils.rm_rf(objects) if File.exist?(objects) && File.mtime(objects) < File.mtime('project.yml')
  File.write('build/test/mutants.yml', ":project:\n  :build_root: #{ROOT}/ceedling\n" \
             ":defines:\n  :test:\n    '*':\n      - UNITY_SUPPORT_64\n      - UNITY_USE_FLUSH_STDOUT\n      - TEST_RANDOM_STEPS=3000\n      - TEST_STRIDE=3\n")
  said, status = Open3.capture2e('ceedling', '--mixin=build/test/mutants.yml', "test:pattern[#{OF_LIBRARY}]")
  status.success? or
    abort "FAILED the unit tests do not pass before anything is broken:\n#{said.lines.grep(/:FAIL|error:|undefined reference|No such file|ERROR/).first(5).join}"
  FileUtils.rm_rf("#{ROOT}/rest")
end

# A tree of all sources for each worker, of which one is broken: src/ files
# include each other by their place.
def plant_trees
  WORKERS.times do |worker|
    FileUtils.rm_rf("#{ROOT}/#{worker}")
    FileUtils.mkdir_p("#{ROOT}/#{worker}")
    FileUtils.cp_r(%w[src include], "#{ROOT}/#{worker}")
  end
end

def in_tree(source, tree)
  source.start_with?('src/') ? "#{tree}/#{source}" : source
end

def compiler(run, tree, *arguments)
  [run.compiler, *FLAGS, *run.options, "-I#{tree}/include", "-I#{tree}/src", "-I#{UNITY}", *arguments,
   *run.sources.map { |source| in_tree(source, tree) }]
end

# What a run does not compile anew, in one object.
def rest_of(run)
  LINKING.synchronize do
    unless File.exist?(run.rest)
      FileUtils.mkdir_p(File.dirname(run.rest))
      system('ld', '-r', *run.objects, '-o', run.rest) or abort "FAILED the linker does not work: #{run.test}"
    end
  end
  run.rest
end

# The program of a run, or nil if the compiler refuses it. A compiler that fails
# without a word about the code says nothing about a break.
def build(run, tree)
  program = "#{tree}/program"
  output, status = Open3.capture2e(*compiler(run, tree, '-o', program), rest_of(run))
  return program if status.success?

  output.match?(COMPLAINT) && !output.match?(/No space left|internal compiler error|Cannot allocate/) or
    abort "FAILED the compiler does not work:\n#{output}"
  nil
end

# What a test program does: the names of the tests that fail, of all or only of the
# first, after which it is stopped; a symbol for another end, or nil.
def run_test(program, all: false)
  failed = []
  output = +''
  status = Open3.popen2e(program, rlimit_cpu: [SECONDS_MOST, SECONDS_MOST + 1]) do |_, printed, process|
    printed.each_line do |line|
      output << line
      failed << line[/^[^:\n]+:\d+:(\w+):FAIL/, 1] if line.include?(':FAIL')
      break stop(process) if failed.any? && !all
    end
    process.value
  end
  return failed.compact if failed.any?
  return :endless if status.termsig == Signal.list['XCPU']

  output =~ /^OK$/ ? nil : :crashed
end

def stop(process)
  Process.kill(:KILL, process.pid)
rescue Errno::ESRCH
  nil # it has just ended
end

def notice_in(run, tree, all: false)
  program = build(run, tree) or return :refused
  run_test(program, all: all)
end

# Yields with the text in place of the file.
def broken(tree, file, text)
  whole = File.read("#{tree}/#{file}")
  File.write("#{tree}/#{file}", text)
  yield
ensure
  File.write("#{tree}/#{file}", whole) if whole
end

def notice(mutant, worker)
  tree = "#{ROOT}/#{worker}"
  runs = RUNS.fetch(mutant.file).select { |run| REACHED.fetch([mutant.file, run])[mutant.line - 1] }
  return :not_compiled if runs.empty?

  broken(tree, mutant.file, mutant.source) do
    caught = nil
    runs.each { |run| caught ||= notice_in(run, tree) }
    caught ||= (:not_compiled if same_for_the_compiler?(mutant, tree))
    caught.is_a?(Array) ? caught.first : caught
  end
end

def preprocessed(file, tree)
  RUNS.fetch(file).map { |run| text_of(run, tree) }
end

def text_of(run, tree)
  Open3.capture3(*compiler(run, tree, '-E', '-P')).first
end

# For each line of a file whether a run's preprocessor reaches it: whether a mark below
# the last condition above it is in what it makes.
def reached_lines(file, run, tree)
  mark = 0
  marks = []
  text = File.readlines(file).slice_when { |line, _| !line.end_with?("\\\n") }.flat_map do |lines|
    marks.concat([mark] * lines.size)
    lines.first.match?(CONDITION) ? [*lines, "MARK_OF_MUTANTS_#{mark += 1}\n"] : lines
  end
  found = broken(tree, file, "MARK_OF_MUTANTS_0\n#{text.join}") { text_of(run, tree).scan(/\bMARK_OF_MUTANTS_(\d+)\b/).flatten.map(&:to_i).uniq }
  marks.map { |one| found.include?(one) }
end

# Whether it is in what no run compiles: it makes no difference after the
# preprocessor.
def same_for_the_compiler?(mutant, tree)
  UNBROKEN.fetch(mutant.file) == preprocessed(mutant.file, tree)
end

# [mutant, what noticed it] of all, in order.
def results_of(mutants)
  queue = Queue.new
  mutants.each { |mutant| queue << mutant }
  results = {}
  lock = Mutex.new
  workers = (0...WORKERS).map do |worker|
    Thread.new do
      until queue.empty?
        mutant = queue.pop(true)
        caught = notice(mutant, worker)
        lock.synchronize { results[mutant] = caught }
      end
    rescue ThreadError
      nil # the queue ran empty between the two calls
    end
  end
  workers.each(&:join)
  mutants.map { |mutant| [mutant, results.fetch(mutant)] }
end

# The lines of a file, and whether they are good: every survivor is named there, and what
# is named there survives.
def judged(file, results, keys, equivalents)
  survivors = results.select { |_, caught| caught.nil? }.map { |mutant, _| keys.fetch(mutant) }
  unexplained = survivors.reject { |key| equivalents.cover?(key) }
  stale = equivalents.stale(file, survivors)
  good = unexplained.empty? && stale.empty?
  [good, ["#{good ? 'ok' : 'FAILED'} #{file}: #{results.size} mutants, #{survivors.size} noticed by no test",
          *unexplained.map { |key| "Nobody notices: #{key}" },
          *stale.map { |key| "No longer true in #{EQUIVALENT}: #{key}" }]]
end

# Whether all mutants of a file are noticed. Their lines are printed and noted, and so is by
# what the mutants ended.
def good?(file, equivalents)
  RUNS[file].each { |run| try_unbroken(run) }
  UNBROKEN[file] = preprocessed(file, "#{ROOT}/0")
  RUNS[file].each { |run| REACHED[[file, run]] = reached_lines(file, run, "#{ROOT}/0") }
  RUNS[file].any? { |run| REACHED[[file, run]].any? } or abort "FAILED no test of #{file} reads it"
  mutants = Breaks.of(file)
  results = results_of(mutants)
  good, lines = judged(file, results, EquivalentMutants.keys(mutants, File.read(file)), equivalents)
  puts lines
  RESULTS.concat(results)
  good
end

# What a compiler or an operating system ends is no test's merit.
def tell_all
  ends = RESULTS.map { |_, caught| caught.is_a?(String) ? :named : caught || :nobody }.tally
  ends.default = 0
  File.write(REPORT, RESULTS.map { |mutant, caught| "#{mutant}: #{caught || 'nobody'}\n" }.join)
  puts "#{RESULTS.size} mutants: #{ends[:named]} noticed by a test, #{ends[:nobody]} by none; see #{REPORT}"
  puts "apart: #{ends[:refused]} refused by the compiler, #{ends[:crashed]} crashed, " \
       "#{ends[:endless]} endless, #{ends[:not_compiled]} not compiled on this machine"
end

# Whether a fault of the table is noticed by the test that it names.
def noticed_by_name?(fault)
  test = fault.words(1).first
  program = Dir['test/unit/*.c'].find { |path| File.read(path).include?("void #{test}(") } or
    abort "FAILED #{Faults::FILE}: no #{test}"
  run = whole_run_of(File.basename(program, '.c'))
  tree = "#{ROOT}/0"
  caught = broken(tree, fault.file, fault.sources.fetch(fault.file)) { notice_in(run, tree, all: true) }
  good = caught.is_a?(Array) && caught.include?(test)
  puts good ? "ok #{test} notices #{fault}" : "FAILED #{test} notices #{fault}: #{caught.inspect}"
  good
rescue Faults::Gone => e
  puts "FAILED #{e.message}"
end

def try_unbroken(run)
  return if PASSED.include?(run)

  program_of(run.test) or abort "FAILED #{run.sources.first} has no test/unit/#{run.test}.c"
  caught = notice_in(run, "#{ROOT}/0")
  caught = Open3.capture2e(*compiler(run, "#{ROOT}/0", '-fsyntax-only')).first.lines.grep(/error/).first if caught == :refused
  abort "FAILED #{[run.test, *run.options].join(' ')} fails with nothing broken: #{caught}" if caught
  PASSED << run
end

PASSED = [] # without a break
RESULTS = [] # [mutant, what noticed it]
UNBROKEN = {}
REACHED = {} # by file and run
RUNS = Hash.new { |runs, file| runs[file] = runs_of(file) }
equivalents = EquivalentMutants.new(EQUIVALENT)
FileUtils.mkdir_p(File.dirname(REPORT))
only = ARGV # files
files = (Dir['src/*/*.[ch]', 'include/*.h'] - Dir[OF_CHIPS]).sort.reject { |file| Breaks.of(file).empty? }
build_objects
plant_trees
chosen = files.select { |file| only.empty? || only.include?(file) }
good = chosen.map { |file| good?(file, equivalents) }
faults = Faults.of('unit').select { |fault| only.empty? || only.include?(fault.file) }
good += faults.map { |fault| noticed_by_name?(fault) }
strangers = equivalents.strangers(files)
puts strangers.map { |key| "FAILED #{EQUIVALENT} names what is not broken: #{key}" }
tell_all
exit(good.all? && strangers.empty? ? 0 : 1)

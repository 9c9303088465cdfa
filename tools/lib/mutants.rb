# SPDX-License-Identifier: MIT
# Breaks the sources in src/ in every small way and names the unit test that
# notices each break: build/test/mutants.txt. A break that no test notices must
# stand in test/mutants/equivalent.txt with the reason why it changes nothing.
# What the compiler refuses, what crashes and what does not end counts as neither.
# The chips' own folders of src/ are not broken here: their files compile to
# nothing on this machine, and test/target breaks them (`planted`).
require 'fileutils'
require 'open3'

ROOT = 'build/mutants'.freeze
REPORT = 'build/test/mutants.txt'.freeze
EQUIVALENT = 'test/mutants/equivalent.txt'.freeze
UNITY = "#{ROOT}/ceedling/vendor/unity/src".freeze
WORKERS = 2
SECONDS_MOST = 1 # of a processor's time: no test takes half of one
NARROW = %w[-D_PIC14].freeze
EVERY_BIT = %w[-DFIXPID_AN964_TERM_LIMIT=255 -DFIXPID_AN964_8BIT_TERM_LIMIT=127].freeze

OPERATORS = { '<' => %w[<= >], '<=' => %w[< >], '>' => %w[>= <], '>=' => %w[> <], '==' => %w[!=],
              '!=' => %w[==], '+' => %w[-], '-' => %w[+], '*' => %w[+], '/' => %w[*], '<<' => %w[>>], '>>' => %w[<<],
              '&' => %w[|], '|' => %w[&], '^' => %w[|], '|=' => %w[=], '&=' => %w[|=], '^=' => %w[=], '--' => %w[++],
              '>>=' => %w[<<=], '<<=' => %w[>>=], '+=' => %w[-=], '-=' => %w[+=], '~' => [''],
              'kp' => %w[ki], 'ki' => %w[kd], 'kd' => %w[kp], 'kp_q4' => %w[ki_q4], 'ki_q4' => %w[kd_q4],
              'kd_q4' => %w[kp_q4], 'left' => %w[right], 'right' => %w[left], 'low' => %w[high], 'high' => %w[low],
              'true' => %w[false], 'false' => %w[true], 'MULTIPLY' => %w[DIVIDE], 'DIVIDE' => %w[MULTIPLY],
              'ADD' => %w[SUBTRACT], 'SUBTRACT' => %w[ADD], 'MINIMUM' => %w[MAXIMUM], 'MAXIMUM' => %w[MINIMUM],
              'X' => %w[Y], 'Y' => %w[X] }.freeze
TOKEN = %r{//[^\n]*|\{END, [0-9, ]*\}|->|<<=|>>=|<<|>>|<=|>=|==|!=|&&|\|\||[|&^+-]=|--|[A-Za-z_]\w*|\d\w*|\n|.}m.freeze
FLAGS = %w[-std=gnu99 -O0 -w -DUNITY_SUPPORT_64 -DTEST_STRIDE=31 -Iinclude -Itest/support].freeze

# fixpid_an964_8bit of fixpid_an964_8bit_more: what has a header.
def noun(name)
  File.exist?("include/#{name}.h") ? name : noun(name[/.*(?=_)/])
end

# A test, what is compiled anew for it, and how.
Run = Struct.new(:test, :sources, :options) do
  def objects
    fresh = sources.map { |source| "#{File.basename(source, '.c')}.o" }
    Dir["#{ROOT}/ceedling/test/out/#{test}/*.o"].reject { |object| fresh.include?(File.basename(object)) }
  end
end

def run_of(test, options = [])
  Run.new(test, ["test/unit/#{test}.c"], options)
end

# Of fixpid_autotune also the recorded experiments.
def autotune_runs(sources)
  %w[test_fixpid_autotune test_fixpid_autotune_rows].map { |test| Run.new(test, sources, []) }
end

# Of fixpid_pid with all features and with none.
def pid_runs(sources)
  [Run.new('test_fixpid_pid', sources, []),
   Run.new('test_fixpid_pid_typical', sources, %w[-DFIXPID_PID_FEATURES=0x00])]
end

# The runs in which a file is compiled, by its name in src/.
def runs_of(file)
  name = File.basename(file, '.*')
  return autotune_runs([file]) if file.match?(/fixpid_autotune\w*\.c\z/)
  return pid_runs([file]) if file.match?(/fixpid_pid\w*\.c\z/)
  return [Run.new("test_#{noun(name)}", [file], [])] if file.end_with?('.c')

  case name
  when 'fixpid_self' then []
  when 'fixpid_bits' then [run_of('test_fixpid_bits'), *runs_of('src/fixpid_pid_arith.h')] # a shift of the second
  when 'fixpid_shift_add' then [run_of('test_fixpid_bits')]
  when 'fixpid_pid_private', 'fixpid_pid_accept', 'fixpid_pid_limit'
    pid_runs(Dir['src/fixpid_pid{,_more,_track}.c'])
  when 'fixpid_autotune_private' then autotune_runs(Dir['src/fixpid_autotune*.c'].sort)
  when 'fixpid_pid_arith'
    [run_of('test_fixpid_pid_arith'), run_of('test_fixpid_pid_arith', NARROW), run_of('test_fixpid_pid_arith_portable')]
  when /_narrow$/ then [run_of("test_#{noun(name)}_arith", NARROW + EVERY_BIT), run_of("test_#{noun(name)}_arith", NARROW)]
  when /_bytes$/ then [run_of("test_#{noun(name)}_arith_bytes")]
  else [run_of("test_#{name}")]
  end
end

RUNS = Dir['src/*.[ch]'].sort.to_h { |file| [file, runs_of(file)] }.reject { |_, runs| runs.empty? }.freeze

Mutant = Struct.new(:file, :line, :from, :to, :source)

def number_replacements(token)
  match = token.match(/\A(0x\h+|\d+)([uU]?)\z/) or return []

  value = Integer(match[1])
  [value + 1, value - 1].reject(&:negative?).map { |other| "#{other}#{match[2]}" }
end

# For each line whether it is not arithmetic: preprocessor outside of macros with
# its continuations, assertions, parameter lists.
def skipped_lines(lines)
  continued = false
  lines.map do |line|
    skipped = continued || line =~ /^\s*#\s*(?:include|if|el|endif|error|ifndef|ifdef|undef)|FIXPID_MULTIPLIER_BITS/
    continued = skipped && line.end_with?("\\\n")
    skipped || line =~ /FIXPID_ASSERT|struct fixpid_|define VALID|define SELF/
  end
end

# `*pointer` and `&object`, which only the compiler would notice.
def unary?(text, position, token)
  %w[* &].include?(token) && text[0...position] =~ /(?:[(,=?:&|{;+-]|return)\s*\z/
end

def mutants_of(file)
  text = File.read(file)
  skipped = skipped_lines(text.lines)
  mutants = []
  position = 0
  line = 0
  text.scan(TOKEN) do |token|
    unless skipped[line] || token.start_with?('//') || unary?(text, position, token)
      (OPERATORS.fetch(token, []) + number_replacements(token)).each do |other|
        changed = text[0...position] + other + text[(position + token.size)..]
        mutants << Mutant.new(file, line + 1, token, other, changed)
      end
    end
    position += token.size
    line += token.count("\n")
  end
  mutants + dropped(file, text)
end

ASSIGNMENT = /[A-Za-z_*.\[\]0-9>-]+ [|&^+-]?= [^;{}\\]+;/.freeze
CALL = /(?!(?:if|for|while|switch|return|sizeof|FIXPID_ASSERT)\b)\w+\([^;{}\\]*\);/.freeze
STATEMENT = /^ +(?<what>#{ASSIGNMENT}|#{CALL})$/.freeze
OPERATION = /(?<what>\{(?!END)[A-Z]+(?:, \w+){3}\},)/.freeze # of a table

def left_out(file, text, pattern, instead)
  text.to_enum(:scan, pattern).map do
    match = Regexp.last_match
    range = match.begin(:what)...match.end(:what)
    changed = text[0...range.begin] + instead + text[range.end..]
    Mutant.new(file, text[0...range.begin].count("\n") + 1, match[:what].gsub(/\s+/, ' '), '', changed)
  end
end

def dropped(file, text)
  left_out(file, text, STATEMENT, ';') + left_out(file, text, OPERATION, '')
end

def build_objects
  system('ceedling', '--mixin=build/test/mutants.yml', 'test:all', out: File::NULL, err: File::NULL) or
    abort 'the unit tests do not pass before anything is broken'
end

# What a test program does: the name of its first failing test, a symbol for
# another end, or nil.
def run_test(program)
  output, status = Open3.capture2e(program, rlimit_cpu: [SECONDS_MOST, SECONDS_MOST + 1])
  return output[/^[^:\n]+:\d+:(\w+):FAIL/, 1] if output =~ /:FAIL/
  return :endless if status.termsig == Signal.list['XCPU']

  output =~ /^OK$/ ? nil : :crashed
end

# A tree of all sources, of which one is broken: src/ files include each other
# by their place.
def in_tree(source, tree)
  source.start_with?('src/') ? "#{tree}/#{source}" : source
end

def notice_in(run, tree)
  program = "#{tree}/program"
  sources = run.sources.map { |source| in_tree(source, tree) }
  system('gcc', *FLAGS, *run.options, "-I#{tree}/src", "-I#{UNITY}", *sources, *run.objects, '-o', program,
         out: File::NULL, err: File::NULL) or return :refused

  run_test(program)
end

def notice(mutant, worker)
  tree = "#{ROOT}/#{worker}"
  whole = File.read(mutant.file)
  File.write("#{tree}/#{mutant.file}", mutant.source)
  RUNS.fetch(mutant.file).each do |run|
    caught = notice_in(run, tree)
    return caught if caught
  end
  same_for_the_compiler?(mutant, tree) ? :not_compiled : nil
ensure
  File.write("#{tree}/#{mutant.file}", whole)
end

def preprocessed(file, tree)
  RUNS.fetch(file).map do |run|
    sources = run.sources.map { |source| in_tree(source, tree) }
    Open3.capture2('gcc', *FLAGS, *run.options, "-I#{tree}/src", "-I#{UNITY}", '-E', '-P', *sources).first
  end
end

# Whether it is in what no run compiles: it makes no difference after the
# preprocessor.
def same_for_the_compiler?(mutant, tree)
  UNBROKEN.fetch(mutant.file) == preprocessed(mutant.file, tree)
end

def describe(mutant)
  "#{mutant.file}:#{mutant.line}: `#{mutant.from}` -> `#{mutant.to}`"
end

# How equivalent.txt names a mutant: by the text of its line, not its number.
def key(mutant)
  text = File.readlines(mutant.file)[mutant.line - 1].sub(%r{//.*}, '').delete('\\').strip.gsub(/\s+/, ' ')
  "#{mutant.file}: #{text}: `#{mutant.from}` -> `#{mutant.to}`"
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
  mutants.map { |mutant| [mutant, results[mutant]] }
end

FileUtils.mkdir_p('build/test')
File.write('build/test/mutants.yml', ":project:\n  :build_root: #{ROOT}/ceedling\n" \
           ":defines:\n  :test:\n    '*':\n      - UNITY_SUPPORT_64\n      - TEST_RANDOM_STEPS=3000\n      - TEST_STRIDE=3\n")
build_objects
WORKERS.times do |worker|
  FileUtils.rm_rf("#{ROOT}/#{worker}")
  FileUtils.mkdir_p("#{ROOT}/#{worker}")
  FileUtils.cp_r('src', "#{ROOT}/#{worker}")
end
RUNS.values.flatten.uniq.each do |run|
  caught = notice_in(run, "#{ROOT}/0")
  abort "#{run.test} fails unbroken, with #{run.options.join(' ')}: #{caught}" if caught
end
UNBROKEN = RUNS.keys.to_h { |file| [file, preprocessed(file, "#{ROOT}/0")] }.freeze
known = File.exist?(EQUIVALENT) ? File.readlines(EQUIVALENT, chomp: true).grep(/^src/) : []
only = ARGV # files
results = results_of(RUNS.keys.select { |file| only.empty? || only.include?(file) }.flat_map { |file| mutants_of(file) })
named, others = results.partition { |_, caught| caught.is_a?(String) }
apart = others.group_by { |_, caught| caught }.transform_values { |pairs| pairs.map(&:first) }
survivors = apart.fetch(nil, [])
File.open(REPORT, 'w') do |report|
  results.each { |mutant, caught| report.puts "#{describe(mutant)}: #{caught || 'nobody'}" }
end
unexplained = survivors.map { |mutant| key(mutant) }.uniq - known
stale = only.empty? ? known - survivors.map { |mutant| key(mutant) } : []
puts "#{results.size} mutants: #{named.size} noticed by a test, #{survivors.size} by none; see #{REPORT}"
puts "apart: #{apart.fetch(:refused, []).size} refused by the compiler, #{apart.fetch(:crashed, []).size} crashed, " \
     "#{apart.fetch(:endless, []).size} endless, #{apart.fetch(:not_compiled, []).size} not compiled on this machine"
puts 'Nobody notices:', unexplained unless unexplained.empty?
puts "No longer true in #{EQUIVALENT}:", stale unless stale.empty?
exit(unexplained.empty? && stale.empty? ? 0 : 1)

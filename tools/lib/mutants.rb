# SPDX-License-Identifier: MIT
# Breaks the sources in src/ in every small way and names the unit test that notices each
# break: build/test/mutants.txt. A break that no test notices must stand in
# test/mutants/equivalent.txt with the reason why it changes nothing. The headers
# of arithmetic are not broken: their leaves are walked over their domains.
require 'fileutils'
require 'open3'
require 'timeout'

ROOT = 'build/mutants'.freeze
REPORT = 'build/test/mutants.txt'.freeze
EQUIVALENT = 'test/mutants/equivalent.txt'.freeze
# fixpid_an964_8bit of fixpid_an964_8bit_access: what has a header.
def noun(name)
  File.exist?("include/#{name}.h") ? name : noun(name[/.*(?=_)/])
end

# A chip's own files compile to nothing here.
TESTS = Dir['src/*.c'].grep_v(/_pic1\d\.c/).sort.to_h { |file| [file, "test_#{noun(File.basename(file, '.c'))}"] }.freeze
OPERATORS = { '<' => %w[<= >], '<=' => %w[< >], '>' => %w[>= <], '>=' => %w[> <], '==' => %w[!=],
              '!=' => %w[==], '+' => %w[-], '-' => %w[+], '*' => %w[+], '<<' => %w[>>], '>>' => %w[<<],
              '&' => %w[|], '|' => %w[&], '|=' => %w[=], '--' => %w[++], '>>=' => %w[<<=], '+=' => %w[-=],
              'kp' => %w[ki], 'ki' => %w[kd], 'kd' => %w[kp], 'kp_q4' => %w[ki_q4], 'ki_q4' => %w[kd_q4],
              'kd_q4' => %w[kp_q4], 'true' => %w[false], 'false' => %w[true] }.freeze
TOKEN = %r{//[^\n]*|->|<<=|>>=|<<|>>|<=|>=|==|!=|&&|\|\||\|=|\+=|--|[A-Za-z_]\w*|\d\w*|\n|.}m.freeze
FLAGS = %w[-std=gnu99 -O0 -w -DUNITY_SUPPORT_64 -DTEST_RANDOM_STEPS=3000 -DTEST_STRIDE=31 -DFIXPID_PRODUCT=3 -Iinclude -Itest/support].freeze

Mutant = Struct.new(:file, :line, :from, :to, :source)

def number_replacements(token)
  match = token.match(/\A(0x\h+|\d+)([uU]?)\z/) or return []

  value = Integer(match[1])
  [value + 1, value - 1].reject(&:negative?).map { |other| "#{other}#{match[2]}" }
end

# Lines that are not arithmetic: preprocessor outside of macros, assertions,
# parameter lists, the frame of a macro.
def skipped?(file, line)
  line =~ /^\s*#\s*(?:include|if|el|endif|error|ifndef|ifdef)|FIXPID_ASSERT|struct fixpid_|define VALID|define SELF|\} while \(0\)/ ||
    (file.end_with?('.h') && line =~ /define FIXPID_(?:\w*PRODUCT\w*|\w+_H|INLINE|SCALED_\w+)\b(?!\()/)
end

def mutants_of(file)
  text = File.read(file)
  lines = text.lines
  mutants = []
  position = 0
  text.scan(TOKEN) do |token|
    line = text[0...position].count("\n")
    unless skipped?(file, lines[line]) || token.start_with?('//')
      (OPERATORS.fetch(token, []) + number_replacements(token)).each do |other|
        changed = text[0...position] + other + text[(position + token.size)..]
        mutants << Mutant.new(file, line + 1, token, other, changed)
      end
    end
    position += token.size
  end
  mutants + dropped_assignments(file, text)
end

def dropped_assignments(file, text)
  return [] if file.end_with?('.h')

  mutants = []
  text.scan(/^( +)([A-Za-z_.\[\]0-9]+ \|?= [^;]+;)/) do
    match = Regexp.last_match
    changed = text[0...match.begin(2)] + ';' + text[match.end(2)..]
    mutants << Mutant.new(file, text[0...match.begin(2)].count("\n") + 1, match[2].gsub(/\s+/, ' '), '', changed)
  end
  mutants
end

def build_objects
  system('ceedling', '--mixin=build/test/mutants.yml', 'test:all', out: File::NULL, err: File::NULL) or
    abort 'the unit tests do not pass before anything is broken'
end

# [what a test program does, the name of its first failing test]
def run_test(program)
  output = +''
  Open3.popen2e(program) do |_, out, thread|
    Timeout.timeout(20) { output << out.read }
  rescue Timeout::Error
    Process.kill(:KILL, thread.pid)
    return 'a time-out'
  end
  return output[/^[^:\n]+:\d+:(\w+):FAIL/, 1] if output =~ /:FAIL/

  output =~ /^OK$/ ? nil : 'a crash'
end

def notice(mutant, worker)
  test = TESTS.fetch(mutant.file)
  folder = "#{ROOT}/#{worker}/#{test}" # a broken header is for its own test only
  FileUtils.mkdir_p(folder)
  source = "#{folder}/#{File.basename(mutant.file)}"
  File.write(source, mutant.source)
  objects = Dir["#{ROOT}/ceedling/test/out/#{test}/*.o"]
  header = mutant.file.end_with?('.h')
  replaced = header ? "#{test}.o" : File.basename(mutant.file, '.c') + '.o'
  objects.reject! { |object| File.basename(object) == replaced }
  compiled = header ? "test/unit/#{test}.c" : source
  system('gcc', *FLAGS, "-I#{folder}", '-Isrc', "-I#{ROOT}/ceedling/vendor/unity/src", compiled, *objects,
         '-o', "#{folder}/program", out: File::NULL, err: File::NULL) or return 'the compiler'

  run_test("#{folder}/program")
end

def describe(mutant)
  "#{mutant.file}:#{mutant.line}: `#{mutant.from}` -> `#{mutant.to}`"
end

# How equivalent.txt names a mutant: by the text of its line, not its number.
def key(mutant)
  text = File.readlines(mutant.file)[mutant.line - 1].sub(%r{//.*}, '').delete('\\').strip.gsub(/\s+/, ' ')
  "#{mutant.file}: #{text}: `#{mutant.from}` -> `#{mutant.to}`"
end

FileUtils.mkdir_p('build/test')
File.write('build/test/mutants.yml', ":project:\n  :build_root: #{ROOT}/ceedling\n" \
           ":defines:\n  :test:\n    '*':\n      - TEST_RANDOM_STEPS=3000\n      - TEST_STRIDE=3\n      - FIXPID_PRODUCT=3\n")
FileUtils.rm_rf(["#{ROOT}/0", "#{ROOT}/1"])
build_objects
TESTS.each_key do |file|
  caught = notice(Mutant.new(file, 0, '', '', File.read(file)), 0)
  abort "#{file} fails its test unbroken: #{caught}" if caught
end
known = File.exist?(EQUIVALENT) ? File.readlines(EQUIVALENT, chomp: true).grep(/^src/) : []
mutants = TESTS.keys.flat_map { |file| mutants_of(file) }
queue = Queue.new
mutants.each { |mutant| queue << mutant }
results = {}
lock = Mutex.new
workers = (0..1).map do |worker|
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

survivors = mutants.reject { |mutant| results[mutant] }
File.open(REPORT, 'w') do |report|
  mutants.each { |mutant| report.puts "#{describe(mutant)}: #{results[mutant] || 'nobody'}" }
end
unexplained = survivors.map { |mutant| key(mutant) } - known
stale = known - survivors.map { |mutant| key(mutant) }
puts "#{mutants.size} mutants, #{mutants.size - survivors.size} noticed, " \
     "#{survivors.size - unexplained.size} change nothing; see #{REPORT}"
puts 'Nobody notices:', unexplained unless unexplained.empty?
puts "No longer true in #{EQUIVALENT}:", stale unless stale.empty?
exit(unexplained.empty? && stale.empty? ? 0 : 1)

# SPDX-License-Identifier: MIT
# Static checks of the C sources; prints `ok` or `FAILED` for each, and what it finds. The
# house rules behind them are in CONTRIBUTING.md. With --quick only what takes
# seconds, warnings and shape of src/; with --misra only MISRA as other compilers have it.
require 'fileutils'
require 'open3'
require_relative 'build/large_pages'

STRICT = %w[-std=c99 -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow
            -Wundef -Wstrict-prototypes -Wmissing-prototypes -Wredundant-decls -Werror].freeze
OBJECT_MODE = Dir['include/fixpid_*.h'].sort.map { |header| File.basename(header, '.h') }
                                       .map { |noun| "-D#{noun.upcase}_OBJECT=#{noun.delete_prefix('fixpid_')}_controller" }.freeze
# Wide and narrow arithmetic: XC8's name for a PIC16 chooses the second.
FORMS = [[], ['-D_PIC14']].freeze
GCC = ['-D__GNUC__'].freeze
# What else cppcheck's addon for MISRA looks at, the portable C as a chip's compiler takes it,
# without the words that only that compiler has; and the rules that all of it deviates from there.
# Under SDCC primitives are `inline` and not `static` (5.8, 8.4, 8.10), which FIXPID_INLINE in
# fixpid.h explains; and its shift of a negative number is a macro, so that 10.1 is at each use
# of what one line of fixpid_bits.h deviates in elsewhere. GCC's configurations have these rules.
SDCC_WORDS = %w[-D__data= -D__idata= -D__xdata= -D__code=].freeze
SYSTEMS = {
  'PIC18' => [%w[-D__XC8 -D_PIC18], []],
  'RISC-V' => [%w[-D__GNUC__ -D__riscv], []],
  'SDCC' => [%w[-D__SDCC -D__SDCC_stm8] + SDCC_WORDS, %w[5.8 8.4 8.10 10.1]]
}.freeze
BOARDS = { 'pic16f684' => /pendulum/, 'pic18f4520' => /motor|oven|thermostat|kept|autotune|experiment|watched/ }.freeze
BARE = 'build/lint'.freeze # the sources without the preprocessor's lines
# Debian's, as cppcheck and its addon are: a user's own is often a script that starts many programs.
PYTHON = ENV.fetch('PYTHON', '/usr/bin/python3').freeze
LINES_MAX = 40
COMPLEXITY_MAX = 8

# The include path and the definitions that a source is compiled with: those of
# its board, or of both boards in turn.
def includes(file)
  base = %w[-Iinclude -Isrc -Iport -Isim/host -Isim/world -Isim/plant -Isim/chip]
  return [base] if file.start_with?('src/', 'include/')
  return [base + %w[-Iport/pic/pic18f4520]] if file.start_with?('port/pic/pic18/')
  return [base + ["-I#{File.dirname(file)}"]] if file.start_with?('port/avr/', 'port/pic/', 'port/template/')

  boards = BOARDS.select { |_, names| file =~ names }.keys
  boards = BOARDS.keys if boards.empty?
  boards.map { |board| base + ["-Iport/pic/#{board}"] }
end

@failures = 0

def run(*command)
  output, status = Open3.capture2e(*command)
  [output, status.success?]
end

# `ok FILE`, for the count of checks to fall if a list of files is short.
def judged(file)
  before = @failures
  yield
  puts "#{@failures == before ? 'ok' : 'FAILED'} #{file}"
end

def expect_clean(*command)
  output, good = run(*command)
  return if good && output.empty?

  @failures += 1
  puts command.join(' '), output.lines.first(20)
end

# Both compilers as far as they warn: gcc does until it has written the assembly.
def strictly(file, *words, gcc: [])
  expect_clean('gcc', *STRICT, *gcc, *words, '-S', file, '-o', '/dev/null')
  expect_clean('clang', *STRICT, *words, '-fsyntax-only', file)
end

def warnings(file)
  includes(file).each { |paths| strictly(file, *paths, gcc: %w[-O1 -fanalyzer]) }
end

# Its registers are avr-libc's.
def avr_warnings(file)
  expect_clean('avr-gcc', "-mmcu=#{File.basename(File.dirname(file))}", *STRICT, *includes(file).first, '-c', file,
               '-o', '/dev/null')
end

# But for those that make no other text of it than another one.
def modes_and_forms(file)
  seen = [preprocessed(file)] # by what warnings looks at
  [[], OBJECT_MODE].product(FORMS).each do |mode, form|
    text = preprocessed(file, *mode, *form)
    strictly(file, '-Iinclude', *mode, *form) unless seen.include?(text)
    seen << text
  end
end

def preprocessed(file, *words)
  output, good = run('gcc', '-std=c99', '-E', '-P', '-Iinclude', *words, file)
  good ? output : words
end

# clang-tidy counts the warnings it hid on its standard error.
def tidy(file)
  includes(file).each do |paths|
    output, status = Open3.capture2('clang-tidy', '--quiet', file, '--', '-std=c99', *paths, err: File::NULL)
    next if status.success? && output.empty?

    @failures += 1
    puts "clang-tidy #{file}", output.lines.first(20)
  end
end

# `path:line:...[rule]`, unless the line or the one above explains it.
def explained?(finding)
  path, line, rule = finding.match(/^([^:\s]+):(\d+):.*\[(?:misra-c2012-)?([\w.]+)\]$/)&.captures
  return false unless path && File.exist?(path)

  lines = File.readlines(path)
  [line.to_i - 1, line.to_i - 2].any? { |at| at >= 0 && lines[at].include?("Deviation #{rule}:") }
end

# With a definition, cppcheck takes one configuration, a PC's, instead of guessing
# the definitions of chips.
def misra(directory, files, defines, but: [])
  return if files.empty?

  paths = files.flat_map { |file| includes(file).first }.uniq
  output, good = run('cppcheck', '--quiet', '--std=c99', '--addon=misra', "--addon-python=#{PYTHON}", '--cppcheck-build-dir=build/cppcheck',
                     '--enable=warning,style,performance,portability', '--error-exitcode=0',
                     '--suppressions-list=tools/lib/cppcheck.txt', '--suppress=missingIncludeSystem',
                     '--suppress=unmatchedSuppression', *but.map { |rule| "--suppress=misra-c2012-#{rule}" },
                     *defines, *paths, *files)
  # An addon that cannot run is no failure to cppcheck.
  findings = output.lines(chomp: true).grep(/\[[\w.-]+\]$|internal error/).reject { |finding| explained?(finding) }
  return if good && findings.empty?

  @failures += 1
  puts "cppcheck #{directory}", good ? findings.first(20) : output
end

# Of these files, those that are another text with these definitions than with any before.
# Those that deviate from more rules come last.
def other_texts(files, defines)
  @texts ||= {}
  files.reject do |file|
    text, good = run('cppcheck', '-E', '--quiet', '--std=c99', *defines, *includes(file).first, file)
    key = [file, good ? text.gsub(/^#.*/, '') : defines]
    @texts.key?(key) || !(@texts[key] = true)
  end
end

# The sources of assembly are not C.
def other_systems(library)
  portable = library.grep_v(/_(?:pic14|pic18|avr|sdcc)\.c\z/)
  SYSTEMS.each { |name, (defines, but)| misra("src as of #{name}", other_texts(portable, defines), defines, but: but) }
end

# Whether the line above a function says why it is longer: path(line).
def longer?(place)
  path, line = place.match(/^(.*)\((\d+)\):$/).captures
  File.readlines(path)[line.to_i - 2].include?('Deviation 40 lines:')
end

# For each line of a file whether it is the preprocessor's.
def preprocessor(lines)
  continued = false
  lines.map do |line|
    found = continued || line.match?(/^\s*#/)
    continued = found && line.end_with?("\\\n")
    found
  end
end

# pmccabe does not look behind an #else, so it gets the files without any. What it
# says of each function: [complexity, lines, place, name].
def functions(files)
  files.each do |file|
    lines = File.readlines(file)
    FileUtils.mkdir_p(File.dirname("#{BARE}/#{file}"))
    File.write("#{BARE}/#{file}", lines.zip(preprocessor(lines)).map { |line, skipped| skipped ? "\n" : line }.join)
  end
  output, errors, status = Open3.capture3('pmccabe', *files, chdir: BARE)
  rows = output.lines.map { |line| line.match(/\A(\d+)\t\d+\t\d+\t\d+\t(\d+)\t(\S+\(\d+\):) (\w+)\n\z/)&.captures }
  return rows if status.success? && errors.empty? && rows.all?

  @failures += 1
  puts "pmccabe: #{errors}#{output.lines.zip(rows).find { |_, row| row.nil? }&.first}"
  []
end

# It may overlook a function, and says nothing then: each ends with a brace at the
# left edge, as only a block of C++ does.
def shape(files)
  found = functions(files)
  seen = found.map { |_, _, place, _| place[/\A[^(]+/] }.tally
  files.each do |file|
    ends = File.readlines(file).sum { |line| { "}\n" => 1, "extern \"C++\" {" => -1 }.fetch(line[/\A(?:}\n\z|extern "C\+\+" {)/], 0) }
    next if seen.fetch(file, 0) == ends

    @failures += 1
    puts "#{file}: pmccabe sees #{seen.fetch(file, 0)} of #{ends} functions"
  end
  found.each { |row| limited(*row) }
end

def limited(complexity, lines, place, name)
  return if complexity.to_i <= COMPLEXITY_MAX && (lines.to_i <= LINES_MAX || longer?(place))

  @failures += 1
  puts "#{place} #{name}: #{lines} lines (at most #{LINES_MAX}), " \
       "complexity #{complexity} (at most #{COMPLEXITY_MAX})"
end

# With one condition in each decision, branch coverage is MC/DC.
def single_conditions(files)
  files.each do |file|
    lines = File.readlines(file)
    lines.zip(preprocessor(lines)).each_with_index do |(line, skipped), index|
      next if skipped || line.sub(%r{//.*}, '') !~ /&&|\|\|/

      @failures += 1
      puts "#{file}:#{index + 1}: two conditions in one decision"
    end
  end
end

FileUtils.mkdir_p('build/cppcheck')
FileUtils.rm_rf(BARE)
library = Dir['src/**/*.c'].sort
library.empty? and abort 'no sources to check'
library_all = Dir['{include,src}/**/*.[ch]'].sort
if ARGV == ['--misra'] # of other systems
  other_systems(library)
  exit(@failures.zero? ? 0 : 1)
end
if ARGV == ['--quick']
  library.each { |file| warnings(file) }
  shape(library_all)
  single_conditions(library_all)
  exit(@failures.zero? ? 0 : 1)
end
# Two examples are built with their system's headers by test/use/packages;
# SDCC compiles the support files, the co-simulation those of chips, and the
# comparisons, guarded loops, faults and recipes of tools/demo are programs for a PC, as is what the
# tuner page computes with.
programs = Dir['{port,examples,sim}/**/*.c'].sort.grep_v(%r{/support/|/gpsim/|/loops/|/random_plants/|/guard/|/faults/|/identify/|/tuner/|/link/|/recipes/|/chip\.c|/esp-idf/|/zephyr/})
identify = Dir['sim/identify/*.c'].sort # MISRA's types have no room for its doubles
avr, others = programs.partition { |file| file.start_with?('port/avr/') }
avr.each { |file| judged(file) { avr_warnings(file) } }
library.each { |file| judged(file) { [warnings(file), modes_and_forms(file), tidy(file)] } }
(others + identify).each { |file| judged(file) { [warnings(file), tidy(file)] } }
[[], OBJECT_MODE].product(FORMS).each do |mode, form|
  defines = GCC + mode + form
  misra('src', other_texts(library, defines), defines)
end
other_systems(library)
programs.group_by { |file| File.dirname(file) }.each do |directory, files|
  misra(directory, files, GCC + (directory.start_with?('sim/probe') ? ['-DHOST_PROBE_OBJECT=controller'] : []))
end
shape(library_all + programs + identify)
single_conditions(library_all)
exit(@failures.zero? ? 0 : 1)

# SPDX-License-Identifier: MIT
# Checks what the documents say: parts that are made from the code, code blocks, in C
# and in C++, and what they print, files, functions and tests that they name, sums that
# are written out, in comments of the code too; the Dockerfile's packages; that the
# manifests are those that tools/lib/manifests.rb writes; that docs/requirements.csv says what
# is there; and the tables of docs/data that are made from the code. With --update it renews the parts first. Tables, links and headings are for the
# Markdown linter of the part `docs`.
require 'fileutils'
require 'open3'
require_relative '../named_figures'
require_relative 'docs/assurance'
require_relative 'docs/chip_choices'
require_relative 'docs/code_blocks'
require_relative 'docs/commands'
require_relative 'docs/levels'
require_relative 'docs/misra'
require_relative 'docs/names'
require_relative 'docs/forms'
require_relative 'docs/numbers'
require_relative 'docs/other_chips'
require_relative 'docs/packages'
require_relative 'docs/prose_numbers'
require_relative 'docs/recipes'
require_relative 'docs/requirements'
require_relative 'docs/shown'
require_relative 'docs/sums'

Encoding.default_external = 'UTF-8'

HOME = 'web/site/home.md' # of the site

lacking = %w[cc g++ avr-g++ gpasm].reject { |tool| system("command -v #{tool} >/dev/null") }
abort "no #{lacking.join(', ')}: tools/test docs installs what this needs" unless lacking.empty?
@failures = []

# Replaces what stands between two markers.
def part(text, name, content)
  text.sub(/(<!-- #{name}:begin -->\n).*?(<!-- #{name}:end -->)/m) { "#{$1}#{content}#{$2}" }
end

def quick_start_output
  FileUtils.mkdir_p('build/test')
  program = 'build/test/quick_start'
  said, objects = CodeBlocks.library
  abort said unless said.empty?
  output, status = Open3.capture2e('cc', '-std=c99', '-Wall', '-Wextra', '-Werror', '-Iinclude',
                                   'examples/quick_start.c', *objects, '-o', program)
  abort output unless status.success?
  output, status = Open3.capture2e(program)
  abort "#{program} failed" unless status.success?
  output
end

def check_packages
  wanted = Packages.wanted
  found = Packages.of_dockerfile(File.read('Dockerfile'))
  @failures << "Dockerfile lacks #{(wanted - found).join(', ')}" unless (wanted - found).empty?
  @failures << "Dockerfile has #{(found - wanted).join(', ')}, which nobody needs" unless (found - wanted).empty?
  unknown = Packages.without_command.reject { |name| File.read('tools/lib/setup.sh').include?("    #{name})") }
  @failures << "setup.sh cannot tell whether #{unknown.join(', ')} is there" unless unknown.empty?
end

def renewed(path, text)
  case path
  when 'docs/start/index.md'
    # Without the line of the licence.
    text = part(text, 'quick_start', "```c\n#{File.readlines('examples/quick_start.c').drop(1).join}```\n")
    part(text, 'quick_start_output', "```\n#{quick_start_output}```\n")
  when Requirements::PAGE
    Requirements.renewed(text)
  when 'docs/recipes.md'
    @failures.concat(Recipes.missing(text).map { |name| "#{path} does not show #{name}" })
    Recipes.names.reduce(text) { |so_far, name| part(so_far, "recipe #{name}", Recipes.part(name)) }
  when HOME
    part(text, 'version', format(Shown.version, '../../CHANGELOG.md'))
  when 'docs/installing.md'
    text = part(part(text, 'version', format(Shown.version, '../CHANGELOG.md')), 'release files', Shown.released)
    part(text, 'folders', Shown.folders)
  else
    text
  end
end

# Where the head of a table has another number of cells than the rule below it, no renderer makes
# one, and the linter sees no table to judge.
def check_heads(path, text)
  text.scan(/^(\|.*\|)\n(\|[-:| ]+\|)$/).each do |head, rule|
    @failures << "#{path}: no table, as its head is not as wide as its rule: #{head}" if head.scan(/(?<!\\)\|/).size != rule.count('|')
  end
end

# A line of a paragraph that begins with a mark is HTML to GitHub: what follows in it is no Markdown.
def check_marks(path, text)
  text.scan(/^ *(<!-- \w+ -->\d.*)/).flatten.each { |line| @failures << "#{path}: a line begins with a mark: #{line}" }
end

def check_named_tests(path, text, tests)
  text.scan(/`(test_\w+)`/).flatten.each do |test|
    @failures << "#{path}: no test #{test}" unless tests.include?(test)
  end
end

documents = Dir['docs/**/*.md', '*.md', HOME]
NamedFigures.keep(Numbers.counted) if ARGV == ['--update']
@failures.concat(NamedFigures.stale(Numbers.counted))
tests = Dir['test/**/*.c'].flat_map { |file| File.read(file).scan(/^void (test_\w+)\(/).flatten }
documents.each do |path|
  text = File.read(path)
  new_text, wrong = CodeBlocks.new(path).renewed(NamedFigures.renewed(Shown.renewed(renewed(path, text))))
  @failures.concat(wrong + Shown.failures(path, text))
  if ARGV == ['--update']
    File.write(path, new_text)
  elsif new_text != text
    @failures << "#{path} is stale: ruby tools/lib/pages/check_docs.rb --update"
  end
  @failures.concat(NamedFigures.unknown(text).map { |name| "#{path}: no number is called #{name}" })
  check_heads(path, new_text)
  check_marks(path, new_text)
  check_named_tests(path, new_text, tests)
  @failures.concat(Sums.failures(path, new_text))
end
{ Requirements::FILE => Requirements.csv, Misra::FILE => Misra.csv, Forms::FILE => Forms.csv, Levels::FILE => Levels.csv,
  OtherChips::FILE => OtherChips.csv, **Assurance.files }.each do |path, csv|
  File.write(path, csv) if ARGV == ['--update']
  @failures << "#{path} is stale: ruby tools/lib/pages/check_docs.rb --update" unless File.exist?(path) && csv == File.read(path)
end
Dir['{src,include,port,sim,examples,test}/**/*.[ch]'].each do |path|
  comments = File.read(path).scan(%r{//(.*)}).join("\n") # a slash would read as a quotient
  @failures.concat(Sums.failures(path, comments))
end
@failures.concat(DocumentNames.failures + Assurance.failures + ProseNumbers.failures +
                 Commands.failures + ChipChoices.failures + Requirements.failures)
check_packages
lines = File.readlines('examples/quick_start.c').size
@failures << "the quick start has #{lines} lines" if lines > 24
puts @failures
exit(@failures.empty? ? 0 : 1)

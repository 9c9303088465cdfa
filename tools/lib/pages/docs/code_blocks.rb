# SPDX-License-Identifier: MIT
# Every C code block of a document: it must compile, and a program that is
# followed by `prints` and a block of ```text must print just that.
#
# A block with a main is a program, linked with the whole library. Any other one
# is compiled with all public headers, as a file or as the body of a function.
# What it takes for granted stands before it: <!-- given: DECLARATIONS -->
# Of a recipe the whole is compiled, whatever the document shows of it.
# A file that is shown has a test of its own.
#
# A block must compile as C++11, too, for a PC and for an Arduino, unless this
# stands before it: <!-- C only: REASON -->
require 'fileutils'
require 'open3'
require_relative 'recipes'
require_relative 'shown'

class CodeBlocks
  FOLDER = 'build/test/docs'.freeze
  FLAGS = %w[-std=c99 -Wall -Wextra -Wpedantic -Wconversion -Werror -Iinclude].freeze
  CPLUSPLUS = { 'g++' => [], 'avr-g++' => %w[-mmcu=atmega328p] }.freeze
  # The structures' fields may be named in C++, too: an extension before C++20.
  CPLUSPLUS_FLAGS = %w[-x c++ -std=gnu++11 -Wall -Wextra -Wno-missing-field-initializers -Wno-unused -Werror
                       -Iinclude -fsyntax-only].freeze
  BLOCK = /(?:^<!-- given: (?<given>.*?) -->\n)?(?:^<!-- (?<c_only>C only): .*? -->\n)?^```c\n(?<code>.*?)^```\n(?:\n*(?:prints\n+)?^```text\n(?<printed>.*?)^```\n)?/m.freeze
  # In an indented block nothing would look at it.
  HIDDEN_CODE = /^ {4,}[^|\n]*[;{]$/.freeze

  # The whole library, once for all programs: what the compiler says of it, and its objects.
  def self.library
    @library ||= begin
      folder = "#{FOLDER}/library"
      FileUtils.rm_rf(folder)
      FileUtils.mkdir_p(folder)
      sources = Dir['src/**/*.c'].map { |path| File.expand_path(path) }
      output, = Open3.capture2e('cc', *FLAGS, "-I#{File.expand_path('include')}", '-c', *sources, chdir: folder)
      [output, Dir["#{folder}/*.o"]]
    end
  end

  def initialize(path)
    @path = path
    @number = 0
    @outputs = 0
  end

  # The document with what its programs print, and what is wrong with it.
  def renewed(text)
    failures = text.gsub(/^```.*?^```$/m, '').scan(HIDDEN_CODE).map { |line| "#{@path}: C outside of ```c: #{line.strip}" }
    new_text = text.gsub(BLOCK) do |whole|
      match = Regexp.last_match
      next whole if match.pre_match.match?(Shown::BEFORE)

      @number += 1
      program = match[:code].match?(/^int main\(/)
      printed = program ? run(match, failures) : fragment(match, failures)
      next whole unless program && match[:printed]

      @outputs += 1
      printed ? whole.sub(/(^```text\n).*?(^```\n)\z/m) { "#{$1}#{printed}#{$2}" } : whole
    end
    unread = text.scan(/^```text/).size - @outputs
    failures << "#{@path}: #{unread} blocks of ```text do not follow a program" unless unread.zero?
    [new_text, failures]
  end

  private

  def name
    "#{FOLDER}/#{File.basename(@path, '.md').downcase}_#{@number}"
  end

  def compile(code, *arguments)
    FileUtils.mkdir_p(FOLDER)
    File.write("#{name}.c", code)
    output, status = Open3.capture2e('cc', *FLAGS, "#{name}.c", *arguments)
    status.success? ? nil : output
  end

  # What C++ compilers say of it.
  def cplusplus(code)
    File.write("#{name}.cc", code)
    complaints = CPLUSPLUS.map do |compiler, options|
      output, status = Open3.capture2e(compiler, *CPLUSPLUS_FLAGS, *options, "#{name}.cc")
      status.success? ? nil : "#{compiler}:\n#{output}"
    end
    complaints.compact.empty? ? nil : complaints.compact.join
  end

  def run(match, failures)
    code = match[:code]
    of_library, objects = CodeBlocks.library
    complaint = of_library.empty? ? compile(code, *objects, '-o', name) : of_library
    if complaint
      failures << "#{@path}, code block #{@number}:\n#{complaint}"
      return nil
    end
    as_cplusplus = match[:c_only] ? nil : cplusplus(code)
    failures << "#{@path}, code block #{@number}, as C++:\n#{as_cplusplus}" if as_cplusplus
    output, status = Open3.capture2e(name)
    failures << "#{@path}, code block #{@number}: exit status #{status.exitstatus}" unless status.success?
    output
  end

  # As a file or as the body of a function, whichever compiles; nil, as it
  # prints nothing.
  def fragment(match, failures)
    head = Dir['include/*.h'].map { |file| "#include \"#{File.basename(file)}\"\n" }.join
    recipe = match.pre_match[/^<!-- recipe (\w+):begin -->\n\z/, 1]
    given, code = recipe ? [Recipes::GIVEN[recipe], Recipes.whole(recipe)] : [match[:given], match[:code]]
    head += "#{given}\n"
    forms = { 'a file' => head + code, "a function's body" => "#{head}void fragment(void);\nvoid fragment(void)\n{\n#{code}}\n" }
    compilers = { 'C' => ->(code) { compile(code, '-Wno-unused', '-c', '-o', "#{name}.o") } }
    compilers['C++'] = ->(code) { cplusplus(code) } unless match[:c_only]
    compilers.each do |language, compiler|
      complaints = {}
      next if forms.any? { |form, code| (complaints[form] = compiler.call(code)).nil? }

      failures << "#{@path}, code block #{@number}, #{language}\n" +
                  complaints.map { |form, complaint| "as #{form}:\n#{complaint}" }.join
    end
    nil
  end
end

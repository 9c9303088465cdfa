# SPDX-License-Identifier: MIT
# Every C code block of a document: it must compile, and a program that is
# followed by `prints` and a block of ```text must print just that.
#
# A block with a main is a program, linked with the whole library. Any other one
# is compiled with all public headers, as a file or as the body of a function.
# What it takes for granted stands before it: <!-- given: DECLARATIONS -->
require 'fileutils'
require 'open3'

class CodeBlocks
  FOLDER = 'build/test/docs'.freeze
  FLAGS = %w[-std=c99 -Wall -Wextra -Wpedantic -Wconversion -Werror -Iinclude].freeze
  BLOCK = /(?:^<!-- given: (?<given>.*?) -->\n)?^```c\n(?<code>.*?)^```\n(?:\n*(?:prints\n+)?^```text\n(?<printed>.*?)^```\n)?/m.freeze
  # In an indented block nothing would look at it.
  HIDDEN_CODE = /^ {4,}[^|\n]*[;{]$/.freeze

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
      @number += 1
      program = match[:code].match?(/^int main\(/)
      printed = program ? run(match[:code], failures) : fragment(match, failures)
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

  def run(code, failures)
    complaint = compile(code, '-Isrc', *Dir['src/**/*.c'], '-o', name)
    if complaint
      failures << "#{@path}, code block #{@number}:\n#{complaint}"
      return nil
    end
    output, status = Open3.capture2e(name)
    failures << "#{@path}, code block #{@number}: exit status #{status.exitstatus}" unless status.success?
    output
  end

  def fragment(match, failures)
    head = Dir['include/*.h'].map { |file| "#include \"#{File.basename(file)}\"\n" }.join
    head += "#{match[:given]}\n"
    as_file = compile(head + match[:code], '-Wno-unused', '-c', '-o', "#{name}.o") or return
    as_body = compile("#{head}void fragment(void);\nvoid fragment(void)\n{\n#{match[:code]}}\n",
                      '-Wno-unused', '-c', '-o', "#{name}.o") or return
    failures << "#{@path}, code block #{@number}, as a file:\n#{as_file}as a function's body:\n#{as_body}"
    nil
  end
end

# SPDX-License-Identifier: MIT
# Checks what the documents say: parts that are made from the code, code blocks, in C
# and in C++, and what they print, files, functions and tests that they name, links, sums that
# are written out, in comments of the code too; the Dockerfile's packages; and that
# CMake's list of sources and the version agree with what is there. With --update it
# renews the parts first.
require 'fileutils'
require 'open3'
require_relative 'docs/assurance'
require_relative 'docs/code_blocks'
require_relative 'docs/facts'
require_relative 'docs/forms'
require_relative 'docs/other_chips'
require_relative 'docs/packages'
require_relative 'docs/recipes'

Encoding.default_external = 'UTF-8'

@failures = []

# Replaces what stands between two markers.
def part(text, name, content)
  text.sub(/(<!-- #{name}:begin -->\n).*?(<!-- #{name}:end -->)/m) { "#{$1}#{content}#{$2}" }
end

def quick_start_output
  FileUtils.mkdir_p('build/test')
  program = 'build/test/quick_start'
  output, status = Open3.capture2e('cc', '-std=c99', '-Wall', '-Wextra', '-Werror', '-Iinclude',
                                   *Dir['src/**/*.c'], 'examples/quick_start.c', '-o', program)
  abort output unless status.success?
  output, status = Open3.capture2e(program)
  abort "#{program} failed" unless status.success?
  output
end

def rounded_up(product, divisor)
  (product + divisor - 1) / divisor
end

# [controller, value, bound, type that holds it]
def bounds
  notes_bounds + pid_bounds + relay_bounds + autotune_bounds + beside_bounds
end

def notes_bounds
  gain = 255
  error = 32_768
  wide = 65_535
  sum_high = 30_000 / 256
  an964_i = sum_high * 1023 / 16
  an964_total = 1023 + an964_i + 255
  [['AN937', 'magnitude of accumulated, delta', wide, 'uint16_t'],
   ['AN937', 'kp * error', gain * error, '24-bit magnitude'],
   ['AN937', 'ki * accumulated, kd * delta', gain * wide, '24-bit magnitude'],
   ['AN937', 'sum before its limit', gain * (error + wide + wide), 'int32_t'],
   ['AN937', 'output', (2**24 - 1) / 16, 'int32_t'],
   ['AN964', 'sum before its limit', 30_000 + 1023, 'int16_t'],
   ['AN964', 'sum / 256', sum_high, '7 bits'],
   ['AN964', 'sum / 256 * ki', sum_high * 1023, 'uint32_t'],
   ['AN964', 'I', an964_i, 'int16_t'],
   ['AN964', 'e(n) - e(n-3)', 2 * 1023, 'int16_t'],
   ['AN964', 'd * kd / 32 before its limit', rounded_up(255 * 1023, 32), '2^14'],
   ['AN964', 'e + I + D', an964_total, '2^14'],
   ['AN964', '(e + I + D) * kp / 1024 before its limit', an964_total * 1023 / 1024, '2^14'],
   ['AN964 8-bit', 'sum before its limit', 8191 + 128, 'int16_t'],
   ['AN964 8-bit', 'sum / 64', 8191 / 64, '7 bits'],
   ['AN964 8-bit', 'I before its limit', 127 * 127 / 8, '2^14'],
   ['AN964 8-bit', 'd * kd / 4 before its limit', rounded_up(127 * 127, 4), '2^14'],
   ['AN964 8-bit', 'e + I + D', 128 + 127 + 127, 'int16_t'],
   ['AN964 8-bit', 'output', 127 * 127 / 32, 'int16_t']]
end

# In 1/256 of an output count, but where the page says otherwise.
def pid_bounds
  error = 32_768
  gain = 32_767
  proportional = gain * error
  derivative_max = 2**30 - 2**24
  decayed = derivative_max - derivative_max / 2**7 # the slowest filter keeps most
  feedforward = 256 * error
  terms = proportional + derivative_max + feedforward
  integral = 256 * 32_767
  room = 256 * (32_767 + 32_768) # between a limit and the feed-forward
  [['PID', 'b * r + 128', 255 * error + 128, 'int32_t'],
   ['PID', 'P = kp_q8 * e', proportional, 'int32_t'],
   ['PID', 'kd_q8 * d', 32_255 * error, '2^30 - 2^24'],
   ['PID', 'D before its limit', decayed + 32_255 * error, 'int32_t'],
   ['PID', 'P + D + 256 F', terms, 'int32_t'],
   ['PID', 'ki as it is kept, from 2^24', (0x7FFF0000 + 2**15) >> 16, 'int16_t'],
   ['PID', 'ki * e + fraction, ki in 2^-24 or 2^-16', gain * error + 255, 'int32_t'],
   ['PID', 'floor(I / 256) + ki * e, ki in 2^-8', integral + gain * error, 'int32_t'],
   ['PID', 'P + D + 256 F + floor(I / 256) + 128', terms + integral + 128, 'int32_t'],
   ['PID', 'held output - (P + D + 256 F)', feedforward + terms, 'int32_t'],
   ['PID', 'set_limits: 256 (limit - F) - (P + D)', room + proportional + derivative_max, 'int32_t'],
   ['PID', 'track: 2^16 * d, d above 0', 2**16 * (error - 1), 'int32_t']]
end

def relay_bounds
  period = 2 * 32_766
  period_q4 = (16 * 8 * period + 4) / 8
  kp_q16 = (32_768 * 256) - 128
  [['relay', 'period of a cycle', period, 'uint16_t'],
   ['relay', 'R, swing', 65_535, 'uint16_t'],
   ['relay', '326 * 16 * R * N', 326 * 16 * 65_535 * 8, 'uint32_t'],
   ['relay', 'Ku * kp_rule, where Ku is not refused', (2**23 - 1) * 116, 'uint32_t'],
   ['relay', 'k * ki_rule, where kp is not refused', kp_q16 * 116, 'uint32_t'],
   ['relay', 'Tu', period_q4, 'uint32_t'],
   ['relay', '16 * rest', 16 * period_q4, 'uint32_t'],
   ['relay', 'ki', (kp_q16 * 116 / 96 + 1) * 16, 'int32_t'],
   ['relay', 'kp * Td, where neither is refused', 32_767 * 131_071, 'uint32_t'],
   ['relay', 'E', 65_535 * period, 'uint32_t'],
   ['relay', '2 * P + T + D', 2 * period + 65_535 + period / 2, 'uint32_t'],
   ['relay', '16 * E / (2 * P + T + D)', 16 * (65_535 * period) / (2 * period), 'int32_t']]
end

# What stands beside a controller.
def beside_bounds
  steps = 32_767
  half = 2**16 - 1
  rate_max = 500_000_000
  [['slew', 'distance of value and target', 2**32 - 2**16, 'uint32_t'],
   ['slew', 'value in offset binary + 2^15', 2**32 - 2**16 + 2**15, 'uint32_t'],
   ['time-proportioned', 'duty * W, minimum_on * full', steps * steps, 'int32_t'],
   ['time-proportioned', '(W + 1 - minimum_off) * full', (steps + 1) * steps, 'int32_t'],
   ['time-proportioned', 'credit', steps * steps - 1 + steps * steps, 'int32_t'],
   ['gains', 'middle sum of a * b', half * half + 2 * half, 'uint32_t'],
   ['gains', 'rest before its shift, c - 1', 2**31 - 1, 'int32_t'],
   ['gains', 'rate_milli * 4', 4 * rate_max, 'int32_t'],
   ['gains', '15625 * 2^filter', 15_625 * 2**7, 'int32_t'],
   ['gains', 'rate_milli + 2^21 - 1', rate_max + 2**21 - 1, 'uint32_t'],
   ['gains', 'kp_q8 * 125 + 16', 32_767 * 125 + 16, 'uint32_t']]
end

def autotune_bounds
  deviation = 32_767
  steps = 32_767
  noise = 32 * 1023
  span = 65_535
  [['autotuner', 'noise and its half, 16', noise + noise / 2 + 16, 'uint16_t'],
   ['autotuner', '24 * hysteresis', 24 * 1536, 'uint16_t'],
   ['autotuner', 'period of a cycle', 2 * 32_767, 'uint16_t'],
   ['autotuner', 'all, on: sums of x', deviation * steps, 'int32_t'],
   ['autotuner', 'rise: of 8 cycles, two turns each', 8 * 2 * 2047, 'int16_t'],
   ['autotuner', 'share of the relay', span * 255 + 128, 'uint32_t'],
   ['autotuner', 'amplitude * share', 131_072 * 255, 'uint32_t'],
   ['autotuner', '2 half', 2 * (span * 85 / 256), 'uint16_t'],
   ['autotuner', 'D * high steps', span * steps, 'int32_t'],
   ['autotuner', 'area: mean - on - rise / 2', 2 * deviation * steps + 8 * 2047, 'int32_t'],
   ['autotuner', 'product of two mantissas', 65_535**2, 'uint32_t'],
   ['autotuner', 'sum of two numbers, 15 bits more', 2 * (65_535 << 15), 'uint32_t']]
end

LIMITS = { '7 bits' => 2**7 - 1, '2^30 - 2^24' => 2**30 - 2**24, '2^14' => 2**14 - 1, 'int16_t' => 2**15 - 1, 'uint16_t' => 2**16 - 1,
           '24-bit magnitude' => 2**24 - 1, 'int32_t' => 2**31 - 1, 'uint32_t' => 2**32 - 1 }.freeze

def bounds_table
  rows = bounds.map do |controller, value, bound, type|
    @failures << "#{controller} #{value}: #{bound} does not fit #{type}" if bound > LIMITS.fetch(type)
    "| #{controller} | `#{value}` | #{bound} | #{type} |\n"
  end
  "| | value | magnitude at most | fits |\n|---|---|---|---|\n#{rows.join}"
end

# What tools/test runs and how long each part takes.
def parts_table
  rows = File.readlines('test/parts.txt', chomp: true).grep(/^[a-z]/).map { |line| line.split(' ', 4) }
  lines = rows.map do |name, checks, seconds, what|
    seconds = seconds.to_i
    time = seconds < 100 ? "#{seconds} s" : "#{(seconds + 30) / 60} minutes"
    "| `#{name}` | #{checks} | #{time} | #{what} |\n"
  end
  "| part | checks | about | what |\n|---|---|---|---|\n#{lines.join}"
end

# Minutes of all parts together, on two cores.
def whole_minutes
  seconds = File.readlines('test/parts.txt').grep(/^[a-z]/).grep_v(/ by name: /)
                .map { |line| line.split[2].to_i }
  (seconds.sum + 30) / 60
end

# The packages as a paragraph.
def packages
  words = Packages.wanted.map { |name| "`#{name}`" }.join(', ')
  "#{words}.".gsub(/(.{1,78})(?: |\z)/, "\\1\n")
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
  when 'README.md'
    # Without the line of the licence.
    text = part(text, 'quick_start', "```c\n#{File.readlines('examples/quick_start.c').drop(1).join}```\n")
    text = part(text, 'quick_start_output', "```\n#{quick_start_output}```\n")
    text.gsub(/(?<=<!-- minutes -->)\d+ minutes/, "#{whole_minutes} minutes")
  when 'CONTRIBUTING.md'
    part(part(text, 'parts', parts_table), 'packages', packages)
  when 'docs/assurance.md'
    part(text, 'claims', Assurance.table)
  when 'docs/arithmetic.md'
    part(part(text, 'bounds', bounds_table), 'forms', Forms.table)
  when 'docs/ports.md'
    part(text, 'other chips', OtherChips.table)
  when 'docs/recipes.md'
    @failures.concat(Recipes.missing(text).map { |name| "#{path} does not show #{name}" })
    Recipes.names.reduce(text) { |so_far, name| part(so_far, "recipe #{name}", Recipes.part(name)) }
  else
    text
  end
end

def check_links(path, text)
  text.scan(/\]\(([^)#\s]+)[^)]*\)/).flatten.grep_v(/\A[a-z]+:/).each do |link|
    target = File.expand_path(link, File.dirname(path))
    @failures << "#{path}: no #{link}" unless File.exist?(target)
  end
end

def check_named_tests(path, text, tests)
  text.scan(/`(test_\w+)`/).flatten.each do |test|
    @failures << "#{path}: no test #{test}" unless tests.include?(test)
  end
end

OPERATORS = { '=' => :==, '<' => :<, '<=' => :<= }.freeze
NUMBER = /\(?\d+(?:\.\d+)?(?:\^\d+)?\)?/.freeze
SUM = %r{#{NUMBER}(?: [-+*/] #{NUMBER})*}.freeze

# `117 * 1023 / 16 = 7480 < 2^14` in a comment or a document: every sum that is
# written out must be right. Integers, so a quotient is rounded toward zero; with
# a decimal point anywhere, exactly.
def check_sums(path, text)
  text.scan(%r{(?<![\w.^(/]|[-+*/] )(?=(#{SUM}) (=|<=|<) (#{SUM}))}).each do |left, operator, right|
    exact = "#{left}#{right}".include?('.')
    # Only digits and operators passed the patterns above.
    values = [left, right].map do |sum|
      eval((exact ? sum.gsub(/(?<!\^)\b\d+(?:\.\d+)?/) { |number| "#{number}r" } : sum).gsub('^', '**'))
    end
    next if values[0].public_send(OPERATORS.fetch(operator), values[1])

    @failures << "#{path}: #{left} #{operator} #{right} is wrong"
  end
end

documents = Dir['*.md', 'docs/*.md']
tests = Dir['test/**/*.c'].flat_map { |file| File.read(file).scan(/^void (test_\w+)\(/).flatten }
documents.each do |path|
  text = File.read(path)
  new_text, wrong = CodeBlocks.new(path).renewed(renewed(path, text))
  @failures.concat(wrong)
  if ARGV == ['--update']
    File.write(path, new_text)
  elsif new_text != text
    @failures << "#{path} is stale: ruby tools/lib/check_docs.rb --update"
  end
  check_links(path, new_text)
  check_named_tests(path, new_text, tests)
  check_sums(path, new_text)
end
Dir['{src,include,port,sim,examples,test}/**/*.[ch]'].each do |path|
  check_sums(path, File.read(path).scan(%r{//(.*)}).join("\n")) # a slash would read as a quotient
end
@failures.concat(Facts.failures + Assurance.failures)
check_packages
lines = File.readlines('examples/quick_start.c').size
@failures << "the quick start has #{lines} lines" if lines > 24
puts @failures
exit(@failures.empty? ? 0 : 1)

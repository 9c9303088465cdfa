# SPDX-License-Identifier: MIT
# Tables of docs/data from what test/chips/target/run has measured:
#
#   figures.rb LOGS SIZES.json [--update]
#
# Fails if a table says something else, which --update rewrites, or if a limit of the
# firmware is exceeded.
require 'json'
require_relative '../../../tools/bound/bound'
require_relative '../../../tools/lib/data_tables'
require_relative '../../../tools/lib/measure/subjects'
require_relative 'firmware_limits'

TITLES = CONTROLLERS.to_h { |one| [one.name, one.title] }.freeze
NOT_FOR_PIC14 = CONTROLLERS.reject { |one| one.pics.include?('pic16f684') }.map(&:name).freeze
PROCESSORS = { 'pic16f684' => 'PIC14', 'pic18f4520' => 'PIC18' }.freeze
POINTER_AND_OBJECT = MODES.reverse.freeze
MACHINES = { 'cortex-m0' => 'Cortex-M0', 'cortex-m3' => 'Cortex-M3', 'cortex-m4' => 'Cortex-M4', 'atmega328p' => 'AVR' }.freeze
# Example, controller and cycles of a tick.
EXAMPLES = { 'pendulum' => 7812, 'pendulum_8bit' => 7812, 'motor' => 10_000, 'oven' => 10_000,
             'motor_pic18f26k22' => 10_000, 'oven_pic18f26k22' => 10_000,
             'motor_atmega328p' => 16_000, 'oven_atmega328p' => 16_000 }.freeze

# What one of the runs printed.
class Logs
  def initialize(folder)
    @folder = folder
  end

  def read(name)
    File.read("#{@folder}/#{name}.log")
  rescue Errno::ENOENT
    abort "figures: #{name} was not run"
  end

  def names(pattern)
    Dir.glob("#{@folder}/#{pattern}.log").map { |path| File.basename(path, '.log') }
  end

  # The named numbers of the line that matches: "rows 2000 different 0".
  def numbers(name, pattern)
    line = read(name)[pattern] or abort "figures: #{name} printed no #{pattern.source}"
    line.scan(/([a-z]+) (\d+)/).map { |key, value| [key, value.to_i] }
  end
end

UPDATE = ARGV.delete('--update')
LOGS = Logs.new(ARGV[0])
SIZES = JSON.parse(File.read(ARGV[1]))
FIRMWARE = File.dirname(ARGV[1])

def thousands(number)
  number.to_s.reverse.scan(/\d{1,3}/).join(' ').reverse
end

# [rows, random steps, different] of all modes.
def sum(names, pattern)
  numbers = names.flat_map { |name| LOGS.read(name).scan(pattern).flat_map { |line| line.scan(/([a-z]+) (\d+)/) } }
  %w[rows random different].map do |key|
    numbers.select { |name, _| name == key }.sum { |_, value| value.to_i }
  end
end

def exact_cell(names, pattern)
  rows, random, different = sum(names, pattern)
  return 'not meant for it' if rows.zero?

  "#{thousands(rows)} rows, #{thousands(random)} steps, #{different} different"
end

def on_chip(controller, chip)
  return 'not meant for it' if NOT_FOR_PIC14.include?(controller) && chip == 'pic16f684'

  exact_cell(POINTER_AND_OBJECT.map { |mode| "replay-#{controller}-#{chip}-#{mode}" }, /rows .* cycles/)
end

def exact
  [['chip', *TITLES.values], *PROCESSORS.map { |chip, name| [name, *TITLES.keys.map { |controller| on_chip(controller, chip) }] }]
end

INTERRUPTED = PROCESSORS.merge('atmega328p' => 'AVR').freeze

def pairs
  INTERRUPTED.keys.product(TITLES.keys).reject { |chip, name| chip == 'pic16f684' && NOT_FOR_PIC14.include?(name) }
end

# The named numbers of all forms and modes, added up.
def all_interrupts(kind, controller, chip)
  LOGS.names("interrupts_#{kind}{,plain,placed}-#{controller}-#{chip}-*")
      .map { |name| LOGS.numbers(name, /interrupts .*/).to_h }
      .reduce { |sum, one| sum.merge(one) { |_, left, right| left + right } } or
    abort "figures: no interrupts of #{controller}, #{chip}"
end

def interrupts
  rows = pairs.map do |chip, controller|
    good = all_interrupts('tick', controller, chip)
    racy = LOGS.numbers("interrupts_racy-#{controller}-#{chip}-object", /interrupts .*/).to_h
    ["#{INTERRUPTED[chip]} #{TITLES[controller]}", good['interrupts'], good['lost'], good['changed'], racy['lost']]
  end
  ticking = all_interrupts('ticking', 'an937', 'pic18f4520')
  rows << ["PIC18 #{TICKING}", ticking['interrupts'], '-', ticking['changed'], '-']
  MACHINES.each do |machine, name|
    calls = LOGS.names("interrupted-#{machine}-*").flat_map { |log| LOGS.read(log).scan(/interrupts (\d+) .* neither (\d+)/) }
    came, neither = [0, 1].map { |at| calls.sum { |call| call[at].to_i } }
    rows << ["#{name} #{TICKING}", came, '-', neither, '-']
  end
  [['chip', 'interrupts', 'ticks lost', 'answers changed', 'lost by the racy port'], *rows]
end

TICKING = 'AN937, `fixpid_an937_tick` in the interrupt'

def title_of_chip(chip)
  chip == 'atmega328p' ? 'ATmega328P' : chip.upcase
end

def code_of(name, size)
  Bound.code(size['chip'], "#{FIRMWARE}/#{name}")
end

# Of an example's code, with interrupts; it fits its chip.
def depth_of(name, size)
  code = code_of(name, size)
  depth = code.stack_of_all
  room = size['chip'] == 'atmega328p' ? size['ram_size'] - size['ram'] : size.fetch('stack', 0)
  return depth if depth.levels <= code.levels && depth.bytes <= room

  abort "figures: #{name} may need #{depth.levels} levels of #{code.levels} and #{depth.bytes} bytes of #{room}"
rescue Bound::Failure => e
  abort "figures: #{name}: #{e.message}"
end

# What was seen is no deeper than the code says.
def deep(name, bound, seen)
  bound >= seen ? bound : abort("figures: #{name} was seen to use a stack of #{seen}, its code says #{bound}")
end

def stacks(name, size, figures)
  depth = depth_of(name, size)
  return "#{deep(name, depth.bytes, figures['stack'])} bytes" if size['chip'] == 'atmega328p'

  levels = "#{deep(name, depth.levels, figures['stack'])} of #{code_of(name, size).levels}"
  bytes = deep(name, depth.bytes, figures['software'])
  bytes.zero? ? levels : "#{levels}, #{bytes} of #{size['stack']} bytes"
end

def examples
  EXAMPLES.map do |name, tick|
    size = SIZES.fetch(name)
    figures = LOGS.numbers("firmware-#{name}", /tick .*/).to_h
    idle = figures['idle'] > 100 ? figures['idle'] : '-'
    ["#{name.delete_suffix("_#{size['chip']}")}, #{title_of_chip(size['chip'])}", "#{size['flash']} of #{size['flash_size']} #{size['flash_unit']}",
     "#{size['ram']} of #{size['ram_size']}", stacks(name, size, figures), figures['step'], figures['tick'],
     idle, figures['interrupt'], format('%.0f %%', 100.0 * (figures['tick'] + figures['interrupt']) / tick)]
  end
end

SIZES.each { |name, size| depth_of(name, size) }
firmware = examples
limits = FirmwareLimits.of(FirmwareLimits::HEAD, firmware)
tables = { 'chips_exact' => exact, 'chips_interrupts' => interrupts, 'chips_firmware' => [FirmwareLimits::HEAD, *firmware],
           'chips_firmware_limits' => [['figure', 'at most', 'now'], *limits.map(&:cells)] }
exceeded = limits.reject(&:kept?)
abort exceeded.map { |limit| "figures: #{limit.what}: #{limit.wrong}" }.join("\n") if exceeded.any?
stale = tables.select { |name, rows| DataTables.difference(name, rows) }
stale.each { |name, rows| UPDATE ? DataTables.write(name, rows) : puts("#{name}, now: #{DataTables.difference(name, rows).last.inspect}") }
puts "#{stale.keys.join(', ')} of #{DataTables::FOLDER}: #{UPDATE ? 'rewritten' : 'stale; test/chips/target/run --update renews them'}" if stale.any?
exit(UPDATE ? true : stale.empty?)

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# port_page.rb BUILD DOCUMENT: does docs/ports.md say what the tests of the ports
# in BUILD have measured? Each number of its table must be one of them, or of the
# data sheets below. Prints what is missing or unknown and fails.
require_relative '../../../tools/lib/data_tables'

build, document = ARGV
PAGE = File.read(document)
TEXT = PAGE.gsub(/\s+/, ' ')
FIRMWARE = DataTables.hashes('chips_firmware').to_h { |row| [row['firmware'], row] }

# Column of the table, cycles a second, counts of the duty a cycle.
Chip = Struct.new(:name, :column, :rate, :counts)
CHIPS = [Chip.new('pic16f684', 1, 2_000_000, 4), Chip.new('pic18f4520', 2, 10_000_000, 4),
         Chip.new('pic18f26k22', 2, 10_000_000, 4), Chip.new('pic18f4431', 2, 10_000_000, 4),
         Chip.new('atmega328p', 3, 16_000_000, 1)].freeze

# Rows without numbers but in the names of pins, which port.cc has itself.
PINS = ['', 'for', 'drive', 'other pins'].freeze

# Of each column the port_board.h whose macros are the analog inputs, the pins' letters,
# and the data sheet's place of the channel's number in what such a macro has.
BOARDS = { 1 => ['pic/pic16f684', 'AN', 2], 2 => ['pic/pic18f4520', 'AN', 2], 3 => ['avr/atmega328p', 'A', 0] }.freeze
INPUTS = { 'ANGLE' => 'angle', 'SETPOINT' => 'set point', 'TACHOMETER' => 'tachometer or selector', 'TEMPERATURE' => 'temperature' }.freeze

# Of the data sheets: the typical voltage of a setting, the clock of a
# PIC16F684's watchdog, and what an Uno's fuses are.
VOLTS = { 'pic16f684' => { nil => '2.1 V' }, 'pic18f4520' => { '0' => '4.6 V' },
          'pic18f26k22' => { '285' => '26K22 2.85 V' }, 'pic18f4431' => { '45' => '4431 4.5 V' } }.freeze
UNO_VOLTS = "an Uno's is at 2.7 V"
# How much longer the simulators' watchdogs take: 28.6 kHz for 31 kHz, and two
# defects of gpsim 0.31.
WATCHDOG_SLOWER = { 'pic16f684' => 31 / 28.6, 'pic18f4520' => 4.5, 'pic18f26k22' => 72, 'pic18f4431' => 4.5,
                    'atmega328p' => 1 }.freeze

def hertz(frequency)
  frequency < 1000 ? format('%.2f Hz', frequency) : "#{(frequency / 1000.0).round(2).to_s.delete_suffix('.0')} kHz"
end

def analog_inputs(chip)
  board, letters, place = BOARDS.fetch(chip.column)
  File.read(File.expand_path("../../../port/#{board}/port_board.h", __dir__)).scan(/^#define PORT_([A-Z]+) 0x(\h\h)u/)
      .map { |name, code| "#{letters}#{(code.hex >> place) & 0x7} #{INPUTS.fetch(name, name)}" }.join(', ')
end

def clock(chip, configuration)
  return "#{chip.rate / 1_000_000} MHz" if chip.column == 3
  return '10 MHz, times four' if configuration.match?(/^(OSC HSPLL|PLLCFG ON)$/) && chip.rate == 10_000_000

  "#{chip.rate * 4 / 1_000_000} MHz"
end

def cycle(rate)
  rate > 10_000_000 ? "#{1e9 / rate} ns" : "#{1e6 / rate} us"
end

def brown_out(chip, configuration)
  return UNO_VOLTS if chip.column == 3

  configuration[/^BOREN (\w+)$/, 1] == 'OFF' ? 'none' : VOLTS.fetch(chip.name)[configuration[/^BORV (\w+)$/, 1]]
end

# What a chip's log says of the row's cell.
class Measured
  def initialize(chip, log, configuration)
    @chip = chip
    @log = log
    @configuration = configuration
    ticks, cycles = numbers(/^(\d+) ticks in (\d+) cycles/)
    @period = (cycles / ticks.to_f).round
    @pwm, @top, @full = numbers(/^PWM (\d+) cycles, (\d+) counts, full drive (\d+)$/)
  end

  def phrases
    interrupt, = numbers(/^interrupt (\d+)\.\.\1 cycles$/)
    conversion, = numbers(/readings, \d+\.\.(\d+) cycles/)
    { 'clock' => clock(@chip, @configuration), 'analog inputs' => analog_inputs(@chip),
      'instruction cycle' => cycle(@chip.rate),
      'tick' => "#{@period} cycles: #{hertz(@chip.rate.to_f / @period)}",
      'interrupt' => "#{interrupt} cycles a tick, #{format('%.1f', 100.0 * interrupt / @period)} %",
      'one conversion' => "#{(1e6 * conversion / @chip.rate).ceil} us", **drive,
      'watchdog' => watchdog, 'brown-out reset' => brown_out(@chip, @configuration) }
  end

  def start_up
    @log[/after port_init, (.* ms)$/, 1]
  end

  # The pulses that are not made.
  def pulses
    count = 1e9 / @chip.rate / @chip.counts
    "#{count.round} to #{(3 * count).round} ns"
  end

  def dead_zone
    format('%.1f %%', 300.0 / @full)
  end

  private

  def numbers(pattern)
    @log.match(pattern).captures.map(&:to_i)
  end

  def drive
    constant = @full == @top
    { 'PWM' => "#{hertz(@chip.rate.to_f / @pwm)}, #{"#{@full} of " unless constant}#{@top} counts",
      'full drive' => constant ? 'constantly on' : format('%.1f %%', 100.0 * @full / @top),
      'turning around' => "#{(1e6 * off / @chip.rate).floor} us without drive" }
  end

  # simavr 1.6 lets a new duty begin at once, the chip after another period.
  def off
    @chip.column == 3 ? 2 * @pwm : numbers(/, (\d+) cycles without drive$/).first
  end

  def watchdog
    typical = @log[/^watchdog resets after (.*) ms$/, 1].to_f / WATCHDOG_SLOWER.fetch(@chip.name)
    "#{typical.round} ms, #{(typical / 1000 * @chip.rate / @period).floor} ticks"
  end
end

# How often the motor's loop comes round in a tick at least.
def passes(title, period)
  with, without, interrupt = FIRMWARE["motor, #{title}"].values_at('pass with a tick', 'pass without', 'interrupt').map(&:to_i)
  format('%.1f', 1 + ((period - interrupt - with) / without.to_f))
end

measured = CHIPS.to_h do |chip|
  logs = ["#{build}/logs/port-#{chip.name}.log", "#{build}/logs/port_configuration-#{chip.name}.log"]
  [chip, Measured.new(chip, *logs.map { |path| File.exist?(path) ? File.read(path) : '' })]
end
wrong = []
table = PAGE.lines.select { |line| line.start_with?('| ') }.take_while { |line| !line.start_with?('| | SDCC') }
            .map { |line| line.split('|').map(&:strip).drop(1) }
table.each do |row, *cells|
  next if PINS.include?(row)

  cells.each.with_index(1) do |cell, column|
    rest = cell.gsub(/Timer\d|CCP\d/, '')
    measured.select { |chip, _| chip.column == column }.each do |chip, one|
      phrase = one.phrases[row]
      wrong << "does not say of the #{chip.name}, #{row}: #{phrase}" unless phrase && cell.include?(phrase)
      rest = rest.gsub(phrase, '') if phrase
    end
    wrong << "has numbers that nothing measures, #{row}: #{rest}" if rest.match?(/\d/)
  end
end

pic16, pic18, avr = %w[pic16f684 pic18f4520 atmega328p].map { |name| measured.find { |chip, _| chip.name == name }[1] }
map = File.read("#{build}/port-pic18f4520.map")
bytes = map[/^\s*S_port__tick\s+code\s+0x000008\s+program\s+0x(\h+)/, 1].hex
sentences = [
  "vector, #{bytes} bytes",
  "pulses of #{pic16.pulses} on the PIC16F684, of #{pic18.pulses} on the PIC18F4520 and of #{avr.pulses} on the ATmega328P",
  "dead zone of #{pic16.dead_zone} of full drive, or #{pic18.dead_zone}",
  "start-up takes #{pic18.start_up}, mostly to clear RAM, the pendulum's #{pic16.start_up}",
  "The ATmega328P starts in #{avr.start_up}",
  "uses #{FIRMWARE['pendulum, PIC16F684']['stack used']} levels",
  "comes round #{passes('ATmega328P', 16_000)} times a tick, not #{passes('PIC18F4520', 10_000)} times"
]
wrong += sentences.reject { |phrase| TEXT.include?(phrase) }.map { |phrase| "does not say: #{phrase}" }
puts wrong.map { |what| "#{document} #{what}" }
exit wrong.empty?

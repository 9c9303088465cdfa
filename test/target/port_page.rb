# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# port_page.rb BUILD DOCUMENT: does docs/ports.md say what the tests of the ports
# in BUILD have measured? Prints what it does not say and fails.
build, document = ARGV
PAGE = File.read(document)
CYCLES_PER_SECOND = { 'pic16f684' => 2_000_000, 'pic18f4520' => 10_000_000, 'pic18f26k22' => 10_000_000,
                      'pic18f4431' => 10_000_000, 'atmega328p' => 16_000_000 }.freeze

def hertz(frequency)
  frequency < 1000 ? format('%.2f Hz', frequency) : format('%g kHz', frequency / 1000.0)
end

# The phrases that must be in the named row, or anywhere.
def expected(log, rate)
  ticks, cycles = log.match(/^(\d+) ticks in (\d+) cycles/).captures.map(&:to_i)
  period = (cycles / ticks.to_f).round
  interrupt = log[/^interrupt (\d+)\.\.\1 cycles$/, 1].to_i
  conversion = log[/readings, \d+\.\.(\d+) cycles/, 1].to_i
  { 'tick' => "#{period} cycles: #{hertz(rate.to_f / period)}",
    'interrupt' => "#{interrupt} cycles a tick, #{format('%.1f', 100.0 * interrupt / period)} %",
    'one conversion' => "#{(1e6 * conversion / rate).ceil} us" }
end

missing = CYCLES_PER_SECOND.flat_map do |chip, rate|
  phrases = expected(File.read("#{build}/logs/port-#{chip}.log"), rate)
  phrases.reject { |row, phrase| PAGE[/^\| #{row} \|.*$/].to_s.include?(phrase) }.map { |row, phrase| "#{row}: #{phrase}" }
end
map = File.read("#{build}/port--pic18f4520-object.map")
bytes = map[/^\s*S_port__tick\s+code\s+0x000008\s+program\s+0x(\h+)/, 1].hex
missing << "#{bytes} bytes at the vector" unless PAGE.include?("vector, #{bytes} bytes")
puts missing.map { |phrase| "#{document} does not say '#{phrase}'" }
exit missing.empty?

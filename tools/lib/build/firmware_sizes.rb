# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# firmware_sizes.rb FOLDER NAME...: what the firmwares FOLDER/NAME.map and .cod,
# and of an AVR FOLDER/NAME.elf, take of their chip. Prints a table of these and
# writes FOLDER/sizes.json for all that are in FOLDER.
require 'json'
require 'open3'
require_relative 'gputils'

SECTION = /^\s*(\S+)\s+(code|idata|romdata|udata)\s+0x(\h+)\s+(program|data)\s+0x(\h+)\s*$/
SYMBOL = /^\s*(\S+)\s+0x(\h+)\s+data\s+\S+\s/

# One firmware, from the linker's map. A program address of a PIC16 is a word of two
# bytes there.
class Firmware
  PROCESSOR = 453 # in the first block of .cod: a length, and as many letters

  def initialize(map)
    @map = File.read(map)
    cod = File.binread(map.sub(/map$/, 'cod'))
    processor = cod[PROCESSOR + 1, cod.getbyte(PROCESSOR)].downcase
    @chip = "pic#{processor}"
    @memory = Memory.new(processor)
    @sections = @map.scan(SECTION).map do |name, _, address, place, size|
      { name: name, address: address.hex, place: place, size: size.hex }
    end
  end

  def sizes
    { chip: @chip, flash: flash, flash_size: @memory.flash_end + 1, flash_unit: words? ? 'words' : 'bytes',
      ram: addresses.size, ram_size: @memory.ram_size }.merge(parts_of_ram)
  end

  private

  def words?
    !@chip.start_with?('pic18')
  end

  # Configuration words lie beyond the end.
  def flash
    @sections.select { |s| s[:place] == 'program' && s[:address] <= @memory.flash_end }
             .sum { |s| s[:size] / (words? ? 2 : 1) }
  end

  # The bytes of RAM that are taken, each counted once: sections may overlap, and
  # registers of the chip are sections too.
  def addresses
    @addresses ||= @sections.select { |s| s[:place] == 'data' }
                            .flat_map { |s| (s[:address]...(s[:address] + s[:size])).to_a }
                            .uniq.select { |address| @memory.ram?(address) }
  end

  # Of it: what SDCC passes arguments and saves registers in on a PIC16, and the
  # software stack of a PIC18.
  def parts_of_ram
    return { shared: section_size('sharebank') } if words?

    symbols = @map.scan(SYMBOL).to_h
    { stack: symbols.fetch('_stack_end').hex - symbols.fetch('_stack').hex + 1 }
  end

  def section_size(name)
    @sections.select { |s| s[:name] == name }.sum { |s| s[:size] }
  end
end

# One firmware of an AVR, from its sections. Its stack takes what they leave.
class AvrFirmware
  def initialize(elf)
    output, status = Open3.capture2('avr-size', '-A', elf)
    abort "firmware: avr-size cannot read #{elf}" unless status.success?
    @sections = output.scan(/^(\.\w+)\s+(\d+)/).to_h.transform_values(&:to_i)
  end

  def sizes
    { chip: 'atmega328p', flash: sum('.text', '.data'), flash_size: 32_768, flash_unit: 'bytes',
      ram: sum('.data', '.bss'), ram_size: 2048, stack: 0 }
  end

  private

  def sum(*names)
    names.sum { |name| @sections.fetch(name, 0) }
  end
end

def percent(part, whole)
  format('%3.0f %%', 100.0 * part / whole)
end

def of_it(size)
  return "#{size[:shared]} shared by SDCC's calls" if size[:shared]

  size[:stack].zero? ? 'without its stack' : "#{size[:stack]} stack"
end

def row(name, size)
  format('%-23s %-11s %6d of %5d %s %s   %4d of %4d bytes %s (%s)', name, size[:chip].upcase,
         size[:flash], size[:flash_size], size[:flash_unit], percent(size[:flash], size[:flash_size]),
         size[:ram], size[:ram_size], percent(size[:ram], size[:ram_size]), of_it(size))
end

folder = ARGV.shift
sizes = Dir["#{folder}/*.hex"].sort.to_h do |hex|
  elf = hex.sub(/hex$/, 'elf')
  firmware = File.exist?(elf) ? AvrFirmware.new(elf) : Firmware.new(hex.sub(/hex$/, 'map'))
  [File.basename(hex, '.hex'), firmware.sizes]
end
File.write("#{folder}/sizes.json", "#{JSON.pretty_generate(sizes)}\n")
puts 'firmware                chip         flash                         RAM'
ARGV.each { |name| puts row(name, sizes.fetch(name)) }
too_big = ARGV.select { |name| sizes[name][:flash] > sizes[name][:flash_size] }
abort "firmware: does not fit its chip: #{too_big.join(', ')}" unless too_big.empty?

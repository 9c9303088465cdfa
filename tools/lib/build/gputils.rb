# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What gputils knows of a PIC: the assembler's header and the linker's script.
module Gputils
  # Where gpasm and gplink look for them: 'header' or 'lkr'.
  def self.folder(kind)
    @folders ||= {}
    @folders[kind] ||= ENV.fetch("GPUTILS_#{kind.upcase}_PATH") do
      `#{kind == 'lkr' ? 'gplink' : 'gpasm'} --help`[/^Default (?:header file|linker script) path (.*)$/, 1] or
        abort 'gputils is missing'
    end
  end
end

# A chip as the assembler's header has it: NAME EQU H'0123' under headings.
class Device
  attr_reader :registers, :bits, :options

  def initialize(chip)
    @registers = {}
    @bits = {}
    @options = {} # of the configuration words: WDT => { ON => 0xFF }; of a PIC18 true, by the comments for CONFIG
    @constants = !chip.start_with?('18')
    heading = nil
    header = "#{Gputils.folder('header')}/p#{chip}.inc"
    abort "gputils has no pic#{chip}" unless File.exist?(header)
    File.foreach(header) do |line|
      heading = Regexp.last_match(1) if line =~ /^;-----\s*(\w.*?)\s*-*$/
      take(heading, Regexp.last_match(1), Regexp.last_match(2).hex) if line =~ /^(\w+)\s+EQU\s+H'(\h+)'/
      (@options[Regexp.last_match(1)] ||= {})[Regexp.last_match(2)] = true if line =~ /^;     (\w+) = (\w+)\s/
    end
    abort "gputils has no registers of the #{chip}" if @registers.empty?
  end

  # What is wrong with a setting of the configuration words, or nil.
  def lack(name, value)
    return "no setting #{name}" unless options[name]

    "no value #{value} of the setting #{name}" unless options[name][value]
  end

  # For each register its byte, and its bits by name where it has any; for a pair both bytes.
  def c_text
    (registers.keys - pairs).map { |name| "extern volatile unsigned char #{name};\n" }.join +
      pairs.map { |name| "extern volatile unsigned short #{name};\n" }.join +
      bits.map { |name, of| "extern volatile union {\n#{structs(of)}#{fields(of)}} #{name}bits;\n" }.join
  end

  private

  def take(heading, name, value)
    case heading
    when /^(?:Register Files|Bank\s*\w+)$/ then @registers[name] = value
    when /^(\w+) Bits$/ then (@bits[Regexp.last_match(1)] ||= {})[name] = value
    when /^CONFIG\w* Options$/ then @constants && option(name, value)
    end
  end

  # `_WDTE_ON` of a PIC16; a name of the setting may have a _ in it, so each way to part
  # them counts.
  def option(name, value)
    words = name.delete_prefix('_').split('_')
    (1...words.size).each do |n|
      (@options[words.take(n).join('_')] ||= {})[words.drop(n).join('_')] = value
    end
  end

  # XL and XH, side by side, as X.
  def pairs
    registers.keys.grep(/L\z/).map(&:chop).select do |name|
      first = registers["#{name}L"]
      registers["#{name}H"] == first + 1 && registers.fetch(name, first) == first
    end
  end

  # Bits with numbers, side by side: X0 and X1 are also a field X.
  def fields(bits)
    bits.keys.grep(/\D0\z/).map do |first|
      name = first.chop
      size = (0..7).take_while { |n| bits["#{name}#{n}"] == bits[first] + n }.size
      next if size == 1 || bits.key?(name)

      "    struct { unsigned char : #{bits[first]}; unsigned char #{name} : #{size}; };\n"
    end.join
  end

  # A bit may have several names: each struct has one of them for each bit.
  def structs(fields)
    names = fields.keys.group_by { |name| fields[name] }
    names.values.map(&:size).max.times.map do |nth|
      rows = 8.times.map { |bit| "unsigned char #{names[bit] && names[bit][nth]} : 1;" }
      "    struct { #{rows.join(' ').gsub(/ +/, ' ')} };\n"
    end.join
  end
end

# A chip's memory as the linker's script has it.
class Memory
  PLACE = /^\s*(CODEPAGE|ACCESSBANK|DATABANK|SHAREBANK)\s+NAME=(\S+)\s+START=0x(\h+)\s+END=0x(\h+)(?:\s+SHADOW=\S+)?\s*$/.freeze

  # The last word of flash, in bytes of a PIC18; the RAM, as ranges.
  attr_reader :flash_end, :ram

  def initialize(chip)
    places = File.read("#{Gputils.folder('lkr')}/#{chip}_g.lkr").scan(PLACE)
                 .map { |kind, _, first, last| [kind, first.hex..last.hex] }
    pages, @banks = places.partition { |kind,| kind == 'CODEPAGE' }
    @flash_end = pages.map { |_, range| range.last }.max
    @ram = @banks.map(&:last)
    abort "gputils has no RAM of the #{chip}" if @ram.empty?
  end

  # The last byte of RAM that needs no bank, of a PIC18.
  def access_end
    @banks.find { |kind,| kind == 'ACCESSBANK' }&.last&.last
  end

  def ram?(address)
    @ram.any? { |range| range.cover?(address) }
  end

  def ram_size
    @ram.flat_map(&:to_a).uniq.size
  end
end

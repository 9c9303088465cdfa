# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# device.rb PORT_FOLDER: what gputils' header of the chip says against what a
# port's configuration.h and registers.h say, and the chip's registers with their
# bits on standard output, as C for xc.h. Says what is wrong and exits with 1.

# A chip as the assembler's header has it: NAME EQU H'0123' under headings.
class Device
  attr_reader :registers, :bits, :options

  def initialize(chip)
    @registers = {}
    @bits = {}
    @options = {} # of the configuration words: WDT => { ON => 0xFF }
    folder = ENV.fetch('GPUTILS_HEADER_PATH') # where gpasm looks, too
    heading = nil
    File.foreach("#{folder}/p#{chip}.inc") do |line|
      heading = Regexp.last_match(1) if line =~ /^;-----\s*(\w.*?)\s*-*$/
      take(heading, Regexp.last_match(1), Regexp.last_match(2).hex) if line =~ /^(\w+)\s+EQU\s+H'(\h+)'/
    end
    abort "xc8_check: no registers of #{chip} in #{folder}" if @registers.empty?
  end

  # For each register its byte, and its bits by name where it has any.
  def c_text
    registers.keys.map { |name| "extern volatile unsigned char #{name};\n" }.join +
      bits.map { |name, fields| "extern volatile union {\n#{structs(fields)}} #{name}bits;\n" }.join
  end

  private

  def take(heading, name, value)
    case heading
    when /^(?:Register Files|Bank\s*\w+)$/ then @registers[name] = value
    when /^(\w+) Bits$/ then (@bits[Regexp.last_match(1)] ||= {})[name] = value
    when /^CONFIG\w* Options$/ then option(name, value)
    end
  end

  # `_WDT_ON_2H` of a PIC18 and `_WDTE_ON` of a PIC16; a name of the setting may
  # have a _ in it, so each way to part them counts.
  def option(name, value)
    words = name.delete_prefix('_').sub(/_\d[LH]$/, '').split('_')
    (1...words.size).each do |n|
      (@options[words.take(n).join('_')] ||= {})[words.drop(n).join('_')] = value
    end
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

# What a port says of its chip.
class Port
  def initialize(folder)
    @folder = folder
    @device = Device.new(File.basename(folder).delete_prefix('pic'))
    @wrong = []
  end

  def check
    check_configuration(File.read("#{@folder}/configuration.h"))
    check_registers(registers('registers.h'))
    abort @wrong.map { |what| "#{@folder}: #{what}" }.join("\n") unless @wrong.empty?
    puts @device.c_text
  end

  private

  # With what it includes of a family's.
  def registers(file)
    text = File.read("#{@folder}/#{file}")
    text + text.scan(/^#include "(.*registers.*)"/).map { |included,| registers(included) }.join
  end

  # Each setting once, and SDCC's word of a PIC16, a number, as XC8's settings make it.
  def check_configuration(text)
    settings = text.scan(/^#pragma config (.*)$/).flat_map { |line, *| line.split(',') }
                   .map { |setting| setting.split('=').map(&:strip) }
    @wrong << 'configuration.h has no #pragma config' if settings.empty?
    values = settings.map { |name, value| known(name, value) }
    names = settings.map(&:first)
    @wrong << "#{names.tally.key(2)} is set twice" if names.uniq.size < names.size
    word = text[/configuration_word = 0x(\h+)/, 1] or return
    all = values.compact.reduce(0x3FFF, :&)
    @wrong << format('SDCC has the word 0x%s, XC8 0x%04X', word, all) if word.hex != all
  end

  def known(name, value)
    of_name = @device.options[name]
    return (@wrong << "no setting #{name}") && nil unless of_name

    of_name[value] or (@wrong << "no value #{value} of the setting #{name}") && nil
  end

  # Their addresses, and the bits that have a mask: REGISTER_BIT.
  def check_registers(text)
    text.scan(/PORT_REGISTER\(0x(\h+), (\w+)\)/) do |address, name|
      @wrong << "no register #{name}" unless @device.registers.key?(name)
      @wrong << "#{name} is not at 0x#{address}" unless @device.registers[name] == address.hex
    end
    text.scan(/^#define ([^\W_]+)_(\w+) 0x(\h+)u?$/) do |register, name, mask|
      bit = @device.bits.fetch(register, {})[name] or next
      @wrong << "#{register}_#{name} is not 0x#{mask}" unless 1 << bit == mask.hex
    end
  end
end

Port.new(ARGV.fetch(0)).check

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# device.rb PORT_FOLDER: what gputils' header and linker script of the chip say
# against what a port's configuration.h, registers.h and port.c say, and the chip's
# registers with their bits on standard output, as C for xc.h. Says what is wrong
# and exits with 1.
#
# device.rb CHIP [-OPTION]... FILE...: the same against each `#pragma config` of these files.
require_relative '../../../tools/lib/build/gputils'
require_relative '../../../tools/lib/build/pic_port'

# A port beside what gputils has of its chip.
class Check
  def initialize(folder)
    @folder = folder
    @port = PicPort.new(folder)
    @device = Device.new(@port.chip)
    @memory = Memory.new(@port.chip)
    @wrong = []
  end

  def check
    check_configuration
    check_registers
    check_memory
    abort @wrong.map { |what| "#{@folder}: #{what}" }.join("\n") unless @wrong.empty?
    puts @device.c_text
  end

  private

  # Each setting once, and SDCC's word of a PIC16, a number, as XC8's settings make it.
  def check_configuration
    @wrong << 'configuration.h has no #pragma config' if @port.settings.empty?
    values = @port.settings.map { |name, value| known(name, value) }
    names = @port.settings.map(&:first)
    @wrong << "#{names.tally.key(2)} is set twice" if names.uniq.size < names.size
    word = @port.text_of('configuration.h')[/configuration_word = 0x(\h+)/, 1] or return
    all = values.compact.reduce(0x3FFF, :&)
    @wrong << format('SDCC has the word 0x%s, XC8 0x%04X', word, all) if word.hex != all
  end

  def known(name, value)
    lack = @device.lack(name, value) and @wrong << lack
    @device.options.dig(name, value)
  end

  # Their addresses, and the bits that have a mask: REGISTER_BIT.
  def check_registers
    @port.registers.each do |name, address|
      @wrong << "no register #{name}" unless @device.registers.key?(name)
      @wrong << format('%s is not at 0x%02X', name, address) unless @device.registers[name] == address
    end
    @port.text_of('registers.h').scan(/^#define ([^\W_]+)_(\w+) 0x(\h+)u?$/) do |register, name, mask|
      bit = @device.bits.fetch(register, {})[name] or next
      @wrong << "#{register}_#{name} is not 0x#{mask}" unless 1 << bit == mask.hex
    end
  end

  # SDCC's run-time stack lies in RAM, and the bytes of the interrupt at the end of
  # what needs no bank.
  def check_memory
    stack = @port.stack or return
    @wrong << format('no RAM at 0x%X for the stack', stack.first) unless stack.all? { |at| @memory.ram?(at) }
    return if @port.access_end == @memory.access_end

    @wrong << format('access RAM does not end at 0x%X', @port.access_end.to_i)
  end
end

# Files of a user's.
class Settings
  # Words as numbers, which have no names.
  NUMBERS = /\A(CONFIG|IDLOC)\d/.freeze

  def initialize(chip, files)
    @device = Device.new(chip)
    @files = files
  end

  def check
    wrong = @files.flat_map { |file| File.readlines(file).flat_map.with_index(1) { |line, at| lacks(line).map { |lack| "#{file}:#{at}: #{lack}" } } }
    abort wrong.join("\n") unless wrong.empty?
    puts @device.c_text
  end

  private

  def lacks(line)
    text = line[%r{^\s*#\s*pragma\s+config\s(.*?)(?://|/\*|$)}, 1].to_s
    text.scan(/(\w+)\s*=\s*(\w+)/).reject { |name,| name =~ NUMBERS }
        .map { |name, value| @device.lack(name, value) }.compact
  end
end

place, *words = ARGV
words.empty? ? Check.new(place).check : Settings.new(PicPort.new(place).chip, words.grep_v(/^-/)).check

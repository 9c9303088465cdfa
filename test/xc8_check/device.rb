# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# device.rb PORT_FOLDER: what gputils' header and linker script of the chip say
# against what a port's configuration.h, registers.h and port.c say, and the chip's
# registers with their bits on standard output, as C for xc.h. Says what is wrong
# and exits with 1.
require_relative '../../tools/lib/gputils'

# What a port says of its chip.
class Port
  def initialize(folder)
    chip = File.basename(folder).delete_prefix('pic')
    @folder = folder
    @device = Device.new(chip)
    @memory = Memory.new(chip)
    @wrong = []
  end

  def check
    check_configuration(text_of('configuration.h'))
    check_registers(text_of('registers.h'))
    check_memory(text_of('configuration.h'), text_of('port.c'))
    abort @wrong.map { |what| "#{@folder}: #{what}" }.join("\n") unless @wrong.empty?
    puts @device.c_text
  end

  private

  # With what it includes from the folders beside the port's.
  def text_of(file)
    File.read("#{@folder}/#{file}").gsub(%r{^#include "(\.\./[^"]+)"$}) { text_of(Regexp.last_match(1)) }
  end

  # SDCC's run-time stack lies in RAM, and the bytes of the interrupt at the end of
  # what needs no bank.
  def check_memory(configuration, port)
    stack = configuration.match(/^#pragma stack 0x(\h+) 0x(\h+)$/) or return
    first, size = stack.captures.map(&:hex)
    @wrong << format('no RAM at 0x%X for the stack', first) unless (first...(first + size)).all? { |at| @memory.ram?(at) }
    last = port[/^#define ACCESS_RAM_END 0x(\h+)$/, 1].to_s.hex
    @wrong << format('access RAM does not end at 0x%X', last) unless last == @memory.access_end
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

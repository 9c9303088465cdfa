# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What the folder of a port for PIC says of its chip.
class PicPort
  attr_reader :chip # as gputils calls it

  # Of all chips that have one.
  def self.all
    Dir['port/pic/*/port.c'].sort.map { |file| new(File.dirname(file)) }
  end

  def initialize(folder)
    @folder = folder
    @chip = File.basename(folder).delete_prefix('pic')
  end

  # A file with what it includes from the folders beside the port's.
  def text_of(file)
    File.read("#{@folder}/#{file}").gsub(%r{^#include "(\.\./[^"]+)"$}) { text_of(Regexp.last_match(1)) }
  end

  # Name and address of each.
  def registers
    text_of('registers.h').scan(/PORT_REGISTER\(0x(\h+), (\w+)\)/).map { |address, name| [name, address.hex] }
  end

  # Name and value of each setting of the configuration words.
  def settings
    text_of('configuration.h').scan(/^#pragma config (.*)$/).flat_map { |line, *| line.split(',') }
                              .map { |setting| setting.split('=').map(&:strip) }
  end

  # Of a PIC18: where SDCC's run-time stack lies, and the last byte that needs no bank.
  def stack
    first, size = text_of('configuration.h').match(/^#pragma stack 0x(\h+) 0x(\h+)$/)&.captures&.map(&:hex)
    first && (first...(first + size))
  end

  def access_end
    text_of('port.c')[/^#define ACCESS_RAM_END 0x(\h+)$/, 1]&.hex
  end
end

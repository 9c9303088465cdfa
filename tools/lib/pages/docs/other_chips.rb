# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../../data_tables'

# What to change in a copy of the nearest port for a chip that has none, from gputils'
# header and linker script of both: which of the port's registers and settings it has
# not, or elsewhere, and what memory it has.
require_relative '../../build/gputils'
require_relative '../../build/pic_port'

# One chip beside one port.
class OtherChip
  STACK = 0x100

  def initialize(name, port)
    @name = name
    @port = port
    @device = Device.new(name)
    @memory = Memory.new(name)
    @nearest = Device.new(port.chip)
  end

  def row
    ["PIC#{@name.upcase}", "PIC#{@port.chip.upcase}", registers, memory, settings]
  end

  def differences
    lacks.size + elsewhere.size + other_bits.size + unknown.size + values.size
  end

  private

  def common
    @port.registers.map(&:first) & @device.registers.keys
  end

  def lacks
    @port.registers.map(&:first) - @device.registers.keys
  end

  def elsewhere
    common.reject { |name| @device.registers[name] == @port.registers.to_h[name] }
  end

  # Registers of which a bit has the same name and another place.
  def other_bits
    common.select do |name|
      bits = @device.bits.fetch(name, {})
      @nearest.bits.fetch(name, {}).any? { |bit, place| bits.fetch(bit, place) != place }
    end
  end

  def unknown
    @port.settings.map(&:first).reject { |name| @device.options[name] }
  end

  def values
    @port.settings.select { |name, value| @device.options[name] && !@device.options[name][value] }
                  .map { |name, value| "#{name} = #{value}" }
  end

  def registers
    said([['without', lacks],
          ['elsewhere', elsewhere.map { |name| format('%s 0x%02X', name, @device.registers[name]) }],
          ['other bits in', other_bits]])
  end

  def settings
    said([['no', unknown], ['no value', values]])
  end

  def memory
    flash = @memory.flash_end + 1
    return "#{flash} bytes, RAM #{@memory.ram_size}#{access}#{stack}" if @port.stack

    banks = @memory.ram.sort_by(&:first).map { |range| format('0x%02X to 0x%02X', range.first, range.last) }
    "#{flash} words, RAM #{banks.join(', ')}"
  end

  def access
    @memory.access_end == @port.access_end ? '' : format('; ACCESS_RAM_END 0x%02X', @memory.access_end)
  end

  # The last place where it fits, if the port's own is none.
  def stack
    return '' if @port.stack.all? { |at| @memory.ram?(at) }

    first = (0..0xFFF).step(STACK).select { |at| (at...(at + STACK)).all? { |byte| @memory.ram?(byte) } }.max
    format('; stack from 0x%X', first)
  end

  def said(parts)
    texts = parts.reject { |_, names| names.empty? }.map { |what, names| "#{what} #{names.join(', ')}" }
    texts.empty? ? 'the same' : texts.join('; ')
  end
end

# Beside the ports that there are.
module OtherChips
  FILE = 'docs/data/ports.csv'
  NAMES = %w[18f2431 18f4331 18f2331 18f46k22 18f45k22 18f25k22 18f4420 18f4620 18f2420 18f2520 18f2620
             18f4550 18f2550 18f452 16f690 16f685 16f887 16f616].freeze

  def self.csv
    rows = NAMES.map { |name| near(name).row }
    DataTables.text([['chip', 'nearest port', 'registers', 'memory', 'settings'], *rows])
  end

  def self.near(name)
    PicPort.all.select { |port| port.chip[0, 2] == name[0, 2] }.map { |port| OtherChip.new(name, port) }
           .min_by(&:differences)
  end
end

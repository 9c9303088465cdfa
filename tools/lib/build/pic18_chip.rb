# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# A PIC18 by gputils' lists, for build_pic:
#
#   pic18_chip.rb CHIP           the definitions that port/template/configuration.h asks for
#   pic18_chip.rb CHIP HEX       whether that firmware has switched XINST off, where CHIP has it
require_relative 'gputils'

# The configuration word that has XINST, which is its bit 6 in each family.
class ExtendedInstructions
  BIT = 0x40

  # A chip that keeps its words at the end of its flash has them in the first, and no
  # constants for them.
  def initialize(chip)
    header = File.read("#{Gputils.folder('header')}/p#{chip}.inc")
    if header =~ /^_XINST_OFF_(\d)([LH])\b/
      @address = 0x300000 + (2 * (Regexp.last_match(1).to_i - 1)) + (Regexp.last_match(2) == 'H' ? 1 : 0)
    elsif header.match?(/^;\s+XINST = OFF/)
      @address = File.read("#{Gputils.folder('lkr')}/#{chip}_g.lkr")[/NAME=config\s+START=0x(\h+)/, 1].hex
    end
  end

  def any?
    !@address.nil?
  end

  # An erased byte has the bit.
  def off?(hex)
    (byte(hex, @address) & BIT).zero?
  end

  private

  def byte(hex, address)
    high = 0
    File.foreach(hex) do |line|
      size, low, kind = line[1, 8].unpack('a2a4a2').map(&:hex)
      high = line[9, 4].hex << 16 if kind == 4
      at = address - high - low
      return line[9 + (2 * at), 2].hex if kind.zero? && (0...size).cover?(at)
    end
    0xFF
  end
end

chip, hex = ARGV
xinst = ExtendedInstructions.new(chip)
exit !xinst.any? || xinst.off?(hex) if hex
puts '-DPORT_NO_XINST' unless xinst.any?
puts '-DPORT_SMALL_RAM' if Memory.new(chip).ram_size < 0x300

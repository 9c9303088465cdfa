# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# pic16_start.rb CHIP: the start-up of a PIC16 for SDCC, in assembly, in place of the
# run-time library's, which clears no RAM. It clears all that gputils' linker script of
# the chip has, and copies no initialized data.
require_relative 'gputils'

chip = ARGV.fetch(0)
enhanced = Device.new(chip).registers.key?('FSR0L')
select, byte, pointer = enhanced ? [nil, 'INDF0', 'FSR0L'] : ['STATUS, IRP', 'INDF', 'FSR']
shared, banked = Memory.new(chip).ram.partition { |range| (range.first & 0x7F) >= 0x70 }
loops = (shared.take(1) + banked).map.with_index do |range, at|
  high = range.first >> 8
  bank = enhanced ? "        movlw   .#{high}\n        movwf   FSR0H" : "        #{high.odd? ? 'bsf' : 'bcf'}     #{select}"
  format(<<~LOOP, bank: bank, first: range.first & 0xFF, last: (range.last + 1) & 0xFF, byte: byte, pointer: pointer, at: at)
    %<bank>s
            movlw   .%<first>d
            movwf   %<pointer>s
    clear%<at>d:
            clrf    %<byte>s
            incf    %<pointer>s, f
            movf    %<pointer>s, w
            xorlw   .%<last>d
            btfss   STATUS, Z
            goto    clear%<at>d
  LOOP
end
puts <<~START
          list    p=#{chip}
          include "p#{chip}.inc"

          global  __sdcc_gsinit_startup
          extern  _main

  STARTCODE code
  __sdcc_gsinit_startup:
          clrf    STATUS
  #{loops.join}
          pagesel _main
          goto    _main
          end
START

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What others cost: figures that are not measured here, with where they are
# from. Costs by chip and build; flash and RAM are those of the ATmega328P at
# -Os.
Other = Struct.new(:title, :costs, :flash, :ram, keyword_init: true)

# AN937: Table 3 of the note gives 437 cycles for the routine and 184 for its
# interrupt, at an error of 6 %. In gpsim its firmware takes up to 510 and 236.
# AN964: 1.4 ms and 215 us at 2 million instructions a second.
NOTES = [
  Other.new(title: 'AN937, the note\'s own firmware', costs: { 'pic18f4520' => 510 + 236 }),
  Other.new(title: 'AN964, the note\'s C program', costs: { 'pic16f684' => 2800 }),
  Other.new(title: 'AN964, the note\'s assembly program', costs: { 'pic16f684' => 430 })
].freeze

# Their real sources, a proportional, integral and derivative step of each: 64
# calls of one trace, from entry to return with all that they call. AVR in
# simavr with gcc 5.4; Cortex-M by instruction count with gcc 12.2 at -Os;
# PIC18F4520 in gpsim with SDCC 4.2.
PEERS = [
  Other.new(title: 'AVR221', flash: 728, ram: 18,
            costs: { 'pic18f4520' => 2401, 'atmega328p-O2' => 280, 'atmega328p-Os' => 841, 'cortex-m0-Os' => 50,
                     'cortex-m4-Os' => 45 }),
  Other.new(title: 'Speeduino integerPID', flash: 1210, ram: 37,
            costs: { 'atmega328p-O2' => 624, 'atmega328p-Os' => 624, 'cortex-m0-Os' => 51, 'cortex-m4-Os' => 42 }),
  Other.new(title: 'integer_pid', flash: 954, ram: 22,
            costs: { 'atmega328p-O2' => 676, 'atmega328p-Os' => 665, 'cortex-m0-Os' => 79, 'cortex-m4-Os' => 53 }),
  Other.new(title: 'FastPID 1.3.2', flash: 3116, ram: 45,
            costs: { 'atmega328p-O2' => 1275, 'atmega328p-Os' => 1203, 'cortex-m0-Os' => 127, 'cortex-m4-Os' => 56 }),
  Other.new(title: 'CMSIS-DSP, q15', costs: { 'cortex-m0-Os' => 48, 'cortex-m4-Os' => 23 }),
  Other.new(title: 'CMSIS-DSP, q31', costs: { 'cortex-m0-Os' => 159, 'cortex-m4-Os' => 17 }),
  Other.new(title: 'Arduino PID, float', flash: 3426, ram: 60,
            costs: { 'atmega328p-O2' => 1671, 'atmega328p-Os' => 1652, 'cortex-m0-Os' => 1778,
                     'cortex-m4-Os' => 650 }),
  Other.new(title: 'geekfactory PID, float', flash: 2926, ram: 45,
            costs: { 'pic18f4520' => 7567, 'atmega328p-O2' => 1534, 'atmega328p-Os' => 1543, 'cortex-m0-Os' => 852,
                     'cortex-m4-Os' => 502 })
].freeze

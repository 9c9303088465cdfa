# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What others cost: figures that are not measured here, with where they are
# from. Costs by chip and build, a mean and a worst step or one number; flash and
# RAM are those of the ATmega328P at -Os.
Other = Struct.new(:title, :costs, :flash, :ram, keyword_init: true) do
  # nil where only a mean is known.
  def worst(place)
    Array(costs[place]).last
  end

  # A cell of a table.
  def shown(place)
    cost = costs.fetch(place, '-')
    cost.is_a?(Array) ? cost.map { |value| value || '-' }.join(' / ') : cost
  end
end

# AN937: Table 3 of the note gives 437 cycles for the routine and 184 for its
# interrupt, at an error of 6 %. In gpsim its firmware takes up to 510 and 236.
# AN964: 1.4 ms and 215 us at 2 million instructions a second.
NOTES = [
  Other.new(title: 'AN937, the note\'s own firmware', costs: { 'pic18f4520' => 510 + 236 }),
  Other.new(title: 'AN964, the note\'s C program', costs: { 'pic16f684' => 2800 }),
  Other.new(title: 'AN964, the note\'s assembly program', costs: { 'pic16f684' => 430 })
].freeze

# Their real sources, from entry to return with all that they call, for the
# trace of 480 calls that docs/cost.md describes: AVR in simavr with gcc 5.4, the
# others by instruction count in QEMU 7.2 with gcc 12.2. What the PIC18F4520
# takes, in gpsim with SDCC 4.2, all of geekfactory PID, flash and RAM are from an
# earlier run, of 64 calls; TI's DCL, its parallel PID of commit bae4f5c6, is from a
# later one, of 640 steps of the same loop.
PEERS = [
  Other.new(title: 'MarbleAccelerator, PI',
            costs: { 'atmega328p-O2' => [270, 282], 'atmega328p-Os' => [276, 286], 'cortex-m0-O2' => [31, 35],
                     'cortex-m4-O2' => [23, 26], 'rv32imc-O2' => [23, 27] }),
  Other.new(title: 'CMSIS-DSP, q15',
            costs: { 'atmega328p-O2' => [588, 594], 'atmega328p-Os' => [588, 594], 'cortex-m0-O2' => [48, 48],
                     'cortex-m4-O2' => [22, 22], 'rv32imc-O2' => [40, 40] }),
  Other.new(title: 'CMSIS-DSP, q31',
            costs: { 'atmega328p-O2' => [975, 1017], 'atmega328p-Os' => [975, 1017], 'cortex-m0-O2' => [163, 163],
                     'cortex-m4-O2' => [20, 20], 'rv32imc-O2' => [29, 29] }),
  Other.new(title: 'AM32',
            costs: { 'atmega328p-O2' => [457, 460], 'atmega328p-Os' => [469, 471], 'cortex-m0-O2' => [35, 35],
                     'cortex-m4-O2' => [34, 34], 'rv32imc-O2' => [30, 30] }),
  Other.new(title: 'AVR221', flash: 728, ram: 18,
            costs: { 'pic18f4520' => [2401, 2427], 'atmega328p-O2' => [274, 281], 'atmega328p-Os' => [840, 856],
                     'cortex-m0-O2' => [48, 50], 'cortex-m4-O2' => [39, 41], 'rv32imc-O2' => [41, 43] }),
  Other.new(title: 'Speeduino integerPID', flash: 1210, ram: 37,
            costs: { 'atmega328p-O2' => [624, 633], 'atmega328p-Os' => [624, 633], 'cortex-m0-O2' => [58, 59],
                     'cortex-m4-O2' => [43, 44], 'rv32imc-O2' => [56, 57] }),
  Other.new(title: 'integer_pid', flash: 954, ram: 22,
            costs: { 'atmega328p-O2' => [652, 709], 'atmega328p-Os' => [651, 706], 'cortex-m0-O2' => [72, 83],
                     'cortex-m4-O2' => [39, 44], 'rv32imc-O2' => [51, 59] }),
  Other.new(title: 'FastPID 1.3.2', flash: 3116, ram: 45,
            costs: { 'atmega328p-O2' => [1166, 1276], 'atmega328p-Os' => [1130, 1204], 'cortex-m0-O2' => [148, 158],
                     'cortex-m4-O2' => [50, 56], 'rv32imc-O2' => [61, 67] }),
  Other.new(title: 'PID-CPP',
            costs: { 'atmega328p-O2' => [1762, 1805], 'atmega328p-Os' => [1600, 1647], 'cortex-m0-O2' => [247, 267],
                     'cortex-m4-O2' => [66, 73], 'rv32imc-O2' => [75, 93] }),
  Other.new(title: 'Arduino PID, double', flash: 3426, ram: 60,
            costs: { 'atmega328p-O2' => [1844, 2099], 'atmega328p-Os' => [1844, 2077], 'cortex-m0-O2' => [1906, 2115],
                     'cortex-m4-O2' => [722, 841] }),
  Other.new(title: 'TI DCL, float',
            costs: { 'atmega328p-O2' => [1950, 2126], 'cortex-m0-O2' => [1178, 1260], 'cortex-m4-O2' => [556, 609],
                     'rv32imc-O2' => [1126, 1198] }),
  Other.new(title: 'SimpleFOC, float',
            costs: { 'atmega328p-O2' => [2461, 2641], 'atmega328p-Os' => [2567, 2751], 'cortex-m0-O2' => [1558, 1718],
                     'cortex-m4-O2' => [743, 785], 'rv32imc-O2' => [1248, 1340] }),
  Other.new(title: 'QuickPID 3.1.9, float',
            costs: { 'atmega328p-O2' => [2996, 3405], 'atmega328p-Os' => [2955, 3336], 'cortex-m0-O2' => [1545, 1813],
                     'cortex-m4-O2' => [953, 1154] }),
  Other.new(title: 'pms67, float',
            costs: { 'atmega328p-O2' => [3075, 3383], 'atmega328p-Os' => [3067, 3360], 'cortex-m0-O2' => [1846, 2009],
                     'cortex-m4-O2' => [820, 906], 'rv32imc-O2' => [1614, 1701] }),
  Other.new(title: 'geekfactory PID, float', flash: 2926, ram: 45,
            costs: { 'pic18f4520' => [7567, 8562], 'atmega328p-O2' => [1534, nil], 'atmega328p-Os' => [1543, 1680] })
].freeze

# What these cycles buy, in the loop that the trace is of: overshoot in counts,
# steps until it is settled, sum of the error's magnitude and error left, of the
# first setpoint; after an unreachable one steps until it is back, and the sum of
# errors until then; the error left where gains are low.
QUALITY = [
  ['double precision, as `fixpid_pid`', 'by the sign', '0.1', 109, 21_068, '0', 22, 4536, '0'],
  ['`fixpid_pid`', 'by the sign', '0.1', 109, 21_068, '0', 22, 4536, '0'],
  ['`fixpid_pid`, filter 2', 'by the sign', '0.1', 106, 20_937, '0', 22, 4611, '-'],
  ['Speeduino integerPID', 'undone, sign-blind', '0.1', 109, 21_088, '0', 22, 4446, '-560 to -592'],
  ['MarbleAccelerator, PI', 'by the sign', '0.0', 116, 21_340, '0', 20, 4192, '-560 to -592'],
  ['QuickPID, float', 'conditional', '22.7', 113, 20_334, '0', 98, 7422, '0'],
  ['`fixpid_an937`', 'sum clamped', '29.6', 99, 20_018, '0', 81, 6570, '-'],
  ['Arduino PID, pms67, SimpleFOC', 'integral clamped', '30.4 to 30.8', '106 to 108', '20302 to 20334', '0',
   '82 to 83', '6191 to 6274', '0'],
  ['PID-CPP, AM32', 'integral clamped', '30.4 to 30.8', '106 to 108', '20302 to 20334', '0', '82 to 83',
   '6191 to 6274', '-'],
  ['integer_pid', 'integral clamped', '30.4 to 30.8', '106 to 108', '20302 to 20334', '0', '82 to 83',
   '6191 to 6274', '-560 to -592'],
  ['FastPID 1.3.2', 'none that matters', '202', 221, 33_747, '0', 629, 174_437, '-560 to -592'],
  ['CMSIS-DSP, q15', 'none', '203', 205, 33_580, '-1.4', 588, 167_073, '-656'],
  ['CMSIS-DSP, q31', 'none', '208', 217, 33_962, '0', 623, 174_392, '-168'],
  ['AVR221', 'none', '229', 195, 33_742, '0', 560, 174_460, '-560 to -592']
].freeze

# Those of README.md, with the version and the commit that were measured: their rows of PEERS and of QUALITY.
RIVALS = {
  'PID_v1 1.2.1 (524a426)' => ['Arduino PID, double', 'Arduino PID, pms67, SimpleFOC'],
  'FastPID 1.3.2 (e00f476)' => ['FastPID 1.3.2', 'FastPID 1.3.2'],
  'Atmel AVR221' => %w[AVR221 AVR221]
}.freeze

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Whether gpsim's dump of the RAM has at `_pid_out` what after_an937.c says.
#
#   by_hand.rb MAP DUMP SOURCE
map, dump, source = ARGV.map { |path| File.read(path) }
wanted = source[/\boutput is \(.*?\) \/ 16 = (\d+)\./, 1].to_i
address = map[/^ *_pid_out +0x(\h+) /, 1].to_i(16)
rows = dump.scan(/^(\h{4}):((?:  ?\h\h){16})/).to_h { |start, bytes| [start.to_i(16), bytes.split] }
bytes = rows.sort.flat_map(&:last)[address, 4] || abort("by_hand: gpsim dumped #{rows.size} rows, none with 0x#{address.to_s(16)}")
found = bytes.reverse.join.to_i(16)
abort "by_hand: _pid_out is #{found}, expected #{wanted}" unless found == wanted
puts "_pid_out is #{found}"

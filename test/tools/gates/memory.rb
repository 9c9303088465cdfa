# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What tools/cost remembers: a figure is measured anew when anything that it depends
# on is another one, here with a compiler that only says where its parts are.
require_relative 'gate'
require "#{PROJECT}/tools/lib/measure/host"
require "#{PROJECT}/tools/lib/measure/memory"

Figures = Struct.new(:most, keyword_init: true)
Subject = Struct.new(:key)

COMPILER = <<~TEXT
  #!/bin/sh
  here=${0%/bin/*}
  case $1 in
  -print-prog-name=*) echo "$here/gcc/${1#*=}" ;;
  -print-libgcc-file-name) echo "$here/gcc/libgcc.a" ;;
  -print-file-name=libc.a) echo "$here/avr/lib/libc.a" ;;
  esac
TEXT

PARTS = %w[bin/avr-gcc gcc/cc1 gcc/cc1plus gcc/as gcc/ld gcc/libgcc.a gcc/avr5/libgcc.a gcc/include/stdint.h
           gcc/device-specs/specs-atmega328p avr/lib/libc.a avr/lib/avr5/crtatmega328p.o avr/include/avr/io.h
           sdcc/bin/sdcc sdcc/bin/sdcpp sdcc/share/sdcc/lib/pic16/libsdcc.lib sdcc/share/sdcc/include/stdint.h
           bin/gpasm bin/qemu-system-arm].freeze
SOURCES = %w[include/fixpid.h src/pid/fixpid_pid.c src/common/fixpid_signed_avr.h port/pic/pic18/support/more.c
             sim/gpsim/chip.cc sim/gpsim/shim/shim.h test/tools/cost/avr/main.c test/chips/target/driver_main.c
             test/support/reference.c tools/cost tools/lib/build/gpsim.sh tools/lib/build/build_pic tools/lib/measure/meters.rb].freeze

def files
  texts = (PARTS + SOURCES).to_h { |path| [path, "#{path}\n"] }
  texts.merge('bin/avr-gcc' => COMPILER, 'bin/gpasm' => "#!/bin/sh\n", 'bin/qemu-system-arm' => "#!/bin/sh\n",
              'sdcc/bin/sdcc' => "#!/bin/sh\n")
end

# How often a figure is measured by a tools/cost that begins now.
def measured
  times = 0
  found = Memory.new.of(Subject.new('toy')) do
    times += 1
    Figures.new(most: 42)
  end
  found.most == 42 or abort 'FAILED the figure is not what was measured'
  times
end

def anew_after(path)
  measured
  yield path
  measured
end

Gate.tree(files) do |folder|
  FileUtils.ln_s('/bin/sh', 'bin/sh')
  ENV['PATH'] = "#{folder}/bin"
  ENV['SDCC'] = "#{folder}/sdcc/bin/sdcc"
  ENV['SDCC_LIB'] = "#{folder}/sdcc/share/sdcc/lib"
  Host.setup(folder)
  Gate.expect('the first time', measured, 1)
  Gate.expect('the second time', measured, 0)
  (PARTS + SOURCES).each do |path|
    Gate.expect("another #{path}", anew_after(path) { File.write(path, '# more', mode: 'a') }, 1)
  end
  Gate.expect('a file that is new', anew_after('src/fixpid_new.c') { |path| File.write(path, '') }, 1)
  Gate.expect('a file that is gone', anew_after('src/fixpid_new.c') { |path| File.delete(path) }, 1)
  Gate.expect('a file of no account', anew_after('notes.txt') { |path| File.write(path, '') }, 0)
  Gate.expect('a memory that broke off', anew_after('build/cost/memory/toy.json') { |path| File.write(path, '{') }, 1)
end
Gate.finish

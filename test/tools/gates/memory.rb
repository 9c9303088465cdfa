# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What tools/cost and tools/test remember: a figure or a verdict is found out anew when
# anything that it depends on is another one, here with a compiler that only says where its
# parts are.
require_relative 'gate'
require "#{PROJECT}/tools/lib/measure/host"
require "#{PROJECT}/tools/lib/measure/remembered"

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
  found = RememberedFigures.new.of(Subject.new('toy')) do
    times += 1
    Figures.new(most: 42)
  end
  found.most == 42 or abort 'FAILED the figure is not what was measured'
  times
end

# What was there before is remembered: each case ends with a measurement.
def anew_after(path)
  yield path
  measured
end

def records
  Dir['cache/fixpid/verdicts/cost/*.json']
end

def same_size_and_time(path)
  status = File.stat(path)
  File.write(path, File.read(path).swapcase)
  File.utime(status.atime, status.mtime, path)
end

# A record that is whole, but for the clock.
def at_another_time(days)
  records.each do |path|
    record = JSON.parse(File.read(path))
    next unless record.is_a?(Hash)

    record['when'] += 86_400 * days
    record['seal'] = Digest::SHA256.hexdigest(JSON.generate(record.slice('key', 'name', 'when', 'value')))
    File.write(path, JSON.generate(record))
  end
end

# How often a verdict is found out by one run: once or, if it is remembered, never.
# The block says what it is.
def asked(name, remembered = Remembered.new('toys', files: ['src/**/*']), **of_its_own)
  times = 0
  remembered.of(name, **of_its_own) do
    times += 1
    yield
  end
  times
end

# The same of two runs.
def judged(name, &block)
  2.times.sum { asked(name, &block) }
end

# Of two runs with a file and a word of the verdict's own, between which the block may
# change something.
def own(words = %w[same same])
  words.each_with_index.sum do |word, run|
    yield if run == 1 && block_given?
    asked('own', Remembered.new('toys'), files: ['sim/**/*'], words: [word]) { 'ok' }
  end
end

# Of two runs with a file that is another one while the verdict is found out, and again
# as it was before the next run.
def changed_meanwhile(path)
  before = File.read(path)
  2.times.sum do |run|
    runs = asked('changed') do
      File.write(path, 'x', mode: 'a') if run.zero?
      'ok'
    end
    File.write(path, before)
    runs
  end
end

# Whether what is old goes, and only that.
def swept
  Remembered.sweep
  return 'gone' if records.empty?

  records.each { |path| File.utime(Time.now, Time.now - 86_400 * 31, path) }
  Remembered.sweep
  records.empty?
end

def verdicts(folder)
  Gate.expect('a test that is called by itself', judged('alone') { 'ok' }, 2)
  ENV['FIXPID_TALLY'] = "#{folder}/tally"
  now = Time.now.to_i
  Gate.expect('a verdict that is good', judged('good') { 'ok' }, 1)
  Gate.expect('and how old it is', (now..now + 60).cover?(File.read('tally')[/\A1 (\d+) checks\n\z/, 1].to_i), true)
  Gate.expect('a verdict that is not good', judged('bad') { nil }, 2)
  Gate.expect('a verdict with a file of its own', own, 1)
  Gate.expect('another file of its own', own { File.write('sim/gpsim/chip.cc', 'x', mode: 'a') }, 1)
  Gate.expect('another word of its own', own(%w[same other]), 1)
  Gate.expect('another variable of a compiler', own { ENV['CFLAGS'] = '-O3' }, 1)
  ENV.delete('CFLAGS')
  Gate.expect('a source that changes meanwhile', changed_meanwhile('src/pid/fixpid_pid.c'), 2)
  ENV['XDG_CACHE_HOME'] = "#{folder}/bin/avr-gcc"
  Gate.expect('a cache that cannot be written', judged('nowhere') { 'ok' }, 2)
ensure
  ENV.delete('FIXPID_TALLY')
end

Gate.tree(files) do |folder|
  FileUtils.ln_s('/bin/sh', 'bin/sh')
  ENV['PATH'] = "#{folder}/bin"
  ENV['SDCC'] = "#{folder}/sdcc/bin/sdcc"
  ENV['SDCC_LIB'] = "#{folder}/sdcc/share/sdcc/lib"
  ENV['XDG_CACHE_HOME'] = "#{folder}/cache"
  Host.setup(folder)
  Gate.expect('the first time', measured, 1)
  Gate.expect('the second time', measured, 0)
  (PARTS + SOURCES).each do |path|
    Gate.expect("another #{path}", anew_after(path) { File.write(path, '# more', mode: 'a') }, 1)
  end
  Gate.expect('a file that is new', anew_after('src/fixpid_new.c') { |path| File.write(path, '') }, 1)
  Gate.expect('as it was before', anew_after('src/fixpid_new.c') { |path| File.delete(path) }, 0)
  Gate.expect('a file of no account', anew_after('notes.txt') { |path| File.write(path, '') }, 0)
  Gate.expect('a record that broke off', anew_after('') { records.each { |path| File.truncate(path, 40) } }, 1)
  Gate.expect('a record with another value', anew_after('') { records.each { |path| File.write(path, File.read(path).sub('42', '43')) } }, 1)
  Gate.expect('a record that is no record', anew_after('') { records.each { |path| File.write(path, '[]') } }, 1)
  Gate.expect('a source of the same size and time', anew_after('src/pid/fixpid_pid.c') { |path| same_size_and_time(path) }, 1)
  Gate.expect('a compiler of the same size and time', anew_after('gcc/cc1') { |path| same_size_and_time(path) }, 1)
  Gate.expect('a record of the future, or older than a month', [-31, 1].sum { |days| anew_after('') { at_another_time(days) } }, 2)
  ENV['FIXPID_FRESH'] = 'yes'
  Gate.expect('what is asked for anew', anew_after('') {}, 1)
  ENV.delete('FIXPID_FRESH')
  Gate.expect('and is remembered then', measured, 0)
  verdicts(folder)
  ENV['XDG_CACHE_HOME'] = "#{folder}/cache"
  Gate.expect('what is older than a month is removed', swept, true)
end
Gate.finish

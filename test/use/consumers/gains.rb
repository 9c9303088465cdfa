# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What FIXPID_PID_GAINS folds 1000 random gains of up to four digits to, with each
# compiler, against the exact quotients rounded half up. Where a double has 64 bits none is
# another one; where it has 32, include/fixpid_pid.h says how many are, and by how much.
#
#   ruby test/use/consumers/gains.rb FOLDER
#
# FOLDER is for what it builds. It prints what it found, and the sentences that differ.
COUNT = 1000
HEADER = 'include/fixpid_pid.h'
INCLUDE = %w[-std=c99 -Iinclude].freeze
XC8 = %w[--target=avr -ffreestanding -funsigned-char -include test/support/as_xc8.h -D_PIC18].freeze

# Little-endian members, and SDCC's for an STM8, where they are bytes of text.
COMPILERS = {
  'gcc' => [%w[gcc], 'objcopy', 'vx2Vvx2'],
  'clang' => [%w[clang], 'objcopy', 'vx2Vvx2'],
  'avr-gcc' => [%w[avr-gcc], 'avr-objcopy', 'vVvx'],
  'clang as XC8' => [['clang', *XC8], 'avr-objcopy', 'vVvx']
}.freeze
WIDE = %w[gcc clang].freeze

Gains = Struct.new(:kp, :ki, :kd, :rate, :filter) do
  def self.draw(random)
    decimal = ->(low, high) { format('%.*e', random.rand(4), 10**random.rand(low..high)) }
    new(decimal[-2.0, 2.0], decimal[-3.0, 2.0], decimal[-2.0, 1.0], decimal[-1.0, 3.0], random.rand(8))
  end

  def exact
    rate, kp, ki, kd = [self.rate, self.kp, self.ki, self.kd].map { |text| Rational(text) }
    [kp * 2**8, ki * 2**24 / rate, kd * rate * 2**8 / 2**filter]
  end

  # All macros take them, with some distance.
  def legal?
    kp, ki, kd = exact
    kp.between?(1, 32_766) && ki.between?(9, 0x7FFE0000) && kd.between?(1, 32_254)
  end

  def integers
    exact.map { |value| (value + 1/2r).floor }
  end

  def to_c
    "    FIXPID_PID_GAINS(#{to_a.join(', ')}),\n"
  end
end

# As the controller keeps it.
def kept(gain)
  places = [gain.bit_length - 15, 0].max
  places.zero? ? gain : ((gain + (1 << (places - 1))) >> places) << places
end

def run(*command)
  system(*command) or abort "failed: #{command.join(' ')}"
end

folder = ARGV.fetch(0)
random = Random.new(1)
gains = Enumerator.produce { Gains.draw(random) }.lazy.select(&:legal?).first(COUNT)
File.write("#{folder}/gains.c", "#include \"fixpid_pid.h\"\nconst struct fixpid_pid_gains table[] = {\n#{gains.map(&:to_c).join}};\n")
exact = gains.map(&:integers)

header = File.read(HEADER).gsub(%r{\n// }, ' ')
wrong = COMPILERS.reject do |name, (compiler, objcopy, members)|
  run(*compiler, *INCLUDE, '-c', "#{folder}/gains.c", '-o', "#{folder}/gains.o")
  run(objcopy, '-O', 'binary', '-j', '.rodata', "#{folder}/gains.o", "#{folder}/gains.bin")
  folded = File.binread("#{folder}/gains.bin").unpack(members * COUNT).each_slice(3).to_a
  kp, ki, kd = [0, 1, 2].map { |at| exact.zip(folded).map { |a, b| [a[at], b[at]] }.reject { |a, b| a == b } }
  controller = ki.count { |a, b| kept(a) != kept(b) }
  puts "#{name}: kp_q8 #{kp.size}, ki_q24 #{ki.size}, kd_q8 #{kd.size}, ki of the controller #{controller}"
  next [kp, ki, kd].all?(&:empty?) if WIDE.include?(name)

  ki.all? { |a, b| (a - b).abs <= 1 + a / 2**22 } && header.include?("of #{COUNT} random gains ki_q24 was another one in #{ki.size}, kp_q8 in #{kp.size} and kd_q8 in #{kd.size}; " \
                  "of the bits of ki that a controller keeps, #{controller}")
end
abort "#{wrong.keys.join(', ')}: not as #{HEADER} says" unless wrong.empty?

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What FIXPID_PID_GAINS folds 1000 random gains of up to four digits to, and
# FIXPID_SLEW_RATE 1000 rates, with each compiler, against the exact quotients rounded half
# up. Where a double has 64 bits none differs; where it has 32, their headers tell how
# many are, and by how much.
#
#   ruby test/use/consumers/gains.rb FOLDER
#
# FOLDER is for what it builds. It prints what it found, and the sentences that differ.
COUNT = 1000
HEADER = 'include/fixpid_pid.h'
SLEW_HEADER = 'include/fixpid_slew.h'
INCLUDE = %w[-std=c99 -Iinclude].freeze
XC8 = %w[--target=avr -ffreestanding -funsigned-char -include test/support/as_xc8.h -D_PIC18].freeze

# How many units a number that was folded in 32 bits may be away: two constants, their
# quotient and the half that is added are rounded, each to 24 bits.
def near?(exact, folded)
  (exact - folded).abs <= 1 + exact / 2**22
end

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

Rate = Struct.new(:counts, :steps) do
  def self.draw(random)
    new(*[-2.0..4.8, -1.0..3.0].map { |range| format('%.*e', random.rand(4), 10**random.rand(range)) })
  end

  def exact
    Rational(counts) * 2**16 / Rational(steps)
  end

  # The macro takes them, with some distance.
  def legal?
    exact.between?(1, 0xFFFE0000)
  end

  def integer
    (exact + 1/2r).floor
  end

  def to_c
    "    FIXPID_SLEW_RATE(#{to_a.join(', ')}),\n"
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

def drawn(kind, seed)
  random = Random.new(seed)
  Enumerator.produce { kind.draw(random) }.lazy.select(&:legal?).first(COUNT)
end

def write(folder, name, header, type, rows)
  File.write("#{folder}/#{name}.c", "#include \"#{header}\"\nconst #{type} table[] = {\n#{rows.map(&:to_c).join}};\n")
end

# The bytes of the table.
def compiled(folder, name, compiler, objcopy)
  run(*compiler, *INCLUDE, '-c', "#{folder}/#{name}.c", '-o', "#{folder}/#{name}.o")
  run(objcopy, '-O', 'binary', '-j', '.rodata', "#{folder}/#{name}.o", "#{folder}/#{name}.bin")
  File.binread("#{folder}/#{name}.bin")
end

def said(header)
  File.read(header).gsub(%r{\n// }, ' ')
end

folder = ARGV.fetch(0)
gains = drawn(Gains, 1)
write(folder, 'gains', 'fixpid_pid.h', 'struct fixpid_pid_gains', gains)
exact = gains.map(&:integers)
rates = drawn(Rate, 2)
write(folder, 'rates', 'fixpid_slew.h', 'uint32_t', rates)

wrong_rates = COMPILERS.reject do |name, (compiler, objcopy)|
  folded = compiled(folder, 'rates', compiler, objcopy).unpack('V*')
  others = rates.map(&:integer).zip(folded).reject { |a, b| a == b }
  puts "#{name}: rates #{others.size}"
  next others.empty? if WIDE.include?(name)

  others.all? { |a, b| near?(a, b) } && said(SLEW_HEADER).include?("of #{COUNT} random rates #{others.size} differed")
end
abort "#{wrong_rates.keys.join(', ')}: not as #{SLEW_HEADER} says" unless wrong_rates.empty?

header = said(HEADER)
wrong = COMPILERS.reject do |name, (compiler, objcopy, members)|
  folded = compiled(folder, 'gains', compiler, objcopy).unpack(members * COUNT).each_slice(3).to_a
  kp, ki, kd = [0, 1, 2].map { |at| exact.zip(folded).map { |a, b| [a[at], b[at]] }.reject { |a, b| a == b } }
  controller = ki.count { |a, b| kept(a) != kept(b) }
  puts "#{name}: kp_q8 #{kp.size}, ki_q24 #{ki.size}, kd_q8 #{kd.size}, ki of the controller #{controller}"
  next [kp, ki, kd].all?(&:empty?) if WIDE.include?(name)

  ki.all? { |a, b| near?(a, b) } && [kp, kd].all?(&:empty?) &&
    header.include?("Of #{COUNT} random gains, ki_q24 differed in #{ki.size}, by at most 1 + ki_q24 / 2^22, and the ki that the controller keeps in #{controller}; " \
                    'kp_q8 and kd_q8 never differed')
end
abort "#{wrong.keys.join(', ')}: not as #{HEADER} says" unless wrong.empty?

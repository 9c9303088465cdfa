# SPDX-License-Identifier: MIT
# Whether the comment behind each feature's bit in fixpid_pid.h names what `init` or the
# linker refuses without it: a field or a function of the same name.
module FeatureComments
  HEADER = 'include/fixpid_pid.h'.freeze
  BIT = %r{^#define FIXPID_PID_HAS_(\w+) 0x\h+u +// (.*)$}.freeze
  KI = 'COARSE_KI'.freeze # a range, which prose_numbers.txt computes

  def self.failures
    text = File.read(HEADER)
    bits = text.scan(BIT)
    declared = text.scan(/^#define FIXPID_PID_HAS_(\w+)/).flatten
    (declared - bits.map(&:first)).map { |name| "#{HEADER}: no comment says what HAS_#{name} is" } +
      bits.reject { |name, comment| name == KI || comment.include?(name.downcase) }
          .map { |name, comment| "#{HEADER}: HAS_#{name} is not \"#{comment}\", which names nothing with #{name.downcase}" }
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Builds the page's C natively: optimised by two compilers, and not at all.
require_relative '../../../tools/lib/pages/tuner/sources'

[%w[gcc -O2], %w[clang -O0], %w[clang -O2]].each do |compiler, level|
  exit 1 unless system(*Sources.native(compiler, level, "#{ARGV.fetch(0)}/native_#{compiler}#{level}"))
end

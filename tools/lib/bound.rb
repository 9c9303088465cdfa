# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What linked code takes at most, of any program: its instructions are read by
# Pic14Code, Pic14EnhancedCode, Pic18Code, AvrCode and the others of code/, and
#
#   LongestPath.new(code).function(code.entry(NAME)).cost   bounds a function's cycles
#   Stack.new(code).firmware                                the stack of all, interrupts too
#
# Each fails with a reason where it cannot tell. This is the only file to require.
require_relative 'code/elf_code'
require_relative 'code/pic_code'
require_relative 'bound/longest_path'
require_relative 'bound/stack'

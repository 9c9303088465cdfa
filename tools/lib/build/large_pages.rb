# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require 'rbconfig'

# Ruby forbids large pages to itself, for the sake of its own forks, and with that to all that
# it starts. What we start are compilers, simulators and solvers, which have them again where
# this is loaded: without them, page faults are most of what gpasm takes on a virtual machine.
module LargePages
  SET_THP_DISABLE = 41 # of prctl
  PRCTL = { 'x86_64' => 157, 'aarch64' => 167 }.freeze # the number of the system call

  def self.allow
    number = PRCTL[RbConfig::CONFIG['host_cpu']]
    syscall(number, SET_THP_DISABLE, 0, 0, 0, 0) if number && RbConfig::CONFIG['host_os'].start_with?('linux')
  rescue SystemCallError, NotImplementedError
    nil # slower, and that is all
  end
end

LargePages.allow

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

module Bound
  # What cannot be told of linked code, and why.
  class Failure < StandardError; end
end

# An instruction as the longest path needs it: where it may go next and what
# that costs, the function that it calls before, and the cost if it returns. An
# `opaque` one leads where only a run can tell, and one that `waits` costs what only a
# run can tell.
Instruction = Struct.new(:edges, :call, :return_cost, :bytes, :opaque, :waits)

# Linked code: instructions by address and functions by name.
class Code
  class Failure < Bound::Failure; end

  # Turns of a counter that begins with 0.
  WRAP = 256

  # Of a return stack that is not in RAM.
  LEVELS = Float::INFINITY

  attr_reader :functions

  def initialize(functions)
    @functions = functions
    @decoded = {}
  end

  def at(address)
    @decoded[address] ||= decode(address)
  end

  # A function of the library may have a suffix to its name: FIXPID_SUFFIXED in
  # include/fixpid.h. Of several, such as step and step_percent, the shortest is it.
  def entry(function)
    @functions[function] || @functions.select { |name, _| name.start_with?("#{function}_") }.min_by { |name, _| name.size }&.last or
      raise Failure, "no function #{function}"
  end

  # The function that an address belongs to.
  def name(address)
    found = @functions.select { |_, start| start <= address }.max_by { |_, start| start }
    found ? found[0] : format('%05x', address)
  end

  # The longest path through a function: its cost, levels and addresses. `turns` says how often
  # loops turn that count no constant down, as LongestPath has it.
  def longest(function, turns = {})
    LongestPath.new(self, self.turns.merge(turns)).function(entry(function))
  end

  # A function's stack with its return address, and that of the whole firmware with interrupts.
  def stack(function)
    Stack.new(self).then { |stack| stack.called(stack.function(entry(function))) }
  end

  def stack_of_all
    Stack.new(self).firmware
  end

  # What these functions take with all that they call, in the chip's units of flash.
  def flash_of(*functions)
    size_of(LongestPath.reached(self, functions.map { |function| entry(function) }))
  end

  # How many return addresses fit, and a depth in words.
  def levels
    self.class::LEVELS
  end

  def shown(depth)
    "#{depth.bytes} bytes"
  end

  # Of the first page alone code of several is followed.
  def several_pages?
    false
  end

  # For loops that count down: the register that an instruction decrements, if
  # that is one that counts; whether an instruction may write a register, or make
  # its name stand for another; what it loads into the register that it writes,
  # a constant, another register or nil; and where it goes on if the register
  # is 0 that was decremented there, or nil if it does not test that.
  def decremented(_address)
    nil
  end

  # For the stack: how many bytes an instruction pushes, or the register that says
  # how many it pops; the registers from which it sets the pointer, or nil if it does
  # not; how many bytes are between the frame pointer and the function's return
  # address behind it, nil if nobody knows; where an opaque one leads, nowhere if it
  # returns and nil if nobody knows; whether it lets interrupts in; and where a reset
  # leads, and, by priority, interrupts.
  def pushed(_address)
    0
  end

  def sets_stack(_address)
    nil
  end

  def frame(_address, _height, _frame)
    nil
  end

  def leads(_address)
    nil
  end

  def enables_interrupts?(_address)
    false
  end

  def reset
    0
  end

  def interrupts
    []
  end

  # Of the compiler's own routines whose returns are not alike: the bytes that
  # they leave on the stack where they do what they are for.
  def left
    {}
  end

  # Of a return address in RAM.
  def return_bytes
    0
  end

  # Of the compiler's own routines: how often their loops turn at most.
  def turns
    {}
  end

  private

  def plain(at, bytes, cost)
    Instruction.new([[at + bytes, cost]], nil, nil, bytes)
  end

  def opaque(what)
    Instruction.new([], nil, nil, 2, what)
  end

  def waits(at, bytes, what)
    Instruction.new([[at + bytes, 1]], nil, nil, bytes, nil, what)
  end

  def missing(address, what)
    raise Failure, format('%<name>s: %<what>s at %<address>05x', name: name(address), what: what, address: address)
  end
end

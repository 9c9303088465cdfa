# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'flow'
require_relative 'longest_path'

# How deep a function's stack may be, from all paths through its code: return
# addresses, and bytes, of an AVR those of the return addresses among them. What
# an instruction finds there must be the same on all paths to it. A jump into another
# function, a tail call, is followed as any other.
class Stack
  # Besides its own return address; `left` bytes are there when it has returned,
  # fewer than none if it takes its arguments.
  Depth = Struct.new(:levels, :bytes, :left)

  class Failure < Bound::Failure; end

  def initialize(code)
    @code = code
    @functions = {}
  end

  def function(entry)
    raise Failure, "#{@code.name(entry)} calls itself" if @functions[entry] == :open

    @functions[entry] = :open unless @functions.key?(entry)
    @functions[entry] = analyse(entry) if @functions[entry] == :open
    @functions[entry]
  end

  # From the reset on, with the deepest interrupt of each priority at the deepest
  # place.
  def firmware
    interrupts = @code.interrupts.map { |handlers| deepest(handlers.map { |at| called(handler(at)) }) }
    all = [function(@code.reset), *interrupts]
    Depth.new(all.sum(&:levels), all.sum(&:bytes), 0)
  end

  # With its return address.
  def called(depth)
    Depth.new(depth.levels + 1, depth.bytes + @code.return_bytes)
  end

  private

  def deepest(depths)
    Depth.new(depths.map(&:levels).max, depths.map(&:bytes).max)
  end

  def handler(entry)
    inner = LongestPath.reached(@code, [entry]).find { |at| @code.enables_interrupts?(at) }
    refuse('an interrupt lets others in', inner) if inner
    function(entry).tap { |depth| refuse('an interrupt leaves the stack as it was not', entry) unless depth.left.zero? }
  end

  def analyse(entry)
    calls = {}
    flow = explore(entry, calls)
    places = { entry => [0, nil] } # the height before each instruction, and the frame pointer's
    depths = [Depth.new(0, 0)]
    ends = {}
    todo = [entry]
    while (at = todo.pop)
      height, frame = places[at]
      after = height + moved(flow, at, height, frame)
      depths << Depth.new(0, after)
      depths << above(height, called(calls[at])) if calls.key?(at)
      after += calls[at].left if calls.key?(at)
      ends[at] = after if ends?(at)
      framed = @code.frame(at, height, frame)
      after = height if ends.key?(at) # a return whose condition is not met has popped nothing
      flow.edges[at].each { |to, _| todo << to if reach(places, to, after, framed) }
    end
    found = deepest(depths)
    Depth.new(found.levels, found.bytes, left(entry, ends))
  end

  def above(height, depth)
    Depth.new(depth.levels, height + depth.bytes)
  end

  def ends?(at)
    instruction = @code.at(at)
    instruction.return_cost || (instruction.opaque && @code.leads(at)&.empty?)
  end

  # What all returns leave; one that never returns leaves nothing.
  def left(entry, ends)
    at, height = ends.first
    stated = @code.left[@code.name(entry)]
    return stated if ends.value?(stated)

    refuse('not all returns leave the same on the stack', at) if ends.values.uniq.size > 1
    height || 0
  end

  # Whether an instruction is reached for the first time, or by a way on which the
  # frame pointer is another one.
  def reach(places, at, height, frame)
    before, framed = places.fetch(at, [height, frame])
    refuse('the stack is not the same on all paths', at) if before != height
    return if places.key?(at) && (framed.nil? || framed == frame)

    places[at] = [height, places.key?(at) ? nil : frame]
  end

  def explore(entry, calls)
    edges = {}
    inside = {}
    todo = [entry]
    while (at = todo.pop)
      next if edges.key?(at)

      instruction = @code.at(at)
      edges[at] = instruction.opaque ? led(at, instruction) : instruction.edges
      if instruction.call
        calls[at] = function(instruction.call)
        inside[at] = LongestPath.reached(@code, [instruction.call])
      end
      todo.concat(edges[at].map(&:first))
    end
    Flow.new(@code, edges, entry, inside)
  end

  def led(at, instruction)
    found = @code.leads(at) or refuse("no path through #{instruction.opaque}", at)
    found.map { |to| [to, 0] }
  end

  # How many bytes an instruction pushes. The pointer may be set from the frame
  # pointer, else only where nothing is on the stack.
  def moved(flow, at, height, frame)
    set = @code.sets_stack(at)
    return frame - height if set && frame && @code.frame?(set)

    refuse('the stack pointer is set', at) if set && !height.zero?
    set&.each { |register| constant(flow, at, register) }
    bytes = @code.pushed(at)
    bytes.is_a?(Integer) ? bytes : -constant(flow, at, bytes)
  end

  def constant(flow, at, register)
    found = flow.constants(flow.before(at), at, register).uniq
    found.size == 1 ? found.first : raise(Flow::Unknown, 'it is not the same on all paths')
  rescue Flow::Unknown => e
    refuse("the stack pointer changes by what is not known: #{e.message},", at)
  end

  def refuse(what, at)
    raise Failure, format('%<name>s: %<what>s at %<at>05x', name: @code.name(at), what: what, at: at)
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# A function: its edges by address, its first instruction, and by the address of
# a call all that this call may execute.
Flow = Struct.new(:edges, :entry, :called) do
  def before(at)
    @before ||= edges.each_with_object(Hash.new { |all, to| all[to] = [] }) do |(from, list), all|
      list.each { |to, _| all[to] << from }
    end
    @before[at].uniq
  end
end

# A loop that counts a constant down. Each turn passes one decrement; from there
# each way back to the head passes a test, and at 0 that test leaves the loop;
# nothing else in the loop, and nothing that it calls, may write the counter; and
# all ways to the loop have loaded it with a constant. Where one of these cannot be
# shown, the loop is refused.
class CountedLoop
  class Refused < StandardError; end

  def initialize(code, flow, component, head)
    @code = code
    @flow = flow
    @component = component
    @head = head
  end

  # How often the head is executed at most for each entry.
  def turns
    refusals = []
    @component.each do |at|
      counter = @code.decremented(at)
      return counted(at, counter) if counter
    rescue Refused => e
      refusals << e.message
    end
    raise Refused, refusals.join(', ')
  end

  private

  def counted(decrement, counter)
    refuse('not every turn passes %05x', decrement) if around?(@head, [decrement])
    refuse('it may go on with 0 after %05x', decrement) if around?(decrement, exits(decrement, counter))
    writer = @component.find { |at| at != decrement && written?(at, counter) }
    refuse('its counter may also change at %05x', writer) if writer
    most = constants(@flow.before(@head) - @component, @head, counter).max
    most.zero? ? @code.class::WRAP : most
  end

  # The tests of the counter that leave the loop at 0.
  def exits(decrement, counter)
    @component.select do |at|
      to = @code.at_zero(at, decrement, counter)
      to && !@component.include?(to)
    end
  end

  # Whether there is a way through the loop from here to its head around these.
  def around?(from, these)
    seen = []
    todo = [from]
    until todo.empty?
      at = todo.pop
      next if these.include?(at) || seen.include?(at)

      seen << at
      following = @flow.edges[at].map(&:first) & @component
      return true if following.include?(@head)

      todo.concat(following)
    end
    false
  end

  def written?(at, register)
    @code.writes?(at, register) || called_writes?(at, register)
  end

  def called_writes?(at, register)
    @flow.called.fetch(at, []).any? { |inner| @code.writes?(inner, register) }
  end

  # What the register may hold after these instructions, which come before `at`.
  def constants(these, at, register)
    todo = before(these, at)
    seen = {}
    found = []
    while (at = todo.pop)
      next if seen.key?(at)

      seen[at] = true
      refuse('its counter may change in what %05x calls', at) if called_writes?(at, register)
      if @code.writes?(at, register)
        found.concat(loaded(at, register))
      else
        todo.concat(before(@flow.before(at), at))
      end
    end
    found
  end

  # A constant, or what another register holds then.
  def loaded(at, register)
    value = @code.loaded(at, register) or refuse('no constant is loaded at %05x', at)
    value.is_a?(Integer) ? [value] : constants(@flow.before(at), at, value)
  end

  # The first instruction comes after whatever the caller has left.
  def before(these, at)
    refuse('its counter comes from before %05x', at) if at == @flow.entry || these.empty?
    these.dup
  end

  def refuse(why, at)
    raise Refused, format(why, at)
  end
end

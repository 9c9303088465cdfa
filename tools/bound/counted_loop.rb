# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'flow'

# A loop that counts a constant down. Each turn passes one decrement; from there
# each way back to the head passes a test, and at 0 that test leaves the loop;
# nothing else in the loop, and nothing that it calls, may write the counter; and
# all ways to the loop have loaded it with a constant. Where one of these cannot be
# shown, the loop is refused.
class CountedLoop
  def initialize(code, flow, component, head)
    @code = code
    @flow = flow
    @component = component
    @head = head
  end

  # How often the head is executed at most for each entry; raises Flow::Unknown.
  def turns
    refusals = []
    @component.each do |at|
      counter = @code.decremented(at)
      return counted(at, counter) if counter
    rescue Flow::Unknown => e
      refusals << e.message
    end
    raise Flow::Unknown, refusals.join(', ')
  end

  private

  def counted(decrement, counter)
    refuse('not every turn passes %05x', decrement) if around?(@head, [decrement])
    refuse('it may go on with 0 after %05x', decrement) if around?(decrement, exits(decrement, counter))
    writer = @component.find { |at| at != decrement && @flow.writes?(at, counter) }
    refuse('its counter may also change at %05x', writer) if writer
    found = @flow.constants(@flow.before(@head) - @component, @head, counter)
    found.map { |count| count.zero? ? @code.class::WRAP : count }.max
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

  def refuse(why, at)
    raise Flow::Unknown, format(why, at)
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# One function of linked code: its edges by address, its first instruction, and by
# the address of a call all that this call may execute.
class Flow
  # What cannot be shown, and why.
  class Unknown < StandardError; end

  attr_reader :edges, :entry

  def initialize(code, edges, entry, called)
    @code = code
    @edges = edges
    @entry = entry
    @called = called
  end

  def before(at)
    @before ||= edges.each_with_object({}) { |(from, list), all| list.each { |to, _| (all[to] ||= []) << from } }
    @before.fetch(at, []).uniq
  end

  # Whether an instruction, or what it calls, may write a register.
  def writes?(at, register)
    @code.writes?(at, register) || called_writes?(at, register)
  end

  # What a register may hold behind these instructions, which come before `at`:
  # constants, on all ways.
  def constants(these, at, register)
    todo = all_before(these, at)
    seen = {}
    found = []
    while (at = todo.pop)
      next if seen.key?(at)

      seen[at] = true
      unknown('it may change in what %05x calls', at) if called_writes?(at, register)
      if @code.writes?(at, register)
        found.concat(loaded(at, register))
      else
        todo.concat(all_before(before(at), at))
      end
    end
    found
  end

  private

  def called_writes?(at, register)
    @called.fetch(at, []).any? { |inner| @code.writes?(inner, register) }
  end

  # A constant, or what another register holds then.
  def loaded(at, register)
    value = @code.loaded(at, register) or unknown('no constant is loaded at %05x', at)
    value.is_a?(Integer) ? [value] : constants(before(at), at, value)
  end

  # The first instruction comes after whatever the caller has left.
  def all_before(these, at)
    unknown('it comes from before %05x', at) if at == entry || these.empty?
    these.dup
  end

  def unknown(why, at)
    raise Unknown, format(why, at)
  end
end

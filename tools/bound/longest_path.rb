# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'code'
require_relative 'counted_loop'

# The longest path through a function: an upper bound of its cost, with paths
# that no input takes among them; without interrupts, which are assumed to leave
# all registers as they found them. `code` has the instructions. A loop has one
# entrance and counts a constant down to 0; of others `turns`, by function, says
# how often the first instruction is executed at most for each entry.
class LongestPath
  # What a function costs at most with its return, how many return addresses it
  # and its callees need besides its own, and all addresses that it reaches.
  Function = Struct.new(:cost, :levels, :addresses)

  class Failure < Bound::Failure; end

  def initialize(code, turns = {})
    @code = code
    @turns = turns
    @functions = {}
  end

  def function(entry)
    raise Failure, "#{@code.name(entry)} calls itself" if @functions[entry] == :open

    @functions[entry] ||= begin
      @functions[entry] = :open
      analyse(entry)
    end
  end

  # All addresses that these functions reach.
  def self.reached(code, entries)
    seen = {}
    todo = entries.dup
    until todo.empty?
      at = todo.pop
      next if seen.key?(at)

      instruction = code.at(at)
      seen[at] = true
      todo.concat([instruction.call].compact, instruction.edges.map(&:first))
    end
    seen.keys
  end

  private

  # Costs of the edges with those of the functions called in between.
  def analyse(entry)
    flow, ends, callees = explore(entry)
    arrival = arrivals(flow, flow.edges.keys, entry, nil)
    cost = ends.map { |at, own| arrival.fetch(at) + own }.max or raise Failure, "#{@code.name(entry)} never returns"
    addresses = flow.edges.keys | callees.flat_map(&:addresses)
    Function.new(cost, callees.map { |callee| callee.levels + 1 }.max || 0, addresses)
  end

  def explore(entry)
    edges = {}
    ends = {}
    called = {}
    callees = []
    todo = [entry]
    while (at = todo.pop)
      next if edges.key?(at)

      instruction = followed(at)
      callee = instruction.call && function(instruction.call)
      if callee
        callees << callee
        called[at] = callee.addresses
      end
      ends[at] = instruction.return_cost if instruction.return_cost
      edges[at] = instruction.edges.map { |to, cost| [to, cost + (callee ? callee.cost : 0)] }
      todo.concat(edges[at].map(&:first))
    end
    [Flow.new(@code, edges, entry, called), ends, callees]
  end

  def followed(at)
    instruction = @code.at(at)
    what = instruction.opaque || instruction.waits or return instruction
    raise Failure, format('%<name>s: no path through %<what>s at %<at>05x', name: @code.name(at), what: what, at: at)
  end

  # The largest cost to come from `start` to each of `nodes`; edges into `cut`
  # are left out.
  def arrivals(flow, nodes, start, cut)
    inside = nodes.to_h { |at| [at, flow.edges[at].select { |to, _| to != cut }] }
    inside.transform_values! { |list| list.select { |to, _| inside.key?(to) } }
    best = { start => 0 }
    components(inside, start).each do |component|
      pass(flow, inside, component, best, start)
      leave(inside, component, best)
    end
    best
  end

  # From the entrance of a component to all of its instructions.
  def pass(flow, inside, component, best, start)
    return unless loop?(inside, component)

    head = entrance(inside, component, start)
    within = arrivals(flow, component, head, head)
    body = component.flat_map { |at| flow.edges[at].select { |to, _| to == head }.map { |_, cost| within[at] + cost } }.max
    before = best.fetch(head) + (turns(flow, component, head) - 1) * body
    component.each { |at| best[at] = before + within[at] }
  end

  # From the code, or as stated.
  def turns(flow, component, head)
    CountedLoop.new(@code, flow, component, head).turns
  rescue Flow::Unknown => e
    stated = @turns[@code.name(head)] || @turns.find { |name, _| @code.name(head).start_with?("#{name}_") }&.last
    stated = stated[around_a_loop?(flow, component, head) ? 0 : 1] if stated.is_a?(Array)
    stated or
      raise Failure, format('a loop of %<name>s, at %<at>05x, does not count down from a constant%<why>s',
                            name: @code.name(head), at: head, why: e.message.empty? ? '' : ": #{e.message}")
  end

  def around_a_loop?(flow, component, head)
    inside = component.to_h { |at| [at, flow.edges[at].select { |to, _| to != head && component.include?(to) }] }
    components(inside, head).any? { |one| loop?(inside, one) }
  end

  def leave(inside, component, best)
    component.each do |at|
      inside[at].each do |to, cost|
        next if component.include?(to)

        best[to] = [best[to] || 0, best.fetch(at) + cost].max
      end
    end
  end

  def loop?(inside, component)
    component.size > 1 || inside[component.first].any? { |to, _| to == component.first }
  end

  def entrance(inside, component, start)
    heads = inside.flat_map { |at, list| component.include?(at) ? [] : list.map(&:first) & component }
    heads << start if component.include?(start)
    heads.uniq!
    raise Failure, "a loop in #{@code.name(heads.first)} has #{heads.size} entrances" if heads.size != 1

    heads.first
  end

  # Tarjan's strongly connected components, in the order of the flow.
  def components(inside, start)
    search = Tarjan.new(inside)
    search.visit(start)
    search.found.reverse
  end

  # The search for them, without recursion: code is long.
  class Tarjan
    attr_reader :found

    def initialize(graph)
      @graph = graph
      @index = {}
      @low = {}
      @stack = []
      @on_stack = {}
      @found = []
    end

    def visit(start)
      work = [open(start)]
      until work.empty?
        at, rest = work.last
        to, = rest.shift
        if to.nil?
          work.pop
          close(at)
          lower(work.last[0], @low[at]) unless work.empty?
        elsif !@index.key?(to)
          work << open(to)
        elsif @on_stack[to]
          lower(at, @index[to])
        end
      end
    end

    private

    def open(at)
      @index[at] = @low[at] = @index.size
      @stack << at
      @on_stack[at] = true
      [at, @graph[at].dup]
    end

    def lower(at, value)
      @low[at] = [@low[at], value].min
    end

    def close(at)
      return unless @low[at] == @index[at]

      component = []
      loop do
        component << @stack.pop
        @on_stack[component.last] = false
        break if component.last == at
      end
      @found << component
    end
  end
end

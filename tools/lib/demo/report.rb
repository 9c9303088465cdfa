# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What was checked: a line for each loop, a table of what failed or of all, and
# a file for programs.
module Report
  Check = Struct.new(:loop, :what, :relation, :limit, :measured, :unit) do
    # What is missing, and what is no number, is never within a limit.
    def ok?
      number = measured.is_a?(Numeric) && limit.is_a?(Numeric) && measured.finite?
      return measured.public_send(relation, limit) if number

      relation == :== && !measured.nil? && !measured.is_a?(Numeric) && measured == limit
    end

    # A line of the table.
    def row
      [loop, what, "#{relation} #{shown(limit)}", shown(measured),
       ok? ? 'ok' : 'FAILED']
    end

    # JSON has no number that is none.
    def to_json(*options)
      hash = to_h.transform_keys(&:to_s).merge('ok' => ok?)
      hash['measured'] = measured.to_s if measured.is_a?(Float) && !measured.finite?
      hash.to_json(*options)
    end

    private

    def shown(value)
      text = value.is_a?(Float) ? format('%.3g', value) : value.to_s
      "#{text} #{unit}".strip
    end
  end

  @checks = []
  @numbers = {}
  @notes = []

  class << self
    attr_reader :checks, :numbers, :loop

    def start(name)
      @loop = name
      @numbers[name] = {}
    end

    def at_most(what, measured, limit, unit = '')
      @checks << Check.new(@loop, what, :<=, limit, measured, unit)
    end

    def at_least(what, measured, limit, unit = '')
      @checks << Check.new(@loop, what, :>=, limit, measured, unit)
    end

    def exactly(what, measured, value, unit = '')
      @checks << Check.new(@loop, what, :==, value, measured, unit)
    end

    # A value that nobody requires, but that is as it was; an integer or a text.
    def unchanged(what, value)
      before = Regression.of(@loop, what, value)
      @checks << Check.new(@loop, "#{what}, as it was", :==, @renew ? value.to_s : before, value.to_s, '')
    end

    # What changed is no failure while it is taken anew.
    def renew!
      @renew = true
    end

    # All has been measured that was, if all ran, and something was checked at all.
    def finish(name)
      Regression.missing(name).each { |what| exactly("#{what}, as it was", 'gone', 'measured') } unless @renew || Extent.part?(name)
      failure("#{name} checked nothing") if @checks.none? { |c| c.loop.split.first == name }
    end

    # A number for the documents that is not a check by itself.
    def number(name, value)
      @numbers[@loop][name] = value
    end

    def good?
      @checks.all?(&:ok?)
    end

    # The loop could not be run to its end.
    def failure(why)
      warn "demo: #{why}"
      @checks << Check.new(@loop, 'runs to its end', :==, 'yes', 'no', '')
    end

    # Lines for a reader who wants to know more.
    def note(*lines)
      @notes.concat(lines)
    end

    # How the checks of a loop went, those of its parts too: `chip motor`.
    def outcome(name)
      checks = @checks.select { |c| c.loop.split.first == name }
      failed = checks.count { |c| !c.ok? }
      failed.zero? ? "#{checks.size} checks held" : "#{failed} of #{checks.size} checks FAILED"
    end

    def print(verbose)
      rows = @checks.select { |c| verbose || !c.ok? }.map(&:row)
      return if rows.empty?

      puts ''
      table([%w[loop checked limit measured] + ['']] + rows)
      puts '', @notes if verbose && @notes.any?
    end

    def summary
      failed = @checks.count { |c| !c.ok? }
      "#{@checks.size - failed} checks held, #{failed} failed"
    end

    def write(path)
      data = { 'checks' => @checks, 'numbers' => @numbers }
      replace(path, "#{JSON.pretty_generate(data)}\n")
    end

    # Whole or not at all.
    def replace(path, text)
      File.write("#{path}.new", text)
      File.rename("#{path}.new", path)
    end

    private

    def table(rows)
      widths = rows.transpose.map { |column| column.map(&:size).max }
      rows.each do |row|
        puts row.zip(widths).map { |text, w| text.ljust(w) }.join('  ').rstrip
      end
    end
  end
end

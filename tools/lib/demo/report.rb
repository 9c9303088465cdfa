# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What was checked: one table for people, one file for programs.
module Report
  Check = Struct.new(:loop, :what, :relation, :limit, :measured, :unit) do
    def ok?
      measured.public_send(relation, limit)
    end

    def shown(value)
      text = value.is_a?(Integer) ? value.to_s : format('%.3g', value)
      "#{text} #{unit}".strip
    end
  end

  @checks = []
  @numbers = {}

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

    # A number for the documents that is not a check by itself.
    def number(name, value)
      @numbers[@loop][name] = value
    end

    def good?
      @checks.all?(&:ok?)
    end

    def print
      puts
      table([%w[loop checked limit measured] + ['']] + @checks.map do |c|
        [c.loop, c.what, "#{c.relation} #{c.shown(c.limit)}",
         c.shown(c.measured), c.ok? ? 'ok' : 'FAILED']
      end)
      failed = @checks.count { |c| !c.ok? }
      puts
      puts "#{@checks.size - failed} held, #{failed} failed; " \
           'pictures: build/demo/*.png and *.svg'
    end

    def write(path)
      data = { 'checks' => @checks.map { |c| row(c) }, 'numbers' => @numbers }
      replace(path, "#{JSON.pretty_generate(data)}\n")
    end

    # Whole or not at all.
    def replace(path, text)
      File.write("#{path}.new", text)
      File.rename("#{path}.new", path)
    end

    private

    def row(check)
      check.to_h.transform_keys(&:to_s).merge('ok' => check.ok?)
    end

    def table(rows)
      widths = rows.transpose.map { |column| column.map(&:size).max }
      rows.each do |row|
        puts row.zip(widths).map { |text, w| text.ljust(w) }.join('  ').rstrip
      end
    end
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../../bound/bound'

# A function of anybody's firmware for a PIC: FILE.hex with the .cod and .map
# that gplink -m writes beside it.
class UserFirmware
  def initialize(file, function, cycles)
    @path = file.sub(/\.(hex|cod|map)\z/, '')
    @function = function
    @cycles = cycles
    %w[hex cod map].each do |kind|
      next if File.readable?("#{@path}.#{kind}")

      raise Host::Failure, "cannot read #{@path}.#{kind}: gplink -m writes FILE.hex, FILE.cod and FILE.map"
    end
  end

  def print
    Harness.build_function
    text, good = Host.run("#{Host.folder}/function", "#{@path}.cod", @function, @cycles.to_s, *vectors)
    raise Host::Failure, text.strip unless good

    chip, numbers = text.match(/^(p\w+) (calls .*)/).captures
    calls, least, most, total = numbers.scan(/\d+/).map(&:to_i)
    puts measured(chip, calls, least, most, total)
    puts "static bound: #{of_code(chip) { |code| "#{code.longest(@function).cost} cycles, without interrupts" }}"
    puts "its stack: #{of_code(chip) { |code| "#{code.shown(code.stack(@function))}, with its call" }}"
    puts "stack of all: #{of_code(chip) { |code| "#{code.shown(code.stack_of_all)}, with interrupts" }}"
    calls.positive?
  end

  private

  # SDCC's sections of interrupts begin at their vectors.
  def vectors
    sections = Bound.sections("#{@path}.map").select { |one| one.place == 'program' && one.name.match?(/ivec|interrupt/) }
    sections.map { |one| one.address.to_s(16) }
  end

  def measured(chip, calls, least, most, total)
    return "#{@function} on a #{chip}: not called in #{@cycles} cycles with nothing on the pins" if calls.zero?

    format('%<name>s on a %<chip>s: %<least>d to %<most>d cycles, mean %<mean>.1f, %<calls>d calls',
           name: @function, chip: chip, least: least, most: most, mean: total.fdiv(calls), calls: calls)
  end

  # Of a mid-range PIC with one page of code, enhanced or not, or of a PIC18.
  def of_code(chip)
    code = Bound.code(chip, @path) or return 'none for this core'
    return 'none beyond the first page of 2048 words' if code.several_pages?

    yield(code)
  rescue Bound::Failure => e
    "none: #{e.message}"
  end
end

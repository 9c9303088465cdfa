# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'pic_code'
require_relative 'longest_path'

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
    puts "static bound: #{bound(chip)}"
    calls.positive?
  end

  private

  # SDCC's sections of interrupts begin at their vectors.
  def vectors
    sections = PicCode.sections("#{@path}.map").select { |one| one.place == 'program' && one.name.match?(/ivec|interrupt/) }
    sections.map { |one| one.address.to_s(16) }
  end

  def measured(chip, calls, least, most, total)
    return "#{@function} on a #{chip}: not called in #{@cycles} cycles with nothing on the pins" if calls.zero?

    format('%<name>s on a %<chip>s: %<least>d to %<most>d cycles, mean %<mean>.1f, %<calls>d calls',
           name: @function, chip: chip, least: least, most: most, mean: total.fdiv(calls), calls: calls)
  end

  # Of a mid-range PIC with one page of code, enhanced or not, or of a PIC18.
  def bound(chip)
    core = PicCode.of(chip) or return 'none for this core'
    code = core.new(@path)
    return 'none beyond the first page of 2048 words' if code.is_a?(Pic14Code) && code.pages > 1

    "#{LongestPath.new(code).function(code.entry(@function)).cost} cycles"
  rescue LongestPath::Failure, Code::Failure => e
    "none: #{e.message}"
  end
end

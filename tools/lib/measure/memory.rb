# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require 'json'
require_relative '../build/inputs'

# What was measured of the same sources with the same tools is not measured
# again: build/cost/memory/, a file for each subject.
class Memory
  SOURCES = %w[include/*.h port/**/* sim/**/* src/**/* test/chips/avr/vectors_table.rb test/chips/modules/* test/tools/cost/**/*
               test/support/*.[ch] test/chips/target/**/* test/support/vectors/* tools/cost tools/lib/setup.sh
               tools/lib/bound.rb tools/lib/{bound,build,code,measure}/*].freeze
  # They say what is allowed, and nothing is measured with them.
  JUDGES = %w[tools/lib/measure/limits.csv].freeze
  PROGRAMS = %w[gpasm gplink qemu-system-arm qemu-system-riscv32].freeze

  def initialize
    @folder = "#{Host.folder}/memory"
    FileUtils.mkdir_p(@folder)
    files = SOURCES.flat_map { |pattern| Dir.glob(pattern, base: Host.root) }.sort - JUDGES
    @sources = Inputs.digest(files.map { |file| "#{Host.root}/#{file}" } + tools)
  end

  # The figures of a subject: remembered, or measured by the block.
  def of(subject)
    path = "#{@folder}/#{subject.key}.json"
    found = read(path)
    return load(found['figures']) if found && found['sources'] == @sources

    figures = yield
    File.write("#{path}.new", JSON.generate({ sources: @sources, figures: figures.is_a?(Figures) ? figures.to_h : figures }))
    File.rename("#{path}.new", path)
    figures
  end

  private

  def read(path)
    JSON.parse(File.read(path))
  rescue Errno::ENOENT, JSON::ParserError
    nil
  end

  def load(figures)
    figures.is_a?(Hash) && figures.key?('most') ? Figures.new(**figures.transform_keys(&:to_sym)) : figures
  end

  def tools
    libraries = Dir.glob('/usr/lib/*/lib{gpsim,simavr}.so*').sort
    (Inputs::COMPILERS + PROGRAMS).flat_map { |name| Inputs.tool(name) } + libraries + Inputs.sdcc
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../remembered'

# The figures of a subject, remembered or measured by the block.
class RememberedFigures
  SOURCES = %w[include/*.h port/**/* sim/**/* src/**/* test/chips/avr/vectors_table.rb test/chips/modules/* test/tools/cost/**/*
               test/support/*.[ch] test/chips/target/**/* test/support/vectors/* tools/cost tools/lib/setup.sh
               tools/bound/*.rb tools/lib/build/* tools/lib/measure/*.rb].freeze
  PROGRAMS = %w[gpasm gplink qemu-system-arm qemu-system-riscv32].freeze

  def initialize
    @remembered = Remembered.new('cost', files: SOURCES, tools: tools, what: 'figures of tools/cost', always: true)
  end

  def of(subject)
    load(@remembered.of(subject.key) { yield.then { |figures| figures.is_a?(Figures) ? figures.to_h : figures } })
  end

  private

  # The names are symbols when they are measured, and texts when they are remembered.
  def load(figures)
    return figures unless figures.is_a?(Hash)

    names = figures.transform_keys(&:to_sym)
    names.key?(:most) ? Figures.new(**names) : figures
  end

  def tools
    libraries = Dir.glob('/usr/lib/*/lib{gpsim,simavr}.so*').sort
    (Inputs::COMPILERS + PROGRAMS).flat_map { |name| Inputs.tool(name) } + libraries + Inputs.c_library + Inputs.sdcc
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'host'

# How fixpid_pid does in the loop of README.md: overshoot, and steps until it is back from a limit.
module AntiWindup
  SOURCES = ['sim/loops/anti_windup.c', 'sim/plant/plant_counts.c'].freeze

  class << self
    def figures
      program = "#{Host.folder}/anti_windup"
      ours = Dir.chdir(Host.root) { Dir['src/pid/*.c'].sort }
      Host.output('cc', '-std=c99', '-O2', '-ffp-contract=off', '-Iinclude', '-Isim/plant', *SOURCES, *ours, '-lm', '-o', program)
      head, *rows = Host.output(program, 'figures').lines.map { |line| line.chomp.split(';') }
      rows.map { |row| head.zip(row).to_h }.find { |row| row['controller'] == 'with' }
    end
  end
end

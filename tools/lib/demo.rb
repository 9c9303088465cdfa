# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Runs the loops, checks what must hold, draws, and reports. Called by
# tools/demo: demo.rb MODE ROOT LOOP...
require 'fileutils'
require 'json'

require_relative 'demo/host'
require_relative 'demo/plot'
require_relative 'demo/report'
require_relative 'demo/docs'
require_relative 'demo/pendulum'
require_relative 'demo/motor'
require_relative 'demo/oven'
require_relative 'demo/tuning'
require_relative 'demo/thermostat'
require_relative 'demo/loops'
require_relative 'demo/autotune'
require_relative 'demo/others'
require_relative 'demo/chip'

Encoding.default_external = 'UTF-8'

LOOPS = {
  'pendulum' => -> { pendulum('pendulum', 'AN964, 10 bits', -0.3) },
  'pendulum_8bit' =>
    -> { pendulum('pendulum_8bit', 'AN964, 8 x 8 bits', -0.2) },
  'motor' => -> { motor },
  'oven' => -> { oven },
  'tuning' => -> { tuning },
  'thermostat' => -> { thermostat },
  'autotune' => -> { autotune },
  'others' => -> { others },
  'chip' => -> { chip }
}.freeze

def remove_results(loops)
  loops.each do |name|
    FileUtils.rm_f(Dir.glob("#{Host.folder}/#{name}{,[-.]*}"))
  end
  FileUtils.rm_f("#{Host.folder}/results.json")
end

def run_loops(loops)
  loops.each_with_index do |name, i|
    puts "[#{i + 1}/#{loops.size}] #{name}"
    Report.start(name)
    LOOPS.fetch(name).call
  end
end

def main(mode, root, *loops)
  Host.setup(root)
  remove_results(loops)
  run_loops(loops)
  Report.write("#{Host.folder}/results.json")
  Report.print
  exit(Report.good? && Docs.update(mode, root) ? 0 : 1)
end

begin
  $stdout.sync = true
  main(*ARGV)
rescue Host::Failure, SystemCallError => e
  warn "demo: #{e.message}"
  exit 1
rescue SignalException
  warn 'demo: interrupted'
  exit 130
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Runs the loops, checks what must hold, draws, and reports. Called by
# tools/demo: demo.rb MODE ROOT [--verbose] LOOP... With the mode `renew` what
# they measure becomes what it was.
require 'fileutils'
require 'json'

require_relative 'demo/extent'
require_relative 'demo/host'
require_relative 'demo/plot'
require_relative 'demo/report'
require_relative 'demo/regression'
require_relative 'demo/docs'
require_relative 'demo/pendulum'
require_relative 'demo/motor'
require_relative 'demo/oven'
require_relative 'demo/tuning'
require_relative 'demo/thermostat'
require_relative 'demo/loops'
require_relative 'demo/autotune'
require_relative 'demo/double'
require_relative 'demo/anti_windup'
require_relative 'demo/random_plants'
require_relative 'demo/recipes'
require_relative 'demo/guard'
require_relative 'demo/chip'
require_relative 'demo/faults'
require_relative 'demo/fault_places'

Encoding.default_external = 'UTF-8'

# What a loop shows, and what runs it.
Loop = Struct.new(:shows, :run)

LOOPS = {
  'pendulum' => Loop.new('caught at 8 degrees, back after a shove, upright on a failing supply',
                         -> { pendulum('pendulum', 'AN964, 10 bits', -0.3) }),
  'pendulum_8bit' => Loop.new('the same with 8 x 8-bit products',
                              -> { pendulum('pendulum_8bit', 'AN964, 8 x 8 bits', -0.2) }),
  'motor' => Loop.new('to speed with little overshoot, new gains in flight, a load', -> { motor }),
  'oven' => Loop.new('an offset with P, none with PI, sooner with PID', -> { oven }),
  'tuning' => Loop.new('the pendulum step by step, from falling to upright', -> { tuning }),
  'thermostat' => Loop.new('reaches 80 C without overshoot, by hand and back without a bump',
                           -> { thermostat }),
  'autotune' => Loop.new('an oven finds its gains, and six plants work with theirs', -> { autotune }),
  'random_plants' => Loop.new('gains for plants of 22 families and machines of 23 kinds',
                              -> { random_plants }),
  'double' => Loop.new('as good on five plants as in double precision', -> { double }),
  'anti_windup' => Loop.new('no overshoot, and soon back from a setpoint out of reach', -> { anti_windup }),
  'recipes' => Loop.new('what is built around a controller: cascade, override, ramp, relay and more', -> { recipes }),
  'guard' => Loop.new('few false alarms on whole machines, each of eight faults seen on nearly all', -> { guard }),
  'faults' => Loop.new('four loops broken in 18 ways: back in control, or off, in time; in 15 for good: seen',
                       -> { run_faults }),
  'faults_chip' => Loop.new('the same on simulated chips', -> { run_faults_on_chips }),
  'faults_places' => Loop.new('a bit flips in the port, the application, the registers or the stack of a chip',
                              -> { run_faults_of_places }),
  'chip' => Loop.new('simulated chips do what the host does', -> { chip })
}.freeze

# The one to look at first, if it was drawn.
BEST = 'thermostat'

def remove_results(loops)
  loops.each do |name|
    FileUtils.rm_f(Dir.glob("#{Host.folder}/#{name}{,[-.]*}"))
  end
  FileUtils.rm_f("#{Host.folder}/results.json")
end

# A dot each ten seconds, while a loop takes long.
def with_dots(seconds = 10)
  dots = Thread.new { loop { sleep(seconds) && print('. ') } }
  yield
ensure
  dots.kill
end

# A line for each loop, its name at once.
def run_loops(loops)
  name_width = loops.map(&:size).max
  width = loops.map { |name| LOOPS.fetch(name).shows.size }.max
  loops.each do |name|
    print name.ljust(name_width + 2)
    Report.start(name)
    begin
      with_dots { LOOPS.fetch(name).run.call }
    rescue Host::Failure => e
      Report.failure(e.message)
    end
    Report.finish(name)
    puts [LOOPS.fetch(name).shows.ljust(width), Report.outcome(name).ljust(16),
          picture(name)].join('  ').rstrip
  end
end

def picture(name)
  path = "#{Host.folder}/#{name}.png"
  File.exist?(path) ? "build/demo/#{name}.png" : ''
end

def tell(loops, verbose)
  Report.print(verbose)
  first = picture(loops.include?(BEST) ? BEST : loops.first)
  puts '', "#{Report.summary}."
  puts "Look at #{first} first; the numbers are in build/demo/results.json." unless first.empty?
end

def main(mode, root, *words)
  verbose = words.first == '--verbose'
  loops = words.drop(verbose ? 1 : 0)
  Host.setup(root)
  Regression.setup(root)
  Report.renew! if mode == 'renew'
  remove_results(loops)
  run_loops(loops)
  Report.write("#{Host.folder}/results.json")
  tell(loops, verbose)
  Report.good? or exit 1
  Regression.renew(loops) if mode == 'renew'
  exit(Docs.update(mode, root, loops) ? 0 : 1)
end

if $PROGRAM_NAME == __FILE__
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
end

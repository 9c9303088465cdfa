# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Measures what the controllers cost. Called by tools/cost:
# cost.rb MODE ROOT WORD...
require 'etc'

require_relative 'cost/host'
require_relative 'cost/subjects'
require_relative 'cost/meters'
require_relative 'cost/tables'

Encoding.default_external = 'UTF-8'

def measure(subjects)
  Harness.build(subjects.map { |one| one.chip.kind }.uniq)
  done = 0
  mutex = Mutex.new
  figures = Host.in_parallel(subjects) do |subject|
    found = Meter.of(subject).figures
    mutex.synchronize do
      done += 1
      warn "cost: [#{done}/#{subjects.size}] #{subject}" if $stderr.tty? || (done % 10).zero?
    end
    found
  end
  subjects.zip(figures).to_h
end

def main(_mode, root, *words)
  Host.setup(root)
  subjects = Subject.all.select { |one| one.matches?(words) }
  unknown = words.reject { |word| Subject.kind_of_word(word) }
  raise Host::Failure, "nothing is called #{unknown.join(', ')}; see --help" if unknown.any?
  raise Host::Failure, "nothing is #{words.join(' ')}" if subjects.empty?

  puts Tables.plain(Tables.steps(measure(subjects)))
end

begin
  $stdout.sync = true
  main(*ARGV)
rescue Host::Failure, SystemCallError => e
  warn "cost: #{e.message}"
  exit 1
rescue SignalException
  warn 'cost: interrupted'
  exit 130
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require 'fileutils'
require 'open3'

# Programs that build and measure.
module Host
  class Failure < StandardError; end

  class << self
    attr_reader :root, :folder

    def setup(root)
      @root = root
      @folder = "#{root}/build/cost"
      @running = {}
      @made = {}
      @making = Mutex.new
      FileUtils.mkdir_p(@folder)
    end

    # What a command prints, from the project's folder; its failure is ours.
    def output(*command)
      text, good = run(*command)
      return text if good

      raise Failure, "#{command.first} failed:\n#{command.join(' ')}\n#{text.lines.last(20).join}"
    end

    # What a command prints, and whether it succeeded.
    def run(*command)
      Open3.popen2e(*command, chdir: root) do |input, printed, process|
        input.close
        @running[process.pid] = true
        text = printed.read
        @running.delete(process.pid)
        [text, process.value.success?]
      end
    end

    # What the block gives, which several need, made once.
    def once(key)
      @making.synchronize { @made[key] ||= yield(key) }
    end

    # When we are stopped, none is left behind.
    def stop_all
      @running.each_key { |pid| Process.kill('TERM', pid) }
    rescue SystemCallError
      nil # it has ended by itself
    end

    # For gnuplot.
    def execute(environment, *command)
      text, status = Open3.capture2e(environment, *command)
      raise Failure, "#{command.first} failed: #{text}" unless status.success?
    end

    # Like map, on as many threads as there are processors, and in order.
    def in_parallel(items)
      waiting = items.each_with_index.to_a
      results = Array.new(items.size)
      mutex = Mutex.new
      threads = Array.new(Etc.nprocessors) do
        Thread.new do
          Thread.current.report_on_exception = false
          while (item, index = mutex.synchronize { waiting.shift })
            results[index] = yield(item)
          end
        end
      end
      threads.each(&:join)
      results
    end
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'harness'

# An MSP430 without a multiplier: clang and lld, in mspdebug's simulator.
Msp430 = Struct.new(:name, :title, :controllers, :refused, :limits, :options, keyword_init: true) do
  def run
    Msp430Run
  end

  # What a form costs that no MSP430 takes is of no use.
  def costs_listed?
    !options.include?('-U__MSP430__')
  end

  def order
    'little'
  end
end

# A run in mspdebug. Questions and answers go through its memory, as many at a time
# as fit; so do the costs.
class Msp430Run < Run
  QUESTIONS = 0x8000
  QUESTIONS_SIZE = 0x3F00
  ANSWERS = 0x4000
  ANSWERS_SIZE = 0x3F00
  COSTS = 0x3000
  COSTS_SIZE = 0x0F00
  COUNT = 0x2FF0
  FLAGS = %w[--target=msp430 -mhwmult=none -std=gnu99 -ffreestanding -fno-builtin -Wall -Wextra -Werror
             -Itest/chips/target/qemu].freeze

  def result(questions)
    asked = questions.of(controller, family.order)
    objects = build
    batches = simulate(asked)
    given = read(batches, 'answers')
    costs = read(batches, 'costs').unpack('S<*').reject(&:zero?)
    Result.new(rows: asked.rows, steps: asked.steps, different: asked.different(given), flash: text_of(objects.first),
               ram: asked.object, **statistics(costs, asked))
  end

  private

  def path(name)
    "#{folder}/#{name}"
  end

  def compile(file, *more)
    object = path("#{File.basename(file, '.c')}.o")
    Host.output('clang', *FLAGS, *family.options, *options, *more, '-c', file, '-o', object)
    object
  end

  def build
    objects = library.map { |file| compile(file) }
    others = %w[main runtime].map { |name| compile("test/chips/families/msp430/#{name}.c") }
    others << compile(redirected)
    Host.output('ld.lld', '-T', 'test/chips/families/msp430/flash.ld', *objects, *others, '-o', path('firmware.elf'))
    objects
  end

  def text_of(object)
    sections = Host.output('size', '-A', object)
    sections.scan(/^\.(?:text|rodata)\S*\s+(\d+)/).flatten.sum(&:to_i)
  end

  def address(name)
    "0x#{Host.output('nm', path('firmware.elf'))[/^(\h+) \w #{name}$/, 1]}"
  end

  def simulate(asked)
    at_once = [QUESTIONS_SIZE / asked.question, ANSWERS_SIZE / asked.answer, COSTS_SIZE / 2].min
    bytes = File.binread(asked.questions)
    batches = (0...asked.count).step(at_once).map { |first| [first, [at_once, asked.count - first].min] }
    batches.each_with_index { |(first, count), n| File.binwrite(path("asked#{n}"), bytes[first * asked.question, count * asked.question]) }
    commands(batches.map(&:last), asked)
    Host.output('timeout', '600', 'mspdebug', '-q', 'sim', "read #{path('commands')}")
    batches.each_index.to_a
  end

  def commands(counts, asked)
    answer = address('answer')
    lines = ['simio add timer t0', "load #{path('firmware.elf')}", 'reset', "set pc #{address('start')}",
             "setbreak #{address('wait')}", 'run']
    counts.each_with_index do |count, n|
      lines += ["load_raw #{path("asked#{n}")} #{QUESTIONS}", 'set sr 0', "set pc #{answer}",
                format('mw 0x%x %02x %02x', COUNT, count & 255, count >> 8), 'run',
                "save_raw #{ANSWERS} #{count * asked.answer} #{path("answers#{n}")}",
                "save_raw #{COSTS} #{count * 2} #{path("costs#{n}")}"]
    end
    File.write(path('commands'), lines.map { |line| "#{line}\n" }.join)
  end

  def read(batches, what)
    batches.map { |n| File.exist?(path("#{what}#{n}")) ? File.binread(path("#{what}#{n}")) : '' }.join
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# How deep the stack may be, of routines that say it, and of the whole programs,
# where an interrupt of each priority comes at the deepest place and the depth is
# measured. Prints `ok` or `FAILED` for each:
#
#   ruby tools/bound/test/stacks.rb [NAME]... | --failed | --list
require_relative 'programs'

def depth_of(code, name)
  code.shown(name == 'main' ? code.stack_of_all : code.stack(name))
rescue Bound::Failure => e
  e.message
end

# name => text behind it
def expected(source)
  File.read(source).scan(/^(\w+): *; (?:all: )?(.*?)(?:, \d+ seen)?$/).to_h
end

def judge(chip, program)
  expected(program.source).each do |name, text|
    wanted = text.start_with?('refused: ') ? /#{Regexp.escape(text.delete_prefix('refused: '))}/ : text
    Gate.expect("stack of #{chip} #{name}", -> { depth_of(program.code, name) }, wanted)
  end
end

# The deepest routine is `third`; what is seen of all, if it is not the same.
def measured(chip, program)
  main = File.read(program.source)[/^main:.*/]
  Gate.expect("stack of #{chip} measured", -> { program.depth('third') }, (main[/(\d+) seen/, 1] || main[/\d+/]).to_i)
end

Programs.all('stacks').each do |chip, program|
  judge(chip, program)
  measured(chip, program)
end
%w[LETS_IN LETS_ALL_IN].each do |how|
  all = Programs.all('stacks', "-D#{how}")
  all.delete('avr') if how == 'LETS_ALL_IN' # it restores SREG so
  all.each { |chip, program| Gate.expect("stack of #{chip} with #{how}", -> { depth_of(program.code, 'main') }, /an interrupt lets others in/) }
end

# Those of cores/.
def judge_core(program, one)
  what = "#{program.name} #{one.name}"
  found = -> { depth_of(program.code, one.name) }
  return Gate.expect("stack of #{what} is refused", found, /#{Regexp.escape(one.refusal)}/) if one.refusal

  Gate.expect("stack of #{what}", found, "#{one.stack} bytes")
  Gate.expect("stack of #{what} measured", -> { program.measured(one.name).last }, one.stack)
end

Programs.cores.each do |program|
  program.routines.each { |one| judge_core(program, one) unless one.refusal&.include?('timing') }
end
Gate.finish

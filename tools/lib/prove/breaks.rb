# SPDX-License-Identifier: MIT
# The breaks of src/, each with the proof that must notice it.
require 'fileutils'
require_relative 'proofs'

Broken = Struct.new(:proof, :file, :whole, :instead, :number) do
  def name
    "#{proof.name}, #{File.basename(file)} broken at `#{whole.strip}`"
  end

  # Gives the block a tree of sources in which it is broken.
  def in_tree(build)
    tree = "#{build}/broken_#{number}"
    FileUtils.rm_rf(tree)
    FileUtils.mkdir_p(tree)
    FileUtils.cp_r(%w[include src], tree)
    File.write("#{tree}/#{file}", File.read(file).sub(whole) { instead })
    yield tree
  ensure
    FileUtils.rm_rf(tree)
  end
end

# All of them.
module Breaks
  FILE = "#{FOLDER}/breaks.txt".freeze

  module_function

  # Of each row `module form what: file: `whole` -> `instead``.
  def all(proofs)
    File.readlines(FILE, chomp: true).grep_v(/^#|^\s*$/).each_with_index.map do |line, number|
      fields = line.match(/\A(\w+ \w+ \w+): (\S+): `(.*)` -> `(.*)`\z/) or abort "prove: #{FILE}: #{line}"
      proof = Proofs.find(proofs, fields[1]) or abort "prove: #{FILE}: no #{fields[1]}"
      Broken.new(proof, *fields[2..4], number)
    end
  end

  # What is not once in its file, and proofs that no break is for.
  def complaints(proofs, breaks)
    elsewhere = breaks.reject { |broken| File.read(broken.file).scan(broken.whole).size == 1 }
    tried = breaks.map { |broken| [broken.proof.group, broken.proof.what] }
    untried = proofs.map { |proof| [proof.group, proof.what] }.uniq - tried - [%w[model model]]
    elsewhere.map { |broken| "#{FILE}: not once in #{broken.file}: `#{broken.whole}`" } +
      untried.map { |names| "#{FILE}: nothing for #{names.join(' ')}" }
  end
end

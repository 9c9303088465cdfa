# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require 'digest'
require 'json'

# What was measured of the same sources with the same tools is not measured
# again: build/cost/memory/, a file for each subject.
class Memory
  SOURCES = %w[include/*.h port/*.[ch] port/pic/**/* sim/{chip,gpsim}/* src/**/* test/avr/vectors_table.rb
              test/beside/* test/cost/**/* test/support/*.[ch] test/target/*.{c,h,cc,hh} test/target/{arm,qemu,riscv,shim}/**/* test/vectors/*
              tools/cost tools/lib/build_pic tools/lib/one_bank* tools/lib/cost.rb tools/lib/cost/**/*].freeze
  TOOLS = %w[gcc g++ gpasm gplink avr-gcc avr-as arm-none-eabi-gcc qemu-system-arm
             riscv64-unknown-elf-gcc qemu-system-riscv32].freeze

  def initialize
    @folder = "#{Host.folder}/memory"
    FileUtils.mkdir_p(@folder)
    files = SOURCES.flat_map { |pattern| Dir.glob(pattern, base: Host.root) }.sort
    @sources = digest(files.map { |file| "#{Host.root}/#{file}" } + tools)
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
    programs = TOOLS.map { |name| Host.output('sh', '-c', "command -v #{name}").strip }
    libraries = Dir.glob('/usr/lib/*/lib{gpsim,simavr}.so*').sort
    (programs + libraries + [ENV['SDCC'], *Dir.glob("#{ENV['SDCC_LIB']}/pic1[46]/*").sort]).compact
  end

  def digest(files)
    Digest::SHA256.hexdigest(files.select { |file| File.file?(file) }
                                  .map { |file| "#{file} #{Digest::SHA256.file(file).hexdigest}\n" }.join)
  end
end

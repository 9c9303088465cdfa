# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require 'digest'
require 'json'

# What was measured of the same sources with the same tools is not measured
# again: build/cost/memory/, a file for each subject. The tools are all that a
# figure depends on: of a compiler also what it starts, its headers, and the
# libraries that it links.
class Memory
  SOURCES = %w[include/*.h port/**/* sim/**/* src/**/* test/avr/vectors_table.rb test/beside/* test/cost/**/*
               test/support/*.[ch] test/target/**/* test/vectors/* tools/cost tools/lib/*.sh tools/lib/build_*
               tools/lib/one_bank* tools/lib/cost.rb tools/lib/cost/**/*].freeze
  COMPILERS = %w[gcc g++ avr-gcc arm-none-eabi-gcc riscv64-unknown-elf-gcc].freeze
  PROGRAMS = %w[gpasm gplink qemu-system-arm qemu-system-riscv32].freeze
  PARTS = %w[cc1 cc1plus as ld].freeze # what a compiler starts

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
    programs = (COMPILERS + PROGRAMS).map { |name| found(name) }.compact
    libraries = Dir.glob('/usr/lib/*/lib{gpsim,simavr}.so*').sort
    programs + libraries + COMPILERS.flat_map { |name| parts_of(name) } + sdcc
  end

  def found(program)
    path = Host.output('sh', '-c', "command -v #{program} || :").strip
    path.empty? ? nil : path
  end

  def parts_of(compiler)
    return [] unless found(compiler)

    programs = PARTS.map { |part| Host.output(compiler, "-print-prog-name=#{part}").strip }
    programs.map { |path| path.include?('/') ? path : found(path) }.compact +
      folders_of(compiler).flat_map { |folder| Dir.glob("#{folder}/**/*").sort }
  end

  # Of a compiler for another chip also its C library's, with what is beside it.
  def folders_of(compiler)
    folders = [File.dirname(Host.output(compiler, '-print-libgcc-file-name').strip)]
    library = Host.output(compiler, '-print-file-name=libc.a').strip
    folders << File.expand_path('../..', File.realpath(library)) if compiler.include?('-') && library.start_with?('/')
    folders
  end

  # The compiler for PICs, what it starts, its headers and libraries, and those of
  # its assembler.
  def sdcc
    return [] unless ENV['SDCC']

    above = File.expand_path('../..', File.realpath(ENV['SDCC']))
    [ENV['SDCC'], *Dir.glob("#{above}/{libexec,share}/sdcc/**/*").sort, *Dir.glob("#{above}/bin/*sdc*").sort,
     *Dir.glob("#{ENV['SDCC_LIB']}/pic1[46]/*").sort, *Dir.glob('/usr/share/gputils/**/*').sort]
  end

  # By what is in them; files of which there are thousands, by size and time.
  def digest(files)
    Digest::SHA256.hexdigest(files.select { |file| File.file?(file) }.map { |file| "#{file} #{state(file)}\n" }.join)
  end

  def state(file)
    return Digest::SHA256.file(file).hexdigest unless file.start_with?('/usr/', '/opt/')

    status = File.stat(file)
    "#{status.size} #{status.mtime.to_r}"
  end
end

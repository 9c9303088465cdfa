# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require 'digest/sha2' # of threads, only the first may load it
require 'open3'
require 'pathname'
require_relative 'large_pages'

# The files that something which is built or measured depends on. Of a compiler these
# are also what it starts, its headers, and the libraries that it links.
module Inputs
  COMPILERS = %w[gcc g++ avr-gcc arm-none-eabi-gcc riscv64-unknown-elf-gcc].freeze
  PARTS = %w[cc1 cc1plus as ld].freeze # what a compiler starts
  BESIDE = { # whatever else a program consists of
    'clang' => %w[/usr/lib/*/libLLVM-*.so* /usr/lib/llvm-*/lib/libclang-cpp.so* /usr/lib/llvm-*/lib/clang/**/*],
    'gcovr' => %w[/usr/lib/python3/dist-packages/{gcovr,jinja2,lxml}/**/*],
    'simavr' => %w[/usr/lib/*/libsimavr*.so*],
    'sdcc' => %w[/usr/bin/sd* /usr/share/sdcc/**/*]
  }.freeze
  INCLUDE = /^[ \t]*#[ \t]*include[ \t]+["<]([^">]+)[">]/.freeze

  class << self
    # By what is in them; files of which there are thousands, by size and time: what Debian
    # has installed, and what setup.sh has sealed, which looks whether it is as it was.
    def digest(files)
      installed = ['/usr/', '/opt/', *sealed.map { |seal| "#{File.dirname(seal)}/" }]
      Digest::SHA256.hexdigest(files.select { |file| File.file?(file) }.map do |file|
        "#{file} #{file.start_with?(*installed) ? stamp(file) : Digest::SHA256.file(file).hexdigest}\n"
      end.join)
    end

    # Of a program's name.
    def tool(name)
      path = found(name)
      [path, *(COMPILERS.include?(name) ? parts_of(name) : []), *Dir.glob(BESIDE.fetch(name, [])).sort].compact
    end

    # The compiler for PICs, what it starts, its headers and libraries, and those of
    # its assembler.
    def sdcc
      return [] unless ENV['SDCC']

      above = File.expand_path('../..', File.realpath(ENV['SDCC']))
      [ENV['SDCC'], *Dir.glob("#{above}/{libexec,share}/sdcc/**/*").sort, *Dir.glob("#{above}/bin/*sdc*").sort,
       *Dir.glob("#{ENV['SDCC_LIB']}/pic1[46]/*").sort, *Dir.glob('/usr/share/gputils/**/*').sort]
    end

    # What tells the private compilers that tools/lib/setup.sh has sealed from others.
    def sealed
      Dir.glob("#{ENV.fetch('XDG_CACHE_HOME', "#{ENV['HOME']}/.cache")}/fixpid/*/SHA256SUMS").sort
    end

    # These sources and all that they may include from these folders: also what a
    # condition leaves out, and of two files of a name both.
    def with_included(sources, folders)
      found = sources.dup
      found.each do |file|
        names = File.binread(file).scan(INCLUDE).flatten
        paths = names.product([File.dirname(file), *folders]).map { |name, folder| "#{folder}/#{name}" }
        found.concat(paths.select { |path| File.file?(path) }.map { |path| Pathname(path).cleanpath.to_s }.uniq - found)
      end
    end

    private

    def stamp(file)
      status = File.stat(file)
      "#{status.size} #{status.mtime.to_r}"
    end

    def said(*command)
      text, status = Open3.capture2(*command)
      status.success? ? text.strip : raise("#{command.join(' ')} failed")
    end

    def found(program)
      path = said('sh', '-c', "command -v #{program} || :")
      path.empty? ? nil : path
    end

    def parts_of(compiler)
      return [] unless found(compiler)

      programs = PARTS.map { |part| said(compiler, "-print-prog-name=#{part}") }
      programs.map { |path| path.include?('/') ? path : found(path) }.compact +
        folders_of(compiler).flat_map { |folder| Dir.glob("#{folder}/**/*").sort }
    end

    # Of a compiler for another chip also its C library's, with what is beside it.
    def folders_of(compiler)
      folders = [File.dirname(said(compiler, '-print-libgcc-file-name'))]
      library = said(compiler, '-print-file-name=libc.a')
      folders << File.expand_path('../..', File.realpath(library)) if compiler.include?('-') && library.start_with?('/')
      folders
    end
  end
end

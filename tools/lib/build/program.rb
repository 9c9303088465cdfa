# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# One program for one chip, with what it calls of the library and of the chip's port:
#
#   ruby tools/lib/build/program.rb CHIP OUTPUT [--port FOLDER] [--own]
#       [-DNAME=VALUE | -IFOLDER]... FILE.c...
#
# From the project's folder; makes OUTPUT.hex by build_pic or build_avr. With --own the
# program is a user's: a fixpid_config.h beside the first FILE counts for all sources, with
# SDCC, too, which looks for none, and a warning is printed and no error.
#
# The linker cannot choose the sources: it takes whole files of SDCC, and a PIC16's are
# compiled as one file, since SDCC gives each local a byte of RAM, which functions that are
# not active at the same time share only within a file.
require 'English'
require 'open3'
require 'pathname'
require 'tmpdir'
require_relative '../modules'
require_relative 'gputils'

# What a C file has for others when it is compiled, and what it takes of them.
class Symbols
  def initialize(chip, options)
    @chip = chip
    @options = options
    @found = {}
  end

  # [defined, needed]; or the end, with the compiler's words.
  def of(file)
    @found[file] ||= Dir.mktmpdir do |folder|
      output, status = Open3.capture2e(*compiler, *@options, file, '-o', "#{folder}/compiled")
      abort "#{output}program: cannot compile #{file}" unless status.success?
      @chip.start_with?('pic') ? of_assembly("#{folder}/compiled") : of_object("#{folder}/compiled")
    end
  end

  private

  def compiler
    return ['avr-gcc', "-mmcu=#{@chip}", '-Os', '-std=c99', '-c'] unless @chip.start_with?('pic')

    [ENV.fetch('SDCC'), @chip.start_with?('pic18') ? '-mpic16' : '-mpic14', "-p#{@chip.delete_prefix('pic')}",
     '--std-c99', '--use-non-free', '-S']
  end

  def of_assembly(path)
    %w[global extern].map { |kind| File.read(path).scan(/^\s+#{kind}\s+_(\S+)/i).flatten }
  end

  def of_object(path)
    lines, = Open3.capture2('avr-nm', path)
    [/ [A-TV-Z] (\S+)$/, / U (\S+)$/].map { |form| lines.scan(form).flatten }
  end
end

# A program's own files, and what goes with them.
class Program
  def initialize(chip, output, port: nil, own: false)
    @chip = chip
    @output = output
    @own_port = port
    @own = own
    @port = port || Dir["port/*/#{chip}"].first
    check if pic?
  end

  # Whether it was built.
  def build(definitions, files)
    @options = definitions + config(files.first) + ["-I#{Dir.pwd}", '-Iinclude', '-Iport', "-I#{@port}"]
    @symbols = Symbols.new(@chip, @options)
    library, port = chosen(files).partition { |file| file.start_with?('src/') }
    main = port.delete("#{@port}/port.c")
    @names = @own && files.flat_map { |file| @symbols.of(file).first }.join('|')
    done = pic? ? for_pic(library + port + files, main) : for_avr([*library, *port, *files, *main])
    say_how(library) if !done && $CHILD_STATUS.exitstatus == TOO_BIG
    say_object if !done && @own
    done
  end

  private

  TOO_BIG = 3 # build_pic's
  PORTS = %w[wait_ticks eeprom uart].freeze

  def pic?(family = 'pic')
    @chip.start_with?(family)
  end

  # Before a compiler says it in its own words.
  def check
    abort "program: gputils knows no chip #{@chip}, and SDCC cannot build for it without; XC8 may: docs/start/mplabx.md" unless
      File.exist?("#{Gputils.folder('lkr')}/#{@chip.delete_prefix('pic')}_g.lkr")
    lacks = %w[port.c port_board.h configuration.h registers.h].find { |name| !File.exist?("#{@port}/#{name}") }
    abort "program: #{@port} has no #{lacks}: begin with a copy of port/template" if lacks
  end

  # Of the user's fixpid_config.h. SDCC takes a path with a space for two, and the second
  # for a file to write.
  def config(file)
    path = "#{File.dirname(file)}/fixpid_config.h"
    return [] unless @own && File.exist?(path)

    @named = File.read(path)
    return ["-I#{File.dirname(path)}"] unless pic?

    File.write("#{@output}.h", "#include \"#{path}\"\n")
    ["-Wp,-include,#{Pathname(@output).relative_path_from(Pathname(Dir.pwd))}.h"]
  end

  # The sources that define what is needed, and what these need.
  def chosen(files)
    all = []
    until (more = missing(files + all).flat_map { |name| definers(name, all) }.uniq - all).empty?
      all += more
    end
    all
  end

  def missing(files)
    defined, needed = files.map { |file| @symbols.of(file) }.transpose.map(&:flatten)
    needed.uniq - defined
  end

  # What a module has for itself need not have its name, and is in its folder.
  def definers(name, files)
    return [source_of_port(name)] if name.start_with?('port_')

    modules = [Modules::ALL.keys.select { |key| name.start_with?("fixpid_#{key}_") }.max_by(&:size)].compact
    modules = files.map { |path| path[%r{\Asrc/(\w+)/}, 1] }.compact.uniq if modules.empty?
    modules.flat_map { |key| Modules.sources(key) }.select { |path| @symbols.of(path).first.include?(name) }.first(1)
  end

  # By its name, since not every chip can compile each.
  def source_of_port(name)
    part = PORTS.find { |one| name.start_with?("port_#{one}") }
    ["port/port_#{part}.c", "#{@port}/port_#{part}.c", "port/pic/pic18/port_#{part}.c"].find { |path| File.exist?(path) } || "#{@port}/port.c"
  end

  # All of a PIC16's files know bank 0 only, but for a port of ours.
  def for_pic(files, main)
    @options << '-DPORT_UART' if pic?('pic18') && files.any? { |path| path.end_with?('/port_uart.c') }
    files = [in_one(files)] unless pic?('pic18')
    files = main && !@own_port ? [*files, '--all-banks', main] : ['--all-banks', *files, *main]
    system('tools/lib/build/build_pic', @chip, @output, *(['--port', @own_port] if @own_port), *(['--own', @names] if @own), *@options, *files)
  end

  def in_one(files)
    File.write("#{@output}.c", files.map { |file| "#include \"#{file}\"\n" }.join)
    "#{@output}.c"
  end

  def for_avr(files)
    system('tools/lib/build/build_avr', @chip, @output, *('-Wno-error' if @own), *@options, *files)
  end

  # The user's switches: options, and those of a fixpid_config.h.
  def switches
    "#{@options.join(' ')} #{@named}"
  end

  def say_object
    switches.scan(/(FIXPID_\w+_OBJECT)[= ](\w+)/) do |switch, name|
      warn "program: #{switch}=#{name}: no file defines #{name}" unless @names.split('|').include?(name)
    end
  end

  def say_how(library)
    names = (library.map { |path| path.split('/')[1] }.uniq & Modules.with_object).map { |name| "FIXPID_#{name.upcase}_OBJECT" }
    name = names.find { |one| !switches.include?(one) }
    warn "program: a controller with a name takes far less of a PIC: -D#{name}=NAME" if name
  end
end

if $PROGRAM_NAME == __FILE__
  chip, output, *rest = ARGV
  port = rest.slice!(0, 2).last if rest.first == '--port'
  own = !rest.delete('--own').nil?
  options, files = rest.partition { |word| word.start_with?('-') }
  exit Program.new(chip, output, port: port, own: own).build(options, files)
end

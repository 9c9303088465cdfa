# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Compiles each component of an unpacked CMSIS pack as a project that takes it does: with
# its own files and include folders. Prints what a component calls of the library that
# neither it nor the components that it requires have.
#
#   cmsis_pack.rb FOLDER PDSC OBJECTS
require 'fileutils'
require 'open3'

folder, pdsc, objects = ARGV
text = File.read("#{folder}/#{pdsc}")
requires = text.scan(%r{<condition id="(.*?)">(.*?)</condition>}m).to_h { |id, what| [id, what.scan(/Csub="(.*?)"/).flatten] }

# [names that it has, names that it lacks]
def symbols(files)
  listed, = Open3.capture2('nm', *files)
  had = listed.scan(/ [A-TV-Z] (fixpid_\w+)$/).flatten
  [had, listed.scan(/ U (fixpid_\w+)$/).flatten.uniq - had]
end

components = text.scan(%r{<component [^>]*Csub="(.*?)"([^>]*)>(.*?)</component>}m).to_h do |name, attributes, files|
  FileUtils.rm_rf("#{objects}/#{name}")
  FileUtils.mkdir_p("#{objects}/#{name}")
  includes = files.scan(/category="include" name="(.*?)"/).flatten.map { |path| "-I#{folder}/#{path}" }
  built = files.scan(/category="source" name="(.*?)"/).flatten.map do |path|
    object = "#{objects}/#{name}/#{File.basename(path, '.c')}.o"
    system('cc', '-std=c99', '-Wall', '-Wextra', '-Werror', *includes, '-c', "#{folder}/#{path}", '-o', object) || exit(1)
    object
  end
  [name, { symbols: symbols(built), requires: requires.fetch(attributes[/condition="(.*?)"/, 1], []) }]
end
abort "#{pdsc} has no component" if components.empty?
lacking = components.map do |name, it|
  had = it[:requires].flat_map { |other| components.fetch(other)[:symbols].first }
  [name, it[:symbols].last - had]
end
lacking.each { |name, names| puts "#{name} lacks #{names.join(' ')}" unless names.empty? }
exit(lacking.all? { |_, names| names.empty? })

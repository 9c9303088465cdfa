# SPDX-License-Identifier: MIT
# Makes what mkdocs builds the site of: site.rb FOLDER. The folder gets the project's
# documents where they are in the project, so that their links hold, a page for each
# header, and one for each other file that a page links to.
require 'fileutils'
require 'yaml'
require_relative 'site/header'
require_relative 'site/names'
require_relative 'site/pages'

Encoding.default_external = 'UTF-8'
TUNER = 'build/tuner/index.html'.freeze

# The files that the navigation names, of a part of it.
def named(part)
  case part
  when Hash then part.values.flat_map { |value| named(value) }
  when Array then part.flat_map { |value| named(value) }
  else [part]
  end
end

def documents
  Dir['*.md', 'docs/*.md', 'python/*.md'].sort
end

def check_navigation(files)
  lost = documents - files
  abort "web/site/mkdocs.yml names no #{lost.join(', ')}" unless lost.empty?
end

folder = ARGV.fetch(0)
pages = "#{folder}/pages"
FileUtils.rm_rf(folder)
config = YAML.load_file('web/site/mkdocs.yml')
headers = Dir['include/*.h'].sort
check_navigation(named(config['nav']))
config['nav'].find { |part| part.key?('Reference') }['Reference'] =
  headers.map { |path| { File.basename(path) => "#{path}.md" } }
config['docs_dir'] = 'pages'

site = Pages.new(pages)
names = Names.new(headers)
documents.each { |path| site.document(path) }
headers.each { |path| site.write("#{path}.md", Header.new(path, names).page) }
site.follow_links

FileUtils.mkdir_p("#{pages}/docs")
FileUtils.cp_r('docs/images', "#{pages}/docs")
FileUtils.mkdir_p("#{pages}/site")
FileUtils.cp(Dir['web/site/*.{css,js}'], "#{pages}/site")
FileUtils.cp_r('web/site/theme', folder)
FileUtils.mkdir_p("#{pages}/tuner")
FileUtils.cp(TUNER, "#{pages}/tuner/index.html")
File.write("#{folder}/mkdocs.yml", YAML.dump(config))

# SPDX-License-Identifier: MIT
# Makes what mkdocs builds the site of: site.rb FOLDER [ADDRESS]. The folder gets the
# project's documents where they are in the project, so that their links hold, a page for
# each header, and one for each other file that a page links to. ADDRESS is where the site
# will be: of a site without one, nothing names an address.
require 'fileutils'
require 'yaml'
require_relative '../project'
require_relative 'site/header'
require_relative 'site/names'
require_relative 'site/pages'

Encoding.default_external = 'UTF-8'
TUNER = 'build/tuner/index.html'.freeze

def documents
  [Pages::HOME, *Dir['*.md', 'docs/**/*.md', 'python/*.md'].sort]
end

def check_navigation(files)
  lost = documents - files
  abort "web/site/mkdocs.yml names no #{lost.join(', ')}" unless lost.empty?
end

folder, address = ARGV
address ||= Project::ADDRESS
pages = "#{folder}/pages"
FileUtils.rm_rf(folder)
config = YAML.load_file('web/site/mkdocs.yml')
headers = Dir['include/*.h'].sort
check_navigation(Pages.named(config['nav']))
config['nav'].find { |part| part.key?('Reference') }['Reference'] =
  headers.map { |path| { File.basename(path) => "#{path}.md" } }
config['docs_dir'] = 'pages'
config['nav'] = Pages.navigation(config['nav'])
config['site_name'] = "#{Project::NAME} #{Project::VERSION}"
config['site_url'] = address if address

site = Pages.new(pages)
names = Names.new(headers)
documents.each { |path| site.document(path) }
headers.each { |path| site.header(path, names) }
site.follow_links

FileUtils.mkdir_p("#{pages}/docs")
FileUtils.cp_r('docs/images', "#{pages}/docs")
FileUtils.mkdir_p("#{pages}/site")
FileUtils.cp(Dir['web/site/*.{css,js,svg}'], "#{pages}/site")
FileUtils.cp_r('web/site/theme', folder)
FileUtils.mkdir_p("#{pages}/tuner")
FileUtils.cp(TUNER, "#{pages}/tuner/index.html")
File.write("#{folder}/mkdocs.yml", YAML.dump(config))

# SPDX-License-Identifier: MIT
# Finishes what the search of a site knows: search.rb SITE PAGES, where PAGES is what site.rb
# made. Pages of source files are taken out, what stands twice, and the words that people type
# for a page, of web/site/words.yml, are put beside it. The index is written once more as a script, for a site that
# is opened from a file. The theme's lunr gets a comma: it takes two nodes of its automaton for one where
# a letter that is a digit and a node's number read alike, and then finds nothing for some words with digits.
require 'json'
require 'yaml'
require_relative 'pages'

# Titles, text and words of the pages that the navigation names.
class Search
  WORDS = 'web/site/words.yml'.freeze

  NODE = 'e=e+s+o.id}'.freeze # in lunr's TokenSet.toString

  def initialize(site, config)
    @workers = Dir["#{site}/assets/javascripts/workers/search.*.js"]
    @folder = "#{site}/search"
    @index = JSON.parse(File.read("#{@folder}/search_index.json", encoding: 'UTF-8'))
    @guides = Pages.named(config['nav']).map { |path| page(path) }
  end

  def finish
    mend_worker
    @index['docs'].select! { |entry| @guides.include?(entry['location'][/\A[^#]*/]) }
    lost = words.keys - @index['docs'].map { |entry| entry['location'] }
    abort "#{WORDS} names no #{lost.join(', ')}" unless lost.empty?

    # The theme shows a page in the place of its first section, and finds it by the page's text.
    first = @index['docs'].reverse.to_h { |entry| [entry['location'][/\A(.*)#/, 1], entry['text']] }
    @index['docs'].each do |entry|
      entry['text'] = first.fetch(entry['location'], entry['text']) # its sections have the rest
      entry['tags'] = words[entry['location']] if words.key?(entry['location'])
    end
    text = JSON.generate(@index)
    File.write("#{@folder}/search_index.json", text)
    File.write("#{@folder}/search_index.js", "__search.index = Promise.resolve(#{text});\n")
  end

  private

  def mend_worker
    path, *others = @workers
    text = File.read(path, encoding: 'UTF-8')
    abort "#{path}: lunr is another one, see NODE" unless others.empty? && text.scan(NODE).size == 1
    File.write(path, text.sub(NODE, "e=e+s+o.id+','}"))
  end

  def page(path)
    path.sub(%r{(\A|/)README\.md\z}, '\1index.md').sub(/\.md\z/, '.html')
  end

  def words
    @words ||= YAML.load_file(WORDS).to_h { |path, list| [page(path), list.split] }
  end
end

site, pages = ARGV
Search.new(site, YAML.load_file("#{pages}/mkdocs.yml")).finish

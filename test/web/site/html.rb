# SPDX-License-Identifier: MIT
# What the pages of a site say and where their links lead, without a browser: html.rb SITE; and
# html.rb address, of a site that is made for an address. Prints `ok NAME` or `FAILED NAME: why`.
require 'cgi'
require 'fileutils'
require 'yaml'
require_relative '../../../tools/lib/project'

Encoding.default_external = 'UTF-8'
SITE = ARGV.fetch(0)
ADDRESS = 'https://host.invalid/fixpid/'.freeze # of a site that is made here
MADE = 'build/site-address'.freeze
SOURCES = %r{\A(?:examples|port|sim|src|test|tools|include)/.*(?<!\.h)\.html\z}.freeze

# Macros that are private, and what their comments say.
PRIVATE = %w[FIXPID_CAST FIXPID_REAL FIXPID_FOLDED FIXPID_CHECKED FIXPID_PID_KP_Q8 FIXPID_SLEW_Q16 FIXPID_TABLE_COUNT
             FIXPID_SUFFIXED fixpid_tpo_suffixed].freeze
INNER = ['A real constant, rounded half up', 'casting a sum of reals to an integer.', 'Gives value as', 'false or not a constant condition', 'condition and check nothing.',
         'Deviation 20.'].freeze

@failed = false

def check(name, problems)
  @failed ||= problems.any?
  puts(problems.empty? ? "ok #{name}" : "FAILED #{name}: #{problems.first(4).join('; ')}")
end

# Pages by their names; the tuner and the page for what is not there are others'.
def pages(site)
  Dir.chdir(site) { Dir['**/*.html'] }.reject { |name| name.start_with?('tuner/') || name == '404.html' }
     .sort.to_h { |name| [name, File.read("#{site}/#{name}")] }
end

def meta(html, name)
  text = html[/<meta (?:name|property)="#{name}" content="([^"]*)">/, 1]
  text && CGI.unescapeHTML(text)
end

def descriptions(all)
  guides = all.reject { |name, _| name.match?(SOURCES) }
  alike = guides.keys.group_by { |name| meta(all[name], 'description') }.values.select { |names| names.size > 1 }
  all.flat_map do |name, html|
    text = meta(html, 'description')
    next ["#{name} has no description"] if text.to_s.size < 20

    [("#{name}: #{text.size} characters" if text.size > 160),
     ("#{name}: #{text} is not plain" if text.match?(/`|[*]{2}|\]\(/)),
     ("#{name}: its card says something else" if meta(html, 'og:description') != text || meta(html, 'og:title').to_s.empty?)].compact
  end + alike.map { |names| "#{names.join(', ')} have one description" }
end

# Nothing that loads or names a host that is not decided.
def hosts(all)
  all.flat_map do |name, html|
    html[%r{<head>.*?</head>}m].scan(%r{(?:href|content|src)="(https?://[^"]*)"}).map { |address,| "#{name}: #{address}" }
  end
end

# Links to a page or a file that is not there, or to a heading that is not on it.
def dead_links(all)
  places = all.transform_values { |html| html.scan(/\sid="([^"]+)"/).flatten }
  all.flat_map do |name, html|
    html.scan(/<(?:a|link|img|script)\s[^>]*?(?:href|src)="([^"]*)"/).flatten.uniq.map { |address| CGI.unescapeHTML(address) }.grep_v(/\Ahttps?:/).reject do |address|
      path, id = address.split('#', 2)
      page = path.to_s.empty? ? name : File.expand_path("/#{File.dirname(name)}/#{CGI.unescape(path)}").delete_prefix('/')
      File.file?("#{SITE}/#{page}") && (id.to_s.empty? || !places.key?(page) || places[page].include?(CGI.unescape(id)))
    end.map { |address| "#{name}: #{address}" }
  end
end

def titles(all)
  all.keys.reject { |name| all[name][%r{<title>(.*?)</title>}m, 1].end_with?("#{Project::NAME} #{Project::VERSION}") }
end

# Its version, and four numbers, each with a link to what proves it.
def first_page(html)
  numbers = html[/class="numbers".*?<\/div>/m].to_s.scan(%r{<li>\s*<strong>\d+.*?</li>}m)
  [("#{numbers.size} numbers" if numbers.size != 4), *numbers.grep_v(/<a href="docs/).map { |number| "no proof of #{number[/\d+/]}" },
   ('no version' unless html.include?("Version #{Project::VERSION}"))].compact
end

# What a reader sees, with each space once.
def words(html)
  CGI.unescapeHTML(html.gsub(%r{<script.*?</script>}m, '').gsub(/<[^>]*>/, '')).delete("\u200b¶`").split.join(' ')
end

# Each function has its declaration below its heading, then what the header says, its arguments,
# its result, its cost and five lines that call it. Nothing private is shown.
def header(file, html)
  text = File.read("include/#{file}")
  sections = html.split(/(?=<h2 id=)/).drop(1).to_h { |part| [part[/<h2 id="([^"]+)"/, 1], part] }
  text.gsub(/^# *define.*(?:\\\n.*)*/, '').scan(/^(?!static)(?:[\w ]*?[ *])(fixpid_\w+)\(([^)]*)\)[^{]*;/).flat_map do |name, arguments|
    function(file, sections[name], name, arguments)
  end + lost(file, text, words(html)) + shown(file, html)
end

def function(file, section, name, arguments)
  return ["#{file}: no heading for #{name}"] unless section

  table = section[%r{<table class="call">.*?</table>}m].to_s
  wanted = arguments.split(',').map { |argument| argument[/(\w+)(?:\[\w*\])?\s*\z/, 1] }.grep_v(/\Avoid\z/) + %w[result cost]
  rows = table.scan(%r{<th scope="row">(.*?)</th>}).flatten.map { |cell| cell.gsub(/<[^>]*>/, '') }
  program = section[%r{class="highlight example">.*?</div>}m].to_s
  example = words(program)
  declaration = section.index('<div class="highlight"')
  prose = section.index('<p>')
  [("#{file}: the declaration of #{name} is not first" unless declaration && prose && declaration < prose),
   ("#{file}: #{name} tells #{rows.join(' ')} instead of #{wanted.join(' ')}" if rows != wanted),
   ("#{file}: #{program.lines.size} lines in the example of #{name}" if program.lines.size != 5),
   ("#{file}: no call in the example of #{name}" unless example.include?("#{name}("))].compact
end

# Lines of a comment that are not on the page.
def lost(file, text, page)
  comments = text.sub(%r{^// The rest is private.*}m, '').scan(%r{(?:^//.*\n)+}).map { |lines| lines.gsub(%r{^// ?}, '') }.reject { |comment| comment.match?(/\A.{0,60}\bprivate\b/i) }
  comments.flat_map(&:lines).map { |line| line.sub(/\A *(?:- |\d+\. )/, '').delete('`').split.join(' ') }
          .reject { |line| page.include?(line) || INNER.any? { |inner| line.include?(inner) } }.map { |line| "#{file} lacks \"#{line}\"" }
end

def shown(file, html)
  text = words(html)
  PRIVATE.select { |name| text.match?(/# *define #{name}\b/) }.map { |name| "#{file} shows #{name}" }
end

# Some pages of the same site for an address.
def with_address
  system('ruby', 'tools/lib/pages/site.rb', MADE, ADDRESS) || abort('site.rb failed')
  config = YAML.load_file("#{MADE}/mkdocs.yml")
  kept = %w[index.md docs/tuning.md docs/start/arduino.md]
  Dir["#{MADE}/pages/**/*.md"].each { |path| File.delete(path) unless kept.include?(path.delete_prefix("#{MADE}/pages/")) }
  config['nav'] = kept
  File.write("#{MADE}/mkdocs.yml", YAML.dump(config))
  system('mkdocs', 'build', '--quiet', '--config-file', "#{MADE}/mkdocs.yml", '--site-dir', File.expand_path("#{MADE}/site"),
         err: File::NULL) || abort('mkdocs failed')
  addresses("#{MADE}/site", kept)
end

def addresses(site, kept)
  map = File.read("#{site}/sitemap.xml").scan(%r{<loc>(.*?)</loc>}).flatten
  kept.flat_map do |path|
    name = path.sub(/md\z/, 'html')
    place = "#{ADDRESS}#{name}".delete_suffix('index.html')
    html = File.read("#{site}/#{name}")
    card = meta(html, 'og:image').to_s
    [("#{name} is not on the map" unless map.any? { |entry| [place, "#{place}index.html"].include?(entry) }),
     ("#{name}: canonical" unless html.match?(/<link rel="canonical" href="#{Regexp.escape(place)}(?:index.html)?">/)),
     ("#{name}: og:url" unless meta(html, 'og:url').to_s.start_with?(place)),
     ("#{name}: no picture #{card}" unless card.start_with?(ADDRESS) && File.file?("#{site}/#{card.delete_prefix(ADDRESS)}"))].compact
  end
end

if SITE == 'address'
  check('a site with an address', with_address)
  exit(@failed ? 1 : 0)
end
all = pages(SITE)
check('no link is dead', dead_links(all))
check('every page says what it is', descriptions(all))
check('no head names a host', hosts(all))
check('the version is in every title', titles(all))
check('the first page', first_page(all.fetch('index.html')))
check('a map has addresses or is not there', File.file?("#{SITE}/sitemap.xml") && !File.read("#{SITE}/sitemap.xml").include?('<loc>http') ? ['None'] : [])
Dir.children('include').sort.each { |file| check("the page of #{file}", header(file, all.fetch("include/#{file}.html"))) }
exit(@failed ? 1 : 0)

# SPDX-License-Identifier: MIT
require 'cgi'
require 'csv'
require 'fileutils'

# The pages of the site: documents as mkdocs reads them, and every file of the project
# that one of them links to.
class Pages
  LINK = /\]\(([^)#\s]+)(#[^)\s]*)?\)/.freeze
  HOME = 'web/site/home.md'.freeze
  # What is elsewhere on the site; mkdocs takes a README.md for a folder's first page.
  PLACES = { HOME => 'index.md', 'README.md' => 'overview.md', 'tools/tuner' => 'tuner/index.html' }.freeze
  CARD = 'docs/images/thermostat.png'.freeze # of a page without a picture
  DESCRIPTION = 160 # characters, which is what searches show

  # The files that a navigation, or a part of one, names.
  def self.named(part)
    case part
    when Hash then part.values.flat_map { |value| named(value) }
    when Array then part.flat_map { |value| named(value) }
    else [part]
    end
  end

  # Its documents by their places on the site.
  def self.navigation(part)
    case part
    when Hash then part.transform_values { |value| navigation(value) }
    when Array then part.map { |value| navigation(value) }
    else PLACES.fetch(part, part)
    end
  end

  def initialize(folder)
    @folder = folder
    @written = []
    @linked = []
  end

  # What the page tells about itself stands at its head, where HTML has it in quotation marks.
  def write(path, text, about)
    place = "#{@folder}/#{path}"
    FileUtils.mkdir_p(File.dirname(place))
    about = about.merge('description' => CGI.escapeHTML(about['description']))
    File.write(place, "#{YAML.dump(about)}---\n\n#{text}")
    @written << path
  end

  def document(path)
    text = File.read(path)
    picture = text[/\]\(([^)\s]+\.png)\)/, 1]
    card = picture ? whole(path, picture) : CARD
    place = PLACES.fetch(path, path)
    write(place, rewritten(path, text), 'description' => Pages.description(text), 'card' => card,
                                        'hide' => place == 'index.md' ? %w[navigation toc] : [])
  end

  def header(path, names)
    page = Header.new(path, names, Functions.new(@linked))
    write("#{path}.md", page.page, 'description' => Pages.description(page.about), 'card' => CARD)
  end

  # The first paragraph of a document in plain words, as far as they are whole.
  def self.description(text)
    paragraph = text.gsub(/^```.*?^```$|<!--.*?-->/m, '').split(/\n{2,}/).map { |part| part.sub(/\A\n+/, '') }
                    .find { |part| part.match?(/\A[*]{0,2}[A-Z`\[a-z]/) && part.match?(/[.:]/) }
    words = paragraph.gsub(/\{ \.\w+ \}\z/, '').gsub(/!?\[([^\]]*)\]\([^)]*\)/, '\1').gsub(/`|[*]{2}/, '').split
    whole = words.join(' ')
    return whole if whole.size <= DESCRIPTION

    whole[0...DESCRIPTION][/\A.*[.](?= )/] || "#{whole[0...(DESCRIPTION - 1)][/\A.*(?= )/].sub(/[,;:]\z/, '')}…"
  end

  # Pages of files that are no documents, until no page links to a new one.
  def follow_links
    until (wanted = @linked.uniq.reject { |path| @written.include?("#{path}.md") }).empty?
      wanted.each do |path|
        write("#{path}.md", File.directory?(path) ? listing(path) : source(path),
              'description' => "#{path} of fixpid, as it is in the sources.", 'card' => CARD, 'source' => true)
      end
    end
  end

  private

  # Its links to files go to their pages. Lists begin after an empty line, no comment
  # stands before a table, and each column of one has a name for those who hear it.
  def rewritten(path, text)
    text = text.gsub(LINK) { "](#{address(path, $1)}#{$2})" }
    outside_of_code(text) { |prose| named_columns(lists(prose.gsub(/^<!--.*?-->\n/m, "\n").gsub(/<!--.*?-->/m, ''))) }
  end

  def named_columns(text)
    text.gsub(/^\| *\|(.*\n\|[ :|-]+\n)/) { "| <span class=\"unseen\">name</span> |#{$1}" }
  end

  def address(path, link)
    return link if link.match?(/\A[a-z]+:/)

    target = whole(path, link)
    up = '../' * PLACES.fetch(path, path).count('/')
    return "#{up}#{PLACES.fetch(target, target)}" if PLACES.key?(target) || target.match?(/\.(?:md|png)\z/)

    @linked << target unless target.match?(%r{\Ainclude/\w+\.h\z})
    "#{up}#{target}.md"
  end

  # A link from the project's folder on.
  def whole(path, link)
    File.expand_path(File.join(File.dirname(path), link), '/').delete_prefix('/')
  end

  def outside_of_code(text)
    text.split(/(^```.*?^```$)/m).map { |part| part.start_with?('```') ? part : yield(part) }.join
  end

  def lists(text)
    in_list = false
    text.lines.each_cons(2).map do |line, following|
      in_list = line.match?(/\A *(?:[*-]|\d+\.) /) || (in_list && line != "\n")
      starts = following.match?(/\A(?:[*-]|\d+\.) /) && !in_list && line != "\n"
      starts ? "#{line}\n" : line
    end.push(text.lines.last).join
  end

  LANGUAGES = { '.c' => 'c', '.h' => 'c', '.cc' => 'cpp', '.py' => 'python', '.rb' => 'ruby' }.freeze

  def source(path)
    return table(path) if path.end_with?('.csv')

    "# #{File.basename(path)}\n\n`#{path}`\n\n````#{LANGUAGES.fetch(File.extname(path), 'text')}\n#{File.read(path)}````\n"
  end

  # Words in backticks are code, as in a document.
  def table(path)
    head, *rows = CSV.read(path).map { |row| row.map { |cell| CGI.escapeHTML(cell.to_s).gsub(/`([^`]+)`/, '<code>\1</code>') } }
    body = rows.map { |row| "<tr>#{row.map { |cell| "<td>#{cell}</td>" }.join}</tr>\n" }.join
    "# #{File.basename(path)}\n\n`#{path}`\n\n<table data-sorted>\n<thead><tr>#{head.map { |name| "<th>#{name}</th>" }.join}</tr></thead>\n<tbody>\n#{body}</tbody>\n</table>\n"
  end

  def listing(folder)
    files = Dir.children(folder).sort.map { |name| "#{folder}/#{name}" }
    @linked.concat(files)
    "# #{folder}\n\n#{files.map { |file| "* [#{File.basename(file)}](#{File.basename(folder)}/#{File.basename(file)}.md)\n" }.join}"
  end
end

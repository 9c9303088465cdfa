# SPDX-License-Identifier: MIT
require 'cgi'
require 'fileutils'

# The pages of the site: documents as mkdocs reads them, and every file of the project
# that one of them links to.
class Pages
  LINK = /\]\(([^)#\s]+)(#[^)\s]*)?\)/.freeze

  def initialize(folder)
    @folder = folder
    @written = []
    @linked = []
  end

  def write(path, text)
    place = "#{@folder}/#{path}"
    FileUtils.mkdir_p(File.dirname(place))
    File.write(place, text)
    @written << path
  end

  def document(path)
    write(path, rewritten(path, File.read(path)))
  end

  # Pages of files that are no documents, until no page links to a new one.
  def follow_links
    until (wanted = @linked.uniq.reject { |path| @written.include?("#{path}.md") }).empty?
      wanted.each { |path| write("#{path}.md", File.directory?(path) ? listing(path) : source(path)) }
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
    return link if link.match?(/\A[a-z]+:|\.(?:md|png)\z/)

    target = File.join(File.dirname(path), link).delete_prefix('./')
    target = File.expand_path(target, '/').delete_prefix('/')
    @linked << target unless target.match?(%r{\Ainclude/\w+\.h\z})
    up = '../' * path.count('/')
    "#{up}#{target}.md"
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
    "# #{File.basename(path)}\n\n`#{path}`\n\n````#{LANGUAGES.fetch(File.extname(path), 'text')}\n#{File.read(path)}````\n"
  end

  def listing(folder)
    files = Dir.children(folder).sort.map { |name| "#{folder}/#{name}" }
    @linked.concat(files)
    "# #{folder}\n\n#{files.map { |file| "* [#{File.basename(file)}](#{File.basename(folder)}/#{File.basename(file)}.md)\n" }.join}"
  end
end

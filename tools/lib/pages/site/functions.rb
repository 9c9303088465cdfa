# SPDX-License-Identifier: MIT
require 'cgi'
require_relative '../../data_tables'

# What a page tells of a function beside its comment: arguments, result, what a call costs, and
# five lines of a program that calls it.
class Functions
  DECLARED = /^(?<result>[\w ]*?[ *])(?<name>fixpid_\w+)\((?<arguments>[^)]*)\)/.freeze
  RANGES = { 'int16_t' => '-32768 to 32767', 'uint16_t' => '0 to 65535', 'uint8_t' => '0 to 255', 'int32_t' => '-2147483648 to 2147483647',
             'uint32_t' => '0 to 4294967295', 'bool' => 'true or false' }.freeze
  RESULT = /\b(?:returns?|result|False|True|refused?)\b/.freeze
  # Its row in a table of tools/cost.
  STEPS = { 'fixpid_pid_step' => 'PID', 'fixpid_an937_step' => 'AN937', 'fixpid_an964_step' => 'AN964',
            'fixpid_an964_8bit_step' => 'AN964 8-bit' }.freeze
  MODULES = { 'fixpid_slew_step' => 'slew', 'fixpid_tpo_step' => 'tpo', 'fixpid_guard_step' => 'guard', 'fixpid_table_at' => 'table, at',
              'fixpid_gains_from_milli' => 'gains, from_milli', 'fixpid_gains_to_milli' => 'gains, to_milli',
              'fixpid_record_pack' => 'record, pack', 'fixpid_record_unpack' => 'record, unpack', 'fixpid_pid_track' => 'pid, track',
              'fixpid_pid_step_error' => 'pid, step_error', 'fixpid_pid_set_limits' => 'pid, set_limits',
              'fixpid_pid_set_integral_limits' => 'pid, set_integral_limits',
              'fixpid_autotune_step' => 'autotune, ordinary step' }.freeze
  BUILDS = { 'PIC18F4520' => 'pointer', 'ATmega328P' => '-O2', 'Cortex-M0' => '-O2', 'Cortex-M4' => '-O2' }.freeze
  # Programs, the simplest first; a test where no program calls it.
  PROGRAMS = [%w[examples/quick_start.c], Dir['examples/recipes/*.c'].sort, Dir['examples/*/*.c'].sort - Dir['examples/recipes/*.c'],
              Dir['test/unit/test_fixpid_*.c'].sort].flatten.freeze
  LINES = 5

  # `used` is told the files that the page links to.
  def initialize(used)
    @used = used
    @programs = PROGRAMS.to_h { |path| [path, File.readlines(path, chomp: true)] }
  end

  def about(code, comment)
    match = code.join("\n").match(DECLARED)
    [table(match, comment), example(match[:name])].join("\n")
  end

  private

  def table(match, comment)
    rows = arguments(match[:arguments]).map { |name, type| ["<code>#{name}</code>", type] }
    rows << ['result', result(match[:result].strip, comment)] << ['cost', cost(match[:name])]
    "<table class=\"call\"><tbody>#{rows.map { |name, what| "<tr><th scope=\"row\">#{name}</th><td>#{what}</td></tr>" }.join}</tbody></table>\n"
  end

  def arguments(text)
    text.split(',').map { |argument| argument.split.join(' ') }.reject { |argument| argument == 'void' }.map do |argument|
      type, name = argument.match(/\A(.*?)(\w+)(?:\[\w*\])?\z/).captures
      [name, described(type.delete_prefix('FIXPID_DATA ').strip)]
    end
  end

  def described(type)
    range = RANGES[type]
    text = "<code>#{CGI.escapeHTML(type)}</code>"
    return "#{text}: #{range}, as far as the text above allows" if range

    text + (type.start_with?('const') ? ', which is only read' : '')
  end

  # What the comment says of it.
  def result(type, comment)
    return 'none' if type == 'void'

    said = Blocks.comment(comment).split(/(?<=[.:])\s+(?=[A-Z])/).grep(RESULT).grep_v(/ {2}|\n/).first(2)
    said = said.map { |sentence| sentence[0, 200] == sentence ? sentence : nil }.compact.join(' ')
    "<code>#{type}</code>#{": #{CGI.escapeHTML(said.delete('`'))}" unless said.empty?}"
  end

  def cost(name)
    rows = measured(name).select { |row| BUILDS[row['chip']] == row['built'] }
    return 'not measured by itself: see <a href="../docs/cost.html">what it costs</a>' if rows.empty?

    words = rows.map do |row|
      unit = row['chip'].start_with?('Cortex') ? 'instructions' : 'cycles'
      "#{row['chip']} #{row['bound'] == '-' ? "#{row['worst found']} #{unit}, the worst found" : "at most #{row['bound']} #{unit}"}"
    end
    "#{words.join('; ')} (<a href=\"../docs/cost.html\">all builds</a>)"
  end

  def measured(name)
    table, row_name = STEPS.key?(name) ? ['cost_steps', STEPS[name]] : ['cost_modules', MODULES[name]]
    return [] unless row_name

    rows = DataTables.hashes(table).select { |row| row.values.first == row_name }
    rows.empty? ? abort("#{DataTables.path(table)} has no row of #{row_name}") : rows
  end

  # The lines about its first call.
  def example(name)
    @programs.each do |path, lines|
      at = lines.index { |line| line.match?(/\b#{name}\(/) && !line.match?(%r{^//|^ *//|^#|^[a-z].*\) *\{?$}) }
      next unless at

      first = [at - LINES / 2, 0].max
      shown = lines[first, LINES]
      indent = shown.reject(&:empty?).map { |line| line[/\A */].size }.min
      return "<p>In #{place(path)}:</p>\n<div class=\"highlight example\"><pre><code>" \
             "#{CGI.escapeHTML(shown.map { |line| line[indent..] }.join("\n")).gsub("\n\n", "\n&#8203;\n")}</code></pre></div>\n"
    end
    abort "nothing calls #{name}"
  end

  # A program has a page, a test has none.
  def place(path)
    name = "<code>#{path}</code>"
    return name if path.start_with?('test/')

    @used << path
    "<a href=\"../#{path}.html\">#{name}</a>"
  end
end

# SPDX-License-Identifier: MIT
# The numbers in the sentences of README.md and of the site's first page. Each stands behind
# its name, as in `<!-- proofs -->375`, and comes from a table that a tool makes.
module Numbers
  NAMED = /<!-- (\w+) -->\K\d+/.freeze
  README = 'README.md'.freeze
  HOME = 'web/site/home.md'.freeze
  AVR = 'ATmega328P'.freeze

  class << self
    def renewed(text)
      text.gsub(NAMED) { |old| all.fetch($1, old).to_s }
    end

    def failures
      named = [README, HOME].to_h { |path| [path, File.read(path).scan(NAMED).flatten] }
      named.flat_map { |path, names| (names - all.keys).map { |name| "#{path}: no number is called #{name}" } } +
        (all.keys - named[README]).map { |name| "#{README} does not say the number of #{name}" }
    end

    # The cells of a table by the names of their columns; the first one has none.
    def table(page, name)
      text = File.read(page)[/<!-- #{name}:begin -->\n(.*?)<!-- #{name}:end -->/m, 1]
      head, _, *rows = text.lines.map { |line| line.split('|')[1...-1].map(&:strip) }
      rows.map { |cells| head.zip(cells).to_h }
    end

    private

    def all
      costs.merge(claims, tuner, 'chips' => chips.size, 'minutes' => minutes)
    end

    # The bounds of our steps, and the worst that was found of the other's.
    def costs
      ours = table('docs/cost.md', 'steps').select { |row| row.values_at('chip', 'built') == [AVR, '-O2'] }
                                           .to_h { |row| [row[''], row['bound'].to_i] }
      others = table('docs/cost.md', 'beside').to_h { |row| [row[''][/\S+/], row["#{AVR} -O2"][/\d+\z/].to_i] }
      { 'typical' => ours['PID, typical'], 'full' => ours['PID'], 'fastpid' => others['FastPID'] }
    end

    def claims
      rows = table('docs/assurance.md', 'claims')
      proved = rows.select { |row| row[''] == 'proved' && row['claim'].start_with?('`fixpid_') }
      amounts = rows.map { |row| row['of how much'] }.join("\n")
      { 'proofs' => proved.sum { |row| row['of how much'][/\d+(?= proofs)/].to_i },
        'rows' => amounts[/\d+(?= recorded steps)/].to_i, 'faults' => amounts[/\d+(?= faults here)/].to_i,
        'plants' => amounts[/\d+(?= random plants)/].to_i }
    end

    # Gains are those of the rule and the word to take first; no word's loop may be
    # unstable.
    def tuner
      ours = table('docs/tuning.md', 'study').select { |row| row['tuner'] == '`fixpid_autotune`' }
      { 'tuned' => ours.find { |row| row['rule'] == 'PI safe' }['plants with gains'].to_i,
        'unstable' => ours.sum { |row| row['unstable'].to_i } }
    end

    # A chip may have several rows, one for each memory model.
    def chips
      %w[exact families].flat_map { |name| table('docs/chips.md', name) }.map { |row| row[''][/[^,]+/] }.uniq
    end

    # Of all parts together, on two cores.
    def minutes
      seconds = File.readlines('test/parts.txt').grep(/^[a-z]/).grep_v(/ by name: /)
                    .map { |line| line.split[2].to_i }
      (seconds.sum + 30) / 60
    end
  end
end

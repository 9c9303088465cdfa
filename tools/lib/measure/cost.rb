# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Measures what the controllers cost. Called by tools/cost:
# cost.rb MODE ROOT WORD...
require 'etc'

require_relative '../named_figures'
require_relative 'host'
require_relative 'subjects'
require_relative 'meters'
require_relative 'tables'
require_relative 'limits'
require_relative 'documents'
require_relative 'picture'
require_relative 'firmware'
require_relative 'modules'
require_relative 'features'
require_relative 'daily'
require_relative 'documented'
require_relative 'together'
require_relative 'anti_windup'

Encoding.default_external = 'UTF-8'

# What measures a part, or all of it but what is left out, which is as documented.
class Cost
  def initialize(subjects, modules, left_out = [])
    @subjects = subjects
    @modules = modules
    @left_out = left_out
    @done = 0
    @mutex = Mutex.new
  end

  def print
    puts Tables.plain(Tables.steps(measured)) if @subjects.any?
    puts Tables.plain(Tables.modules(called)) if @modules.any?
  end

  def print_beside
    puts Tables.plain(Tables.rivals(measured, AntiWindup.figures))
  end

  def print_all
    parts = all_parts
    parts.each { |_, _, rows| puts Tables.plain(rows), '' }
    Picture.new(measured).draw
    puts 'picture: build/cost/cost.png and .svg'
    limits.all.all?(&:kept?)
  end

  # A line for each figure that is kept and for each table.
  def check
    good = limits.all.map { |limit| tell(limit.good?, limit.what, limit.wrong) }
    all_parts.each do |document, name, rows|
      changes = Document.of(document, Host.root).replace(name, rows)
      good << tell(changes.empty?, "#{name} of #{document}", *changes)
    end
    stale = NamedFigures.stale(named, Host.root)
    good << tell(stale.empty?, NamedFigures::FILE, *stale)
    warn 'cost: tools/cost --update renews the tables, --tighten and --loosen the limits' unless good.all?
    good.all?
  end

  def tighten
    puts limits.tighten
  end

  def loosen(words)
    puts limits.loosen(words)
  end

  # Keeps each dearer sequence that a long search finds.
  def search(seed)
    kept = Kept.all
    subjects = @subjects + @subjects.select(&:has_plain_c?).map(&:plain_c)
    Host.in_parallel(subjects) do |subject|
      found = Meter.of(subject).search(seed).found
      @mutex.synchronize { keep(kept.find { |one| one.name == subject.controller.name }, subject, found) }
    end
  end

  def update
    all_parts.group_by(&:first).each do |path, parts|
      document = Document.of(path, Host.root)
      parts.each { |_, name, rows| puts document.replace(name, rows) }
      document.write
    end
    NamedFigures.keep(named, Host.root)
    Picture.new(measured).draw
    FileUtils.cp("#{Host.folder}/cost.png", "#{Host.root}/docs/images/cost.png")
    limits.all.reject(&:good?).each { |limit| tell(false, limit.what, limit.wrong) }.empty?
  end

  private

  # A run that is interrupted has kept what it found.
  def keep(kept, subject, found)
    return puts "#{subject}: #{found.own} is kept" if found.best.zero?

    kept.replace(subject.key, found.steps)
    kept.write
    puts "#{subject}: #{found.best} found, #{found.own.zero? ? 'nothing' : found.own} was kept"
  end

  def tell(good, what, *why)
    puts good ? "ok #{what}" : "FAILED #{what}"
    puts(why.map { |line| "    #{line}" }) unless good
    good
  end

  def measured
    @measured ||= known(@subjects, :figures) { |some| in_parallel(some, &:figures) }
  end

  # The figures of the modules' functions.
  def called
    @called ||= known(@modules, :called) { |some| Host.in_parallel(some) { |one| ModuleMeter.of(one).figures } }
  end

  # In their order: what the block measures, and what is documented of those that are left out.
  def known(all, what)
    now = all - @left_out
    measured = now.zip(yield(now)).to_h
    all.to_h { |one| [one, measured.fetch(one) { documented.public_send(what, one) }] }
  end

  def documented
    @documented ||= Documented.new
  end

  # What each feature of fixpid_pid costs.
  def prices
    @prices ||= begin
      all = Features.all
      all.zip(Host.in_parallel(all) { |one| Meter.of(one.subject).of_code }).to_h
    end
  end

  # Of each firmware with controller, guard and table.
  def together
    @together ||= Together.all.to_h { |one| [one, one.sizes] }
  end

  def plain_c
    @plain_c ||= known(@subjects.select(&:has_plain_c?), :plain_c) { |some| in_parallel(some.map(&:plain_c), &:most) }
  end

  def in_parallel(subjects)
    Host.in_parallel(subjects) do |subject|
      found = yield(Meter.of(subject))
      @mutex.synchronize { progress }
      found
    end
  end

  def progress
    @done += 1
    warn "cost: #{@done} of #{@total ||= (@subjects - @left_out).then { |some| some.size + some.count(&:has_plain_c?) }}" if (@done % 10).zero?
  end

  def limits
    @limits ||= Limits.new(measured, called, plain_c, left_out: @left_out)
  end

  # Daily none and all of them are measured, as PID, typical and PID.
  def features
    @left_out.empty? ? [[DataTables::FOLDER, 'features', Features.table(prices)]] : []
  end

  # What docs/figures.json has of it.
  def named
    Tables.named(measured, called)
  end

  def all_parts
    [*files.map { |name, rows| [DataTables::FOLDER, "cost_#{name}", rows] },
     *features,
     ['docs/cost.md', 'summary', Tables.summary(measured)],
     ['docs/recipes.md', 'masked', Tables.masked(called)],
     ['README.md', 'rivals', Tables.rivals(measured, AntiWindup.figures)]]
  end

  def files
    { 'steps' => Tables.steps(measured), 'modules' => Tables.modules(called), 'together' => Together.table(together),
      'ratios' => Tables.ratios(measured, plain_c), 'beside' => Tables.beside(measured), 'pics' => Tables.beside_pics(measured),
      'quality' => Tables.quality, 'limits' => Tables.limits(limits.others) }
  end
end

# The user's words do not name anything.
class WrongUse < StandardError; end

def chosen(words)
  unknown = words.reject { |word| Subject.kind_of_word(word) }
  raise WrongUse, "nothing is called #{unknown.join(', ')} (see --help)" if unknown.any?

  subjects = Subject.all.select { |one| one.matches?(words) }
  modules = ModuleSubject.all.select { |one| one.matches?(words) }
  raise WrongUse, "nothing is #{words.join(' ')} (see --help)" if subjects.empty? && modules.empty?

  [subjects, modules]
end

# MODE ROOT WORD..., `search` ROOT SEED WORD..., or `words WORD...`: only whether something is called so.
def main(mode, root = nil, *words)
  return chosen([root, *words].compact) if mode == 'words'

  Host.setup(root)
  return UserFirmware.new(*words).print if mode == 'firmware'

  seed = words.shift if mode == 'search'
  cost = Cost.new(*chosen(mode == 'loosen' ? [] : words), mode == 'daily' ? Daily.left_out + Daily.modules_left_out : [])
  case mode
  when 'check', 'daily' then cost.check
  when 'update' then cost.update
  when 'search' then cost.search(seed)
  when 'tighten' then cost.tighten
  when 'loosen' then cost.loosen(words)
  when 'beside' then cost.print_beside
  else words.empty? ? cost.print_all : cost.print
  end
end

begin
  $stdout.sync = true
  exit(main(*ARGV) == false ? 1 : 0)
rescue WrongUse => e
  warn "cost: #{e.message}"
  exit 2
rescue Host::Failure, SystemCallError => e
  warn "cost: #{e.message}"
  exit 1
rescue SignalException
  Host.stop_all
  warn 'cost: interrupted'
  exit 130
end

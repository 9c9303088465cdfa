# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative 'published'

# The figures as tables: rows of cells, the head first.
module Tables
  HEAD = ['controller', 'chip', 'built', 'least', 'mean', 'worst found', 'bound', 'bound in cycles', 'flash of the step', 'with init', 'linked',
          'RAM each', 'RAM once', 'stack'].freeze
  # Of the comparisons with others.
  COLUMNS = { 'atmega328p-O2' => 'ATmega328P -O2', 'atmega328p-Os' => 'ATmega328P -Os',
              'cortex-m0-O2' => 'Cortex-M0 -O2', 'cortex-m4-O2' => 'Cortex-M4 -O2',
              'rv32imc-O2' => 'RV32IMC -O2' }.freeze
  SUMMARY = { 'pic16f684' => 'object', 'pic18f4520' => 'object', 'atmega328p' => '-O2', 'cortex-m0' => '-O2', 'cortex-m4' => '-O2',
              'rv32imc' => '-O2' }.freeze # what one would build
  NAMED = { 'typical' => 'pid_typical', 'full' => 'pid' }.freeze # in sentences
  PIC_COLUMNS = { 'pic16f684' => 'PIC16F684', 'pic18f4520' => 'PIC18F4520' }.freeze
  QUALITY_HEAD = ['library', 'anti-windup', 'overshoot', 'settled after', 'sum of errors', 'error left', 'back after',
                  'sum until then', 'error left, low gains'].freeze
  # Of README.md: in our builds what most need, and all.
  OURS = { 'pid_typical' => '`fixpid_pid`, no features', 'pid' => '`fixpid_pid`, all features' }.freeze
  RIVALS_HEAD = ['', 'overshoot', 'back after', 'cycles', 'flash'].freeze

  class << self
    def steps(measured)
      [HEAD] + measured.map { |subject, figures| step(subject, figures) }
    end

    # What one would build on a chip of each kind: bounds in cycles, and flash.
    def summary(measured)
      shown = CONTROLLERS.reject { |one| one.id == 'pid_plain' }
      rows = SUMMARY.map do |name, build|
        chip = CHIPS.find { |one| one.name == name }
        cells = shown.map { |one| find(measured, one.id, name, build).then { |all| all ? "#{in_cycles(all)}; #{all.needed}" : '-' } }
        ["#{chip.title}, #{build}#{', flash in words' if chip.flash == 'words'}", *cells]
      end
      ram = shown.map { |one| find(measured, one.id, 'atmega328p', '-O2').instance }
      [['cycles at most; bytes of flash', *shown.map(&:title)], *rows, ['bytes of RAM, ATmega328P', *ram]]
    end

    # What stands beside a controller, a row for each function.
    def modules(called)
      [['function', 'chip', 'built', 'least', 'mean', 'worst found', 'bound', 'bound in cycles', 'flash', 'RAM each']] + called.flat_map do |subject, functions|
        functions.map do |name, figures|
          [subject.title_of(subject.called.functions.fetch(name)), subject.chip.title, subject.build, figures.least, figures.mean, figures.most,
           figures.bound || '-', in_cycles(figures), subject.chip.flash == 'words' ? "#{figures.flash} words" : figures.flash,
           figures.instance]
        end
      end
    end

    # How long new gains without a bump keep an interrupt waiting.
    def masked(called)
      shown = [%w[pic18f4520 pointer], %w[atmega328p -Os], %w[cortex-m0 -O2]]
      [['chip', 'built', 'at most, in cycles']] + shown.map do |chip, build|
        subject, functions = called.find { |one, all| one.chip.name == chip && one.build == build && all.key?('pid_change') }
        [subject.chip.title, build, in_cycles(functions['pid_change'])]
      end
    end

    # Ours, then the others'.
    def beside(measured)
      ours = own_rows(measured, COLUMNS).map do |controller, name, cells|
        small = find(measured, controller.id, 'atmega328p', '-Os', name)
        [*cells, small&.needed || '-', small&.instance || '-']
      end
      others = other_rows(PEERS, COLUMNS).map { |other, cells| [*cells, other.flash || '-', other.ram || '-'] }
      [['library', *COLUMNS.values, 'flash, ATmega328P -Os', 'RAM']] + ours + others
    end

    # The same on the PICs, with the notes' own programs.
    def beside_pics(measured)
      ours = own_rows(measured, PIC_COLUMNS).map(&:last)
      [['program', *PIC_COLUMNS.values]] + ours + other_rows(NOTES + PEERS, PIC_COLUMNS).map(&:last)
    end

    def quality
      [QUALITY_HEAD] + QUALITY
    end

    # The worst found against that of the straightforward form: { subject => its worst }.
    def ratios(measured, plain_c)
      [['controller', 'chip', 'built', 'fixpid', 'straightforward', 'ratio']] + plain_c.map do |subject, most|
        [subject.controller.title, subject.chip.title, subject.build, measured.fetch(subject).most, most,
         format('%.2f', measured.fetch(subject).most.fdiv(most))]
      end
    end

    def limits(limits)
      [['what', 'at most', 'now']] + limits.map(&:cells)
    end

    # Ours, from a loop that is closed here, a bound and the flash; and what is published of others.
    def rivals(measured, loop)
      ours = OURS.map do |id, title|
        small = find(measured, id, 'atmega328p', '-Os')
        [title, loop['overshoot'], loop['back'], small.bound, small.needed]
      end
      [RIVALS_HEAD] + ours + RIVALS.map do |title, (peer, quality)|
        other = PEERS.find { |one| one.title == peer }
        row = QUALITY.find { |one| one.first == quality }
        [title, row[2], row[6], other.worst('atmega328p-Os'), other.flash]
      end
    end

    # What sentences of the documents say, by the names of docs/figures.json.
    def named(measured, called)
      on_avr = NAMED.transform_values { |id| find(measured, id, 'atmega328p', '-O2').bound }
      stream = called.find { |subject, _| subject.called.functions.value?('stream only, step') && subject.chip.name == 'pic18f4520' }
      { **on_avr, **beside_others(measured), 'fastpid' => PEERS.find { |peer| peer.title.start_with?('FastPID') }.worst('atmega328p-O2'),
        'link_stream_flash' => stream.last.fetch('fixpid_link_step').flash }
    end

    def markdown(rows)
      lines = [rows.first, rows.first.map { '---' }] + rows.drop(1)
      lines.map { |cells| "| #{cells.join(' | ')} |\n" }.join
    end

    def plain(rows)
      widths = rows.transpose.map { |column| column.map { |cell| cell.to_s.size }.max }
      rows.map { |row| row.zip(widths).map { |cell, width| cell.to_s.ljust(width) }.join('  ').rstrip }
    end

    def find(measured, controller, chip, build, variant = nil)
      measured.find do |subject, _|
        subject.controller.id == controller && subject.chip.name == chip && subject.build == build &&
          subject.variant&.name == variant
      end&.last
    end

    private

    # What stands beside others' figures: the worst steps found, and the flash.
    def beside_others(measured)
      NAMED.flat_map do |name, id|
        [["#{name}_m4", find(measured, id, 'cortex-m4', '-O2').most], ["#{name}_rv32imc", find(measured, id, 'rv32imc', '-O2').most],
         ["#{name}_linked", find(measured, id, 'atmega328p', '-Os').linked]]
      end.to_h
    end

    # "235", or with the slow multiplier of a Cortex-M0 "235 or 359".
    def in_cycles(figures)
      (figures.cycles || [figures.bound || '-']).uniq.join(' or ')
    end

    def step(subject, figures)
      [subject.controller.title, subject.chip.title, subject.built, figures.least, figures.mean.round, figures.most,
       figures.bound, in_cycles(figures), "#{figures.step_flash} #{subject.chip.flash}", figures.needed, figures.linked,
       figures.instance, figures.fixed, stack(subject.chip, figures)]
    end

    def stack(chip, figures)
      return "#{figures.stack} bytes" unless chip.kind == :pic

      levels = "#{figures.levels} levels"
      figures.stack.zero? ? levels : "#{levels}, #{figures.stack} bytes"
    end

    # nil for the plain build, first, and the names of the others.
    def variants(measured, controller)
      own = measured.keys.select { |subject| subject.controller == controller }
      [nil] + own.map { |subject| subject.variant&.name }.compact.uniq
    end

    # [controller, variant, cells] of what has a cell in these columns.
    def own_rows(measured, columns)
      rows = CONTROLLERS.flat_map { |one| variants(measured, one).map { |name| [one, name] } }
      rows.map { |controller, name| [controller, name, own_cells(measured, controller, name, columns)] }
          .select { |_, _, cells| (cells.drop(1) - ['-']).any? }
    end

    def own_cells(measured, controller, name, columns)
      costs = columns.keys.map do |column|
        chip, option = column.split(/(?=-O)/)
        figures = find(measured, controller.id, chip, option || 'object', name)
        figures ? "#{figures.mean.round} / #{figures.most}" : '-'
      end
      ["fixpid #{[controller.title, name].compact.join(', ')}", *costs]
    end

    def other_rows(others, columns)
      others.select { |other| (columns.keys & other.costs.keys).any? }
            .map { |other| [other, [other.title, *columns.keys.map { |column| other.shown(column) }]] }
    end
  end
end

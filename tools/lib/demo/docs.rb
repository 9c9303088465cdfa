# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The parts of the documents that come from the demo's runs.
module Docs
  BEGIN_MARK = '<!-- tuning:begin -->'
  END_MARK = '<!-- tuning:end -->'
  PICTURES = %w[pendulum motor oven tuning chip].freeze

  class << self
    # True unless mode asks for a check that fails.
    def update(mode, root)
      return true if mode == 'run'

      path = "#{root}/docs/tuning.md"
      text = File.read(path)
      renewed = with_table(text)
      return compare(path, text, renewed) if mode == 'check-docs'

      Report.replace(path, renewed)
      copy_pictures(root)
      true
    end

    private

    def compare(path, text, renewed)
      return true if text == renewed

      warn "demo: #{path} is stale; tools/demo --docs renews it"
      false
    end

    def copy_pictures(root)
      FileUtils.mkdir_p("#{root}/docs/images")
      PICTURES.each do |name|
        FileUtils.cp("#{Host.folder}/#{name}.png", "#{root}/docs/images")
      end
    end

    def with_table(text)
      head, rest = text.split(BEGIN_MARK, 2)
      tail = rest&.split(END_MARK, 2)&.last
      tail or raise Host::Failure, 'docs/tuning.md has lost its markers'
      [head, BEGIN_MARK, "\n", table, END_MARK, tail].join
    end

    def table
      rows = ['| step | KP | KI | KD | upright | base moves | ' \
              'base reverses | swing at the end |',
              '|---|---|---|---|---|---|---|---|']
      rows += STAGES.map { |stage| row(stage, Report.numbers['tuning']) }
      "#{rows.join("\n")}\n"
    end

    def row(stage, numbers)
      upright, base, reversals, swing =
        %w[upright_s base_m reversals swing_degrees]
        .map { |what| numbers["#{stage.name}_#{what}"] }
      ['', stage.steps, stage.kp, stage.ki, stage.kd,
       upright < TUNING_S ? format('%.2f s', upright) : 'to the end',
       format('%.2f m', base), times(reversals),
       swing ? format('%.1f degrees', swing) : 'fallen', ''].join(' | ').strip
    end

    def times(count)
      { 0 => 'never', 1 => 'once' }.fetch(count, "#{count} times")
    end
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require_relative '../data_tables'
require_relative '../named_figures'
require_relative 'tables'

# The parts of the documents that come from the demo's runs.
module Docs
  PICTURES = %w[anti_windup pendulum motor oven tuning thermostat autotune random_plants guard chip
                faults-pendulum faults-motor faults-oven faults-thermostat].freeze

  # Document, or the folder of tables, and by loop its parts with what makes each of them.
  PARTS = {
    'docs/tuning.md' => { 'tuning' => { 'tuning' => :tuning },
                          'autotune' => { 'gains' => :found_gains } },
    'docs/controller.md' => { 'recipes' => { 'saturations' => :saturations } },
    'docs/faults.md' => { 'faults' => { 'limits' => :fault_limits, 'staying_limits' => :staying_limits } },
    DataTables::FOLDER => { 'autotune' => { 'tuners_plants' => :autotune },
                            'random_plants' => { 'tuners_picture' => :random_plants, 'tuners_at_once' => :at_once },
                            'recipes' => { 'recipes' => :recipes },
                            'faults' => { 'faults' => :faults, 'faults_staying' => :staying },
                            'guard' => { 'faults_guard_sees' => :guard_sees, 'faults_guard_boiler' => :guard_boiler,
                                         'faults_guard_healthy' => :guard_healthy } }
  }.freeze
  # These tell of all that a loop has.
  WHOLE = %i[faults staying guard_sees guard_healthy].freeze

  # Made by tools/demo --long only, of these loops.
  LONG = { DataTables::FOLDER => { 'faults_long' => :long_faults, 'faults_places' => :fault_places,
                                   'tuners_study' => :study, 'tuners_families' => :study_families,
                                   'tuners_refusals' => :study_refusals,
                                   'tuners_machines' => :study_machines, 'tuners_heaters' => :study_heaters,
                                   'tuners_advice' => :study_advice },
           'docs/tuners.md' => { 'study' => :study_summary } }.freeze
  LONG_LOOPS = { long_faults: %w[faults faults_chip], fault_places: %w[faults_places] }.freeze

  class << self
    # True unless mode asks for a check that fails.
    def update(mode, root, loops)
      return true if %w[run renew].include?(mode)

      parts = Extent.long? ? long_parts(loops) : parts_of(loops)
      stale = parts.map { |name, parts| name == DataTables::FOLDER ? renew_tables(mode, root, parts) : renew(mode, "#{root}/#{name}", parts) }
      copy_pictures(root) if mode == 'docs'
      NamedFigures.keep(Tables.study_figures, root) if mode == 'long' && loops.include?('random_plants')
      stale.none?
    end

    private

    # Those of which enough was run.
    def parts_of(loops)
      PARTS.transform_values do |by_loop|
        by_loop.slice(*loops).values.reduce({}, :merge).select { |_, table| Extent.whole? || !WHOLE.include?(table) }
      end
    end

    # Those of which all loops were run.
    def long_parts(loops)
      LONG.transform_values { |tables| tables.select { |_, table| (LONG_LOOPS.fetch(table, %w[random_plants]) - loops).empty? } }
    end

    # True where a table is stale and stays so.
    def renew_tables(mode, root, parts)
      stale = parts.transform_values { |table| Tables.public_send(table) }.select { |name, rows| DataTables.difference(name, rows, root) }
      if mode == 'check-docs'
        stale.each_key { |name| warn "demo: #{DataTables.path(name)} is stale; tools/demo --docs renews it" }
        return stale.any?
      end
      stale.each { |name, rows| DataTables.write(name, rows, root) }
      false
    end

    # True where a document is stale and stays so.
    def renew(mode, path, parts)
      text = File.read(path)
      renewed = parts.reduce(text) do |so_far, (name, table)|
        with_part(path, so_far, name, Tables.public_send(table))
      end
      return false if renewed == text

      if mode == 'check-docs'
        warn "demo: #{path} is stale; tools/demo --docs renews it"
        return true
      end
      Report.replace(path, renewed)
      false
    end

    def copy_pictures(root)
      FileUtils.mkdir_p("#{root}/docs/images")
      [*PICTURES, *RECIPE_PICTURES.map { |name| recipe_name(name) }].each do |name|
        FileUtils.cp("#{Host.folder}/#{name}.png", "#{root}/docs/images")
      end
    end

    def with_part(path, text, name, table)
      begin_mark, end_mark = %w[begin end].map { |at| "<!-- #{name}:#{at} -->" }
      head, rest = text.split(begin_mark, 2)
      tail = rest&.split(end_mark, 2)&.last
      tail or raise Host::Failure, "#{path} has lost its markers"
      [head, begin_mark, "\n", table, end_mark, tail].join
    end
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require 'csv'

# The tables of docs/data: rows of cells, the head first.
module DataTables
  FOLDER = 'docs/data'

  class << self
    def path(name, root = '.')
      "#{root}/#{FOLDER}/#{name}.csv"
    end

    def read(name, root = '.')
      CSV.read(path(name, root))
    end

    def text(rows)
      rows.map(&:to_csv).join
    end

    # Whole or not at all.
    def write(name, rows, root = '.')
      path = path(name, root)
      File.write("#{path}.new", text(rows))
      File.rename("#{path}.new", path)
    end

    # The rows below the head, by its names; one that comes again has its place behind it.
    def hashes(name, root = '.')
      head, *rows = read(name, root)
      head = head.each_with_index.map { |title, at| head.index(title) == at ? title : "#{title} #{at}" }
      rows.map { |row| head.zip(row).to_h }
    end

    # The first line that is another one, and what it should be; nil if there is none.
    def difference(name, rows, root = '.')
      old = File.exist?(path(name, root)) ? read(name, root) : []
      new = rows.map { |row| row.map(&:to_s) }
      [old.size, new.size].max.times { |at| return [old[at], new[at]] if old[at] != new[at] }
      nil
    end
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# A break of a file. `source` is the whole text with the break in it.
Mutant = Struct.new(:file, :line, :place, :from, :to, :source) do
  def to_s
    "#{file}:#{line}: `#{from}` -> `#{to}`"
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# tools/lib/autotune/constants.rb: the header of the project is what it writes, and another
# is not, whichever of the two was changed.
require_relative 'gate'

TOOL = 'tools/lib/autotune/constants.rb'
HEADER = 'src/autotune/fixpid_autotune_constants.h'

# What it says in a folder where a file has another text, after these of its options.
def constants(path = nil, text = nil, instead = nil, *runs)
  files = [TOOL, HEADER].to_h { |name| [name, File.read("#{PROJECT}/#{name}")] }
  lambda do
    Gate.tree(files) do
      Gate.seed(path, text, instead) if path
      [*runs, []].map { |options| Gate.run('ruby', TOOL, *options) }.last
    end
  end
end

STALE = /#{HEADER} is stale: ruby #{TOOL} --update/

Gate.passed('the constants as they are', constants)
Gate.refused('a mantissa one off', constants(HEADER, '{36045u, -15}', '{36046u, -15}'), STALE)
Gate.refused('an exponent one off', constants(HEADER, '{40632u, -17}', '{40632u, -16}'), STALE)
Gate.refused('a name that is left out', constants(HEADER, "    C0_05,\n", ''), STALE)
Gate.refused('an origin by hand', constants(HEADER, 'where the search for R ends', 'where it ends'), STALE)
Gate.refused('another value in the tool', constants(TOOL, '0.31r =>', '0.32r =>'), STALE)
Gate.passed('another value, and written again', constants(TOOL, '0.31r =>', '0.32r =>', ['--update']))
Gate.finish

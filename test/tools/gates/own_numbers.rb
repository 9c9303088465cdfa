# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# tools/lib/prove/own_numbers.rb on a harness of one line, with a number of its own and with
# one of the source.
require_relative 'gate'

def numbers(harness)
  files = { 'src/toy/fixpid_toy.c' => "#define MOST 24u\n", 'test/proof/toy.c' => harness }
  -> { Gate.tree(files) { Gate.run('ruby', "#{PROJECT}/tools/lib/prove/own_numbers.rb") } }
end

Gate.passed('a harness with numbers of its own', numbers("#define MOST 24u\nclaim(x <= MOST);\n"))
Gate.refused('a number of the source', numbers("\nclaim(x <= MOST);\n"), %r{test/proof/toy\.c:2: MOST is a macro of src/toy/fixpid_toy\.c})
Gate.finish

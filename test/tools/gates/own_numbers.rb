# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# tools/lib/prove/own_numbers.rb on a harness of one line, with numbers of its own and
# with those of the source.
require_relative 'gate'

def numbers(harness, file: 'toy.c', source: "#define MOST 24u\n#define add(a, b) ((a) + (b))\n#ifndef FIXPID_TOY_H\n#define FIXPID_TOY_H\n#endif\n")
  files = { 'src/toy/fixpid_toy.c' => source, "test/proof/#{file}" => harness }
  -> { Gate.tree(files) { Gate.run('ruby', "#{PROJECT}/tools/lib/prove/own_numbers.rb") } }
end

Gate.passed('a harness with numbers of its own', numbers("claim(x <= 24u); // MOST\n"))
Gate.passed('a macro of the harness', numbers("#define MOST 24u\nclaim(x <= MOST);\n"))
Gate.passed('a function that is a macro on some chips', numbers("claim(add(1, 2) == 3);\n"))
Gate.passed('the guard of a form', numbers("#ifdef FIXPID_TOY_H\n#endif\n"))
Gate.refused('a number of the source', numbers("\nclaim(x <= MOST);\n"), %r{test/proof/toy\.c:2: MOST is a macro of src/toy/fixpid_toy\.c})
Gate.refused('a number in a condition', numbers("#if MOST > 23\n#endif\n"), /MOST is a macro/)
Gate.refused('a number in a theorem', numbers("claim(x <= MOST);\n", file: 'theorems/toy.c'), /MOST is a macro/)
Gate.refused('sources without a macro', numbers("claim(x);\n", source: "\n"), /defines no macro/)
Gate.finish

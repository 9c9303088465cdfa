# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# tools/lib/prove/harness_rules.rb on a harness of a few lines: with a number of the source,
# and with an assumption that holds of half of what its module is for.
require_relative 'gate'

DOMAIN = "// Domain: any.\nstatic bool toy_is_legal(int x)\n{\n    return true;\n}\n\n"

def harness(text)
  files = { 'src/toy/fixpid_toy.c' => "#define MOST 24u\n", 'test/proof/proofs.txt' => "toy any : step\n",
            'test/proof/toy.c' => "#{DOMAIN}void prove_step(void)\n{\n    assume(toy_is_legal(x));\n#{text}}\n" }
  -> { Gate.tree(files) { Gate.run('ruby', "#{PROJECT}/tools/lib/prove/harness_rules.rb") } }
end

Gate.passed('a harness with numbers of its own', harness("    const int y = nondet_int16();\n\n    assume(y >= 24);\n"))
Gate.refused('a number of the source', harness("    claim(x <= MOST);\n"), %r{test/proof/toy\.c:10: MOST is a macro of src/toy/fixpid_toy\.c})
Gate.refused('a narrowed assumption', harness("    assume(c.credit >= 0);\n"), %r{test/proof/toy\.c:10: assume.c\.credit >= 0. is no domain})
Gate.finish

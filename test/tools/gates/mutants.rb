# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# tools/lib/faults/mutants.rb on a library of two functions.
require_relative 'gate'

HEADER = "#ifndef FIXPID_TOY_H\n#define FIXPID_TOY_H\nint fixpid_toy_low(int x);\nint fixpid_toy_high(int x);\n#endif\n"
SOURCE = <<~TEXT
  #include "fixpid_toy.h"

  int fixpid_toy_low(int x)
  {
      int value = x;

      if (value < 0) {
          value = 0;
      }
      return value;
  }

  int fixpid_toy_high(int x)
  {
      int value = x;

      if (value > 9) {
          value = 0;
      }
      return value;
  }
TEXT
SAME = ['src/toy/fixpid_toy.c, fixpid_toy_low: if (value < 0) {: `<` -> `<=`',
        'src/toy/fixpid_toy.c, fixpid_toy_low: if (value < 0) {: `0` -> `1`'].freeze
LOW = "TEST_ASSERT_EQUAL_INT(0, fixpid_toy_low(-1));\nTEST_ASSERT_EQUAL_INT(2, fixpid_toy_low(2));"
HIGH = "TEST_ASSERT_EQUAL_INT(9, fixpid_toy_high(9));\nTEST_ASSERT_EQUAL_INT(0, fixpid_toy_high(10));"
FAULT = "unit test_high: src/toy/fixpid_toy.c, fixpid_toy_high: `value > 9` -> `value > 9 + (x == 10)`\n"

def test(low, high)
  "#include \"fixpid_toy.h\"\n#include \"unity.h\"\nvoid setUp(void)\n{\n}\nvoid tearDown(void)\n{\n}\n" \
    "void test_low(void)\n{\n#{low}\n}\nvoid test_high(void)\n{\n#{high}\n}\n"
end

PROJECT_FILE = ":project:\n  :build_root: build/ceedling\n  :use_mocks: FALSE\n:paths:\n  :test: [test/unit/**]\n" \
               "  :source: [src/**]\n  :include: [include/**]\n  :support: [test/support]\n"

def mutants(low: LOW, high: HIGH, equivalents: SAME, faults: FAULT)
  files = { 'project.yml' => PROJECT_FILE, 'include/fixpid_toy.h' => HEADER, 'src/toy/fixpid_toy.c' => SOURCE,
            'test/unit/test_fixpid_toy.c' => test(low, high), 'test/support/nothing.h' => '',
            'test/tools/mutants/equivalent.txt' => equivalents.map { |line| "#{line}\n" }.join, 'test/faults.txt' => faults }
  -> { Gate.tree(files) { Gate.run('ruby', "#{PROJECT}/tools/lib/faults/mutants.rb") } }
end

Gate.passed('tests that notice every break', mutants)
Gate.refused('a bound that nobody asks about', mutants(high: HIGH.lines.last, faults: ''),
             /Nobody notices: src.toy.fixpid_toy.c, fixpid_toy_high: if .value > 9. \{: `>` -> `>=`/, /^FAILED src.toy.fixpid_toy.c/)
Gate.refused('an equivalent for a line that is gone', mutants(equivalents: SAME + ['src/toy/fixpid_toy.c, fixpid_toy_low: value--;: `--` -> `++`']),
             /No longer true .*value--/)
Gate.refused('a fault that no test notices', mutants(faults: FAULT.sub('x == 10', 'x == 11')), /^FAILED test_high/)
Gate.finish

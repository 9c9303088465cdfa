# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# tools/lib/lint.rb on a library of one function, clean and with faults; and what else
# part lint asks of the sources.
require_relative 'gate'

def header(inline = '')
  "// SPDX-License-Identifier: MIT\n#ifndef FIXPID_TOY_H\n#define FIXPID_TOY_H\n#include <stdint.h>\n\n" \
    "uint8_t fixpid_toy_step(uint8_t value);\n#{inline}\n#endif\n"
end

# The library with these lines in its function; `before` stands above it.
def source(lines, before: '')
  "// SPDX-License-Identifier: MIT\n#include \"fixpid_toy.h\"\n\n#{before}uint8_t fixpid_toy_step(uint8_t value)\n{\n" \
    "#{lines.gsub(/^/, '    ')}    return value;\n}\n"
end

def lint(lines, *options, before: '', inline: '', programs: {}, settings: [])
  files = { 'include/fixpid_toy.h' => header(inline), 'src/fixpid_toy.c' => source(lines, before: before),
            '.clang-tidy' => File.read("#{PROJECT}/.clang-tidy"),
            'tools/lib/cppcheck.txt' => File.read("#{PROJECT}/tools/lib/cppcheck.txt") }
  files.merge!(programs.transform_keys { |name| "bin/#{name}" }.transform_values { |text| "#!/bin/sh\n#{text}\n" })
  lambda do
    Gate.tree(files) { |folder| Gate.run('env', *settings, 'ruby', "#{PROJECT}/tools/lib/lint.rb", *options, programs: "#{folder}/bin") }
  end
end

def quick(lines, **more)
  lint(lines, '--quick', **more)
end

def branches(count)
  (1..count).map { |number| "if (value == #{number}u) {\n    value++;\n}\n" }.join
end

long = "value++;\n" * 38
Gate.passed('a clean library', quick("value++;\n"))
Gate.refused('a warning', quick("int unused;\n"), /unused variable/)
Gate.refused('complexity 9', quick(branches(8)), /complexity 9 \(at most 8\)/)
Gate.refused('42 lines', quick(long), /42 lines \(at most 40\)/)
Gate.passed('42 lines with a reason', quick(long, before: "// Deviation 40 lines: a reason\n"))
Gate.refused('two conditions in a header',
             quick('', inline: "static inline uint8_t both(uint8_t a, uint8_t b)\n{\n" \
                               "    return (uint8_t)((a != 0u) || (b != 0u));\n}\n"),
             /include.fixpid_toy\.h.*two conditions in one decision/)
Gate.refused('a pmccabe that says nothing', quick('', programs: { 'pmccabe' => 'exit 0' }), /pmccabe sees 0 of 1 functions/)

# Of MISRA and clang-tidy: rule 17.8 is that a parameter stays what it is.
Gate.passed('a library that is clean for all', lint(''))
Gate.refused('a parameter changed, and a branch after a return',
             lint("if (value > 3u) {\n    return 3u;\n} else {\n    value = 2u;\n}\n"),
             /misra-c2012-17\.8/, /clang-tidy/, /else-after-return/)
Gate.passed('a parameter changed with a reason', lint("value = 2u; // Deviation 17.8: a reason\n"))
Gate.refused("a Python that cannot run cppcheck's addon", lint('', '--misra', settings: %w[PYTHON=/nowhere/python3]), /internal error.*nowhere/)
RULES = 'tools/lib/pages/docs/misra.rb'
rules = [RULES, 'tools/lib/data_tables.rb'].to_h { |path| [path, File.read("#{PROJECT}/#{path}")] }
Gate.refused("another list of MISRA's rules", -> { Gate.tree(rules) { Gate.seed(RULES, "'8.13' => nil,", '') && Gate.run('ruby', RULES) } }, /has (?:no )?rule \d/)

# tools/lib/test/asserts.rb, on a test that asserts through a helper, a shared function
# that gets it as an argument, and a macro.
ASSERTING = "#include \"each.h\"\n\n#define SAME(a, b) \\\n    TEST_ASSERT_EQUAL(a, b)\n\n" \
            "static void is_even(unsigned n)\n{\n    if ((n % 2u) != 0u) {\n        TEST_FAIL();\n    }\n}\n\n" \
            "static void fill(unsigned n)\n{\n    is_even(n);\n}\n\n" \
            "void test_toy_called(void)\n{\n    fill(2);\n}\n\n" \
            "void test_toy_handed_on(void)\n{\n    each(1, fill);\n}\n\n" \
            "void test_toy_macro(void)\n{\n    SAME(1, 1);\n}\n"
EACH = "void each(unsigned n, void (*call)(unsigned))\n{\n    call(n);\n}\n"

def asserts(text)
  Gate.tree('test/unit/test_fixpid_toy.c' => text, 'test/support/each.c' => EACH) do
    Gate.run('ruby', "#{PROJECT}/tools/lib/test/asserts.rb")
  end
end

Gate.passed('unit tests that assert', asserts(ASSERTING))
{ 'called' => 'fill(2);', 'handed_on' => 'each(1, fill);', 'macro' => 'SAME(1, 1);' }.each do |name, body|
  Gate.refused("a unit test #{name} with another body", asserts(ASSERTING.sub(body, '(void)fill; // TEST_ASSERT_TRUE(true);')),
               /test_fixpid_toy\.c: test_toy_#{name} reaches no TEST_ASSERT/)
end
Gate.refused('a helper that asserts no more', asserts(ASSERTING.sub('TEST_FAIL();', 'n = 0;')), /test_toy_called/, /test_toy_handed_on/)

# tools/lib/prove/harness_rules.rb, on a harness with a number of the source, and with an
# assumption that holds of half of what its module is for.
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

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# tools/lib/faults/mutants.rb on a library of two functions: tests that notice every break,
# tests that do not, and equivalent mutants that are not true.
require_relative 'gate'
require "#{PROJECT}/tools/lib/faults/breaks"
require "#{PROJECT}/tools/lib/faults/equivalents"

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

def mutants(*words, low: LOW, high: HIGH, equivalents: SAME, faults: FAULT, programs: {}, more: {})
  files = { 'project.yml' => PROJECT_FILE, 'include/fixpid_toy.h' => HEADER, 'src/toy/fixpid_toy.c' => SOURCE,
            'test/unit/test_fixpid_toy.c' => test(low, high), 'test/support/nothing.h' => '',
            'test/tools/mutants/equivalent.txt' => equivalents.map { |line| "#{line}\n" }.join, 'test/faults.txt' => faults, **more }
  files.merge!(programs.transform_keys { |name| "bin/#{name}" }.transform_values { |text| "#!/bin/sh\n#{text}\n" })
  lambda do
    Gate.tree(files) { |folder| Gate.run('ruby', "#{PROJECT}/tools/lib/faults/mutants.rb", *words, programs: "#{folder}/bin") }
  end
end

Gate.passed('tests that notice every break', mutants)
Gate.refused('a bound that nobody asks about', mutants(high: HIGH.lines.last, faults: ''),
             /Nobody notices: src.toy.fixpid_toy.c, fixpid_toy_high: if .value > 9. \{: `>` -> `>=`/, /^FAILED src.toy.fixpid_toy.c/)
# `value = 0;` is in both functions, and a test notices one of them.
Gate.refused('an equivalent for the same line of another function',
             mutants(low: LOW.lines.last, equivalents: SAME + ['src/toy/fixpid_toy.c, fixpid_toy_high: value = 0;: `0` -> `1`']),
             /Nobody notices: src.toy.fixpid_toy.c, fixpid_toy_low: value = 0;: `0` -> `1`/,
             /No longer true .*: src.toy.fixpid_toy.c, fixpid_toy_high: value = 0;/)
Gate.refused('an equivalent for a line that is gone', mutants(equivalents: SAME + ['src/toy/fixpid_toy.c, fixpid_toy_low: value--;: `--` -> `++`']),
             /No longer true .*value--/)
Gate.refused('an equivalent for a file that is gone', mutants(equivalents: SAME + ['src/toy/fixpid_toys.c, f: x = 0;: `0` -> `1`']), /names what is not broken/)
Gate.refused('an equivalent twice', mutants(equivalents: SAME + SAME), /named twice/)
Gate.refused('a line that is no equivalent', mutants(equivalents: SAME + ['And all others.']), /not an equivalent/)
Gate.refused('a fault that another test notices', mutants(faults: FAULT.sub('test_high', 'test_low')), /^FAILED test_low notices .*test_high/)
Gate.refused('a fault that no test notices', mutants(faults: FAULT.sub('x == 10', 'x == 11')), /^FAILED test_high/)
Gate.refused('a fault whose text is gone', mutants(faults: FAULT.sub('value > 9', 'value > 10')),
             /^FAILED test.faults.txt:1: `value > 10` stands 0 times in fixpid_toy_high .* nearest is src.toy.fixpid_toy.c:17: `if .value > 9. \{`$/)
Gate.refused('a fault whose text is there twice', mutants(faults: FAULT.sub('`value > 9`', '`value`')), /stands 4 times in fixpid_toy_high/)
Gate.refused('a test that fails before anything is broken', mutants(high: 'TEST_FAIL();'), /do not pass before/, /test_fixpid_toy\.c:\d+:test_high:FAIL/)
Gate.refused('a test that does not compile', mutants(high: 'nothing;'), /do not pass before/, /test_fixpid_toy\.c:\d+:\d+: error: .nothing. undeclared/)
Gate.refused('a source without a test', mutants(more: { 'src/toy/fixpid_more.c' => "int fixpid_more(int x);\nint fixpid_more(int x)\n{\n    return x + 1;\n}\n" }),
             %r{^FAILED src/toy/fixpid_more\.c has no test/unit/test_fixpid_more\.c$})
Gate.refused('a compiler that has no room', mutants(programs: { 'tcc' => <<~TEXT }), /the compiler does not work/)
  case $* in
  *program*) echo 'tcc: No space left on device: error: nothing' >&2; exit 1 ;;
  esac
  exec /usr/bin/tcc "$@"
TEXT

# What is broken of a line: from, to.
def breaks(line, file: 'src/x/x.c')
  Breaks.of(file, "void f(void)\n{\n    #{line}\n}\n").map { |mutant| [mutant.from, mutant.to] }
end

Gate.expect('a bound and its neighbours', breaks('if (a < limit) {'), [['<', '<='], ['<', '>'], ['<', '< -1 +']])
Gate.expect('a bound that is a number', breaks('if (a >= 5u) {'), [['>=', '>'], ['>=', '<'], ['5u', '6u'], ['5u', '4u']])
Gate.expect('a call that is left out', breaks('reset(self);'), [['reset(self);', '']])
Gate.expect('an assignment that is left out', breaks('a -= b;'), [['-=', '+='], ['a -= b;', '']])
Gate.expect('exclusive or, not and complement', breaks('return (a ^ ~b) & !c;'),
            [['^', '|'], ['~', ''], ['&', '|'], ['!', '']])
Gate.expect('an assertion, a comment and an address', breaks('FIXPID_ASSERT(a < b); // a < b') + breaks('return &a; // 7'), [])
Gate.expect('a macro of a header for users', Breaks.of('include/x.h', "#define LIMIT 5u\n#define F(x) \\\n    ((x) < 0.5)\nint f(int a[5]);\n")
                                                .map { |mutant| [mutant.line, mutant.from, mutant.to] },
            [[3, '<', '<='], [3, '<', '>'], [3, '0.5', '-0.5'], [3, '0.5', '1.5']])
alike = "int f(void)\n{\n    a = 0u & 0u;\n    a = 0u & 0u;\n}\n"
keys = EquivalentMutants.keys(Breaks.of('src/x/x.c', alike), alike)
Gate.expect('an equivalent names one break', keys.values.uniq.size, keys.size)
Gate.expect('and counts from above', keys.values.grep(/0u` -> `1u/).map { |key| key[/\(.*\)/] },
            ['(1 of 4)', '(2 of 4)', '(3 of 4)', '(4 of 4)'])

# tools/lib/faults/assembly.rb with a chip that answers right while it adds.
TOY = "// add %0, %1\nstatic int f(int a, int b)\n{\n    __asm__(\"add %0, %1\\n\\t\"\n            \"andi %0, 1\"\n            : ...);\n}\n"
CHIP = <<~TEXT
  require '#{PROJECT}/tools/lib/faults/assembly'

  class Toy < Board
    private

    def ways
      [1, 2]
    end

    def build(_way)
      FileUtils.cp("\#{@source}/toy/toy_avr.h", code)
      !File.read(code).include?('ori')
    end

    def code
      "\#{@folder}/code"
    end

    def answers
      File.read(code).include?(ARGV.first) ? nil : :different
    end
  end

  Thread.abort_on_exception = true
  Board.define_singleton_method(:of) { |*arguments| Toy.new(*arguments) }
  exit(Broken.new('src/toy/toy_avr.h', EquivalentMutants.new('equivalents'), File.open('report', 'w')).judge)
TEXT
TOYS = ['"andi %0, 1": `andi %0, 1` -> `nop`', '"andi %0, 1": `andi %0, 1` -> `andi %0, 2`',
        '"andi %0, 1": `andi %0, 1` -> `andi %0, 0`'].map { |break_| "src/toy/toy_avr.h, f: #{break_}" }.freeze

def assembly(equivalents, right: '"add', source: TOY)
  files = { 'include/toy.h' => '', 'src/toy/toy_avr.h' => source, 'equivalents' => equivalents.map { |line| "#{line}\n" }.join }
  -> { Gate.tree(files) { Gate.run('ruby', '-e', CHIP, right) } }
end

Gate.passed('instructions that somebody notices', assembly(TOYS))
Gate.refused('an instruction that nobody notices', assembly(TOYS.drop(1)), /^FAILED src.toy.toy_avr.h/, /Nobody notices: .*`nop`/)
Gate.refused('an instruction that somebody does', assembly(TOYS + [TOYS.first.sub('andi %0, 1"', 'add %0, %1"')]), /No longer true/)
Gate.refused('a chip that answers wrong unbroken', assembly(TOYS, right: 'xor'), /the unbroken one is noticed/)
Gate.refused('a program that cannot be built', assembly([], source: TOY.sub('andi', 'ori')), /cannot be built/)
Gate.finish

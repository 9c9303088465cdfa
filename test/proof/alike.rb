# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Whether tools/prove --equivalents sees that a function was changed: in what it gives,
# what it leaves, and what C leaves undefined; and whether it takes only such objects for
# granted as its callers have. Prints `ok` or `FAILED` for each case:
#
#   ruby test/proof/alike.rb [NAME]... | --failed | --list
require_relative '../tools/gates/gate'
require "#{PROJECT}/tools/lib/prove/alike"

HEADER = <<~C
  #include <stdint.h>
  struct fixpid_toy {
      int16_t low;
      int16_t high;
      int16_t last;
  };
  void fixpid_toy_init(struct fixpid_toy *self, int16_t low, int16_t high);
  int16_t fixpid_toy_step(struct fixpid_toy *self, int16_t x);
C

SOURCE = <<~C
  #include "fixpid_toy.h"

  static int16_t limited(const struct fixpid_toy *self, int16_t x)
  {
      if (x > self->high) {
          return self->high;
      }
      if (x < self->low) {
          return self->low;
      }
      return x;
  }

  void fixpid_toy_init(struct fixpid_toy *self, int16_t low, int16_t high)
  {
      self->low = low;
      self->high = (high < low) ? low : high;
      self->last = limited(self, 0);
  }

  int16_t fixpid_toy_step(struct fixpid_toy *self, int16_t x)
  {
      self->last = limited(self, x);
      return self->last;
  }
C

HARNESS = <<~C
  #include "prove.h"

  #include "toy/fixpid_toy.c"

  struct fixpid_toy c;

  static bool sound(const struct fixpid_toy *x)
  {
      return x->low <= x->high;
  }
C

# Of a change, in a source that another change may have made before.
def answer(from, to, before: nil, header: HEADER)
  source = before ? SOURCE.sub(*before) : SOURCE
  changed = source.sub(from, to)
  changed == source && header == HEADER && from != to and raise "nothing to change: #{from}"
  files = { 'include/fixpid_toy.h' => HEADER, 'src/toy/fixpid_toy.c' => source, 'test/proof/toy.c' => HARNESS,
            'test/proof/prove.h' => File.read("#{PROJECT}/test/proof/prove.h"), 'test/proof/proofs.txt' => "toy any : step\n",
            'other/include/fixpid_toy.h' => header, 'other/src/toy/fixpid_toy.c' => changed }
  lambda do
    Gate.tree(files) { Alike.new(Proof.new('toy', 'any', [], 'step', 16, true), '.', {}).answer('other') }
  end
end

EARLY = ["    self->last = limited(self, 0);\n", ''].freeze # init, then, does not ask

Gate.expect('nothing', answer('x > ', 'x > '), :as_it_was)
Gate.expect('the same for all objects', answer('x < self->low', 'x <= self->low'), :alike)
Gate.expect('another result', answer('x < self->low', 'x > self->low'), :nothing)
Gate.expect('another result at one value', answer('return x;', 'return (x == 7) ? 8 : x;'), :nothing)
Gate.expect('something else left', answer("return self->last;", 'self->last = 0; return limited(self, x);'), :nothing)
Gate.expect('what C leaves undefined', answer('return x;', 'return (int16_t)((x + 1) - 1);'), :nothing)
Gate.expect('the same for sound objects', answer('x > self->high', 'x >= self->high', before: EARLY), :alike)
Gate.expect('an init that has made the object sound', answer('x > self->high', 'x >= self->high'), :alike)
Gate.expect('an init that has not', answer('x > self->high', 'x >= self->high', before: [/(    self->low = low;\n.*\n)(.*\n)/, '\2\1']), :nothing)
Gate.expect('another structure', answer('x > ', 'x > ', header: HEADER.sub('int16_t last;', 'int32_t last;')), :nothing)
Gate.finish

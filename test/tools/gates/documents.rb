# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# tools/lib/pages/check_docs.rb on a copy of the project, as it is and with a fault of
# each kind that it looks for.
require_relative 'gate'

ABSENT = 'not_there' # a whole name would be one that the project has

# [file, text, instead, what must be said]
FAULTS = [
  ['README.md', '<!-- quick_start:begin -->', "<!-- quick_start:begin -->\n", /README.md is stale/],
  ['README.md', '<!-- proofs -->', '<!-- proof -->', /README.md: no number is called proof$/,
   /README.md does not say the number of proofs$/],
  ['CONTRIBUTING.md', '| `quick` | ', '| `quick` | 1', /CONTRIBUTING.md is stale/],
  ['docs/scaling.md', /\z/, "\nSee [what is not there](nowhere.md).\n", /docs.scaling.md: no nowhere.md/],
  ['docs/scaling.md', /\z/, "\nThe product is 117 * 1023 / 16 = 7481.\n", /docs.scaling.md: 117 \* 1023 . 16 = 7481 is wrong/],
  ['docs/scaling.md', /\z/, "\nSo says `test_what_is_not_there_is_missed`.\n", /no test test_what_is_not_there_is_missed/],
  ['docs/scaling.md', /\z/, "\nCall `fixpid_pid_#{ABSENT}`, of `src/fixpid_#{ABSENT}.c`.\n",
   /no fixpid_pid_#{ABSENT}/, /no src.fixpid_#{ABSENT}.c/],
  ['docs/scaling.md', /\z/, "\n```c\nint16_t broken = fixpid_pid_step(;\n```\n", /docs.scaling.md, code block \d+, C$/],
  # As a body it needs a declaration, so that C takes it.
  ['docs/scaling.md', /\z/, "\n<!-- given: #include <stdlib.h> -->\n```c\nint *counts = malloc(4);\n(void)counts;\n```\n",
   /docs.scaling.md, code block \d+, C\+\+$/],
  ['docs/scaling.md', /\z/, "\n```text\n7\n```\n", /blocks of ```text do not follow a program/],
  ['docs/scaling.md', /\z/, "\n    int hidden = 0;\n", /C outside of ```c: int hidden = 0;/],
  ['src/common/fixpid_bits.h', /\z/, "// at most 2 * 3 = 7\n", /src.common.fixpid_bits.h: 2 \* 3 = 7 is wrong/],
  ['Dockerfile', ' pmccabe', '', /Dockerfile lacks pmccabe/],
  ['examples/quick_start.c', /\z/, "\n" * 20, /the quick start has \d+ lines/],
  ['CMakeLists.txt', '    src/slew/fixpid_slew.c', '', /fixpid_slew/],
  ['tools/lib/pages/docs/assurance.rb', '`tools/demo random_plants`', '`tools/demo sky`', /no tools.demo sky/]
].freeze

Encoding.default_external = 'UTF-8'
Dir.mktmpdir do |folder|
  Gate.copy(folder)
  Dir.chdir(folder) do
    Gate.passed('the documents as they are', Gate.run('ruby', 'tools/lib/pages/check_docs.rb'))
    FAULTS.each { |path, text, instead| Gate.seed(path, text, instead) }
    result = Gate.run('ruby', 'tools/lib/pages/check_docs.rb')
    FAULTS.each { |path, text, instead, *said| Gate.refused("#{path} with #{instead.empty? ? "no #{text}" : instead}".inspect, result, *said) }
  end
end
Gate.finish

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# tools/lib/pages/check_docs.rb and the Markdown linter on a copy of the project with a fault of
# each kind that they look for. As they are, the part `docs` looks at them.
require_relative 'gate'

ABSENT = 'not_there' # a whole name would be one that the project has

# [file, text, instead, what must be said]
FAULTS = [
  ['docs/start/index.md', '<!-- quick_start:begin -->', "<!-- quick_start:begin -->\n", /docs.start.index.md is stale/],
  ['web/site/home.md', '<!-- chips -->', '<!-- chip -->', /web.site.home.md: no number is called chip$/],
  ['docs/figures.json', '"rows": ', '"rows": 1', /docs.figures.json: rows is 14000, but 4000 was found$/],
  ['docs/start/zephyr.md', 'CONFIG_FIXPID=y', 'CONFIG_FIXPID=n', /docs.start.zephyr.md is stale/],
  ['docs/start/esp.md', /\z/, "\n```ini\nnobody = 1\n```\n", /docs.start.esp.md: a block of ini shows no file/],
  ['docs/scaling.md', /\z/, "\n| a | b |\n|---|---|---|\n", /docs.scaling.md: no table, .*: \| a \| b \|$/],
  ['docs/scaling.md', /\z/, "\nOf all\n<!-- chips -->18 some.\n", /docs.scaling.md: a line begins with a mark: <!-- chips/],
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
  ['docs/installing.md', "dependency('fixpid')", "dependency('libfixpid')", /docs.installing.md: Meson has no dependency libfixpid$/],
  ['src/common/fixpid_bits.h', /\z/, "// at most 2 * 3 = 7\n", /src.common.fixpid_bits.h: 2 \* 3 = 7 is wrong/],
  ['docs/scaling.md', '| 0.5/256 | 125.996 |', '| 0.5/256 | 127.996 |', /docs.scaling.md: 127.996 in .*PID_KD_MAX . 256 is 125.99/],
  ['docs/migrating.md', '| 4, p_err_sign |', '| 3, p_err_sign |', /docs.migrating.md: 3 in ".*p_err_sign.*AN937_P_ERR_SIGN is 4$/],
  ['docs/migrating.md', '`FIXPID_AN937_A_ERR_SIGN`', '`FIXPID_AN937_P_ERR_SIGN`', /docs.migrating.md does not say ".*a_err_sign/],
  ['docs/ports.md', 'AN4 KI, AN5 KD', 'AN5 KI, AN4 KD', /docs.ports.md: 5 in ".*'KI'\) is 4$/, /docs.ports.md: 4 in ".*'KD'\) is 5$/],
  ['include/fixpid_autotune.h', 'QUICK, with a third more', 'QUICK, with half more', /fixpid_autotune.h: half in ".*QUICK.* is 0.307/],
  ['docs/data/levels.csv', 'fixpid_an964,4', 'fixpid_an964,3', /docs.data.levels.csv is stale/],
  ['include/fixpid_pid.h', '// reverse', '// feedforward', /fixpid_pid.h does not say ".*HAS_REVERSE/],
  ['SECURITY.md', 'tools/prove autotune total', 'tools/prove autotune totals', /SECURITY.md: no tools.prove autotune totals/],
  ['SECURITY.md', 'targets `bytes`', 'targets `byte`', /SECURITY.md: no test.fuzz.run byte$/],
  ['docs/data/chip_choices.csv', 'Z80,yes', 'Z80,no', /chip_choices.csv: `fixpid_an937` on Z80: no, but the run says [0-9 ]+ rows/],
  ['docs/requirements.csv', 'Errors and differences saturate', 'Errors and differences wrap', /requirements.csv, PID-1: fixpid_pid.h does not say "Errors and differences wrap/],
  ['docs/requirements.csv', 'output_is_rounded_half_up', 'output_is_rounded_half_down', /requirements.csv, PID-2: no test test_step_output_is_rounded_half_down$/],
  ['docs/requirements.csv', 'theorems bumpless', 'theorems bumpy', /requirements.csv, PID-17: no tools.prove theorems bumpy$/],
  ['docs/requirements.csv', 'SLEW-2,', 'SLEW-1,', /requirements.csv has SLEW-1 twice$/],
  ['docs/requirements.csv', 'AN964-8BIT-1,fixpid_an964_8bit.h', 'AN964-8BIT-1,fixpid_an964.h', /requirements.csv has no sentence of fixpid_an964_8bit.h$/],
  ['docs/conditions.md', '## C7. ', '## C77. ', /docs.conditions.md has no C7$/, /requirements.csv has no C77, which docs.conditions.md has$/],
  ['tools/lib/cppcheck.txt', "misra-c2012-20.5\n", '', /docs.misra.csv is stale/],
  ['Dockerfile', ' pmccabe', '', /Dockerfile lacks pmccabe/],
  ['examples/quick_start.c', /\z/, "\n" * 20, /the quick start has \d+ lines/],
  ['CMakeLists.txt', '    src/slew/fixpid_slew.c', '', /fixpid_slew/],
  ['tools/lib/pages/docs/assurance.rb', '`tools/demo random_plants`', '`tools/demo sky`', /no tools.demo sky/]
].freeze

# For the linter.
MARKDOWN = [
  ['docs/start/zephyr.md', "\n| a | b |\n|---|---|\n| 1 |\n", /zephyr.md.* MD056.*Too few cells/],
  ['docs/start/esp.md', "\n| a | b |\n|---|---|\n| 1 | 2\n", /esp.md.* MD055.*missing trailing pipe/i],
  ['docs/start/stm32.md', "\nSee [what is not there](nowhere.md).\n", /stm32.md.*"nowhere.md" should exist/],
  ['docs/start/arduino.md', "\nSee [what is not there](stm32.md#nowhere).\n", /arduino.md.*"stm32.md#nowhere" should have a valid fragment/],
  ['docs/start/glossary.md', "\n##### Nothing above it\n", /glossary.md.* MD001/]
].freeze

Dir.mktmpdir do |folder|
  Gate.copy(folder)
  Dir.chdir(folder) do
    FAULTS.each { |path, text, instead| Gate.seed(path, text, instead) }
    result = Gate.run('ruby', 'tools/lib/pages/check_docs.rb')
    FAULTS.each { |path, text, instead, *said| Gate.refused("#{path} with #{instead.empty? ? "no #{text}" : instead}".inspect, result, *said) }

    MARKDOWN.each { |path, text| Gate.seed(path, /\z/, text) }
    linted = Gate.run('sh', '-c', "root=#{PROJECT}; cd $root; . tools/lib/setup.sh; . tools/lib/build/browser.sh; need_node_modules; " \
                                  "mkdir -p '#{folder}/build'; ln -s \"$browser\" '#{folder}/build/browser'; " \
                                  "cd '#{folder}'; node \"$browser/node_modules/.bin/markdownlint-cli2\"")
    MARKDOWN.each { |path, text, said| Gate.refused("#{path} with #{text.inspect}", linted, said) }
  end
end
Gate.finish

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# tools/lib/manifests.rb on a copy of the project with one fault after the other: it
# must name the manifest that is wrong.
require_relative '../../tools/gates/gate'

# [file, text, instead, what must be said]; without a text the file is a new one.
FAULTS = [
  ['include/fixpid.h', 'VERSION_PATCH 0', 'VERSION_PATCH 7', /FAILED CHANGELOG.md/, /FAILED library.properties/, /FAILED library.json/],
  ['src/fixpid_new.c', nil, '', %r{FAILED CMakeLists.txt: sources in no folder of src: src/fixpid_new.c$}],
  ['src/slew/fixpid_slew_new.c', nil, '', %r{FAILED CMakeLists.txt: \+ src/slew/fixpid_slew_new.c; ruby tools/lib/manifests.rb --update$},
   /FAILED meson.build/, /FAILED fixpid.fixpid.pdsc/],
  ['CMakeLists.txt', "    src/slew/fixpid_slew.c\n", '', %r{FAILED CMakeLists.txt: \+ src/slew/fixpid_slew.c; }],
  ['CMakeLists.txt', 'set(fixpid_sources', 'set(sources', /FAILED CMakeLists.txt: no place for the sources/],
  ['include/fixpid_new.h', nil, "void fixpid_new(void);\n", %r{FAILED src/fixpid_new.h: it is gone},
   %r{FAILED keywords.txt: \+ fixpid_new KEYWORD2; ruby tools/lib/manifests.rb --update$}, %r{FAILED tools/lib/modules.rb: fixpid_new: no entry}],
  ['src/new/fixpid_new.c', nil, '', %r{fixpid_new: no entry in tools/lib/modules.rb},
   %r{fixpid_new: no include/fixpid_new.h}],
  ['include/fixpid_slew.h', 'define FIXPID_SLEW_RATE(', 'define FIXPID_SLEW_SPEED(', /FAILED keywords.txt: - FIXPID_SLEW_RATE KEYWORD2$/,
   /\+ FIXPID_SLEW_SPEED KEYWORD2$/],
  ['include/fixpid.h', 'write FIXPID_PERIOD_MS(100)', 'divide 1000 by it', /FAILED keywords.txt: - FIXPID_PERIOD_MS KEYWORD2; /],
  ['include/fixpid_slew.h', 'macro above, and private.', 'macro above.', /FAILED keywords.txt: \+ FIXPID_SLEW_Q16 KEYWORD2; /],
  ['src/fixpid_new.h', nil, '', %r{FAILED src/fixpid_new.h: not in include}],
  ['src/fixpid_pid.h', '../include/', '', %r{FAILED src/fixpid_pid.h}],
  ['library.properties', 'fixpid_autotune.h', 'fixpid_tuner.h', /FAILED library.properties: - includes=.*fixpid_tuner.h/],
  ['tools/lib/project.rb', 'fixpid_autotune.h', 'fixpid_tuner.h', %r{FAILED tools/lib/project.rb: files that are not there: include/fixpid_tuner.h}],
  ['library.properties', 'url=', 'url=x', /FAILED library.properties: - url=x/],
  ['tools/lib/project.rb', 'ADDRESS = nil', "ADDRESS = 'https://fixpid.invalid'", %r{FAILED library.properties:.*\n.*\+ url=https://fixpid.invalid$},
   %r{FAILED library.json: \+ "homepage": "https://fixpid.invalid",; }, %r{FAILED idf_component.yml: \+ url: https://fixpid.invalid; },
   %r{FAILED fixpid.fixpid.pdsc:.*\n.*\+ <url>https://fixpid.invalid</url>$}, %r{FAILED conanfile.py: \+ homepage = "https://fixpid.invalid"; },
   %r{FAILED vcpkg/fixpid/vcpkg.json: \+ "homepage": "https://fixpid.invalid",; }],
  ['library.json', '"examples",', '"samples",', %r{FAILED library.json: - "samples",}],
  ['tools/lib/project.rb', 'docs examples', 'docs samples', %r{FAILED tools/lib/project.rb: files that are not there: samples}],
  ['library.json', '"version": "1.0.0"', '"version": "1.0"', /FAILED library.json: - "version": "1.0",/],
  ['meson.build', "  'src/slew/fixpid_slew.c',\n", '', %r{FAILED meson.build: \+ 'src/slew/fixpid_slew.c',; }],
  ['meson.build', "version: '1", "version: '2", /FAILED meson.build: - .*version: '2/],
  ['fixpid.pc.in', 'without float', 'with float', /FAILED fixpid.pc.in: - Description: .* with float/],
  ['idf_component.yml', 'version: 1.0.0', 'version: 1.0', /FAILED idf_component.yml: - version: 1.0$/],
  ['idf_component.yml', 'examples/esp-idf/heater', 'examples/heater', %r{FAILED idf_component.yml: - - path: examples/heater}],
  ['zephyr/module.yml', 'examples/zephyr', 'examples/zephyros', %r{FAILED zephyr/module.yml: - - examples/zephyros}],
  ['zephyr/Kconfig', 'config FIXPID_NO_ASSEMBLY', 'config FIXPID_PLAIN_C',
   %r{FAILED zephyr/CMakeLists.txt: options .*: FIXPID_PLAIN_C, FIXPID_NO_ASSEMBLY$}],
  ['zephyr/Kconfig', 'default 0xFF', 'default 0x7F', %r{FAILED zephyr/Kconfig: - default 0x7F}],
  ['zephyr/Kconfig', 'range 0x00 0xFF', 'range 0x00 0x7F', %r{FAILED zephyr/Kconfig: - range 0x00 0x7F}],
  ['include/fixpid_pid.h', 'FIXPID_PID_ALL 0xFFu', 'FIXPID_PID_ALL 0x1FFu', %r{FAILED zephyr/Kconfig:}, %r{\+ default 0x1FF$}],
  ['fixpid.fixpid.pdsc', 'Cversion="1.0.0"', 'Cversion="1.0.1"', /FAILED fixpid.fixpid.pdsc: - <component .* Cversion="1.0.1"/],
  ['fixpid.fixpid.pdsc', 'src/tpo/fixpid_tpo.c', 'src/fixpid_tp.c', %r{FAILED fixpid.fixpid.pdsc: - <file .* name="src/fixpid_tp.c"}],
  ['conanfile.py', '"include/*"', '"inc/*"', %r{FAILED conanfile.py: - exports_sources = .*"inc/\*"}],
  ['conanfile.py', '    package_type', '    package_sort', /FAILED conanfile.py: no place for the attributes/],
  ['vcpkg/fixpid/vcpkg.json', '"license": "MIT"', '"license": "BSD"', %r{FAILED vcpkg/fixpid/vcpkg.json: - "license": "BSD",}],
  ['CITATION.cff', 'version: 1.0.0', 'version: 1.1.0', /FAILED CITATION.cff: - version: 1.1.0$/],
  ['python/setup.py', 'license="MIT"', 'license="BSD"', %r{FAILED python/setup.py: - license="BSD",}],
  ['docs/installing.md', '| `conan` |', '| `conan_create` |', %r{FAILED docs/installing.md: tests that are not there: conan_create$}],
  ['tools/lib/modules.rb', "    'tpo' => {", "    'tpq' => {", /fixpid_tpo: no entry/, %r{fixpid_tpq: no test/unit/test_fixpid_tpq.c}],
  ['test/faults.txt', 'fuzz record: ', 'fuzz recorded: ', %r{fixpid_record: not in test/faults.txt}],
  ['docs/installing.md', '<!-- install:begin -->', '', %r{FAILED docs/installing.md: ways to install: none}],
  ['docs/installing.md', '| `conan` |', '| |', %r{FAILED docs/installing.md: ways to install without a test: Conan$}],
  ['README.md', '| Meson |', '| Mason |', /FAILED README.md: ways to install .*: Meson, Mason$/],
  ['examples/arduino/Oven/Heater.ino', nil, '', %r{FAILED library.properties: sketches that are not there: examples/arduino/Oven/Oven.ino}]
].freeze

# Each that is gone is missed.
MANIFESTS = %w[CHANGELOG.md CITATION.cff CMakeLists.txt conanfile.py fixpid.fixpid.pdsc fixpid.pc.in idf_component.yml keywords.txt library.json
               library.properties docs/installing.md meson.build python/setup.py README.md src/fixpid_tpo.h vcpkg/fixpid/vcpkg.json zephyr/CMakeLists.txt
               zephyr/Kconfig zephyr/module.yml].freeze

def copy(folder)
  FileUtils.cp_r(Dir.children(PROJECT).reject { |name| %w[build .git].include?(name) }.map { |name| "#{PROJECT}/#{name}" }, folder)
end

# With the fault while the block runs.
def seeded(path, text, instead)
  before = File.read(path) if text
  after = text ? before.sub(text) { instead } : instead
  after == before and abort "FAILED nothing to plant in #{path}: #{text}"
  Gate.write(path, after)
  yield
ensure
  text ? File.write(path, before) : FileUtils.rm(path)
  Dir.rmdir(File.dirname(path)) if Dir.empty?(File.dirname(path))
end

def gone(path)
  FileUtils.mv(path, "#{path}.away")
  yield
ensure
  FileUtils.mv("#{path}.away", path)
end

# What is said of a manifest that differs in everything: a few lines of a few words.
def readable
  more = File.readlines('keywords.txt').size + 1 - 10 # all of its lines and `nothing`, but for those that are shown
  output, = seeded('keywords.txt', /.+/m, "nothing\n") { Gate.run('ruby', 'tools/lib/manifests.rb') }
  said = output[/^FAILED keywords.*?(?=^ok|^FAILED|\z)/m].lines(chomp: true)
  Gate.expect('a difference is at most 12 lines', said.size <= 12, true)
  Gate.expect('of 130 characters', said.map(&:size).max <= 130, true)
  Gate.expect('says how much more there is', said[-2].strip, "and #{more} lines more")
  Gate.expect('and how to mend it', said.last.strip, 'ruby tools/lib/manifests.rb --update')
end

Dir.mktmpdir do |folder|
  copy(folder)
  Dir.chdir(folder) do
    Gate.passed('the manifests as they are', Gate.run('ruby', 'tools/lib/manifests.rb'))
    FAULTS.each do |path, text, instead, *said|
      seeded(path, text, instead) do
        Gate.refused("#{path} with #{instead.inspect}", Gate.run('ruby', 'tools/lib/manifests.rb'), *said)
      end
    end
    MANIFESTS.each do |path|
      gone(path) { Gate.refused("#{path} gone", Gate.run('ruby', 'tools/lib/manifests.rb'), /FAILED #{path}: it is gone/) }
    end
    readable
  end
end
Gate.finish

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# tools/lib/manifests.rb on a copy of the project with one fault after the other: it
# must name the manifest that is wrong.
require_relative '../gates/planted'

# [file, text, instead, what must be said]; without a text the file is a new one.
FAULTS = [
  ['include/fixpid.h', 'VERSION_PATCH 0', 'VERSION_PATCH 7', /FAILED CHANGELOG.md/, /FAILED library.properties/, /FAILED library.json/],
  ['src/fixpid_new.c', nil, '', /FAILED CMakeLists.txt: sources/],
  ['CMakeLists.txt', "    src/fixpid_slew.c\n", '', /FAILED CMakeLists.txt: sources/],
  ['include/fixpid_new.h', nil, "void fixpid_new(void);\n", %r{FAILED src/fixpid_new.h}, /FAILED keywords.txt/],
  ['src/fixpid_pid.h', '../include/', '', %r{FAILED src/fixpid_pid.h}],
  ['library.properties', 'fixpid_autotune.h', 'fixpid_tuner.h', /FAILED library.properties: headers/, /FAILED library.json: headers/],
  ['library.properties', 'url=', 'url=x', /FAILED library.json: URL/],
  ['library.json', '"examples/arduino"', '"examples/uno"', /FAILED library.json: exported files/],
  ['library.json', '"version": "0.1.0"', '"version": "0.1"', /FAILED library.json: version/],
  ['meson.build', "  'src/fixpid_slew.c',\n", '', /FAILED meson.build: sources/],
  ['meson.build', "version: '0", "version: '1", /FAILED meson.build: version/],
  ['fixpid.pc.in', 'without float', 'with float', /FAILED fixpid.pc.in: description/],
  ['idf_component.yml', 'version: 0.1.0', 'version: 0.1', /FAILED idf_component.yml: version/],
  ['idf_component.yml', 'examples/esp-idf/heater', 'examples/heater', /FAILED idf_component.yml: examples/],
  ['zephyr/module.yml', 'examples/zephyr', 'examples/zephyros', %r{FAILED zephyr/module.yml: files}],
  ['zephyr/Kconfig', 'config FIXPID_NO_ASSEMBLY', 'config FIXPID_PLAIN_C', %r{FAILED zephyr/CMakeLists.txt: options}],
  ['fixpid.fixpid.pdsc', 'Cversion="0.1.0"', 'Cversion="0.1.1"', /FAILED fixpid.fixpid.pdsc: versions of components/],
  ['fixpid.fixpid.pdsc', 'src/fixpid_tpo.c', 'src/fixpid_tp.c', /FAILED fixpid.fixpid.pdsc: sources/],
  ['conanfile.py', '"include/*"', '"inc/*"', /FAILED conanfile.py: exported files/],
  ['vcpkg/fixpid/vcpkg.json', '"license": "MIT"', '"license": "BSD"', %r{FAILED vcpkg/fixpid/vcpkg.json: licence}],
  ['README.md', '| `conan` |', '| `conan_create` |', /FAILED README.md: tests that are not there/],
  ['examples/arduino/Oven/Heater.ino', nil, '', /FAILED library.properties: sketches/]
].freeze

def copy(folder)
  FileUtils.cp_r(Dir.children(PROJECT).reject { |name| %w[build .git].include?(name) }.map { |name| "#{PROJECT}/#{name}" }, folder)
end

# With the fault while the block runs.
def planted(path, text, instead)
  before = File.read(path) if text
  after = text ? before.sub(text) { instead } : instead
  after == before and abort "FAILED nothing to plant in #{path}: #{text}"
  Planted.write(path, after)
  yield
ensure
  text ? File.write(path, before) : FileUtils.rm(path)
end

Encoding.default_external = 'UTF-8'
Dir.mktmpdir do |folder|
  copy(folder)
  Dir.chdir(folder) do
    Planted.passed('the manifests as they are', Planted.run('ruby', 'tools/lib/manifests.rb'))
    FAULTS.each do |path, text, instead, *said|
      planted(path, text, instead) do
        Planted.refused("#{path} with #{instead.inspect}", Planted.run('ruby', 'tools/lib/manifests.rb'), *said)
      end
    end
  end
end
Planted.finish

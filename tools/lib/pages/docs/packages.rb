# SPDX-License-Identifier: MIT
# The Debian packages that the tools ask for: what stands after `need` in the
# scripts and in test/matrix.txt, as `command`, `command:package` or `:package`.
module Packages
  SCRIPTS = Dir['tools/*', 'tools/lib/*', 'tools/lib/{build,test}/*', 'test/*/{*,*/*}', 'test/matrix.txt'].select { |file| File.file?(file) }.freeze
  NEED = /^ *need ((?:[\w:.+-]+(?: +| *\\\n *)?)+)$/.freeze

  def self.items
    texts = SCRIPTS.select { |path| File.file?(path) }.map { |path| File.binread(path) }
    scripts = texts.select { |text| text.match?(/\A#!.*sh\n|^# shellcheck shell=sh$|\A# What users do/n) }
    scripts.flat_map { |text| text.scan(NEED) }.flatten.flat_map { |line| line.delete('\\').split }.uniq
  end

  def self.wanted
    items.map { |item| item.split(':').last }.uniq.sort
  end

  # Those that no command stands for: setup.sh has to know how to ask.
  def self.without_command
    items.grep(/^:/).map { |item| item.delete(':') }
  end

  def self.of_dockerfile(text)
    text[/--no-install-recommends(.*?)&&/m, 1].delete('\\').split.sort
  end
end

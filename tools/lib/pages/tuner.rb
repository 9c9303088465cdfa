# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Builds the tuner page into a folder: the C of sim/tuner and sim/identify as WebAssembly, and the
# modules of web/ in one file with it, packed.
require 'json'
require 'zlib'
require_relative 'tuner/costs'
require_relative 'tuner/layouts'
require_relative 'tuner/modules'
require_relative 'tuner/names'
require_relative 'tuner/sources'

Encoding.default_external = 'UTF-8'

folder = ARGV.fetch(0)
wasm = "#{folder}/tuner.wasm"
exit 1 unless system(*Sources.wasm(wasm))

# What the modules import from built.js.
built = { **Names.lists, LAYOUT: Layouts.of('sim/identify/identify.h', 'sim/identify/loop.h'), COSTS: Costs.steps, FEATURES: Costs.features, VERSION: Names.version,
          WASM: [File.binread(wasm)].pack('m0') }
text = built.map { |name, value| "export const #{name} = #{JSON.generate(value)};\n" }.join
File.write("#{folder}/built.js", text)

page = File.read('web/page.html')
script = Zlib.gzip(Modules.joined('web/page.js', "#{folder}/built.js"), level: Zlib::BEST_COMPRESSION)
{ 'page.css' => File.read('web/page.css'), 'page.js' => [script].pack('m0') }
  .each do |name, content|
  raise "web/page.html does not name #{name} once" unless page.scan("/* #{name} */").size == 1

  page = page.sub("/* #{name} */") { content }
end
File.write("#{folder}/index.html", page)
puts "Open #{folder}/index.html in a browser: #{page.bytesize} bytes."

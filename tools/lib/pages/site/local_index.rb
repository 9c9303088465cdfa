# SPDX-License-Identifier: MIT
# The search's index once more as a script, for a site that is opened from a file:
# local_index.rb SITE.
folder = "#{ARGV.fetch(0)}/search"
index = File.read("#{folder}/search_index.json", encoding: 'UTF-8')
File.write("#{folder}/search_index.js", "__search.index = Promise.resolve(#{index.strip});\n")

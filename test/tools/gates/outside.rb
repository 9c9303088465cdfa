# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What a person meets who types the first command: every script that may install
# something, with no program that one of them asks for, as root and as another user.
require_relative 'gate'
require_relative '../bare/outside'
require "#{PROJECT}/tools/lib/pages/docs/packages"

# A folder with all programs of PATH but those, whose `id` is this user's.
def programs(folder, hidden, user)
  FileUtils.mkdir_p(folder)
  found = ENV.fetch('PATH').split(':').flat_map { |path| Dir.glob("#{path}/*") }
  found.uniq { |path| File.basename(path) }.each do |path|
    name = File.basename(path)
    File.symlink(path, "#{folder}/#{name}") unless hidden.include?(name) || name.match?(/\A(?:apt|dpkg|id\z)/)
  end
  Gate.write("#{folder}/id", "#!/bin/sh\necho #{user}\n")
  Gate.write("#{folder}/apt-get", Outside.apt_get("#{File.dirname(folder)}/asked"))
  folder
end

def try(script, path)
  Outside.run(script, path: path, record: "#{File.dirname(path)}/asked")
end

Dir.mktmpdir do |folder|
  Gate.copy("#{folder}/tree")
  Dir.chdir("#{folder}/tree") do
    hidden = Packages.items.map { |item| item.split(':').first }.reject(&:empty?) + %w[gem npm] - %w[dash]
    paths = { root: 0, user: 1000 }.to_h { |whom, id| [whom, programs("#{folder}/#{whom}", hidden, id)] }
    Outside.scripts.each do |script|
      Gate.expect("#{script} as root", Outside.complaints_of_root(try(script, paths[:root])), [])
      Gate.expect("#{script} as another user", Outside.complaints_of_user(try(script, paths[:user])), [])
    end
    Gate.expect('what a PIC wants is asked for at once', try('tools/firmware', paths[:user]).output.match?(/missing: .*ruby.* bison .*gputils/), true)
    waiting = /^site: another program has apt's lock, process 7 \(apt\): waiting for it/
    Gate.write("#{paths[:root]}/sleep", "#!/bin/sh\n")
    { 'a while' => [3, /installed, but not usable/], 'ever' => [99, /another program still has apt's lock, process 7 \(apt\)/] }.each do |long, (times, last)|
      Gate.write("#{paths[:root]}/apt-get", Outside.locked_apt_get("#{folder}/asked", times))
      said = try('tools/site', paths[:root]).output
      Gate.expect("apt's lock is held for #{long}", [waiting, last, /network/].map { |words| said.match?(words) }, [true, true, false])
    end
    Gate.write("#{paths[:root]}/apt-get", Outside.apt_get("#{folder}/asked"))
    Gate.seed('tools/lib/setup.sh', '    announce "installing$missing', '    : "')
    Gate.expect('seeded: nothing announced', Outside.complaints_of_root(try('tools/site', paths[:root])).first, 'does not say what it installs')
    FileUtils.rm_rf('build')
    Gate.refused('no folder for temporary files', Gate.run('env', "TMPDIR=#{folder}/none", 'dash', 'tools/demo'),
                 %r{\Ademo: cannot write to #{folder}/none, .*\(TMPDIR\)\n\z})
    Gate.expect('and nothing is built', File.exist?('build'), false)
    Gate.write("#{folder}/full/df", "#!/bin/sh\nprintf 'name\\ntmpfs 2 2 0 100%% /tmp\\n'\n")
    Gate.refused('no room for temporary files', Gate.run('env', "PATH=#{folder}/full:#{ENV.fetch('PATH')}", "TMPDIR=#{folder}", 'dash', 'tools/demo'),
                 /\Ademo: less than 1 MB free for #{folder}\n\z/)
  end
end
Gate.finish

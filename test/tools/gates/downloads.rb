# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What is downloaded is what was meant: a gem or a package with another digest is refused
# with a sentence, and so is an action of the workflows that is no commit. What a fetch
# that was killed has left, or holds, does not hinder the next one.
require 'digest/sha2'
require_relative 'gate'

APT = <<~TEXT
  #!/bin/sh
  case "$*" in
  *--print-uris*) echo "'http://mirror.invalid/debian/dists/bookworm/InRelease' x 0" ;;
  *download*) find . -name left >"$FOUND"; for name in cbmc_6.6.0-4 minisat_1%3a2.2.1-8; do echo other >"${name}_amd64.deb"; done ;;
  esac
TEXT
GEM = <<~TEXT
  #!/bin/sh
  case "$*" in
  *--install-dir*) mkdir "$5/cache" && echo other >"$5/cache/ceedling-1.2.1.gem" ;;
  *) echo "$*" >>"$FOUND" ;;
  esac
TEXT
OTHER = Digest::SHA256.hexdigest("other\n")

def programs(folder)
  Gate.write("#{folder}/apt-get", APT)
  Gate.write("#{folder}/dpkg", "#!/bin/sh\necho amd64\n")
  Gate.write("#{folder}/gem", GEM)
  Gate.write("#{folder}/ruby", "#!/bin/sh\necho /none\n")
  folder
end

# Without a ceedling, which no folder of this PATH has, nor one that Ruby would name.
def ceedling(folder)
  found = %w[sh gcc cc as ld mkdir mktemp rm tail sha256sum dirname id cat].to_h { |name| [name, `sh -c 'command -v #{name}'`.chomp] }
  found.each { |name, path| FileUtils.ln_sf(path, "#{folder}/#{name}") }
  script = ". #{PROJECT}/tools/lib/setup.sh; need() { :; }; need_ceedling"
  Gate.run('env', "PATH=#{folder}", "FOUND=#{folder}/found", 'sh', '-c', script)
end

def fetched(folder, home)
  Gate.run('env', "FOUND=#{folder}/found", "#{PROJECT}/tools/lib/build/fetch_cbmc", home, programs: folder)
end

# A private CBMC in this cache, after this command, and one more fetched where it is not
# taken.
def private_cbmc(folder, command)
  home = "#{folder}/cache/fixpid/cbmc-6"
  %w[cbmc goto-cc goto-instrument].each { |name| Gate.write("#{home}/#{name}", "#!/bin/sh\necho 6.6.0\n") }
  Gate.write("#{folder}/tools/lib/build/fetch_cbmc", "#!/bin/sh\necho fetched\nexit 1\n")
  script = ". tools/lib/setup.sh; . tools/lib/build/cbmc.sh; root=#{folder}; cd #{home}; #{command}; need_cbmc; echo $CBMC"
  Gate.run('env', '-u', 'CBMC', "XDG_CACHE_HOME=#{folder}/cache", 'PATH=/usr/bin:/bin', 'sh', '-c', "cd #{PROJECT}; #{script}")
end

def unpinned(text)
  text.scan(/^.*uses: (?!\.\/).*$/).grep_v(/uses: [\w-]+\/[\w-]+@\h{40} # v\d+\.\d+\.\d+$/)
end

Dir.mktmpdir do |folder|
  home = "#{folder}/cache/cbmc-6"
  Gate.write("#{home}.part/root/left", 'of one that was killed')
  Gate.write("#{home}.lock", '')
  result = fetched(programs("#{folder}/programs").tap { |path| File.delete("#{path}/ruby") }, home)
  Gate.refused('another package of CBMC', result, /cbmc_6\.6\.0-4_amd64\.deb has the SHA-256 #{OTHER}, expected 0256\h+: it is not used/)
  Gate.expect('what a killed fetch has left', File.read("#{folder}/programs/found"), '')
  Gate.expect('nothing is left of a refused one', Dir["#{home}*"], ["#{home}.lock"])
  Gate.refused('another gem', ceedling(programs("#{folder}/gem")), /ceedling-1\.2\.1\.gem has the SHA-256 #{OTHER}, expected 9280\h+: it is not used/)
  Gate.expect('it is not installed', File.exist?("#{folder}/gem/found"), false)
end
Dir.mktmpdir { |folder| Gate.passed('a private one as it was put there', private_cbmc(folder, 'seal .')) }
Dir.mktmpdir do |folder|
  Gate.refused('another byte of it', private_cbmc(folder, 'seal .; echo >>goto-cc'), /cbmc-6 is not as it was put there: it is not used/, /^fetched$/)
end
Dir["#{PROJECT}/.github/workflows/*.yml"].sort.each do |path|
  Gate.expect("the actions of #{File.basename(path)} are commits", unpinned(File.read(path)), [])
end
Gate.expect('an action by its tag', unpinned("      - uses: actions/checkout@v4\n").size, 1)
Gate.finish

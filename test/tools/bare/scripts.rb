# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# Every script that may install something, in a chroot with nothing, as far as the
# line that says so: scripts.rb CHROOT, where the project is in fixpid/.
require_relative 'outside'

CHROOT = ARGV.fetch(0)
APT_GET = '/usr/local/sbin/apt-get' # before the real one in PATH
INSIDE = ['chroot', CHROOT, 'env', '-C', '/fixpid'].freeze

def try(script)
  Outside.run(script, path: '/usr/local/sbin:/usr/sbin:/usr/bin:/sbin:/bin', record: "#{CHROOT}/tmp/asked", into: INSIDE)
end

def tell(what, wrong)
  puts wrong.empty? ? "ok #{what}" : "FAILED #{what}: #{wrong.join('; ')}"
  @failed ||= wrong.any?
end

Dir.chdir("#{CHROOT}/fixpid")
File.write("#{CHROOT}#{APT_GET}", Outside.apt_get('/tmp/asked'))
File.chmod(0o755, "#{CHROOT}#{APT_GET}")
Outside.scripts.each { |script| tell(script, Outside.complaints_of_root(try(script))) }

setup = File.read('tools/lib/setup.sh')
broken = setup.sub(*Outside::SILENT)
File.write('tools/lib/setup.sh', broken)
noticed = broken != setup && Outside.complaints_of_root(try('tools/demo')).include?('ends with status 2')
tell('seeded: announce as it was', noticed ? [] : ['nobody noticed'])
File.write('tools/lib/setup.sh', setup)
File.delete("#{CHROOT}#{APT_GET}")
exit(@failed ? 1 : 0)

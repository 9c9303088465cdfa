# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# A script that may install something, in a chroot with nothing, as far as the line
# that says so; or tools/demo with a fault that must be noticed. In the chroot the project
# is in fixpid/.
#
#   scripts.rb CHROOT NAME | --list
require_relative 'outside'

SEEDED = 'seeded: announce as it was'
if ARGV == ['--list']
  Dir.chdir(File.expand_path('../../..', __dir__))
  puts Outside.scripts, SEEDED
  exit
end

CHROOT, NAME = ARGV
APT_GET = '/usr/local/sbin/apt-get' # before the real one in PATH
INSIDE = ['chroot', CHROOT, 'env', '-C', '/fixpid'].freeze

def try(script)
  Outside.run(script, path: '/usr/local/sbin:/usr/sbin:/usr/bin:/sbin:/bin', record: "#{CHROOT}/tmp/asked", into: INSIDE)
end

# `announce` as it was must be noticed.
def seeded
  setup = File.read('tools/lib/setup.sh')
  broken = setup.sub(*Outside::SILENT)
  File.write('tools/lib/setup.sh', broken)
  broken != setup && Outside.complaints_of_root(try('tools/demo')).include?('ends with status 2') ? [] : ['nobody noticed']
ensure
  File.write('tools/lib/setup.sh', setup)
end

Dir.chdir("#{CHROOT}/fixpid")
File.write("#{CHROOT}#{APT_GET}", Outside.apt_get('/tmp/asked'))
File.chmod(0o755, "#{CHROOT}#{APT_GET}")
wrong = NAME == SEEDED ? seeded : Outside.complaints_of_root(try(NAME))
File.delete("#{CHROOT}#{APT_GET}")
puts wrong
exit(wrong.empty? ? 0 : 1)

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# A script that may install something, in a chroot with nothing, as far as the line
# that says so. In the chroot the project is in fixpid/.
#
#   scripts.rb CHROOT NAME | --list
require_relative 'outside'

if ARGV == ['--list']
  Dir.chdir(File.expand_path('../../..', __dir__))
  puts Outside.scripts
  exit
end

CHROOT, NAME = ARGV
APT_GET = '/usr/local/sbin/apt-get' # before the real one in PATH
INSIDE = ['chroot', CHROOT, 'env', '-C', '/fixpid'].freeze

def try(script)
  Outside.run(script, path: '/usr/local/sbin:/usr/sbin:/usr/bin:/sbin:/bin', record: "#{CHROOT}/tmp/asked", into: INSIDE)
end

Dir.chdir("#{CHROOT}/fixpid")
File.write("#{CHROOT}#{APT_GET}", Outside.apt_get('/tmp/asked'))
File.chmod(0o755, "#{CHROOT}#{APT_GET}")
wrong = Outside.complaints_of_root(try(NAME))
File.delete("#{CHROOT}#{APT_GET}")
puts wrong
exit(wrong.empty? ? 0 : 1)

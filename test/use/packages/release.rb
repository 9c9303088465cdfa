# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# What is wrong with what tools/release made, a line each:
#
#   release.rb RELEASE USERS SMALL
#
# RELEASE is its folder, USERS the unpacked .zip and SMALL the unpacked .tar.xz. The bill of
# materials must name each archive and each of those files with its digest, as SPDX 2.3 wants
# it, and nothing else; and links of the documents must lead somewhere.
require 'digest'
require 'json'
require 'open3'

Encoding.default_external = 'UTF-8'

# The digests are computed from what was unpacked, and not as the tool does.
class Bill
  DOCUMENT = %w[spdxVersion dataLicense SPDXID name documentNamespace creationInfo packages files relationships].freeze
  PACKAGE = %w[SPDXID name versionInfo packageFileName downloadLocation filesAnalyzed checksums licenseConcluded
               licenseDeclared copyrightText supplier].freeze
  FILE = %w[SPDXID fileName fileTypes checksums licenseConcluded licenseInfoInFiles copyrightText].freeze
  MADE_LATER = /\.spdx\.json\z|-commit\.txt\z|-logs\.tar\.xz\z|\ASHA256SUMS\z/.freeze
  ID = /\ASPDXRef-[A-Za-z0-9.-]+\z/.freeze

  def initialize(release)
    @release = release
    path = Dir["#{release}/*.spdx.json"].fetch(0)
    @version = File.basename(path, '.spdx.json').delete_prefix('fixpid-')
    @bill = JSON.parse(File.read(path))
    @files = @bill.fetch('files').to_h { |file| [file.fetch('SPDXID'), file] }
    @contained = @bill.fetch('relationships').select { |one| one['relationshipType'] == 'CONTAINS' }
                      .group_by { |one| one['spdxElementId'] }.transform_values { |all| all.map { |one| one['relatedSpdxElement'] } }
  end

  def faults(users, small)
    packages = @bill['packages'].to_h { |package| [package['packageFileName'], package] }
    shape + archives(packages) +
      packages.flat_map { |name, package| contents(name, package, tree_of(name, users, small)) }
  end

  private

  def tree_of(name, users, small)
    case name
    when /\.(?:zip|pack)\z/ then users
    when /-source\.tar\.xz\z/ then nil
    when /\.tar\.xz\z/ then small
    end
  end

  def shape
    elements = @bill['packages'] + @bill['files']
    ids = elements.map { |one| one['SPDXID'] }
    [*(DOCUMENT - @bill.keys).map { |field| "the document has no #{field}" },
     *(@bill['packages'].map { |one| one['versionInfo'] }.uniq - [@version]).map { |version| "a package of version #{version}, not #{@version}" },
     *@bill['packages'].flat_map { |one| (PACKAGE - one.keys).map { |field| "#{one['packageFileName']} has no #{field}" } },
     *@bill['files'].flat_map { |one| (FILE - one.keys).map { |field| "#{one['fileName']} has no #{field}" } },
     *ids.grep_v(ID).map { |id| "#{id} is no identifier" }, *ids.tally.select { |_, count| count > 1 }.keys.map { |id| "#{id} is there twice" },
     *(elements.map { |one| one['licenseConcluded'] }.uniq - ['MIT']).map { |license| "the licence is #{license}" },
     *(@bill['creationInfo']['created'].match?(/\A\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ\z/) ? [] : ['no time of creation'])]
  end

  def archives(packages)
    there = Dir.children(@release).grep_v(MADE_LATER).select { |name| File.file?("#{@release}/#{name}") }
    differences('archives', there.to_h { |name| [name, sha256("#{@release}/#{name}")] },
                packages.transform_values { |package| checksum(package, 'SHA256') })
  end

  def contents(name, package, tree)
    listed = @contained.fetch(package['SPDXID'], []).map { |id| @files.fetch(id) }
    return listed.empty? && !package['filesAnalyzed'] ? [] : ["#{name} lists files"] unless tree

    there = Dir.glob('**/*', File::FNM_DOTMATCH, base: tree).select { |path| File.file?("#{tree}/#{path}") }
    sums = Open3.capture2('sha1sum', '--', *there, chdir: tree).first.lines.map { |line| line[0, 40] }.sort
    code = Open3.capture2('sha1sum', stdin_data: sums.join).first[0, 40]
    differences(name, there.to_h { |path| ["./#{path}", sha256("#{tree}/#{path}")] },
                listed.to_h { |file| [file['fileName'], checksum(file, 'SHA256')] }) +
      (package.dig('packageVerificationCode', 'packageVerificationCodeValue') == code ? [] : ["#{name}: another verification code"])
  end

  def checksum(one, algorithm)
    one['checksums'].find { |sum| sum['algorithm'] == algorithm }&.fetch('checksumValue')
  end

  def sha256(path)
    Digest::SHA256.file(path).hexdigest
  end

  def differences(what, there, listed)
    (there.keys | listed.keys).reject { |key| there[key] == listed[key] }.map { |key| "#{what}: #{key} is #{listed[key].inspect}, not #{there[key].inspect}" }
  end
end

# README.md is whole; what only those need who work on fixpid, the other documents may name.
module Links
  ELSEWHERE = %w[python sim test tools].freeze

  module_function

  def faults(tree)
    Dir["#{tree}/**/*.md"].sort.flat_map do |path|
      broken = File.read(path).scan(/\]\(([^)#\s]+)[^)]*\)/).flatten.grep_v(/\A[a-z]+:/).reject { |link| File.exist?(File.expand_path(link, File.dirname(path))) }
      broken = broken.reject { |link| ELSEWHERE.include?(folder(tree, path, link)) } unless path == "#{tree}/README.md"
      broken.map { |link| "#{path.delete_prefix("#{tree}/")} leads to #{link}, which is not there" }
    end
  end

  def folder(tree, path, link)
    File.expand_path(link, File.dirname(path)).delete_prefix("#{File.expand_path(tree)}/").split('/').first
  end
end

release, users, small = ARGV
faults = Bill.new(release).faults(users, small) + Links.faults(users)
puts faults
exit(faults.empty? ? 0 : 1)

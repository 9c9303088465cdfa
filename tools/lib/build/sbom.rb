# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The bill of materials of a release, SPDX 2.3 in JSON: each file that is published is a
# package with its digest, and what users take in is listed file by file. fixpid contains
# nothing of others.
#
#   ruby tools/lib/build/sbom.rb FOLDER VERSION COMMIT SECONDS TREE
#
# FOLDER has the published files, TREE the unpacked .zip, and SECONDS is the commit's time:
# the same commit gives the same bytes. It prints the document.
require 'digest'
require 'json'
require 'time'
require_relative '../project'

Encoding.default_external = 'UTF-8'

class Sbom
  TYPES = { 'c' => 'SOURCE', 'h' => 'SOURCE', 'asm' => 'SOURCE', 'ino' => 'SOURCE', 'py' => 'SOURCE', 'cmake' => 'SOURCE',
            'md' => 'DOCUMENTATION', 'png' => 'IMAGE' }.freeze
  OWN_LICENSE = /SPDX-License-Identifier: ([\w.-]+)/n.freeze
  # Those whose files are listed, and which of the tree's they have.
  LISTED = { '.zip' => [''], '.pack' => [''], '.tar.xz' => Project::SMALL_FILES }.freeze

  def initialize(folder, version, commit, seconds, tree)
    @folder = folder
    @version = version
    @commit = commit
    @created = Time.at(seconds.to_i).utc.iso8601
    @tree = tree
    @files = Dir.glob('**/*', File::FNM_DOTMATCH, base: tree).select { |path| File.file?("#{tree}/#{path}") }.sort
                .to_h { |path| [path, file(path)] }
  end

  def to_s
    packages = Dir.children(@folder).sort.map { |name| package(name) }
    name = "#{Project::NAME}-#{@version}"
    "#{JSON.pretty_generate(spdxVersion: 'SPDX-2.3', dataLicense: 'CC0-1.0', SPDXID: 'SPDXRef-DOCUMENT', name: name,
                            documentNamespace: "https://spdx.org/spdxdocs/#{name}-#{@commit}",
                            creationInfo: { created: @created, creators: ['Tool: fixpid-tools-release', "Organization: #{Project::AUTHOR}"] },
                            packages: packages, files: @files.values, relationships: relationships(packages))}\n"
  end

  private

  def file(path)
    bytes = File.binread("#{@tree}/#{path}")
    { SPDXID: "SPDXRef-File-#{Digest::SHA1.hexdigest(path)[0, 16]}", fileName: "./#{path}",
      fileTypes: [TYPES.fetch(File.extname(path).delete('.'), 'TEXT')],
      checksums: [digest('SHA1', Digest::SHA1.hexdigest(bytes)), digest('SHA256', Digest::SHA256.hexdigest(bytes))],
      licenseConcluded: Project::LICENSE, licenseInfoInFiles: [bytes[OWN_LICENSE, 1] || 'NONE'], copyrightText: 'NOASSERTION' }
  end

  def digest(algorithm, value)
    { algorithm: algorithm, checksumValue: value }
  end

  # The archive of the source, with its tests, is not for taking in.
  def listed(name)
    parts = name.end_with?('-source.tar.xz') ? nil : LISTED[LISTED.keys.find { |ending| name.end_with?(ending) }]
    parts && @files.select { |path, _| parts.any? { |part| part.empty? || path == part || path.start_with?("#{part}/") } }
                   .reject { |path, _| parts == Project::SMALL_FILES && File.fnmatch?(Project::NOT_SMALL, path, File::FNM_PATHNAME) }
  end

  def package(name)
    files = listed(name)
    { SPDXID: "SPDXRef-Package-#{name.gsub(/[^A-Za-z0-9.-]/, '-')}", name: Project::NAME, versionInfo: @version, packageFileName: name,
      supplier: "Organization: #{Project::AUTHOR}",
      downloadLocation: Project::ADDRESS ? "git+#{Project::ADDRESS}@#{@commit}" : 'NOASSERTION',
      sourceInfo: "git commit #{@commit}", filesAnalyzed: !files.nil?, packageVerificationCode: files && { packageVerificationCodeValue: code(files) },
      checksums: [digest('SHA256', Digest::SHA256.file("#{@folder}/#{name}").hexdigest)],
      licenseConcluded: Project::LICENSE, licenseDeclared: Project::LICENSE,
      licenseInfoFromFiles: files && files.values.flat_map { |one| one[:licenseInfoInFiles] }.uniq.sort,
      copyrightText: File.read('LICENSE')[/^Copyright .*/] }.compact
  end

  # SPDX 2.3, 7.9: of the digests of all files, in order.
  def code(files)
    Digest::SHA1.hexdigest(files.values.map { |one| one[:checksums].first[:checksumValue] }.sort.join)
  end

  def relationships(packages)
    packages.flat_map do |one|
      files = listed(one[:packageFileName]) || {}
      [['SPDXRef-DOCUMENT', 'DESCRIBES', one[:SPDXID]], *files.values.map { |each| [one[:SPDXID], 'CONTAINS', each[:SPDXID]] }]
    end.map { |from, type, to| { spdxElementId: from, relationshipType: type, relatedSpdxElement: to } }
  end
end

puts Sbom.new(*ARGV) if $PROGRAM_NAME == __FILE__

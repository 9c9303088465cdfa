# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# .github/: the workflows and forms are what GitHub takes, as far as that can be told
# here; a command of theirs is one of the project's; and the workflow's list of parts,
# made by its own command, is the one of test/parts.txt.
require 'json'
require 'open3'
require 'yaml'

Dir.chdir(File.expand_path('../../..', __dir__))
@failures = []

def expect(what, condition)
  puts condition ? "ok #{what}" : "FAILED #{what}"
  @failures << what unless condition
end

workflows = Dir['.github/workflows/*.yml'].to_h { |path| [path, YAML.safe_load(File.read(path))] }
expect('three workflows', workflows.size == 3)
workflows.each do |path, workflow|
  expect("#{path} has a name, an event and jobs", workflow.key?('name') && workflow.key?(true) && workflow['jobs'].any?) # `on` is true in YAML
  workflow['jobs'].each do |name, job|
    expect("#{path}, #{name}: needs what is there", Array(job['needs']).all? { |needed| workflow['jobs'].key?(needed) })
    if job.key?('uses') # another workflow's jobs
      expect("#{path}, #{name}: #{job['uses']} may be called", workflows.dig(job['uses'].delete_prefix('./'), true)&.key?('workflow_call'))
      next
    end
    expect("#{path}, #{name}: a machine", job['runs-on'].is_a?(String))
    job['steps'].each do |step|
      expect("#{path}, #{name}: a step runs or uses", step.key?('run') ^ step.key?('uses'))
      next unless step['run']

      _, errors, status = Open3.capture3('sh', '-n', stdin_data: step['run'].gsub(/\$\{\{.*?\}\}/, 'x'))
      expect("#{path}, #{name}: `#{step['run']}` is a command #{errors}", status.success?)
      tools = step['run'].scan(%r{\b(?:tools|test/\w+)/\w+})
      expect("#{path}, #{name}: #{tools.join(' ')} is there", tools.all? { |tool| File.executable?(tool) })
    end
  end
end

tests = workflows.fetch('.github/workflows/test.yml')['jobs']
list = tests['parts']['steps'].find { |step| step['id'] == 'list' }['run']
Dir.mkdir('build') unless File.exist?('build')
File.write('build/github_output', '')
system({ 'GITHUB_OUTPUT' => 'build/github_output' }, 'sh', '-c', list)
parts = File.readlines('test/parts.txt').grep(/^[a-z]/).grep(/ daily /).map { |line| line.split.first }
expect('the parts of the workflow', File.read('build/github_output') == "parts=#{parts.to_json}\n")
expect('each part is run', tests['test']['steps'].any? { |step| step['run'] == 'tools/test ${{ matrix.part }}' })

Dir['.github/ISSUE_TEMPLATE/*.yml'].grep_v(/config/).each do |path|
  form = YAML.safe_load(File.read(path))
  expect("#{path} has a name and a description", form.values_at('name', 'description').all?(String))
  ids = form['body'].map { |field| field['id'] }
  expect("#{path}: each field has an id and a label", ids.uniq.size == ids.size && form['body'].all? { |field| field['attributes']['label'] })
  expect("#{path}: fields are of a known type", form['body'].all? { |field| %w[input textarea dropdown checkboxes markdown].include?(field['type']) })
end
exit(@failures.empty? ? 0 : 1)

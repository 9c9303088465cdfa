# SPDX-License-Identifier: MIT
# Whether a function that was changed does the same as it did.
require 'digest/sha2'
require 'fileutils'
require 'open3'
require_relative '../c_functions'
require_relative 'cbmc'

# A solver compares both for all arguments and all states of the object: what they return,
# what they leave, and that the changed one does nothing that C leaves undefined. Where they
# differ for an object that there never is, or a solver is slow at their products, the object
# is assumed to be what the harness calls sound, and contracts stand for the primitives; then
# each public function is shown to come with such an object only.
class Alike
  SECONDS = { any: 3, sound: 60 }.freeze
  FUNCTION = /^(?!typedef)(\w[\w \n*]*?)\b(\w+)\(([^;{}]*?)\)\s*\{.*?^\}/m.freeze
  SOUND = /^static\s+_Bool\s+(sound_settings|sound)\(const struct (\w+) \*/.freeze
  COMING = %w[--unwind 200 --drop-unused-functions --slice-formula --no-standard-checks].freeze # no number is of interest
  FROM_ANY = /_(?:init|restore)(?:_c)?\z/.freeze # they take an object of any bytes

  # One as a preprocessor leaves it.
  Function = Struct.new(:type, :name, :parameters, :text) do
    def result
      type.gsub(/\b(?:static|inline|const|extern)\b/, '').strip
    end

    def static?
      type.include?('static')
    end

    # Of each its type, its name, and the elements of an array.
    def arguments
      parameters.gsub(/\s+/, ' ').strip.sub(/\Avoid\z/, '').split(',').map do |one|
        one.strip.match(/\A(?:const )?(.*?)(\w+)(?:\[([^\]]*)\])?\z/).captures
      end
    end

    def head
      text[/\A[^{]*/m].strip
    end

    def body
      text[head.size..]
    end
  end

  # Where loops are those of src/, and an object is one.
  def self.can_ask?(proof)
    !proof.theorem? && !Proofs.text(proof.harness).include?('#define for(')
  end

  # In the form of a proof; `answers` are shared by all forms.
  def initialize(proof, build, answers)
    @proof = proof
    @build = build
    @answers = answers
    @object = proof.object
    @text = text('.')
    @functions = functions(@text)
    @sound, @type = @text.match(SOUND)&.captures
  end

  # Whether all functions that a tree changes are :alike, or it leaves the form :as_it_was;
  # of what else there may be :nothing is known.
  def answer(tree)
    other = text(tree)
    return :as_it_was if other == @text

    changed = functions(other).reject { |name, function| @functions[name]&.text == function.text }
    return :nothing if changed.keys.any? { |name| !ours.include?(name.delete_suffix('_c')) } || rest(other) != rest(@text)

    changed.values.all? { |function| alike?(function) } ? :alike : :nothing
  end

  private

  def alike?(function)
    same?(function, :any) || (takes_sound?(function) && same?(function, :sound) && comes_sound?(function))
  end

  def same?(function, objects)
    proved?(<<~C, SECONDS[objects], Cbmc::CHECKS, objects == :sound ? primitives(function) : [])
      #{needed(function.text, objects)}
      #{function.text.sub(/\b#{function.name}\(/, "#{function.name}_changed(")}
      void both(void)
      {
      #{values(function, objects)}
      #{call(function, '', 0)}
      #{'c_0 = c; c = c_any;' if @object}
      #{call(function, '_changed', 1)}
      #{equal(function)}
      }
    C
  end

  # Whether each public function comes to it with a sound object only.
  def comes_sound?(function)
    was = @functions.fetch(function.name)
    object = @object ? '&c' : was.arguments.first[1]
    asking = "static _Bool #{@sound}(const struct #{@type} *);\n#{was.head}\n{\n" \
             "__CPROVER_assert(#{@sound}(#{object}), \"sound\");\n#{was.body.sub('{', '')}"
    callers(function.name).select { |one| public?(one) }.all? do |entry|
      proved?(<<~C, SECONDS[:sound], COMING, [])
        #{needed(entry.text, :sound).sub(was.text) { asking }}
        void both(void)
        {
        #{values(entry, entry.name.match?(FROM_ANY) ? :any : :sound)}
        #{call(entry, '', 0)}
        }
      C
    end
  end

  def public?(function)
    @declared ||= Dir['include/*.h'].flat_map { |file| File.read(file).scan(/\b(fixpid_\w+)\(/).flatten }.uniq
    !function.static? && @declared.include?(function.name.delete_suffix('_c'))
  end

  # Itself, and what comes to it.
  def callers(name)
    found = [name]
    loop do
      more = @functions.values.select { |function| found.any? { |one| function.body.match?(/\b#{one}\b/) } }.map(&:name) - found
      break @functions.values_at(*found) if more.empty?

      found += more
    end
  end

  def takes_sound?(function)
    @sound && (@object || function.arguments.first&.first == "struct #{@type} *")
  end

  # What takes and gives numbers, and has a contract.
  def primitives(function)
    @functions.values.select do |one|
      one.name != function.name && @functions.key?("#{one.name}_contract") && one.arguments.none? { |type,| type.match?(/\*|\bstruct\b/) }
    end.map(&:name)
  end

  # What a function's text needs of the form's, for sound objects with what says so, and contracts.
  def needed(text, objects)
    names = text.scan(/\w+/)
    names += [@sound, *@functions.keys.grep(/_contract\z/)] if objects == :sound
    loop do
      more = @functions.slice(*names).values.flat_map { |function| function.text.scan(/\w+/) }.uniq - names
      break if more.empty?

      names += more
    end
    @text.gsub(FUNCTION) { names.include?(Regexp.last_match[2]) ? Regexp.last_match[0] : '' }
  end

  # Any values of the arguments, each twice, and of the object.
  def values(function, objects)
    lines = function.arguments.map do |type, name, elements|
      elements ? "struct { #{type} of[#{elements}]; } #{name}_0;" : "#{type.delete('*').strip} #{name}_0;"
    end
    lines << "struct fixpid_#{@object} c_any; struct fixpid_#{@object} c_0;" if @object
    lines << "__CPROVER_assume(#{@sound}(&#{@object ? 'c_any' : "#{function.arguments.first[1]}_0"}));" if objects == :sound
    lines << 'c = c_any;' if @object
    (lines + function.arguments.map { |_, name,| "__typeof__(#{name}_0) #{name}_1 = #{name}_0;" }).join("\n")
  end

  def call(function, mark, which)
    arguments = function.arguments.map { |type, name, elements| "#{'&' if type.include?('*')}#{name}_#{which}#{'.of' if elements}" }
    result = "#{function.result} result_#{which} = " unless function.result == 'void'
    "#{result}#{function.name}#{mark}(#{arguments.join(', ')});"
  end

  def equal(function)
    pairs = function.arguments.map { |_, name,| ["#{name}_0", "#{name}_1"] }
    pairs << %w[result_0 result_1] unless function.result == 'void'
    pairs << %w[c_0 c] if @object
    pairs.map { |pair| "__CPROVER_assert(__CPROVER_equal(#{pair.join(', ')}), \"the same\");" }.join("\n")
  end

  def proved?(source, seconds, options, contracts)
    known = [@proof.word, source, contracts]
    @answers.fetch(known) { @answers[known] = ask("#{@build}/alike_#{Digest::SHA256.hexdigest(known.join)[0, 16]}", source, seconds, options, contracts) }
  end

  def ask(path, source, seconds, options, contracts)
    File.write("#{path}.c", source)
    tool('goto-cc', "--#{@proof.word}", "#{path}.c", '--function', 'both', '-o', path)
    contracts.each { |one| tool('goto-instrument', '--replace-calls', "#{one}:#{one}_contract", path, path) }
    said, = Open3.capture2e(AskedOnce.environment, "#{ENV.fetch('CBMC')}/cbmc", path, *options, '--stop-on-fail', rlimit_cpu: [seconds, seconds + 1])
    said.match?(/^VERIFICATION SUCCESSFUL$/) && !said.match?(/^Generated 0 VCC/)
  ensure
    FileUtils.rm_f([path, "#{path}.c"])
  end

  def text(tree)
    tool('goto-cc', '-E', *@proof.flags(tree), @proof.harness).lines.grep_v(/^#|^\s*$/).join
  end

  # Gives what it says.
  def tool(name, *arguments)
    said, complaint, good = Open3.capture3(AskedOnce.environment, "#{ENV.fetch('CBMC')}/#{name}", *arguments)
    good.success? or abort "prove: #{@proof.name}: #{complaint}#{said}"
    said
  end

  def functions(text)
    text.to_enum(:scan, FUNCTION).map { Function.new(*Regexp.last_match[1..3], Regexp.last_match[0]) }.to_h { |function| [function.name, function] }
  end

  # What is no function.
  def rest(text)
    text.gsub(FUNCTION, '')
  end

  def ours
    @ours ||= Dir['src/**/*.[ch]'].flat_map { |file| CFunctions.of_lines(File.readlines(file)) }.compact.uniq
  end
end

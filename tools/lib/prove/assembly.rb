# SPDX-License-Identifier: MIT
# frozen_string_literal: true

require 'fileutils'
require_relative 'assembly/arm'
require_relative 'assembly/avr'
require_relative 'assembly/pic14'
require_relative 'assembly/pic18'
require_relative 'cbmc'
require_relative 'exhaustion'

# An operand or a result of a claim: for an operand `text` is its name, for a result the C
# that it must equal.
Operand = Struct.new(:type, :text, :limit, :place) do
  # An operand that is a number.
  def constant?
    text.match?(/\A\d/)
  end

  def bytes
    type[/\d+/].to_i / 8
  end

  def signed?
    type.start_with?('int')
  end

  # The least value and the greatest, in C.
  def range
    return limit ? ["-#{limit}", limit] : ["INT#{bytes * 8}_MIN", "INT#{bytes * 8}_MAX"] if signed?

    ['0', limit || "UINT#{bytes * 8}_MAX"]
  end
end

# A row of test/proof/assembly/claims.txt.
Claimed = Struct.new(:image, :function, :how, :operands, :condition, :results) do
  def name
    "#{image} #{function} #{how}"
  end

  def matches?(words)
    words.all? { |word| name.split.include?(word) }
  end
end

# The claims about assembly, and the programs that show them.
module Assembly
  CLAIMS = "#{FOLDER}/assembly/claims.txt"
  ROW = /\A(\w+) (\w+) by (solver|products|trying): (.*?)(?: where (.*))? -> (.*)\z/.freeze
  OPERAND = /\A(u?int(?:8|16|32)_t) (\w+)(?: within (\w+))? in (\S+)\z/.freeze
  RESULT = /\A(u?int(?:8|16|32)_t) in (\S+) = (.+)\z/.freeze
  # Not the empty one, which only hides a value from the compiler.
  TEXT = /__asm__\s*\(\s*"[^"]|__asm$/.freeze
  SETS = [ArmTranslation, AvrTranslation, Pic14Translation, Pic18Translation].freeze

  module_function

  def claims
    @claims ||= File.readlines(CLAIMS, chomp: true).grep_v(/^#|^\s*$/).map { |row| claim(row) }
  end

  def claim(row)
    image, function, how, operands, condition, results = row.match(ROW)&.captures
    image or abort "prove: #{CLAIMS}: no such row: #{row}"
    Claimed.new(image, function, how,
                operands.split(', ').map { |text| Operand.new(*(text.match(OPERAND) or abort("prove: #{CLAIMS}: no operand: #{text}")).captures) },
                condition,
                results.split('; ').map do |text|
                  type, place, c = (text.match(RESULT) or abort("prove: #{CLAIMS}: no result: #{text}")).captures
                  Operand.new(type, c, nil, place)
                end)
  end

  def set_of(image)
    SETS.find { |set| set.images.include?(image) } or abort "prove: #{CLAIMS}: no image #{image}"
  end

  # The files of src/ with assembly that is in no image.
  def outside
    files = Dir['src/**/*.[ch]'].sort.select { |file| File.read(file).match?(TEXT) }
    files.reject { |file| SETS.any? { |set| set.sources.match?(file) } }
  end

  # In documents.
  def family(image)
    set_of(image)::NAME
  end

  # The program of an image, translated.
  def image(name, build, tree = '.')
    folder = "#{build}/assembly_#{name}#{tree == '.' ? '' : "_#{File.basename(tree)}"}"
    FileUtils.mkdir_p(folder)
    set_of(name).of(name, folder, tree)
  end
end

# The C programs of a claim: one for CBMC, and one that tries all operands.
class ClaimText
  def initialize(claim, image)
    @claim = claim
    @image = image
    @all = claim.operands
    @operands = @all.reject(&:constant?)
    @results = claim.results
  end

  # Both begin with this: the functions made of the assembly, and what they are called with.
  def functions
    @functions ||= <<~TEXT
      #include "#{@image.class::MODEL}"

      #{@image.c_of('run' => @claim.function)}
      #{@image.places(@claim)}
      static void set(struct cpu *cpu#{declared})
      {
      #{@all.map { |one| "    #{written(one)}\n" }.join}}
      #{itself}
    TEXT
  end

  # That the results are right, if it is not tried, and that all else is as it was.
  def to_solve
    <<~TEXT
      #{functions}void proof(void)
      {
          struct cpu cpu;
          unsigned anywhere;
      #{@operands.map { |one| "    #{one.type} #{one.text};\n" }.join}
      #{assumptions.map { |condition| "    __CPROVER_assume(#{condition});\n" }.join}    begin(&cpu);
          set(&cpu#{names});
          const struct cpu before = cpu;
          run(&cpu);
          __CPROVER_assert(kept(&before, &cpu, anywhere), "what the caller needs is as it was");
      #{equality if @claim.how != 'trying'}}
    TEXT
  end

  def to_try
    <<~TEXT
      #include <stdio.h>
      #{functions}int main(void)
      {
          static struct cpu cpu;
          unsigned long long cases = 0;
          begin(&cpu);
      #{@operands.map { |one| loop_over(one) }.join}
      #{@claim.condition ? "    if (!(#{@claim.condition})) { continue; }\n" : ''}
          cases++;
          turns = 0;
          litter(&cpu, (cases * 0x9E3779B97F4A7C15u >> 63) ? 0xFF : 0);
          set(&cpu#{names});
          run(&cpu);
      #{@results.map { |one| trial(one) }.join}
      #{'    }' * @operands.size}
          printf("%llu cases\\n", cases);
          return 0;
      }
    TEXT
  end

  private

  # For what a claim says of the assembly's own result with other operands.
  def itself
    return '' unless @results.any? { |one| one.text.include?('itself(') }

    <<~TEXT
      static #{@results.first.type} itself(#{declared.delete_prefix(', ')})
      {
          struct cpu cpu;

          begin(&cpu);
          set(&cpu#{names});
          run(&cpu);
          return #{read(@results.first, 'cpu')};
      }
    TEXT
  end

  def declared
    @operands.map { |one| ", #{one.type} #{one.text}" }.join
  end

  def names
    @operands.map { |one| ", #{one.text}" }.join
  end

  def written(operand)
    (0...operand.bytes).map do |index|
      "#{@image.place(operand.place, index)} = (uint8_t)((uint32_t)#{operand.text} >> #{8 * index});"
    end.join(' ')
  end

  def read(result, cpu)
    bytes = (0...result.bytes).map { |index| "((uint32_t)#{@image.place(result.place, index).gsub('cpu->', "#{cpu}.")} << #{8 * index})" }
    "(#{result.type})(#{bytes.join(' | ')})"
  end

  def assumptions
    limits = @operands.select(&:limit).map { |one| "#{one.text} >= #{one.range[0]} && #{one.text} <= #{one.range[1]}" }
    [*limits, @claim.condition].compact
  end

  def equality
    @results.map { |one| "    __CPROVER_assert(#{read(one, 'cpu')} == (#{one.type})(#{one.text}), \"#{one.text}\");\n" }.join
  end

  def loop_over(operand)
    from, to = operand.range
    "    for (int64_t each_#{operand.text} = #{from}; each_#{operand.text} <= #{to}; each_#{operand.text}++) {\n" \
      "    const #{operand.type} #{operand.text} = (#{operand.type})each_#{operand.text};\n"
  end

  def trial(result)
    values = @operands.map { |one| [one.text, "(long long)#{one.text}"] }
    "    if (#{read(result, 'cpu')} != (#{result.type})(#{result.text})) {\n" \
      "        printf(\"#{@claim.function}(#{values.map { |name, _| "#{name} %lld" }.join(', ')}) is %lld, not %lld\\n\", " \
      "#{values.map(&:last).join(', ')}, (long long)#{read(result, 'cpu')}, (long long)(#{result.type})(#{result.text}));\n" \
      "        return 1;\n    }\n"
  end
end

# What Cbmc and Exhaustion are asked for: a claim's program, as a proof.
Written = Struct.new(:name, :harness, :options) do
  include Compiled

  def word
    HOST
  end

  def function
    'proof'
  end

  def compiler
    %w[cc -std=c99]
  end

  def what
    'assembly'
  end

  def contracts
    []
  end
end

# Asks for a claim in a folder: CBMC, and the program that tries all operands.
class ClaimRun
  EACH_BYTE = %w[--max-field-sensitivity-array-size 1024].freeze # of a memory is a variable of its own
  SHARED = %w[-D_PIC18 -DPRODUCTS_SHARED].freeze
  SECONDS_MOST = 600

  def initialize(claim, text, folder, seconds = SECONDS_MOST)
    @claim = claim
    @text = text
    @folder = folder
    @seconds = seconds
  end

  # The first answer that is not good, or the last one.
  def run
    FileUtils.rm_rf(@folder)
    FileUtils.mkdir_p(@folder)
    tried = @claim.how == 'trying'
    answer = Cbmc.new(written('solve', @text.to_solve, @claim.how == 'solver' ? [] : SHARED), @folder, '.', @seconds, EACH_BYTE).run
    return answer unless tried && answer.verdict == :proved

    Exhaustion.new(written('try', @text.to_try, []), @folder, '.', @seconds).run
  end

  private

  def written(name, text, options)
    harness = "#{@folder}/#{name}.c"
    File.write(harness, text)
    Written.new(name, harness, ["-I#{FOLDER}/assembly", *options])
  end
end

# Whether the tables say what the instructions do: the same as the chip's simulator, with
# random registers and flags.
class TableRun
  EXAMPLE = /\A([a-z]+)_\d+\z/.freeze
  SECONDS_MOST = 60 # of a processor; the longest takes 2

  def initialize(set, build)
    @set = set
    @folder = "#{build}/assembly_instructions_#{set::MODEL.delete_suffix('.h')}"
  end

  def name
    "#{@set::MODEL.delete_suffix('.h')} instructions"
  end

  # Whether it is good, and its line.
  def run
    FileUtils.mkdir_p(@folder)
    examples = @set.examples(@folder)
    untried = @set.names - examples.entries.keys.map { |entry| entry[EXAMPLE, 1] }
    return [false, "#{name}: no example of #{untried.join(', ')}"] if untried.any?

    File.write("#{@folder}/instructions.h", text(examples))
    said, status = compared
    [status, "#{name}: #{status ? said.lines.last.to_s.strip : said.lines.first(8).join}#{' as the simulator does them' if status}"]
  end

  private

  def text(examples)
    functions = examples.entries.select { |entry, _| entry.match?(EXAMPLE) }.map { |entry, at| [entry, at, "run_#{entry}"] }
    "#include \"#{@set::MODEL}\"\n#{examples.c_of(functions.to_h { |entry, _, run| [run, entry] })}\n" \
      "static const struct instruction {\n    const char *name;\n    uint32_t entry;\n    void (*run)(struct cpu *cpu);\n} " \
      "instructions[] = {\n#{functions.map { |entry, at, run| "    {\"#{entry}\", #{at}, #{run}},\n" }.join}};\n"
  end

  def compared
    said, status = Open3.capture2e(*@set::COMPILE, '-O1', '-w', "-I#{@folder}", "-I#{FOLDER}/assembly", '-Iinclude', '-Isrc',
                                   '-o', "#{@folder}/compared", *@set::SIMULATOR)
    return [said, false] unless status.success?

    said, status = Open3.capture2e(*@set.compared(@folder), in: File::NULL, rlimit_cpu: [SECONDS_MOST, SECONDS_MOST + 1])
    [said, status.success?]
  end
end

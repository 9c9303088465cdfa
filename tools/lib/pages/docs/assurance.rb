# SPDX-License-Identifier: MIT
# The tables of docs/assurance.md: what is claimed, how it is known, of how much, and the command
# that shows it; the theorems; and what the proofs assume. What can be counted is counted here.
require_relative '../../data_tables'
require_relative '../../prove/assembly'
require_relative '../../prove/domains'
require_relative '../../prove/seeded'
require_relative '../../demo/plot'
require_relative '../../demo/random_plants'
require_relative '../../demo/faults'
require_relative '../../demo/fault_places'
require_relative 'commands'

# A claim; `how` is one of Assurance::HOW.
Claim = Struct.new(:how, :what, :amount, :command)

# All of them.
module Assurance
  HOW = %w[proved exhaustive tested measured argued].freeze
  PAGE = 'docs/assurance.md'.freeze

  # What is proved of a module of whose header a part is only tested or tried.
  PARTLY = {
    'autotune' => 'in part: init, progress and a record, as its header says; a step as the definition says, by contracts of its parts, ' \
                  'of the relay that comes next only its range, and not which cycles are alike; not its result, but sums and differences of its numbers',
    'reaction' => 'in part: init as its header says; of any bytes, a step is defined, puts out what it may and leads to the end, and what it tells is ' \
                  'within its range; an experiment stays one; not what its parts compute',
    'gains' => 'as its header says, but for a product of 64 bits in which neither number is a power of two, which is tested',
    'tpo' => 'as its header says, what a window asks for only where its length is a power of two'
  }.freeze

  module_function

  # Each file's text.
  def files
    { 'claims' => [%w[known claim amount command], *table], 'theorems' => [%w[module theorem assumed command], *theorems],
      'domains' => [%w[module domain holds], *domains] }.to_h { |name, rows| ["#{DataTables::FOLDER}/#{name}.csv", DataTables.text(rows)] }
  end

  def table
    claims.sort_by.with_index { |claim, i| [HOW.index(claim.how), i] }.map(&:to_a)
  end

  # The sentences that stand above the theorems' proofs.
  def theorems
    groups.fetch(THEOREMS).uniq { |proof| [proof.form, proof.what] }.map do |proof|
      ["fixpid_#{proof.form}", proof.sentence, proof.assumed, "`tools/prove #{THEOREMS} #{proof.what}`"]
    end
  end

  # What the proofs of each module assume: the words above its domains.
  def domains
    Domains.all.group_by(&:group).slice(*groups.keys).flat_map do |group, of_module|
      of_module.map { |domain| ["fixpid_#{group}", domain.name, domain.words] }
    end
  end

  # The commands that do not exist.
  def failures
    claims.flat_map { |claim| claim.command.scan(/`([^`]+)`/).flatten }.uniq.reject { |command| Commands.known?(command) }
          .map { |command| "#{PAGE}: no #{command}" }
  end

  def claims
    proved + exhaustive + tested + measured + argued
  end

  def proved
    breaks = Seeded.all(Proofs.all)
    groups.except(PRIMITIVES).map do |group, proofs|
      drawn = Seeded.long_functions.count { |place| place.first.split('/')[1] == group && !Seeded.unproved?(*place) }
      noticed = breaks.count { |broken| broken.proof.group == group } + (drawn * Seeded::BREAKS)
      forms = group == THEOREMS ? [] : proofs.map(&:form).uniq - ['any']
      Claim.new('proved', of_the_proofs(group, proofs),
                "#{proofs.size} proofs#{", in the forms #{forms.join(', ')}" if forms.any?}; planted faults refuted: #{noticed}",
                "`tools/prove #{group}`")
    end + beside_the_proofs
  end

  def beside_the_proofs
    [Claim.new('proved', 'no assumption of a proof leaves out a place of what is proved, a claim or an end', 'each form with all features; claims and ends in all',
               '`tools/prove --coverage`'),
     Claim.new('proved', 'no memory is read before it was written', "but for the #{rows_of('test/proof/eva/alarms.txt')} " \
               'alarms that are listed with their reasons', '`tools/prove --eva`'),
     by_model]
  end

  # How much of the assembly is proved or tried by what its instructions do.
  def by_model
    functions = Assembly.claims.map { |claim| [Assembly.family(claim.image), claim.function] }.uniq
    families = functions.map(&:first).tally.map { |family, count| "#{count} of #{family}" }
    Claim.new('proved', 'the assembly, as it is linked, equals the C that it replaces, for all operands',
              "#{families[0..-2].join(', ')} and #{families.last}; but for what docs/assurance.md names", '`tools/prove --assembly`')
  end

  def of_the_proofs(group, proofs)
    return 'the proofs run with words of 16, 32 and 64 bits' if group == 'model'
    return "the theorems: #{proofs.map { |proof| proof.what.tr('_', ' ') }.uniq.join(', ')}" if group == THEOREMS

    said = PARTLY.fetch(group, 'as its header says')
    "`fixpid_#{group}`, #{said}: #{proofs.map { |proof| proof.what.tr('_', ' ') }.uniq.join(', ')}"
  end

  def exhaustive
    [Claim.new('exhaustive', 'the primitives, with all operands', "#{groups[PRIMITIVES].count { |proof| proof.what == 'all' }} forms",
               "`tools/prove #{PRIMITIVES} all`"),
     Claim.new('exhaustive', 'what a window of `fixpid_tpo` asks for, duty * window', 'all duties in all windows', "`tools/prove #{PRIMITIVES} tpo`"),
     Claim.new('exhaustive', 'a record with 1, 2 or 3 wrong bits is refused', 'all of them', '`tools/test unit`'),
     Claim.new('exhaustive', "the AN964 forms' products and quotients, as the chips' assembly has them",
               'all gains; operands of 14 bits in strides', '`test/chips/target/run arith`')]
  end

  def tested
    of_the_library + of_the_chips + of_the_loops + of_the_tests
  end

  def of_the_library
    [Claim.new('tested', "the same as the notes' own firmware", "#{rows('*_firmware')} recorded steps",
               '`tools/test unit`'),
     Claim.new('tested', 'the same as the definition', "#{rows('*') - rows('*_firmware')} recorded rows and experiments, " \
               'and a million random calls', '`tools/test unit`'),
     Claim.new('tested', 'the same as the definition, on inputs that look for new ways through the code',
               "#{Faults.of('fuzz').size} defects found", '`tools/test fuzz long`'),
     Claim.new('tested', 'each sentence of the headers, where `int` has 32 bits and where it has 16',
               'every line and branch', '`tools/test unit cores`'),
     Claim.new('tested', 'nothing that C leaves undefined',
               "all targets of the fuzzer and the unit tests, under clang's sanitizers",
               '`tools/test fuzz sanitize long variants`'),
     Claim.new('tested', 'no warning and nothing of clang-tidy; of the rules of MISRA C:2012 that cppcheck has, only named deviations',
               'the library, the ports and the examples', '`tools/test lint`'),
     Claim.new('tested', 'the same as a program for Windows, under Wine, and by the newest gcc and clang', 'all recorded rows; ' \
               'the newest SDCC only compiles', '`tools/test windows newest`'),
     Claim.new('tested', 'it builds as users build it', 'with CMake, by plain C and C++ compilers, for other chips', '`tools/test consumers variants`')]
  end

  def of_the_chips
    [Claim.new('tested', 'the compiled library, and its assembly, the same on every chip as here',
               'the unit tests on six cores, recorded rows and random steps on other chips', '`tools/test cores target families variants`'),
     Claim.new('tested', 'an interrupt before every instruction changes nothing',
               'every instruction of a turn on a PIC16, a PIC18 and an AVR',
               '`test/chips/target/run interrupts`'),
     Claim.new('tested', '`fixpid_an937_tick` may interrupt each function of its controller before every instruction',
               'of a step on a PIC18; of all functions on an AVR and on Cortex-M0, M3 and M4',
               '`test/chips/target/run interrupts`'),
     Claim.new('tested', 'a port keeps its promises at its pins and registers',
               "#{Faults.of('port').size} faults noticed", '`test/chips/target/run port seeded`')]
  end

  def of_the_loops
    here = FAULT_LOOPS.values.sum(&:runs)
    there = CHIP_FAULTS.values.sum(&:runs)
    long = FAULT_LOOPS.values.sum(&:long_runs)
    [Claim.new('tested', 'the firmware controls its plant, each step the same as the definition',
               'closed loops on simulated chips', '`tools/test chip`'),
     Claim.new('tested', 'with a fault the drive stays inside its limits, and the loop is back in time or off',
               "#{here} faults here, #{there} on simulated chips: flips in the controller's object, resets, hangs, inputs and ticks; " \
               "#{long} here in docs/faults.md, with an older version of the motor and the oven",
               '`tools/demo --whole faults faults_chip`'),
     Claim.new('measured', "what a flip elsewhere in a chip does: in the port's variables, the others, the registers, the stack in RAM",
               "#{FaultPlaces::LONG_RUNS} flips in each place of #{FaultPlaces::CHIPS.size} firmwares; those where the simulator stops show nothing: " \
               'docs/faults.md', '`tools/demo --long faults_places`')]
  end

  def of_the_tests
    [Claim.new('tested', 'a small change of the portable C or of a macro is noticed by a named test',
               "all changes but #{rows_of('test/tools/mutants/equivalent.txt')} that change nothing; " \
               "#{Faults.of('unit').size} faults of other kinds", '`tools/test mutants`'),
     Claim.new('tested', 'every checker reports an error that is seeded for it', 'one error each',
               '`tools/test gates`')]
  end

  def measured
    [Claim.new('measured', 'what a step takes at most: cycles, flash, RAM and stack',
               'a bound of the linked code, and the worst that a search finds',
               '`tools/test cost`'),
     Claim.new('measured', 'how good the gains of the tuners are',
               "#{STUDY_SEEDS.size * STUDY_PLANTS} plants; #{LONG_SEEDS.size * LONG_PLANTS} random plants and " \
               "#{LONG_SEEDS.size * MACHINES_EACH * MACHINE_KINDS} machines " \
               'in docs/tuners.md',
               '`tools/demo random_plants`'),
     Claim.new('measured', 'how the loops settle, and beside double precision', 'all of its loops',
               '`tools/demo`')]
  end

  def argued
    [Claim.new('argued', 'the recorded steps are those of the notes, because they were taken from their firmware', '',
               'docs/migrating.md'),
     Claim.new('argued', 'a step takes no longer than its bound: interrupts and what waits for hardware are not in it',
               '', 'docs/cost.md'),
     Claim.new('argued', 'a rate that the caller keeps is the rate that the gains are for', '',
               'SECURITY.md'),
     Claim.new('argued', 'silicon does what the simulators do, but for their known defects', '',
               'docs/ports.md')]
  end

  def groups
    @groups ||= Proofs.all.group_by(&:group)
  end

  # Recorded ones, without the head of each file.
  def rows(names)
    Dir["test/support/vectors/#{names}.csv"].sum { |path| File.readlines(path).size - 1 }
  end

  def rows_of(path)
    File.readlines(path).grep_v(/\A(?:#|\s*\z)/).size
  end
end

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The modules of the library, an entry each: whoever wants to know of them looks here, or
# for files by their names. `ruby tools/lib/modules.rb` says what a module lacks, and so
# does tools/lib/pages/check_docs.rb. An entry says:
#
#   title    in packages
#   what     one sentence, for packages
#   fuzz     inputs that test/fuzz/run makes, and most bytes of each
#   narrow   that it makes them for the arithmetic of an 8-bit chip, too
#   rows     the columns of its recorded rows, with their types, that its calls_x.c takes
#   shared   more of them, which are the same in many rows
#   uses     modules whose sources a program of it links, too
#   calls    what tools/cost meters of its calls_x.c, and bounds: CalledModule in tools/lib/measure/
#
# A controller of the notes, and fixpid_pid, has its cost in CONTROLLERS of
# tools/lib/measure/subjects.rb. What any may cost at most is in tools/lib/measure/limits.csv.
module Modules
  ALL = {
    'slew' => {
      title: 'Slew', what: 'A value that follows a target at limited speed',
      fuzz: [20_000, 256],
      rows: %w[event:uint8_t rise_q16:uint32_t fall_q16:uint32_t seed:int16_t target:int16_t],
      calls: [{ object: 'slew', calls: 5000, functions: { 'fixpid_slew_step' => 'step' } }]
    },
    'tpo' => {
      title: 'Time-proportioned output', what: 'Time-proportioned output for relays and valves',
      fuzz: [20_000, 256],
      rows: %w[event:uint8_t full:int16_t window:uint16_t minimum_on:uint16_t minimum_off:uint16_t duty:int16_t],
      calls: [{ object: 'tpo', calls: 5000, functions: { 'fixpid_tpo_step' => 'step' } }]
    },
    'guard' => {
      title: 'Guard', what: 'An alarm when a loop no longer does what it should',
      fuzz: [20_000, 512],
      rows: %w[event:uint8_t setpoint:int16_t measurement:int16_t output:int16_t repeat:uint16_t],
      shared: %w[output_min:int16_t output_max:int16_t measurement_min:int16_t measurement_max:int16_t
                 reach_min:int16_t reach_max:int16_t band:uint16_t patience:uint16_t options:uint8_t],
      calls: [{ object: 'guard', calls: 5000, functions: { 'fixpid_guard_step' => 'step' }, pic: %w[pointer object] },
              # A PIC16 has no room for its pointers, and no bound where its code lies in pages.
              { object: 'guard', calls: 20_000, functions: { 'fixpid_guard_step' => 'step' }, kinds: %i[pic16], pic: %w[object],
                rows: 100, unbounded: %w[fixpid_guard_step] }]
    },
    'gains' => {
      title: 'Gains', what: 'Gains of fixpid_pid from thousandths at run time, and back',
      fuzz: [20_000, 256],
      rows: %w[kp_milli:uint32_t ki_milli:uint32_t kd_milli:uint32_t rate_milli:uint32_t filter:uint8_t],
      # A turn for each bit of the quotient, and a shift by a filter of at most 7, each with
      # the test that ends it.
      calls: [{ calls: 2000, functions: { 'fixpid_gains_from_milli' => 'from_milli', 'fixpid_gains_to_milli' => 'to_milli' },
                turns: { 'scaled' => 33, 'fixpid_gains_from_milli' => 8, 'fixpid_gains_to_milli' => 8 } }]
    },
    'table' => {
      title: 'Table', what: 'A curve from points, with straight lines between them',
      fuzz: [20_000, 512],
      rows: %w[kind:uint8_t x:int16_t y:int16_t],
      # The search turns 8 times and the division by hand 16 times, in the order of the code;
      # each is left or tested once more. A Cortex-M0 divides by a routine that jumps into
      # its own loop, so that no bound can be told.
      calls: [{ calls: 2000, functions: { 'fixpid_table_at' => 'at' }, without: /_avr\.o\z/, kinds: %i[avr pic],
                turns: { 'fixpid_table_at' => [9, 17], 'rise_at' => 17 } },
              { calls: 2000, functions: { 'fixpid_table_at_P' => 'at, in flash' }, without: /_fixpid_table\.o\z/, kinds: %i[avr],
                turns: { 'fixpid_table_at_P' => [9, 17] } },
              { calls: 2000, functions: { 'fixpid_table_at' => 'at' }, kinds: %i[arm], unbounded: %w[fixpid_table_at] },
              # A bank of a PIC16 holds fewer points, and it jumps to an address that it calculates.
              { calls: 2000, functions: { 'fixpid_table_at' => 'at' }, kinds: %i[pic16], rows: 100, flags: %w[-DPOINTS=16],
                unbounded: %w[fixpid_table_at] }]
    },
    'record' => {
      title: 'Record', what: 'A tuning of fixpid_pid as bytes for an EEPROM',
      fuzz: [20_000, 256],
      # A turn for each byte of the check and one for each of its bits, and where the loop is
      # left; by whatever name a compiler has it.
      calls: [{ calls: 2000, functions: { 'fixpid_record_pack' => 'pack', 'fixpid_record_unpack' => 'unpack' },
                program: %w[test/support/numbers_pid.c test/support/numbers_control.c],
                turns: %w[check_of check_of.constprop.0 fixpid_record_pack fixpid_record_unpack].to_h { |name| [name, [22, 9]] } }]
    },
    'link' => {
      title: 'Link', what: 'The steps of fixpid_pid over a serial wire, and commands back',
      fuzz: [20_000, 512], uses: %w[pid record],
      # The turns of a check are those of its bytes, which no constant tells. What meters an ARM passes four arguments. A
      # PIC18F4520 has room for the stream alone.
      calls: [[:pic, { 'step' => 'stream only, step' }, { pic: %w[object], takes: %r{/fixpid_link\.c\z},
                                                         flags: %w[-DCALLS_STREAM -DFIXPID_PID_OBJECT=pid -DFIXPID_PID_FEATURES=0x00] }],
              [:avr, { 'step' => 'step', 'receive' => 'receive' }], [:avr, { 'answer' => 'answer' }],
              [:avr, { 'step_tracked' => 'step_tracked' }, { takes: /_link/, flags: %w[-DCALLS_TRACKED] }, 'src/pid/fixpid_pid_track.c'],
              [:arm, { 'receive' => 'receive', 'answer' => 'answer' }]].map do |kind, functions, more, *linked|
        names = functions.transform_keys { |name| "fixpid_link_#{name}" }
        { object: 'wire', calls: 1000, kinds: [kind], functions: names, unbounded: names.keys,
          program: %w[test/support/numbers_control.c test/support/numbers_pid.c sim/link/link_frames.c] + linked, **(more || {}) }
      end
    },
    'pid' => {
      title: 'PID', what: 'The general-purpose controller',
      fuzz: [20_000, 1024], narrow: true,
      calls: [{ object: 'pid', calls: 2000, functions: { 'pid_change' => 'set_gains and seed', 'fixpid_pid_track' => 'track' },
                program: %w[test/chips/modules/steps_pid.c] },
              { object: 'pid', calls: 2000,
                functions: { 'fixpid_pid_set_limits' => 'set_limits', 'fixpid_pid_set_integral_limits' => 'set_integral_limits' },
                program: %w[test/chips/modules/steps_pid.c] },
              # A turn for each place of the derivative filter, and the test that ends it.
              { object: 'pid_errors', part: 'step_error', calls: 5000, functions: { 'fixpid_pid_step_error' => 'step_error' },
                program: %w[test/support/numbers_control.c test/support/numbers_pid.c],
                flags: %w[-DCALLS_WITHOUT_ROWS], turns: %w[fixpid_pid_step differentiate].to_h { |name| [name, 8] } },
              { object: 'pid_errors', part: 'step_error', calls: 1000,
                functions: { 'fixpid_pid_state' => 'state', 'fixpid_pid_restore' => 'restore' },
                program: %w[test/support/numbers_control.c test/support/numbers_pid.c], flags: %w[-DCALLS_WITHOUT_ROWS] }]
    },
    'autotune' => {
      title: 'Autotune', what: 'Gains for fixpid_pid from an experiment on the plant',
      fuzz: [2000, 256],
      # The end of a cycle halves a number of 16 bits until it is small, and divides
      # by eight turns; both test once more than they turn. A result is what tables of
      # equations tell, one of them until a number is small enough: it has no bound. It fills a
      # PIC18, in object mode, and so does not tell the kinds of its steps apart there.
      calls: [{ object: 'tuner', calls: 20_000, kinds: %i[avr arm], program: %w[test/chips/modules/steps_autotune.c],
                functions: { 'autotune_ordinary_step' => 'ordinary step', 'autotune_cycle_step' => 'end of a cycle' },
                flags: %w[-DCALLS_BY_KIND], turns: { 'fixpid_autotune_fit_relay' => 17, 'in_proportion_q8' => 17 } },
              { object: 'tuner', calls: 10_000, kinds: %i[pic], program: [], pic: %w[object],
                functions: { 'fixpid_autotune_step_tuner' => 'any step', 'fixpid_autotune_result_tuner' => 'result' },
                turns: { 'in_proportion_q8' => 17, 'share' => 9 }, unbounded: %w[fixpid_autotune_result_tuner] }]
    },
    'reaction' => {
      title: 'Reaction', what: 'Gains for fixpid_pid from the first minutes of a heat-up',
      fuzz: [2000, 128],
      rows: %w[output_rest:int16_t output_drive:int16_t measurement_stop:int16_t timeout_steps:uint16_t options:uint8_t
               robustness_q4:uint8_t],
      pieces: %w[readings],
      # A turn for each place by which a number is shifted, for each rise of the record and for each bit of a
      # quotient, and where a loop is left. Of the rows a PIC18F4520 has room for some.
      calls: [{ kinds: %i[avr arm], flags: %w[-DCALLS_BY_KIND],
                program: %w[test/support/numbers_control.c test/support/numbers_reaction.c test/chips/modules/steps_reaction.c],
                functions: { 'reaction_ordinary_step' => 'ordinary step', 'reaction_block_step' => 'end of a block' } },
              { kinds: %i[avr arm], functions: { 'fixpid_reaction_result' => 'result' }, unbounded: %w[fixpid_reaction_result] },
              { kinds: %i[pic], pic: %w[pointer object], rows: 16,
                functions: { 'fixpid_reaction_step' => 'any step', 'fixpid_reaction_result' => 'result' } }].map do |call|
        { object: 'reaction', calls: 10_000, **call,
          turns: { **%w[scaled origin needed step].to_h { |name| ["fixpid_reaction_#{name}", 8] }, 'fixpid_reaction_begin' => 5, 'fixpid_reaction_halve' => 5,
                   'fixpid_reaction_end_block' => [16, 7], 'measure' => 7, 'steepest' => 7, 'take_tangent' => [8, 16], 'height_of' => [8, 16],
                   'ratio' => 56, 'fixpid_reaction_result' => 8, 'take_gains' => 8 } }
      end
    },
    'an937' => {
      title: 'AN937', what: 'The controller of Microchip AN937',
      fuzz: [20_000, 512], narrow: true
    },
    'an964' => {
      title: 'AN964', what: 'The controller of Microchip AN964',
      fuzz: [20_000, 512], narrow: true
    },
    'an964_8bit' => {
      title: 'AN964 8-bit', what: 'The arithmetic of AN964 in assembly',
      fuzz: [20_000, 512], narrow: true
    }
  }.freeze

  # What has recorded rows and a calls_x.c beside those of its module: who links only the
  # module's other calls does not link this.
  PARTS = {
    'step_error' => {
      of: 'pid',
      rows: %w[kp_q8:uint16_t ki_q24:uint32_t kd_q8:uint16_t filter:uint8_t output_min:int16_t output_max:int16_t
               integral_min:int16_t integral_max:int16_t weight_q8:uint16_t options:uint8_t event:uint8_t value:int16_t
               value2:int16_t by_error:uint8_t first:int32_t second:int32_t tracked:uint8_t applied:int16_t shift:uint8_t]
    }
  }.freeze

  # What a module has: files of its own, where one of several is enough, and a line in
  # files that name each.
  FILES = [%w[include/fixpid_NAME.h], %w[src/NAME/fixpid_NAME.c], %w[test/unit/test_fixpid_NAME.c], %w[test/proof/NAME.c],
           %w[test/proof/eva/NAME.c],
           %w[test/chips/modules/calls_NAME.c test/chips/target/driver_NAME.c]].freeze
  LINES = { /^NAME / => %w[test/proof/proofs.txt], /^fuzz NAME: / => %w[test/faults.txt],
            /\bfixpid_NAME\b/ => %w[README.md docs/choosing.md CHANGELOG.md] }.freeze

  module_function

  # `fixpid_deadband: no test/unit/test_fixpid_deadband.c`
  def lacks
    folders = Dir['src/*/*'].map { |path| path.split('/')[1] } - ['common']
    headers = Dir['include/fixpid_*.h'].map { |path| path[/fixpid_(\w+)\.h/, 1] }
    (ALL.keys | folders | headers).flat_map { |name| lacks_of(name).map { |what| "fixpid_#{name}: #{what}" } }
  end

  def lacks_of(name)
    files = FILES.map { |paths| paths.map { |path| path.gsub('NAME', name) } }
    entry = ALL.key?(name) ? [] : ['no entry in tools/lib/modules.rb']
    entry + files.reject { |paths| paths.any? { |path| File.exist?(path) } }.map { |paths| "no #{paths.join(', nor ')}" } +
      LINES.flat_map do |form, paths|
        line = Regexp.new(form.source.sub('NAME', name))
        paths.reject { |path| File.exist?(path) && File.read(path).match?(line) }.map { |path| "not in #{path}" }
      end
  end

  # The modules whose headers a module's header includes.
  def needs(name)
    header = "include/fixpid_#{name}.h"
    File.exist?(header) ? File.read(header).scan(/^#include "fixpid_(\w+)\.h"/).flatten : []
  end

  # Its sources, with those of chips behind the others, from the project's folder.
  def sources(name, root = '.')
    Dir.glob("src/#{name}/*.c", base: root).sort_by { |path| [path.match?(/_pic1[48]\.c\z/) ? 1 : 0, path] }
  end

  # And those of the modules that it uses.
  def linked(name, root = '.')
    [name, *ALL.fetch(name)[:uses]].flat_map { |each| sources(each, root) }
  end

  # The entry of a module or part.
  def entry(name)
    ALL[name] || PARTS.fetch(name)
  end

  # What makes the random arguments of a module alone.
  def numbers(name)
    Dir["{test/support/numbers_#{name},sim/link/#{name}_frames}.c"]
  end

  # Those that calls_x.c calls on simulated chips, against the host: all but
  # controllers, which have a driver for that. And the parts.
  def called
    ALL.keys.select { |name| File.exist?("test/chips/modules/calls_#{name}.c") && !ALL[name][:narrow] } + PARTS.keys
  end

  # Those whose controller can be the program's only one, by its name.
  def with_object
    ALL.keys.select { |name| File.read("include/fixpid_#{name}.h").include?("FIXPID_#{name.upcase}_OBJECT") }
  end
end

if $PROGRAM_NAME == __FILE__
  puts Modules.lacks
  exit(Modules.lacks.empty? ? 0 : 1)
end

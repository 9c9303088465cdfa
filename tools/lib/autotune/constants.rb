# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The constants of fixpid_autotune's result, each with where it comes from. Writes them to
# src/autotune/fixpid_autotune_constants.h: `ruby tools/lib/autotune/constants.rb --update`.
# Without the option it says whether that file is what it would write.
module AutotuneConstants
  FILE = 'src/autotune/fixpid_autotune_constants.h'

  # A quantile regression, repeated by tools/lib/autotune/refit: the delay that gives PI a
  # maximum sensitivity of 1.6, for integrators at 92 % of the plants and for lags at 93 %.
  INTEGRATOR = 'regression, integrator: '
  LAG = 'regression, lag: '
  AMIGO = 'AMIGO (Astrom and Hagglund 2006): '

  # value => origin
  ALL = {
    1 => 'exact',
    2 => 'exact',
    4 => 'exact',
    1r / 2 => 'exact; two processes if their slopes are so far apart: by trial on random plants',
    1r / 4 => 'exact',
    1r / 32 => 'exact: what the mean outputs leave open, of the relay',
    1r / 256 => 'exact: where the search for R ends',
    15r / 16 => 'exact: its steps',
    63r / 64 => 'exact: below the 1 of a pure delay',
    0.03r => 'R of an integrator, by trial on random plants',
    0.05r => "derived: psi(R), one lag's slope over the one of its wave",
    0.06r => 'R of a process that runs away, by trial on random plants',
    0.1r => "#{AMIGO}TI",
    0.12r => 'most of BEND that a PID makes use of, by trial on random plants',
    0.2r => "derived: f(R), the roundness of one lag; #{AMIGO}KP; #{INTEGRATOR}V in E",
    0.216r => "#{INTEGRATOR}V",
    0.3r => "derived: f(R), and least of ROUND; #{AMIGO}TD; CHI in LIMIT",
    0.31r => 'derived: psi(R)',
    0.4r => "#{AMIGO}TI",
    0.45r => "#{AMIGO}KP",
    0.46r => "#{INTEGRATOR}where a wave is flatter than an integrator's",
    0.47r => "#{LAG}most of E",
    0.53r => "derived: ROUND of an integrator's wave, where one lag ends",
    0.6r => 'least delay, by trial on random plants',
    0.64r => 'derived: psi(R)',
    0.75r => 'regression: most of CHI',
    0.8r => "#{AMIGO}TI",
    0.808r => "#{INTEGRATOR}FLATTER",
    0.875r => "#{INTEGRATOR}most of ROUND",
    0.9r => "#{LAG}where a wave is flatter than a lag's",
    1.03r => 'derived: Z of one lag, where it ends',
    1.1r => 'what ROUND may lie below f(R), by trial on random plants',
    1.16r => "#{INTEGRATOR}Q",
    1.188r => "#{LAG}Q",
    1.193r => "#{LAG}R",
    1.2r => "#{INTEGRATOR}least delay of a flatter wave",
    1.5r => 'most of CHI that is a lag or an integrator, by trial on random plants',
    2.068r => "#{LAG}I",
    2.272r => "#{LAG}FLATTER",
    2.828r => "#{LAG}R R",
    3.204r => LAG.sub(/: \z/, ''),
    4.382r => "#{LAG}E",
    4.608r => INTEGRATOR.sub(/: \z/, ''),
    4.627r => "#{INTEGRATOR}I",
    5.285r => "#{LAG}R CHI",
    5.488r => "#{LAG}CHI CHI",
    6 => 'TI of an integrator with a lag, by trial on random plants',
    6.815r => "#{LAG}CHI",
    9.462r => "#{INTEGRATOR}CHI CHI",
    10 => 'KP of an integrator with a lag, by trial on random plants',
    11.667r => "#{LAG}E CHI",
    11.75r => "#{INTEGRATOR}CHI",
    22.4r => "#{INTEGRATOR}E E",
    26.16r => "#{INTEGRATOR}E",
    28.086r => "#{LAG}R E",
    45.48r => "#{INTEGRATOR}E CHI",
    64 => 'exact: a quarter of 256'
  }.freeze

  # What the regression gave has more digits than its name.
  FITTED = { 1.188r => 38_935, 1.193r => 39_086, 4.382r => 35_898, 4.608r => 37_748, 4.627r => 37_905, 5.488r => 44_957,
             6.815r => 55_829, 9.462r => 38_757, 11.667r => 47_790 }.freeze

  FRACTIONS = { 1r / 2 => 'HALF', 1r / 4 => 'QUARTER', 1r / 32 => 'C1_32ND', 1r / 256 => 'C1_256TH',
                15r / 16 => 'C15_16THS', 63r / 64 => 'C63_64THS' }.freeze
  WORDS = { 1 => 'ONE', 2 => 'TWO', 4 => 'FOUR' }.merge(FRACTIONS).freeze

  module_function

  # 0.45 is C0_45.
  def name(value)
    WORDS.fetch(value) { "C#{decimal(value).tr('.', '_')}" }
  end

  def decimal(value)
    return "#{value.numerator}/#{value.denominator}" if FRACTIONS.key?(value)

    value.to_r.denominator == 1 ? value.to_i.to_s : value.to_f.to_s
  end

  # The nearest mantissa of 32768..65535 and its exponent.
  def number(value)
    exponent = -15
    exponent += 1 while value / 2r**exponent > 65_535
    exponent -= 1 while value / 2r**exponent < 32_768
    [FITTED.fetch(value) { (value / 2r**exponent).round }, exponent]
  end

  def header
    <<~TEXT
      // SPDX-License-Identifier: MIT
      // The constants of fixpid_autotune's result, mantissa * 2^exponent. Written by
      // tools/lib/autotune/constants.rb. A regression was repeated after these were
      // chosen, and tools/lib/autotune/refit repeats it again. Its numbers differ a
      // little from these, and loops with them were not better: so these stay.
      #ifndef FIXPID_AUTOTUNE_CONSTANTS_H
      #define FIXPID_AUTOTUNE_CONSTANTS_H
      #include <stdint.h>

      #include "fixpid_autotune_arith.h"

      // A number with this bit is one of these, and not one of a sheet.
      #define CONSTANT 0x40u

      enum constant_name {
      #{ALL.keys.each_with_index.map { |value, i| "    #{name(value)}#{i.zero? ? ' = CONSTANT' : ''}" }.join(",\n")}
      };

      static const struct constant {
          uint16_t mantissa;
          int8_t exponent;
      } constants[] FIXPID_AUTOTUNE_FLASH = {
      #{ALL.map { |value, origin| entry(value, origin) }.join("\n")}
      };

      #endif
    TEXT
  end

  # A long origin stands in a line above its number.
  def entry(value, origin)
    number = format('    {%du, %d},', *number(value)).ljust(18)
    comment = "// #{decimal(value)}: #{origin}"
    return "#{number} #{comment}" if number.length + comment.length < 80

    lines = comment.split.drop(1).each_with_object([+'    //']) do |word, all|
      all << +'    //' if all.last.length + word.length + 1 > 80
      all.last << " #{word}"
    end
    "#{lines.join("\n")}\n#{number.rstrip}"
  end
end

if $PROGRAM_NAME == __FILE__
  Dir.chdir(File.expand_path('../../..', __dir__))
  header = AutotuneConstants.header
  File.write(AutotuneConstants::FILE, header) if ARGV == ['--update']
  if File.read(AutotuneConstants::FILE) != header
    warn "constants: #{AutotuneConstants::FILE} is stale: ruby tools/lib/autotune/constants.rb --update"
    exit 1
  end
end

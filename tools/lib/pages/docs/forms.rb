# SPDX-License-Identifier: MIT
# Which form of its arithmetic each controller takes on which chip, as the
# preprocessor chooses it from the macros of the chip's compiler.
require 'fileutils'
require 'open3'
require_relative '../../data_tables'

module Forms
  FILE = 'docs/data/forms.csv'.freeze
  FOLDER = 'build/test/docs/forms'.freeze
  GCC = '__GNUC__=12'.freeze
  CHIPS = {
    'PIC16, SDCC' => %w[__SDCC __SDCC_pic14],
    'PIC18, SDCC' => %w[__SDCC __SDCC_pic16],
    'PIC16, XC8' => %w[__XC8 _PIC14],
    'PIC18, XC8' => %w[__XC8 _PIC18],
    'AVR with a multiplier' => [GCC, '__AVR__', '__AVR_HAVE_MOVW__', '__AVR_HAVE_MUL__'],
    'AVR without a multiplier' => [GCC, '__AVR__', '__AVR_HAVE_MOVW__'],
    'MSP430' => [GCC, '__MSP430__'],
    '8051' => %w[__SDCC __SDCC_mcs51],
    'STM8' => %w[__SDCC __SDCC_stm8],
    'HC08, S08' => %w[__SDCC __SDCC_hc08],
    'Z80 and its family' => %w[__SDCC __SDCC_z80],
    'Padauk' => %w[__SDCC __SDCC_pdk14],
    'RISC-V without a multiplier' => [GCC, '__riscv'],
    'Cortex-M, other RISC-V and any other' => [GCC]
  }.freeze
  CONTROLLERS = %w[fixpid_pid fixpid_an937 fixpid_an964 fixpid_an964_8bit].freeze

  class << self
    def csv
      standard_headers
      rows = CHIPS.map { |chip, macros| [chip, *CONTROLLERS.map { |controller| form(controller, macros) }] }
      DataTables.text([['chip', *CONTROLLERS], *rows])
    end

    private

    # The host's own ask for macros that are undefined here.
    def standard_headers
      FileUtils.mkdir_p(FOLDER)
      %w[stdbool stddef stdint].each { |name| File.write("#{FOLDER}/#{name}.h", '') }
      File.write("#{FOLDER}/limits.h", <<~HEADER)
        #if defined(__SDCC) || defined(__XC8) || defined(__AVR__) || defined(__MSP430__)
        #define INT_MAX 32767
        #else
        #define INT_MAX 2147483647
        #endif
      HEADER
    end

    # Where the controller chooses.
    def header(controller)
      return 'src/pid/fixpid_pid_private.h' if controller == 'fixpid_pid'

      "src/#{controller.delete_prefix('fixpid_')}/#{controller}_arith.h"
    end

    def form(controller, macros)
      output, status = Open3.capture2('cc', '-E', '-undef', '-nostdinc', "-I#{FOLDER}", '-Iinclude',
                                      *macros.map { |macro| "-D#{macro}" }, header(controller))
      raise "cannot preprocess #{header(controller)} for #{macros.join(' ')}" unless status.success?

      # The file that it takes; the products of fixpid_pid may be another form's.
      case output
      when /^# \d+ "[^"]*_avr\.h.*return \(int32_t\)gain \* x;/m then 'wide, sums in assembly'
      when /^# \d+ "[^"]*_(?:pic14|pic18|avr)\./ then 'assembly'
      when /^# \d+ "[^"]*_bytes\.h"/ then 'bytes'
      when /return fixpid_product_in_turns\(gain/ then 'turns'
      when /^# \d+ "[^"]*_signed_narrow\.h".*return \(int32_t\)gain \* x;/m then 'wide'
      when /^# \d+ "[^"]*_narrow\.h"/ then 'narrow'
      else 'wide'
      end
    end
  end
end

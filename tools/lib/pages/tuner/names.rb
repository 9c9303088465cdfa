# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The lists of names that the page shares with the C: each enumeration of
# sim/tuner/tuner.h, of sim/identify/identify.h and of sim/link/link_page.h, those of both tuners that the page shows, the bits of
# fixpid_pid.h and the ends of its ranges.
module Names
  class << self
    # { PARAM: { CONTROLLER: 0, .. }, COUNT: .., VALUE: .., METRIC: .., RESULT: .., EVENT: .., STATUS: .., HEAT_UP: .., CAUSE: .., RULE: ..,
    #   WORD: { QUICK: 8, .. }, OPTION: { REVERSE: 0x80, .. }, FEATURE: .., LIMIT: { STEPS: .., KP: .. } }
    def lists
      header = File.read('sim/tuner/tuner.h')
      tuner = File.read('include/fixpid_autotune.h')
      reaction = File.read('include/fixpid_reaction.h')
      pid = File.read('include/fixpid_pid.h')
      an964 = File.read('include/fixpid_an964.h')
      identify = File.read('sim/identify/identify.h')
      live = File.read('sim/link/link_page.h')
      { PARAM: of(header, 'tuner_param', 'PARAM_'), COUNT: of(header, 'tuner_count', 'COUNT_'),
        VALUE: of(header, 'tuner_value', 'VALUE_'), METRIC: of(header, 'tuner_metric', 'METRIC_'), RESULT: of(header, 'tuner_result', 'RESULT_'),
        EVENT: of(header, 'tuner_event', 'EVENT_'), CONTROLLER: of(header, 'tuner_controller', 'TUNER_'),
        PLANT: of(header, 'tuner_plant', 'TUNER_'), EXPERIMENT: of(header, 'tuner_experiment_kind', 'EXPERIMENT_'),
        FIT_KIND: of(identify, 'identify_kind', 'IDENTIFY_'), FIT_REASON: of(identify, 'identify_reason', 'IDENTIFY_'),
        FIT_START: of(identify, 'identify_start', 'IDENTIFY_'), STATUS: of(tuner, 'fixpid_autotune_state', 'FIXPID_AUTOTUNE_'), HEAT_UP: of(reaction, 'fixpid_reaction_state', 'FIXPID_REACTION_'),
        CAUSE: of(tuner, 'fixpid_autotune_cause', 'FIXPID_AUTOTUNE_'), RULE: of(tuner, 'fixpid_autotune_rule', 'FIXPID_AUTOTUNE_'),
        WORD: %w[QUICK SAFE CALM].to_h { |name| [name, number(tuner, "FIXPID_AUTOTUNE_#{name}")] },
        STEP: of(live, 'live_step', 'LIVE_'), TWIN: of(live, 'live_count', 'LIVE_'), CONFIG: of(live, 'live_config', 'LIVE_'),
        ALLOWED: link_bits, OPTION: bits(header, 'TUNER_OPTION_'), FEATURE: bits(pid, 'FIXPID_PID_HAS_'),
        LIMIT: { **%w[STEPS EVENTS EVENT_SIZE].to_h { |name| [name, number(header, "TUNER_#{name}")] }, **gains(pid),
                 **%w[SUM TERM OUTPUT].to_h { |name| ["AN964_#{name}", number(an964, "FIXPID_AN964_#{name}_LIMIT")] },
                 RECORD_SIZE: number(tuner, 'FIXPID_AUTOTUNE_RECORD_SIZE'),
                 RECORD_VERSION: number(tuner, 'FIXPID_AUTOTUNE_RECORD_VERSION'), LINES: number(identify, 'IDENTIFY_LINES'), LIVE_BYTES: number(live, 'LIVE_BYTES') } }
    end

    def version
      header = File.read('include/fixpid.h')
      %w[MAJOR MINOR PATCH].map { |part| number(header, "FIXPID_VERSION_#{part}") }.join('.')
    end

    private

    # Counted from 0; the number of the names, the last one, is left out.
    def of(text, enumeration, prefix)
      body = text[/enum #{enumeration} \{(.*?)\}/m, 1] || raise("no enum #{enumeration}")
      names = body.gsub(%r{//.*}, '').scan(/\w+/)
      names.each_with_index.select { |name, _| name.start_with?(prefix) }
           .to_h { |name, at| [name.delete_prefix(prefix), at] }
    end

    # Of the macros with this beginning.
    def bits(text, prefix)
      text.scan(/^#define #{prefix}(\w+) (0x\h+)u/).to_h { |name, value| [name, value.hex] }
    end

    # What a board may allow: { SETPOINT: 1, .. }.
    def link_bits
      File.read('include/fixpid_link.h').scan(/^#define FIXPID_LINK_(SETPOINT|GAINS|LIMITS|MANUAL) (0x\h+)u/).to_h { |name, value| [name, value.hex] }
    end

    # The largest gains; that of ki with HAS_COARSE_KI, and without.
    def gains(pid)
      ki, fine = pid.scan(/^#define FIXPID_PID_KI_MAX (0x\h+)u/).flatten.map(&:hex)
      { KP: number(pid, 'FIXPID_PID_KP_MAX'), KD: number(pid, 'FIXPID_PID_KD_MAX'), KI: ki, KI_FINE: fine }
    end

    def number(text, name)
      text[/^#define #{name} (\d+)/, 1]&.to_i || raise("no #{name}")
    end
  end
end

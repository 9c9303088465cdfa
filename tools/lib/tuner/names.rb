# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# The lists of names that the page shares with the C: each enumeration of
# sim/tuner/tuner.h and those of fixpid_autotune.h that the page shows.
module Names
  class << self
    # { PARAM: { CONTROLLER: 0, .. }, COUNT: .., VALUE: .., RESULT: .., EVENT: .., STATUS: .., RULE: .. }
    def lists
      header = File.read('sim/tuner/tuner.h')
      tuner = File.read('include/fixpid_autotune.h')
      { PARAM: of(header, 'tuner_param', 'PARAM_'), COUNT: of(header, 'tuner_count', 'COUNT_'),
        VALUE: of(header, 'tuner_value', 'VALUE_'), RESULT: of(header, 'tuner_result', 'RESULT_'),
        EVENT: of(header, 'tuner_event', 'EVENT_'), CONTROLLER: of(header, 'tuner_controller', 'TUNER_'),
        PLANT: of(header, 'tuner_plant', 'TUNER_'), STATUS: of(tuner, 'fixpid_autotune_status', 'FIXPID_AUTOTUNE_'),
        RULE: of(tuner, 'fixpid_autotune_rule', 'FIXPID_AUTOTUNE_'),
        LIMIT: { STEPS: number(header, 'TUNER_STEPS'), EVENTS: number(header, 'TUNER_EVENTS') } }
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

    def number(text, name)
      text[/^#define #{name} (\d+)/, 1]&.to_i || raise("no #{name}")
    end
  end
end

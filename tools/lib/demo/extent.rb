# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# How much runs of what has many random faults, plants or chips: a fixed part of it, all that
# the tables of the documents tell of (tools/demo --whole), or far more (--long).
module Extent
  NAME = ENV.fetch('DEMO_EXTENT', 'part')
  LOOPS = %w[guard faults faults_chip chip].freeze

  class << self
    def whole?
      NAME != 'part'
    end

    def long?
      NAME == 'long'
    end

    # Whether that is not all of a loop.
    def part?(loop)
      !whole? && LOOPS.include?(loop)
    end

    # Of so many, one of `of`.
    def share(count, of)
      whole? ? count : (count + of - 1) / of
    end
  end
end

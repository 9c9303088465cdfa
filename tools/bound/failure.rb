# SPDX-License-Identifier: MIT
# frozen_string_literal: true

module Bound
  # What cannot be told of linked code, and why.
  class Failure < StandardError; end
end

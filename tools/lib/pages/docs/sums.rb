# SPDX-License-Identifier: MIT
# `117 * 1023 / 16 = 7480 < 2^14` in a comment or a document: every sum that is written
# out must be right. Integers, so a quotient is rounded toward zero; with a decimal
# point anywhere, exactly.
module Sums
  OPERATORS = { '=' => :==, '<' => :<, '<=' => :<= }.freeze
  NUMBER = /\(?\d+(?:\.\d+)?(?:\^\d+)?\)?/.freeze
  SUM = %r{#{NUMBER}(?: [-+*/] #{NUMBER})*}.freeze
  # The right side may be the left one of the next.
  WRITTEN = %r{(?<![\w.^(/]|[-+*/] )(?=(#{SUM}) (=|<=|<) (#{SUM}))}.freeze

  class << self
    def failures(path, text)
      text.scan(WRITTEN).reject { |left, operator, right| right?(left, operator, right) }
          .map { |left, operator, right| "#{path}: #{left} #{operator} #{right} is wrong" }
    end

    private

    def right?(left, operator, right)
      exact = "#{left}#{right}".include?('.')
      # Only digits and operators passed the patterns above.
      values = [left, right].map do |sum|
        eval((exact ? sum.gsub(/(?<!\^)\b\d+(?:\.\d+)?/) { |number| "#{number}r" } : sum).gsub('^', '**'))
      end
      values[0].public_send(OPERATORS.fetch(operator), values[1])
    end
  end
end

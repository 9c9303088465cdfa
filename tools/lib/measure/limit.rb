# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# A figure that must not grow beyond a number, whatever the tables say. A limit that
# is far above its figure is no promise, unless it says why.
Limit = Struct.new(:what, :most, :now, :unit, :reason) do
  def kept?
    !now.nil? && now <= most
  end

  def slack?
    reason.to_s.empty? && kept? && most > now * (1 + Limit::SLACK)
  end

  def good?
    kept? && !slack?
  end

  def wrong
    return "#{shown(now)}, at most #{shown(most)} allowed" unless kept?

    "#{shown(now)}, and #{shown(most)} allowed, more than #{(Limit::SLACK * 100).round} % above: tools/cost --tighten"
  end

  def shown(value)
    return '-' if value.nil?

    "#{value.is_a?(Float) ? format('%.2f', value) : value} #{unit}".strip
  end

  # A row of a table.
  def cells
    [what, shown(most), shown(now)]
  end
end

Limit::SLACK = 0.03

# SPDX-License-Identifier: MIT
# frozen_string_literal: true

# A figure that must not grow beyond a number, whatever the tables say.
Limit = Struct.new(:what, :most, :now, :unit) do
  def kept?
    !now.nil? && now <= most
  end

  def exceeded
    "#{shown(now)}, at most #{shown(most)} allowed"
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

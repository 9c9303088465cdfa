# SPDX-License-Identifier: MIT
# The table of docs/assurance.md, from what tools/prove proves.
require_relative '../prove/seeded'

# What is proved of each module, in which forms, and with how many breaks.
module Assurance
  module_function

  def table
    proofs = Proofs.all
    breaks = Seeded.all(proofs)
    rows = proofs.group_by(&:group).map { |group, of_group| row(group, of_group, breaks) }
    "| module | proved | forms | proofs | breaks | command |\n|---|---|---|---|---|---|\n#{rows.join}" \
      "| all | | | #{proofs.size} | #{breaks.size} | `tools/prove` |\n"
  end

  def row(group, proofs, breaks)
    what = proofs.map { |proof| proof.what.tr('_', ' ') }.uniq.join(', ')
    forms = proofs.map(&:form).uniq.join(', ')
    noticed = breaks.count { |broken| broken.proof.group == group }
    "| `#{group}` | #{what} | #{forms} | #{proofs.size} | #{noticed} | `tools/prove #{group}` |\n"
  end
end

// SPDX-License-Identifier: MIT
#pragma once

namespace slamscope::slam::experiments {

struct AssociationTableOptions {
  int seeds = 20;        ///< runs of each line
  int hypotheses = 50;   ///< of the lines with hypotheses
  unsigned threads = 0;  ///< 0: one per core
};

/// Prints, for the ambiguous world at several spacings and odometries, what `nearest`, `joint` and
/// `joint` with hypotheses make of it, beside known ids. Returns the number of lines where joint is
/// not better.
int printAssociationTable(const AssociationTableOptions& options);

}  // namespace slamscope::slam::experiments

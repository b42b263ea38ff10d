// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace slamscope::slam::experiments {

struct FaultTableOptions {
  int seeds = 100;
  std::uint64_t first_seed = 1;
  std::vector<std::string> faults;  ///< only these rows; all where empty
  double alpha = 1e-3;
  unsigned threads = 0;
};

/// Plants every fault of the catalogue in runs of the paper's experiment and prints what the audit
/// makes of their logs: of each level, precision and kind of update.
void printFaultTable(const FaultTableOptions& options);

}  // namespace slamscope::slam::experiments

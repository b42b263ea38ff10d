// SPDX-License-Identifier: MIT
#pragma once

namespace slamscope::slam::experiments {

struct ConsistencyTableOptions {
  int runs = 100;        ///< of each line
  int loops = 3;         ///< driven in each run
  unsigned threads = 0;  ///< 0: one per core
};

/// Prints mean NIS and ANEES of a correct filter, for each sensor, motion input and kind of update,
/// with their two-sided 99 % bands. Returns the number of lines whose NIS is outside.
int printConsistencyTable(const ConsistencyTableOptions& options);

}  // namespace slamscope::slam::experiments

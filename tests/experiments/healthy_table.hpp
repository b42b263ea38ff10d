// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace slamscope::slam::experiments {

struct HealthyTableOptions {
  int runs = 1000;
  std::uint64_t first = 1;
  double alpha = 1e-3;
  unsigned threads = 0;
  std::string only = {};  ///< name of one variant; empty: all
};

/// Audits runs of correct filters and prints how often it cried out, and over which. Returns the
/// number of code-fault verdicts, which must be 0.
int printHealthyTable(const HealthyTableOptions& options);

/// The lawful variants that break a law by design: with and without their word of `--allow`.
/// Returns the number of code-fault verdicts, with the word or without.
int printVariantTable(const HealthyTableOptions& options);

}  // namespace slamscope::slam::experiments

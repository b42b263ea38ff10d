// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "slam/formats/number_array.hpp"
#include "slam/formats/stack_plan.hpp"

namespace slamscope::slam {

/// An array of a run, step by step; a matrix comes row by row.
class Slices {
 public:
  Slices() = default;
  Slices(const Slices&) = delete;
  Slices& operator=(const Slices&) = delete;
  virtual ~Slices() = default;
  /// The numbers of the next step (how many may differ from step to step), valid until the next
  /// call. Not to be called more often than there are steps. Throws for what can't be read.
  [[nodiscard]] virtual std::span<const double> next() = 0;
};

/// The steps of an array in memory. `square`: a step is a matrix, which is turned round where the
/// array was stored column by column.
[[nodiscard]] std::unique_ptr<Slices> slicesOf(NumberArray array, std::size_t steps, StepAxis axis,
                                               bool square = false);

/// n×n numbers turned round in place.
void transpose(std::span<double> matrix);

}  // namespace slamscope::slam

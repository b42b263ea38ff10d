// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "slam/formats/number_array.hpp"

namespace slamscope::slam {

/// Which axis of a stacked array counts the steps. People write steps × N × N in Python and
/// N × N × steps in MATLAB, and then carry the one over into the other.
enum class StepAxis { first, last };

/// An array as the plan needs it: its shape (the last axis fastest) and the axis that counts steps
/// where the shape alone leaves both open.
struct Stacked {
  Shape shape;
  StepAxis usual = StepAxis::first;
};

/// How x and P, stacked over the steps of a run, are cut into steps of N numbers and N×N (or, where
/// only the diagonal was kept, N) numbers.
struct StackPlan {
  std::size_t steps = 0;
  std::size_t size = 0;  ///< N: 3 + 2 numbers a feature
  StepAxis x = StepAxis::first;
  StepAxis P = StepAxis::first;
  bool diagonal = false;
};

/// x absent: covariance alone. Throws std::runtime_error "x: …" or "P: expected …, found …" where
/// the shapes do not fit together.
[[nodiscard]] StackPlan planStack(const std::optional<Stacked>& x, const Stacked& P);

/// The axis of `steps` in an array beside x and P (of one axis or two); nothing where it has none.
[[nodiscard]] std::optional<StepAxis> stepAxis(const Stacked& array, std::size_t steps);

/// Without the axes of length 1, as long as more than `axes` are left.
[[nodiscard]] Shape squeezed(Shape shape, std::size_t axes);

}  // namespace slamscope::slam

// SPDX-License-Identifier: MIT
#include "slam/formats/slices.hpp"

#include <cmath>
#include <utility>

namespace slamscope::slam {
namespace {

class LoadedSlices : public Slices {
 public:
  LoadedSlices(NumberArray array, std::size_t steps, StepAxis axis, bool square)
      : array_(std::move(array)),
        steps_(steps),
        axis_(axis),
        turned_(square && array_.reversed),
        slice_(steps == 0 ? 0 : array_.values.size() / steps) {}

  [[nodiscard]] std::span<const double> next() override {
    for (std::size_t k = 0; k < slice_.size(); ++k) {
      slice_[k] = axis_ == StepAxis::first ? array_.values[step_ * slice_.size() + k]
                                           : array_.values[k * steps_ + step_];
    }
    ++step_;
    if (turned_) transpose(slice_);
    return slice_;
  }

 private:
  NumberArray array_;
  std::size_t steps_;
  StepAxis axis_;
  bool turned_;
  std::vector<double> slice_;
  std::size_t step_ = 0;
};

}  // namespace

std::unique_ptr<Slices> slicesOf(NumberArray array, std::size_t steps, StepAxis axis, bool square) {
  return std::make_unique<LoadedSlices>(std::move(array), steps, axis, square);
}

void transpose(std::span<double> matrix) {
  const auto n =
      static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(matrix.size()))));
  for (std::size_t row = 0; row < n; ++row) {
    for (std::size_t col = 0; col < row; ++col) {
      std::swap(matrix[row * n + col], matrix[col * n + row]);
    }
  }
}

}  // namespace slamscope::slam

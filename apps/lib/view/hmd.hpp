// SPDX-License-Identifier: MIT
#pragma once

#include "apps/lib/view/hmd_options.hpp"
#include "apps/lib/view/viewer.hpp"

namespace slamscope::apps {

/// What a person with a video-see-through HMD sees: both cameras' pictures, undistorted, and over
/// each what the filter believes, standing on the real floor. Both eyes are drawn at once, each
/// with the head's pose at its own frame's mid-exposure, then laid out in one picture.
class Hmd final : public Viewer {
 public:
  /// Opens everything. Throws std::runtime_error, one line, where something can't be had.
  explicit Hmd(const HmdOptions& options);
  ~Hmd() override;

  bool next() override;
  void draw() override;
  void explain(const Eigen::Vector2d& pixel) override;
  void presented() override;
  void finish(Ending ending) override;

  [[nodiscard]] const engine::Image& drawn() const override;
  [[nodiscard]] std::string status() const override;  ///< of the head, one line

 private:
  [[nodiscard]] ViewedRun& run() override;
  [[nodiscard]] const ViewedRun& run() const override;

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace slamscope::apps

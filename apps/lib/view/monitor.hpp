// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/lib/view/monitor_options.hpp"
#include "apps/lib/view/viewer.hpp"
#include "engine/render/options.hpp"
#include "engine/scene/view.hpp"

namespace slamscope::apps {

/// The overhead view: frames of a camera, registered, with what the filter believes drawn over
/// them.
///
///   Monitor monitor(options);
///   while (monitor.next()) monitor.draw();
///   monitor.finish(Viewer::Ending::input_ended);
///
/// The paper's render cycle (section 3.1): take a frame and where it was taken from, take the
/// newest state of SLAM, draw.
class Monitor final : public Viewer {
 public:
  /// Opens everything. Throws std::runtime_error, one line, where something can't be had.
  explicit Monitor(const MonitorOptions& options);
  ~Monitor() override;

  bool next() override;
  void draw() override;
  void explain(const Eigen::Vector2d& pixel) override;
  void finish(Ending ending) override;

  /// What draw() draws, for a window that presents it itself.
  struct Picture {
    engine::View view;
    engine::Scene scene;
    engine::RenderOptions render;
  };
  [[nodiscard]] const Picture& picture() const;
  [[nodiscard]] const engine::Image& drawn() const override;
  [[nodiscard]] std::string status() const override;

 private:
  [[nodiscard]] ViewedRun& run() override;
  [[nodiscard]] const ViewedRun& run() const override;

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace slamscope::apps

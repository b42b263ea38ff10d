// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "apps/lib/view/monitor_options.hpp"
#include "engine/gpu/gpu.hpp"
#include "engine/render/options.hpp"
#include "engine/scene/view.hpp"

namespace slamscope::apps {

/// The overhead view: frames of a camera, registered, with what the filter believes drawn over
/// them.
///
///   Monitor monitor(options);
///   while (monitor.next()) monitor.draw();
///   monitor.finish();
///
/// The paper's render cycle (section 3.1): take a frame and where it was taken from, take the
/// newest state of SLAM, draw.
class Monitor {
 public:
  /// Opens everything. Throws std::runtime_error, one line, where something can't be had.
  explicit Monitor(const MonitorOptions& options);
  ~Monitor();
  Monitor(const Monitor&) = delete;
  Monitor& operator=(const Monitor&) = delete;

  /// Takes the next frame and the snapshot that belongs to it; false at the end.
  bool next();
  /// Draws what was taken last and hands it to the outputs; draws it again, with no output, when
  /// called again for the same frame (a window that is paused).
  void draw();
  /// Closes the outputs. Throws std::runtime_error where a finite input never showed the tags that
  /// are needed.
  void finish();

  /// What draw() draws, for a window that presents it itself.
  struct Picture {
    engine::View view;
    engine::Scene scene;
    engine::RenderOptions render;
  };
  [[nodiscard]] const Picture& picture() const;
  [[nodiscard]] const engine::Image& drawn() const;

  /// The user's choices; changes show from the next draw() on.
  struct Choices {
    slam::PairMode mode = slam::PairMode::all;
    slam::AxisScale axis;
    bool covariance_rings = false;
    bool labels = true;
    bool legend = true;
    double opacity = 1.0;
    std::string message;  ///< one more status line: "paused", a key's effect
  };
  [[nodiscard]] Choices& choices();

  /// Whether frames come faster than they should be shown: a film or a lab beside a window or a
  /// live filter.
  [[nodiscard]] bool paced() const;
  [[nodiscard]] double secondsShown() const;  ///< from the first frame to the newest
  [[nodiscard]] double frameSeconds() const;  ///< from the frame before to this one
  [[nodiscard]] std::uint64_t framesShown() const;
  /// Share of the run that was shown, where its end is known; else negative.
  [[nodiscard]] double progress() const;
  [[nodiscard]] std::string status() const;  ///< of the registration, one line
  /// What the user should know of how the inputs were taken.
  [[nodiscard]] const std::vector<std::string>& notes() const;
  [[nodiscard]] const std::shared_ptr<engine::Gpu>& gpu() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace slamscope::apps

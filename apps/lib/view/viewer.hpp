// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "apps/lib/view/palette.hpp"
#include "engine/gpu/gpu.hpp"
#include "engine/scene/view.hpp"
#include "slam/correlation.hpp"
#include "slam/correlation_pairs.hpp"

namespace slamscope::apps {

struct ViewedRun;  // apps/lib/view/viewed_run.hpp

/// Frame by frame a picture of what the filter believes: the overhead view (Monitor), the two eyes
/// of a head (Hmd).
///
///   while (viewer.next()) viewer.draw();
///   viewer.finish(Viewer::Ending::input_ended);
class Viewer {
 public:
  Viewer() = default;
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;
  virtual ~Viewer() = default;

  /// Takes the next frame and the snapshot that belongs to it; false at the end.
  virtual bool next() = 0;
  /// Draws what was taken last and hands it to the outputs; draws it again, with no output, when
  /// called again for the same frame (a window that is paused).
  virtual void draw() = 0;
  /// Says in the next picture what is seen at this pixel of drawn().
  virtual void explain(const Eigen::Vector2d& pixel) = 0;
  /// What was drawn stands before the user's eyes now.
  virtual void presented() {}
  enum class Ending { input_ended, user_quit };
  /// Closes the outputs. Throws std::runtime_error where a finite input never showed the tags that
  /// are needed; the report, which says what was seen instead, is written all the same.
  virtual void finish(Ending ending) = 0;

  [[nodiscard]] virtual const engine::Image& drawn() const = 0;

  /// The user's choices; changes show from the next draw() on.
  struct Choices {
    slam::PairMode mode = slam::PairMode::all;
    slam::AxisScale axis;
    PaletteName palette = PaletteName::paper;
    bool covariance_rings = false;
    bool own_error = false;  ///< the registration's, at each feature
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
  [[nodiscard]] virtual std::string status() const = 0;  ///< of the registration, one line
  /// What the user should know of how the inputs were taken.
  [[nodiscard]] const std::vector<std::string>& notes() const;
  [[nodiscard]] const std::shared_ptr<engine::Gpu>& gpu() const;

 private:
  [[nodiscard]] virtual ViewedRun& run() = 0;
  [[nodiscard]] virtual const ViewedRun& run() const = 0;
};

}  // namespace slamscope::apps

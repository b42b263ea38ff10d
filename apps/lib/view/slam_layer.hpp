// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/lib/audit_watch.hpp"
#include "apps/lib/run_truth.hpp"
#include "apps/lib/slam_feed.hpp"
#include "apps/lib/view/alarm_marks.hpp"
#include "apps/lib/view/cluster_pairs.hpp"
#include "apps/lib/view/legend.hpp"
#include "apps/lib/view/monitor_options.hpp"
#include "apps/lib/view/run_clock.hpp"
#include "apps/lib/view/slam_view.hpp"
#include "apps/lib/view/viewer.hpp"

namespace slamscope::apps {

/// The true world of the run that a lab is to show; nothing where the camera isn't a lab or the run
/// has no truth.
[[nodiscard]] std::optional<RunTruth> truthFor(const MonitorOptions& options);

[[nodiscard]] Viewer::Choices choicesOf(const MonitorOptions& options);

/// The device that is asked for, for a window too where one is.
[[nodiscard]] std::shared_ptr<engine::Gpu> gpuFor(const MonitorOptions& options);

/// What a viewer lays over its pictures, whichever camera they come from: the filter's state at a
/// frame's time as glyphs, status lines, legend and what the audit says.
class SlamLayer {
 public:
  /// Opens the feed. `options` and `choices` must outlive it. `gpu` sums pairs of clusters up.
  SlamLayer(const MonitorOptions& options, const Viewer::Choices& choices,
            std::shared_ptr<engine::Gpu> gpu);

  /// The time of the first frame: lays it on the run's start unless one clock stamped both. Returns
  /// a line for people where it did.
  [[nodiscard]] std::optional<std::string> begin(std::chrono::nanoseconds first_frame,
                                                 bool stamped);
  /// Takes what the filter has said up to the time of a frame.
  void advance(std::chrono::nanoseconds frame_time);
  /// Takes what the audit has to say of that.
  void judge();

  /// How the map lies in the picture.
  struct Place {
    const engine::View& view;  ///< whose labels are kept apart
    double map_scale = 1.0;
    double metres_per_px = 0.0;  ///< at the map's origin: what glyphs' sizes go by
    Eigen::Vector3d viewer_up = Eigen::Vector3d::UnitZ();  ///< as SceneStyle
    /// Covariance of the registration's own error at a point of the scene's floor (m², scene);
    /// nothing where it isn't in view.
    std::function<std::optional<Eigen::Matrix2d>(const Eigen::Vector3d& p_scene)> own_error{};
  };
  /// The scene, with panels for a picture of the camera's size. Without a place: only the status.
  /// `lines`: what the viewer has to say of its camera.
  [[nodiscard]] engine::Scene compose(const std::optional<Place>& place,
                                      const engine::Pinhole& camera,
                                      const std::vector<std::string>& lines);

  /// What became of the pairs when the scene composed last was drawn. The next status line says it:
  /// only the device knows, and only afterwards.
  void drawn(const engine::FrameStats::Pairs& pairs) { drawn_ = pairs; }

  [[nodiscard]] const slam::SnapshotPtr& newest() const { return slam_.newest(); }
  [[nodiscard]] const std::optional<AuditWatch>& audit() const { return audit_; }
  /// Of what the scene composed last shows.
  [[nodiscard]] const AlarmMarks& alarms() const { return alarms_; }
  [[nodiscard]] const SlamFeed& feed() const { return *feed_; }
  [[nodiscard]] std::chrono::nanoseconds runTime() const { return run_time_; }
  /// Share of the run between truth's start and end that was shown.
  [[nodiscard]] double progress(const RunTruth& truth) const;

 private:
  [[nodiscard]] const engine::PlanarPointsPtr& points();
  [[nodiscard]] std::span<const slam::ClusterPair> clusterPairs();
  [[nodiscard]] std::string pairsText(const engine::Scene& scene) const;
  [[nodiscard]] SceneStyle style(const Place& place, const engine::Pinhole& camera) const;
  /// Of the registration, at robot and features.
  void addOwnError(engine::Scene& scene, const Place& place) const;
  [[nodiscard]] std::string runLine(const engine::Scene& scene) const;
  [[nodiscard]] std::vector<std::string> statusLines(const engine::Scene& scene,
                                                     const std::vector<std::string>& lines) const;
  [[nodiscard]] Legend legend(const Place& place) const;
  [[nodiscard]] bool clustered() const {
    return choices_.mode == slam::PairMode::between_clusters ||
           choices_.mode == slam::PairMode::min_mean_max;
  }

  const MonitorOptions& options_;
  const Viewer::Choices& choices_;
  std::unique_ptr<SlamFeed> feed_;
  SlamView slam_;
  std::optional<AuditWatch> audit_;
  AlarmMarks alarms_;  ///< of the newest judgement
  RunClock clock_;
  std::chrono::nanoseconds run_time_{};
  slam::SnapshotPtr sent_;  ///< whose points `points_` are
  engine::PlanarPointsPtr points_;
  ClusterPairs cluster_pairs_;
  engine::FrameStats::Pairs drawn_;
  engine::FontAtlas fonts_;
};

}  // namespace slamscope::apps

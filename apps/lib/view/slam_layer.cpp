// SPDX-License-Identifier: MIT
#include "apps/lib/view/slam_layer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "apps/lib/view/alarm_lines.hpp"
#include "apps/lib/view/feature_labels.hpp"
#include "engine/window/window.hpp"
#include "slam/laser_lab.hpp"

namespace slamscope::apps {

using slam::seconds;

namespace {

/// 499500 as "499,500".
std::string thousands(std::size_t number) {
  std::string text = std::to_string(number);
  for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, 1, ',');
  return text;
}

}  // namespace

std::optional<RunTruth> truthFor(const MonitorOptions& options) {
  if (options.camera != "lab" || options.slam == "-" || options.slam.starts_with("tcp://")) {
    return std::nullopt;
  }
  if (options.slam == "simulate") return truthOfSimulation(options.simulation);
  if (options.slam == "laser-lab") return truthOfLaserLab(laserLabOf(options.simulation));
  return truthOfRun(options.slam);
}

Viewer::Choices choicesOf(const MonitorOptions& options) {
  return {.mode = options.mode,
          .axis = options.axis,
          .palette = options.palette,
          .covariance_rings = options.covariance_rings,
          .own_error = options.own_error,
          .labels = options.labels,
          .legend = options.legend,
          .opacity = options.opacity,
          .message = {}};
}

std::shared_ptr<engine::Gpu> gpuFor(const MonitorOptions& options) {
  return std::make_shared<engine::Gpu>(
      engine::GpuOptions{.device = options.device,
                         .validation = options.validation,
                         .instance_extensions = options.window ? engine::windowInstanceExtensions()
                                                               : std::vector<std::string>{}});
}

SlamLayer::SlamLayer(const MonitorOptions& options, const Viewer::Choices& choices,
                     std::shared_ptr<engine::Gpu> gpu)
    : options_(options),
      choices_(choices),
      feed_(openSlamFeed(options.slam, options.simulation)),
      slam_(*feed_, options.cluster_cut),
      cluster_pairs_(std::move(gpu)) {
  if (options.audit) audit_.emplace(*feed_, options.audit_options);
}

std::optional<std::string> SlamLayer::begin(std::chrono::nanoseconds first_frame, bool stamped) {
  const auto start = feed_->start();
  if (!start) return std::nullopt;
  const std::chrono::nanoseconds offset(std::llround(1e9 * options_.time_offset));
  clock_ = RunClock({.run_start = *start,
                     .first_frame = first_frame,
                     .frames_stamped = stamped,
                     .rate = options_.slam_rate,
                     .offset = offset});
  if (clock_.sameClock()) return std::nullopt;
  char note[96];
  std::snprintf(note, sizeof note, "the first frame is laid on the run's start, t = %.3f s",
                seconds(*start));
  return note;
}

void SlamLayer::advance(std::chrono::nanoseconds frame_time) {
  run_time_ = clock_.runTime(frame_time);
  if (!audit_ || !feed_->live() || !audit_->full()) slam_.advanceTo(run_time_);
}

void SlamLayer::judge() {
  if (!audit_) return;
  // A film shows each alarm at its record, however long that takes; before somebody's eyes the
  // picture goes on.
  const bool nobody_waits = !options_.window && !feed_->live();
  if (nobody_waits) {
    audit_->settle();
  } else {
    audit_->advance();
  }
  alarms_ = AlarmMarks(audit_->newest());
}

double SlamLayer::progress(const RunTruth& truth) const {
  return seconds(run_time_ - truth.start) / std::max(seconds(truth.end - truth.start), 1e-9);
}

SceneStyle SlamLayer::style(const Place& place, const engine::Pinhole& camera) const {
  // Cones and arrow have one size on the floor, so chosen that they suit the picture: that many
  // more cones cover no more of it.
  constexpr double kConeShare = 0.09;  // of the picture's height, seen from the side
  constexpr double kManyFeatures = 60.0;
  const double crowd = std::max(slam_.newest()->featureCount() / kManyFeatures, 1.0);
  const double cone = kConeShare * camera.height * place.metres_per_px / std::sqrt(crowd);
  return {.mode = choices_.mode,
          .axis = choices_.axis,
          .selected = options_.selected,
          .thinning = options_.thinning,
          .palette = choices_.palette,
          .map_scale = place.map_scale,
          .covariance_rings = choices_.covariance_rings,
          .labels = choices_.labels,
          .cone_height = cone,
          .cone_radius = 0.15 * cone,
          .arrow_length = 1.1 * cone,
          .viewer_up = place.viewer_up};
}

const engine::PlanarPointsPtr& SlamLayer::points() {
  if (sent_ != slam_.newest()) {
    sent_ = slam_.newest();
    points_ = pointsOf(*sent_);
  }
  return points_;
}

std::span<const slam::ClusterPair> SlamLayer::clusterPairs() {
  if (choices_.mode != slam::PairMode::min_mean_max) return {};
  return cluster_pairs_.of(slam_.newest(), points(), slam_.clusters());
}

std::string SlamLayer::pairsText(const engine::Scene& scene) const {
  const std::size_t own = ellipsoidCount(scene);
  if (!scene.pairs) return thousands(own) + " ellipsoids";
  // How many of them the device tells after it has drawn them; until then it knows of others.
  const std::size_t all = scene.pairs->points->pairCount();
  if (drawn_.all != all) return thousands(all) + " pairs";
  std::string text = thousands(drawn_.drawn + own) + " of " + thousands(all) + " pairs drawn";
  if (drawn_.greatest_growth > 0.0F) {
    char growth[48];
    std::snprintf(growth, sizeof growth, ", greatest growth × %.3g", drawn_.greatest_growth);
    text += growth;
  }
  return text;
}

std::string SlamLayer::runLine(const engine::Scene& scene) const {
  char text[200];
  const slam::Snapshot& snapshot = *slam_.newest();
  const double age =
      feed_->live() ? seconds(slam_.sinceArrival()) : seconds(run_time_ - snapshot.time);
  const std::string doubted = snapshot.tentative.empty()
                                  ? std::string()
                                  : ", " + std::to_string(snapshot.tentative.size()) + " tentative";
  std::snprintf(text, sizeof text,
                "t %.2f s · record %llu, %.2f s old · %d features%s · %s · mode %s",
                seconds(snapshot.time), static_cast<unsigned long long>(snapshot.sequence),
                std::max(age, 0.0), snapshot.featureCount(), doubted.c_str(),
                pairsText(scene).c_str(), std::string(slam::pairModeName(choices_.mode)).c_str());
  return text;
}

std::vector<std::string> SlamLayer::statusLines(const engine::Scene& scene,
                                                const std::vector<std::string>& lines) const {
  std::vector<std::string> all;
  if (slam_.newest()) {
    all.emplace_back(runLine(scene));
    if (slam_.newest()->diagonal_only) {
      all.emplace_back("only the diagonal of P was logged: relative covariances are unknown");
    }
    if (scene.pairs && !drawn_.problem.empty()) all.emplace_back(drawn_.problem);
    if (choices_.mode == slam::PairMode::min_mean_max && !cluster_pairs_.problem().empty()) {
      all.emplace_back(cluster_pairs_.problem());
    }
  } else {
    all.emplace_back("no record of the filter yet");
  }
  all.insert(all.end(), lines.begin(), lines.end());
  if (const std::string link = feed_->status(); !link.empty()) all.emplace_back(link);
  if (clustered() && slam_.framesSinceRepartition() < 45)
    all.emplace_back("the clusters have changed");
  if (slam_.stopped()) all.emplace_back("the picture stops at " + *slam_.stopped());
  if (!choices_.message.empty()) all.emplace_back(choices_.message);
  return all;
}

Legend SlamLayer::legend(const Place& place) const {
  const slam::Clustering& clusters = slam_.clusters();
  return {.mode = choices_.mode,
          .axis = choices_.axis,
          .palette = choices_.palette,
          .map_scale = place.map_scale,
          .covariance_rings = choices_.covariance_rings,
          .own_error = choices_.own_error,
          .tentative = slam_.newest() && !slam_.newest()->tentative.empty(),
          .clusters = clustered() ? clusters.count() : 0,
          .cluster_cut = clusters.cut,
          .automatic_cut = clusters.automatic,
          .thinning = options_.thinning,
          .lines_left_out = points_ && points_->pairCount() > kMostPairLines,
          .flagged = choices_.mode == slam::PairMode::alarms || !alarms_.empty(),
          .px_per_m = 1.0 / place.metres_per_px};
}

void SlamLayer::addOwnError(engine::Scene& scene, const Place& place) const {
  if (!place.own_error) return;
  const slam::Snapshot& snapshot = *slam_.newest();
  const auto add = [&](const Eigen::Vector2d& p_map) {
    const Eigen::Vector2d p = place.map_scale * p_map;
    if (const auto P = place.own_error({p.x(), p.y(), 0.0})) {
      scene.lines.push_back(
          floorRing(p, *P, choices_.axis.k, paletteOf(choices_.palette).own_error));
    }
  };
  add(snapshot.pose.head<2>());
  for (const Eigen::Vector2d& feature : snapshot.features) add(feature);
}

engine::Scene SlamLayer::compose(const std::optional<Place>& place, const engine::Pinhole& camera,
                                 const std::vector<std::string>& lines) {
  engine::Scene scene;
  const bool shown = place.has_value() && slam_.newest() != nullptr;
  if (shown) {
    scene = buildScene({.snapshot = *slam_.newest(),
                        .points = points(),
                        .path = slam_.path(),
                        .clusters = slam_.clusters(),
                        .cluster_pairs = clusterPairs(),
                        .alarms = alarms_},
                       style(*place, camera));
    if (choices_.own_error) addOwnError(scene, *place);
  }
  addStatus(scene, statusLines(scene, lines), camera, fonts_);
  if (!shown) return scene;
  if (choices_.legend) addLegend(scene, legend(*place), camera, fonts_);
  if (audit_) {
    const bool asked = choices_.mode == slam::PairMode::alarms;
    addAlarms(scene, alarmLines(audit_->newest(), slam_.newest()->time, asked), choices_.palette,
              camera, fonts_);
  }
  spreadLabels(scene, place->view, fonts_);
  return scene;
}

}  // namespace slamscope::apps

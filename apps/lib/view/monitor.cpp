// SPDX-License-Identifier: MIT
#include "apps/lib/view/monitor.hpp"

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "apps/lib/run_truth.hpp"
#include "apps/lib/slam_feed.hpp"
#include "apps/lib/view/camera_setup.hpp"
#include "apps/lib/view/frame_prefetch.hpp"
#include "apps/lib/view/legend.hpp"
#include "apps/lib/view/monitor_report.hpp"
#include "apps/lib/view/output_camera.hpp"
#include "apps/lib/view/overlay.hpp"
#include "apps/lib/view/picture_output.hpp"
#include "apps/lib/view/run_clock.hpp"
#include "apps/lib/view/slam_view.hpp"
#include "engine/render/offscreen.hpp"
#include "engine/scene/clip.hpp"
#include "engine/window/window.hpp"
#include "tracking/tag_detector.hpp"

namespace slamscope::apps {
namespace {

using std::chrono::nanoseconds;
using tracking::RegistrationState;

using slam::seconds;

/// Milliseconds since it was made or last asked.
class StopWatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double passed = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    return passed;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

std::optional<RunTruth> truthFor(const MonitorOptions& options) {
  if (options.camera != "lab" || options.slam == "-" || options.slam.starts_with("tcp://")) {
    return std::nullopt;
  }
  if (options.slam == "simulate") return truthOfSimulation(options.simulation);
  return truthOfRun(options.slam);
}

tracking::TagDetectorOptions detectorOptions(const CameraSetup& setup) {
  const auto& registration = setup.registration;
  return {.family = registration.layout.tags.empty() && registration.robot
                        ? registration.robot->family
                        : registration.layout.family,
          .threads = 2,
          .quad_decimate = {},
          .camera = tracking::CameraModel(setup.info)};
}

}  // namespace

struct Monitor::State {
  explicit State(const MonitorOptions& request);

  bool next();
  void detect(const tracking::Frame& frame);
  [[nodiscard]] bool runIsOver() const;

  void compose();
  [[nodiscard]] SceneStyle style() const;
  [[nodiscard]] std::vector<std::string> statusLines() const;
  [[nodiscard]] std::string runLine() const;
  [[nodiscard]] Legend legend() const;
  [[nodiscard]] bool clustered() const {
    return choices.mode == slam::PairMode::between_clusters ||
           choices.mode == slam::PairMode::min_mean_max;
  }

  void draw();
  void hand();
  void compare();
  [[nodiscard]] FrameReport frameReport() const;
  void finish();

  [[nodiscard]] const std::optional<tracking::RegistrationResult>& registered() const {
    return registration.result();
  }
  [[nodiscard]] bool shown() const { return registered().has_value() && slam.newest() != nullptr; }

  MonitorOptions options;
  std::optional<RunTruth> truth;
  CameraSetup setup;
  std::unique_ptr<SlamFeed> feed;
  SlamView slam;
  OutputCamera camera;
  tracking::TagDetector detector;
  tracking::Registration registration;
  FramePrefetch frames;
  std::shared_ptr<engine::Gpu> gpu;
  engine::Offscreen offscreen;
  engine::FontAtlas fonts;
  std::unique_ptr<PictureOutput> output;
  MonitorReport report;

  Choices choices;
  RunClock clock;
  std::optional<nanoseconds> first_time;
  nanoseconds frame_time{};
  nanoseconds frame_step{};
  nanoseconds run_time{};
  std::uint64_t frame_count = 0;
  std::uint64_t drawn_frame = 0;
  bool ever_registered = false;
  double metres_per_px = 0.0;  ///< at the map's origin, when it was first registered
  Picture picture;
  std::vector<engine::Image> pixels;
  std::optional<engine::Image> start_picture;
  bool at_end = false;
};

Monitor::State::State(const MonitorOptions& request)
    : options(request),
      truth(truthFor(request)),
      setup(openCamera(request, truth)),
      feed(openSlamFeed(request.slam, request.simulation)),
      slam(*feed, request.cluster_cut),
      camera(makeOutputCamera(setup.info, request.width, request.height)),
      detector(detectorOptions(setup)),
      registration(setup.registration, tracking::CameraModel(setup.info)),
      frames(*setup.source),
      gpu(std::make_shared<engine::Gpu>(engine::GpuOptions{
          .device = request.device,
          .validation = request.validation,
          .instance_extensions =
              request.window ? engine::windowInstanceExtensions() : std::vector<std::string>{}})),
      offscreen(gpu, camera.pinhole.width, camera.pinhole.height) {
  choices = {.mode = request.mode,
             .axis = request.axis,
             .covariance_rings = request.covariance_rings,
             .labels = request.labels,
             .legend = request.legend,
             .opacity = request.opacity,
             .message = {}};
  if (!request.output.empty()) output = openPictureOutput(request.output, setup.fps);
  if (!request.lab_truth.empty()) {
    if (!setup.lab) throw std::runtime_error("--lab-truth: only the lab knows its truth");
    tracking::writeLabTruth(*setup.lab, request.lab_truth);
  }
  picture.view.camera = camera.pinhole;
  picture.view.background.map = camera.map;
}

bool Monitor::State::runIsOver() const {
  // A lab has no end of its own; a camera or a film is shown to its end.
  return setup.lab && feed->ended() && (registered() || slam.newest() == nullptr);
}

bool Monitor::State::next() {
  if (options.frames > 0 && frame_count >= options.frames) return false;
  if (frame_count > 0 && runIsOver()) return false;
  StopWatch watch;
  const std::optional<tracking::Frame> frame = frames.next();
  if (!frame) return false;
  report.addStage("frame", watch.lap());
  if (!first_time) {
    first_time = frame->time;
    if (const auto start = feed->start()) {
      clock = RunClock({.run_start = *start,
                        .first_frame = frame->time,
                        .frames_stamped = setup.source->stamped(),
                        .rate = options.slam_rate,
                        .offset = nanoseconds(std::llround(1e9 * options.time_offset))});
      if (!clock.sameClock()) {
        char note[96];
        std::snprintf(note, sizeof note, "the first frame is laid on the run's start, t = %.3f s",
                      seconds(*start));
        setup.notes.emplace_back(note);
      }
    }
  }
  if (frame_count > 0) frame_step = frame->time - frame_time;
  frame_time = frame->time;
  run_time = clock.runTime(frame_time);
  ++frame_count;
  detect(*frame);
  report.addStage("detect", watch.lap());
  slam.advanceTo(run_time);
  report.addStage("slam", watch.lap());
  picture.view.background.image = toImage(*frame);
  return true;
}

void Monitor::State::detect(const tracking::Frame& frame) {
  const bool stored = !options.continuous && registered().has_value();
  if (stored) return;
  registration.add(frame.time, detector.detect(frame));
  if (!registered() || ever_registered) return;
  ever_registered = true;
  const double depth = registered()->T_camera_map.translation().z();
  metres_per_px = depth / camera.pinhole.fx;
}

SceneStyle Monitor::State::style() const {
  // Cones and arrow have one size on the floor, so chosen that they suit the picture.
  constexpr double kConeShare = 0.09;  // of the picture's height, seen from the side
  const double cone = kConeShare * camera.pinhole.height * metres_per_px;
  return {.mode = choices.mode,
          .axis = choices.axis,
          .selected = options.selected,
          .map_scale = setup.map_scale,
          .covariance_rings = choices.covariance_rings,
          .labels = choices.labels,
          .cone_height = cone,
          .cone_radius = 0.15 * cone,
          .arrow_length = 1.1 * cone,
          .viewer_up = registered()->T_camera_map.linear().transpose() * -Eigen::Vector3d::UnitY()};
}

std::string Monitor::State::runLine() const {
  char text[200];
  const slam::Snapshot& snapshot = *slam.newest();
  const double age =
      feed->live() ? seconds(slam.sinceArrival()) : seconds(run_time - snapshot.time);
  std::snprintf(text, sizeof text,
                "t %.2f s · record %llu, %.2f s old · %d features · %zu ellipsoids · mode %s",
                seconds(snapshot.time), static_cast<unsigned long long>(snapshot.sequence),
                std::max(age, 0.0), snapshot.featureCount(), picture.scene.ellipsoids.size(),
                std::string(slam::pairModeName(choices.mode)).c_str());
  return text;
}

std::vector<std::string> Monitor::State::statusLines() const {
  std::vector<std::string> lines;
  if (slam.newest()) {
    lines.push_back(runLine());
    if (slam.newest()->diagonal_only) {
      lines.emplace_back("only the diagonal of P was logged: relative covariances are unknown");
    }
  } else {
    lines.emplace_back("no record of the filter yet");
  }
  lines.push_back((setup.calibrated ? "" : "uncalibrated · ") + registration.status());
  for (const std::string& problem : registration.problems()) lines.push_back(problem);
  if (const std::string link = feed->status(); !link.empty()) lines.push_back(link);
  if (clustered() && slam.framesSinceRepartition() < 45)
    lines.emplace_back("the clusters have changed");
  if (slam.stopped()) lines.push_back("the picture stops at " + *slam.stopped());
  if (!choices.message.empty()) lines.push_back(choices.message);
  return lines;
}

Legend Monitor::State::legend() const {
  const slam::Clustering& clusters = slam.clusters();
  return {.mode = choices.mode,
          .axis = choices.axis,
          .map_scale = setup.map_scale,
          .covariance_rings = choices.covariance_rings,
          .clusters = clustered() ? clusters.count() : 0,
          .cluster_cut = clusters.cut,
          .automatic_cut = clusters.automatic,
          .px_per_m = 1.0 / metres_per_px};
}

void Monitor::State::compose() {
  picture.scene = {};
  picture.render.opacity = static_cast<float>(choices.opacity);
  if (shown()) {
    picture.view.T_eye_scene = registered()->T_camera_map;
    picture.scene = buildScene(*slam.newest(), slam.path(), slam.clusters(), style());
  }
  addStatus(picture.scene, statusLines(), camera.pinhole, fonts);
  if (!shown()) return;
  if (choices.legend) addLegend(picture.scene, legend(), camera.pinhole, fonts);
  spreadLabels(picture.scene, picture.view, fonts);
}

void Monitor::State::draw() {
  StopWatch watch;
  compose();
  report.addStage("scene", watch.lap());
  offscreen.draw({&picture.view, 1}, picture.scene, picture.render, pixels);
  report.addStage("draw", watch.lap());
  if (drawn_frame == frame_count) return;
  drawn_frame = frame_count;
  hand();
  report.addStage("write", watch.lap());
}

void Monitor::State::hand() {
  if (output) output->write(pixels.front());
  if (!options.report.empty()) report.add(frameReport());
  if (!options.compare.empty() && !start_picture && !picture.scene.ellipsoids.empty()) compare();
}

void Monitor::State::compare() {
  start_picture = pixels.front();
  // Nobody looks at what lies between: the lab can go straight to the end.
  const bool only_compare = !output && options.report.empty() && !options.window;
  if (!only_compare || !setup.lab || !truth) return;
  const double left = seconds(truth->end - run_time) / options.slam_rate;
  const double count = std::floor(left * setup.lab->fps) - 1.0;
  if (count < 1.0) return;
  frames.skip(static_cast<std::uint64_t>(count));
}

FrameReport Monitor::State::frameReport() const {
  FrameReport frame{.time_s = seconds(frame_time),
                    .snapshot_time_s = {},
                    .state = registration.state(),
                    .registration = registered(),
                    .overlay_errors_px = {},
                    .slam_error_m = {},
                    .tips = {}};
  if (slam.newest()) frame.snapshot_time_s = seconds(slam.newest()->time);
  if (!shown()) return frame;
  const slam::Snapshot& snapshot = *slam.newest();
  frame.ellipsoids = picture.scene.ellipsoids.size();
  frame.features = snapshot.ids.size();

  Overlay overlay{.camera = camera.pinhole,
                  .T_camera_map = picture.view.T_eye_scene,
                  .true_T_camera_map = {},
                  .map_scale = setup.map_scale};
  if (setup.lab) {
    overlay.true_T_camera_map = setup.lab->T_world_camera.inverse() * setup.lab->T_world_map;
  }
  measureOverlay(overlay, snapshot, frame);
  return frame;
}

void Monitor::State::finish() {
  if (!ever_registered && !setup.source->live() && (!setup.lab || frame_count > 0)) {
    throw std::runtime_error(options.camera + ": never registered in " +
                             std::to_string(frame_count) + " frames (" + registration.status() +
                             ")");
  }
  if (output) output->finish();
  if (!options.picture.empty()) writePicture(options.picture, pixels.front());
  if (!options.compare.empty()) {
    if (!start_picture) throw std::runtime_error("--compare: no ellipsoid was ever drawn");
    writePicture(options.compare, sideBySide(*start_picture, pixels.front()));
  }
  if (!options.report.empty()) report.write(options.report);
}

Monitor::Monitor(const MonitorOptions& options) : state_(std::make_unique<State>(options)) {}
Monitor::~Monitor() = default;

bool Monitor::next() {
  return state_->next();
}
void Monitor::draw() {
  state_->draw();
}
void Monitor::finish() {
  state_->finish();
}
const Monitor::Picture& Monitor::picture() const {
  return state_->picture;
}
const engine::Image& Monitor::drawn() const {
  return state_->pixels.front();
}
Monitor::Choices& Monitor::choices() {
  return state_->choices;
}

bool Monitor::paced() const {
  return !state_->setup.source->live() && (state_->options.window || state_->feed->live());
}
double Monitor::secondsShown() const {
  return state_->first_time ? seconds(state_->frame_time - *state_->first_time) : 0.0;
}
double Monitor::frameSeconds() const {
  return seconds(state_->frame_step);
}
std::uint64_t Monitor::framesShown() const {
  return state_->frame_count;
}
double Monitor::progress() const {
  const State& state = *state_;
  if (state.options.frames > 0) {
    return static_cast<double>(state.frame_count) / static_cast<double>(state.options.frames);
  }
  if (const auto count = state.setup.source->count(); count && *count > 0) {
    return static_cast<double>(state.frame_count) / static_cast<double>(*count);
  }
  if (!state.truth) return -1.0;
  return seconds(state.run_time - state.truth->start) /
         std::max(seconds(state.truth->end - state.truth->start), 1e-9);
}
std::string Monitor::status() const {
  return state_->registration.status();
}
const std::vector<std::string>& Monitor::notes() const {
  return state_->setup.notes;
}
const std::shared_ptr<engine::Gpu>& Monitor::gpu() const {
  return state_->gpu;
}

}  // namespace slamscope::apps

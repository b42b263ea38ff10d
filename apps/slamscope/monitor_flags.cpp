// SPDX-License-Identifier: MIT
#include "apps/slamscope/monitor_flags.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>
#include <system_error>

namespace slamscope::apps {
namespace {

constexpr const char* kCameraGroup = "Camera and registration";
constexpr const char* kOutputGroup = "Output";

engine::MostBy mostByFromName(const std::string& name) {
  if (name == "growth") return engine::MostBy::growth;
  if (name == "last-growth") return engine::MostBy::last_growth;
  return engine::MostBy::area;
}

slam::Axis axisFromName(const std::string& name) {
  if (name == "eigenvalue") return slam::Axis::eigenvalue;
  if (name == "log") return slam::Axis::log;
  return slam::Axis::sigma;
}

/// Two numbers of two to five figures, as in "1280x720".
void readSize(const std::string& flag, const std::string& text, int& width, int& height) {
  constexpr int kLeast = 10, kMost = 99999;
  const char* const end = text.data() + text.size();
  const auto [middle, no_width] = std::from_chars(text.data(), end, width);
  const bool parted = middle != end && *middle == 'x';
  const auto [last, no_height] = std::from_chars(parted ? middle + 1 : end, end, height);
  if (no_width != std::errc() || no_height != std::errc() || last != end ||
      std::min(width, height) < kLeast || std::max(width, height) > kMost) {
    throw std::invalid_argument(flag + ": expected WxH, for example 1280x720, got " + text);
  }
}

void addCameraFlags(CLI::App& verb, MonitorFlags& flags) {
  const std::string group = kCameraGroup;
  MonitorOptions& rest = flags.rest;
  verb.add_option(
          "--camera", rest.camera,
          "lab (synthetic), a device (/dev/video0), a video, a directory or a pattern of pictures")
      ->group(group);
  verb.add_option("--camera-info", rest.camera_info, "intrinsics, ROS camera_info YAML")
      ->group(group);
  verb.add_option("--tags", rest.tags, "floor or board tags of known place, YAML")->group(group);
  verb.add_option("--camera-pose", rest.camera_pose, "pose of the camera over the floor, YAML")
      ->group(group);
  verb.add_option("--robot", rest.robot,
                  "the robot's tag, YAML (id, size_m, T_robot_tag); none: the map starts at the "
                  "origin of --tags")
      ->group(group);
  verb.add_option("--registration", flags.registration,
                  "once: from the first frames, then stored; continuous: a camera that moves")
      ->check(CLI::IsMember({"once", "continuous"}))
      ->group(group);
}

void addSlamFlags(CLI::App& verb, MonitorFlags& flags) {
  const std::string group = "SLAM";
  MonitorOptions& rest = flags.rest;
  verb.add_option("--slam", rest.slam,
                  "simulate, laser-lab (a robot with a laser, no ids), a run (.jsonl, .jsonl.zst, "
                  ".npz, .npy, .mat), - (standard input) or tcp://HOST:PORT (listens)")
      ->group(group);
  verb.add_option("--slam-rate", rest.slam_rate, "seconds of the run per second of the camera")
      ->check(CLI::PositiveNumber)
      ->group(group);
  verb.add_option("--time-offset", rest.time_offset,
                  "s, added to a frame's time before the run is asked")
      ->group(group);
  verb.add_flag("!--no-audit", rest.audit, "flag nothing")->group(group);
  verb.add_option("--allow", flags.allow,
                  "laws that the filter breaks by design (slamscope audit --help)")
      ->delimiter(',')
      ->group(group);
  verb.add_option("--map-scale", flags.map_scale,
                  "size of the map on the floor: 0.1 draws 10 m as 1 m")
      ->check(CLI::PositiveNumber)
      ->group(group);
}

void addDrawingFlags(CLI::App& verb, MonitorFlags& flags) {
  const std::string group = "Drawing";
  MonitorOptions& rest = flags.rest;
  verb.add_option(
          "--mode", flags.mode,
          "pairs: all, between-clusters, min-mean-max, selected; alarms: what the audit flags "
          "only (flagged is magenta in every mode)")
      ->check(CLI::IsMember({"all", "between-clusters", "min-mean-max", "selected", "alarms"}))
      ->group(group);
  verb.add_option("--select", rest.selected, "ids of features whose pairs `--mode selected` shows")
      ->delimiter(',')
      ->group(group);
  verb.add_option("--most", rest.thinning.most,
                  "of the pairs of the mode only so many, those that come first by --most-by")
      ->check(CLI::PositiveNumber)
      ->group(group);
  verb.add_option("--most-by", flags.most_by,
                  "area: the largest relative covariances; growth: those that grew most since they "
                  "were first drawn; last-growth: since the record before")
      ->check(CLI::IsMember({"area", "growth", "last-growth"}))
      ->group(group);
  verb.add_flag("--in-view", rest.thinning.in_view,
                "no pair but those both of whose features are in the picture")
      ->group(group);
  verb.add_option("--least-area", rest.thinning.least_area,
                  "m^2: no pair whose relative covariance has a smaller sqrt(det)")
      ->check(CLI::NonNegativeNumber)
      ->group(group);
  verb.add_option("--axis", flags.axis,
                  "length of a semi-axis: sigma (k sqrt(lambda), metres), eigenvalue (the paper's: "
                  "gain x lambda), log")
      ->check(CLI::IsMember({"sigma", "eigenvalue", "log"}))
      ->group(group);
  verb.add_option("--k", flags.k, "how many sigma")->check(CLI::PositiveNumber)->group(group);
  verb.add_option("--gain", flags.gain,
                  "factor on the axes; default 1, for eigenvalue 25 (m per m^2)")
      ->check(CLI::PositiveNumber)
      ->group(group);
  verb.add_option("--cluster-cut", flags.cluster_cut,
                  "m: features nearer than this are one cluster; default automatic")
      ->check(CLI::PositiveNumber)
      ->group(group);
  verb.add_flag("--rings", rest.covariance_rings,
                "k-sigma ellipses of robot and features on the floor")
      ->group(group);
  verb.add_flag("--own-error", rest.own_error,
                "k-sigma ellipses of the registration's own error at each feature: what lies "
                "further off than that is SLAM's")
      ->group(group);
  verb.add_option("--palette", flags.palette,
                  "paper: the paper's colours; safe: colours that the colour-blind can tell apart")
      ->check(CLI::IsMember({"paper", "safe"}))
      ->group(group);
  verb.add_option("--opacity", rest.opacity, "of everything drawn, 0 to 1")
      ->check(CLI::Range(0.0, 1.0))
      ->group(group);
  verb.add_flag("!--no-labels", rest.labels, "leave the feature ids out")->group(group);
  verb.add_flag("!--no-legend", rest.legend, "leave the legend out")->group(group);
  verb.add_option("--size", flags.size, "WxH of the picture; default the camera's")->group(group);
}

void addOutputFlags(CLI::App& verb, MonitorFlags& flags) {
  const std::string group = kOutputGroup;
  MonitorOptions& rest = flags.rest;
  verb.add_option("--output", rest.output, "out.mp4 or out-%05d.png; without any output: a window")
      ->group(group);
  verb.add_option("--picture", rest.picture, "one PNG or JPEG: the last frame")->group(group);
  verb.add_option("--report", rest.report, "JSON: registration, errors and pixels of each frame")
      ->group(group);
  verb.add_option("--lab-seed", rest.lab_seed, "of the lab's floor and noise")->group(group);
  verb.add_option("--frames", rest.frames, "stop after so many")
      ->check(CLI::PositiveNumber)
      ->group(group);
  verb.add_flag("--window", rest.window, "a window, besides the outputs")->group(group);
  verb.add_option("--device", rest.device, "Vulkan device by index or name (slamscope devices)")
      ->group(group);
  verb.add_flag("--validation", rest.validation,
                "Vulkan's validation layer; its messages are errors")
      ->group(group);
}

}  // namespace

void addCaptureFlags(CLI::App& verb, MonitorFlags& flags, const std::string& group) {
  MonitorOptions& rest = flags.rest;
  verb.add_option("--fps", rest.fps, "frame rate of pictures without stamps, and of a lab")
      ->check(CLI::Range(0.1, 1000.0))
      ->group(group);
  verb.add_option_function<std::string>(
          "--capture-size",
          [&rest](const std::string& text) {
            readSize("--capture-size", text, rest.v4l2.width, rest.v4l2.height);
          },
          "WxH asked of a device")
      ->group(group);
  verb.add_option("--capture-rate", rest.v4l2.fps, "frames a second asked of a device")
      ->group(group);
  verb.add_option("--pixel-format", rest.v4l2.pixel_format, "YUYV, MJPG or GREY, of a device")
      ->check(CLI::IsMember({"YUYV", "MJPG", "GREY"}))
      ->group(group);
  verb.add_option("--focus", flags.focus, "fixed focus of a device, driver's units")->group(group);
  verb.add_option("--exposure-ms", flags.exposure_ms, "fixed exposure of a device")->group(group);
}

MonitorOptions MonitorFlags::options() const {
  MonitorOptions options = rest;
  options.simulation = simulation.options();
  options.continuous = registration == "continuous";
  options.mode = slam::pairModeFromName(mode);
  options.palette = paletteFromName(palette);
  options.thinning.by = mostByFromName(most_by);
  if (options.thinning.by != engine::MostBy::area && options.thinning.most == 0) {
    throw std::invalid_argument("--most-by " + most_by + " needs --most N");
  }
  options.axis.axis = axisFromName(axis);
  options.axis.k = k;
  options.axis.gain = gain > 0.0 ? gain : defaultGain(options.axis.axis);
  if (map_scale > 0.0) options.map_scale = map_scale;
  if (cluster_cut > 0.0) options.cluster_cut = cluster_cut;
  if (focus >= 0) options.v4l2.focus = focus;
  if (exposure_ms > 0.0) {
    options.v4l2.exposure = std::chrono::microseconds(std::lround(1000.0 * exposure_ms));
  }
  for (const std::string& word : allow) {
    options.audit_options.allow.insert(slam::allowFromName(word));
  }
  if (options.mode == slam::PairMode::alarms && !options.audit) {
    throw std::invalid_argument("--mode alarms needs the audit: leave --no-audit out");
  }
  if (options.mode == slam::PairMode::selected && options.selected.empty()) {
    throw std::invalid_argument("--mode selected needs --select ID,ID,…");
  }
  if (!size.empty()) readSize("--size", size, options.width, options.height);
  return options;
}

void addMonitorFlags(CLI::App& verb, MonitorFlags& flags) {
  addCameraFlags(verb, flags);
  addCaptureFlags(verb, flags, kCameraGroup);
  addViewFlags(verb, flags);
  MonitorOptions& rest = flags.rest;
  verb.add_option("--compare", rest.compare,
                  "one PNG or JPEG: start and end of the run beside each other")
      ->group(kOutputGroup);
  verb.add_option("--until", rest.until, "stop at that time of the run, s")->group(kOutputGroup);
  verb.add_option("--lab-truth", rest.lab_truth, "JSON: the lab's camera, poses and features")
      ->group(kOutputGroup);
}

void addViewFlags(CLI::App& verb, MonitorFlags& flags) {
  addSlamFlags(verb, flags);
  addDrawingFlags(verb, flags);
  addOutputFlags(verb, flags);
  addSimulationFlags(verb, flags.simulation);
}

}  // namespace slamscope::apps

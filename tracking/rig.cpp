// SPDX-License-Identifier: MIT
#include "tracking/rig.hpp"

#include <cmath>
#include <stdexcept>

#include "tracking/camera_info_yaml.hpp"

namespace slamscope::tracking {
namespace {

constexpr double kEyeDistance = 0.064;  // m, a grown-up's

std::chrono::nanoseconds secondsOf(double seconds) {
  return std::chrono::nanoseconds(std::llround(seconds * 1e9));
}

double inSeconds(std::chrono::nanoseconds time) {
  return std::chrono::duration<double>(time).count();
}

DisplayLens readDisplay(const YamlField& field) {
  field.allowOnly({"centre", "k", "zoom", "colour_scale"});
  DisplayLens lens;
  if (const auto centre = field.find("centre")) lens.centre = centre->vector(2);
  if (const auto zoom = field.find("zoom")) lens.zoom = zoom->positive();
  if (const auto k = field.find("k")) {
    const Eigen::VectorXd values = k->vector(3);
    lens.k = {values[0], values[1], values[2]};
  }
  if (const auto scale = field.find("colour_scale")) {
    const Eigen::VectorXd values = scale->vector(3);
    if (!(values.minCoeff() > 0)) scale->reject("expected three positive numbers");
    lens.colour_scale = {values[0], values[1], values[2]};
  }
  return lens;
}

RigCamera readCamera(const YamlField& field) {
  RigCamera camera;
  const YamlField info = field.at("camera_info");
  camera.info =
      info.isText() ? readCameraInfo(field.file().parent_path() / info.text()) : cameraInfoOf(info);
  field.allowOnly({"camera_info", "readout_s", "time_offset_s", "time_sigma_s", "display"});
  if (const auto value = field.find("readout_s")) camera.readout = secondsOf(value->notNegative());
  if (const auto value = field.find("time_offset_s"))
    camera.time_offset = secondsOf(value->number());
  if (const auto value = field.find("time_sigma_s"))
    camera.time_sigma = secondsOf(value->notNegative());
  if (const auto display = field.find("display")) camera.display = readDisplay(*display);
  return camera;
}

std::string cameraText(const RigCamera& camera) {
  const DisplayLens& lens = camera.display;
  std::string text = "  camera_info:\n" + cameraInfoText(camera.info, "    ");
  text += "  readout_s: " + yamlNumber(inSeconds(camera.readout)) + "\n";
  text += "  time_offset_s: " + yamlNumber(inSeconds(camera.time_offset)) + "\n";
  text += "  time_sigma_s: " + yamlNumber(inSeconds(camera.time_sigma)) + "\n";
  text += "  display:\n    centre: " + yamlNumbers(lens.centre.data(), 2) + "\n";
  text += "    k: " + yamlNumbers(lens.k.data(), 3) + "\n";
  text += "    zoom: " + yamlNumber(lens.zoom) + "\n";
  text += "    colour_scale: " + yamlNumbers(lens.colour_scale.data(), 3) + "\n";
  return text;
}

}  // namespace

bool DisplayLens::plain() const {
  return k == std::array<double, 3>{} && zoom == 1 &&
         colour_scale == std::array<double, 3>{1, 1, 1};
}

Eigen::Vector2d shownAt(const DisplayLens& lens, const Eigen::Vector2d& display_px, int width,
                        int height, int channel) {
  const Eigen::Vector2d axis(lens.centre.x() * width - 0.5, lens.centre.y() * height - 0.5);
  const Eigen::Vector2d off = (display_px - axis) / (0.5 * height);
  const double s = off.squaredNorm();
  const double factor = (1 + s * (lens.k[0] + s * (lens.k[1] + s * lens.k[2]))) / lens.zoom *
                        lens.colour_scale.at(static_cast<std::size_t>(channel));
  return axis + factor * (display_px - axis);
}

Eigen::Isometry3d Rig::T_head_camera(std::size_t camera) const {
  if (camera >= cameras.size()) {
    throw std::out_of_range("rig " + name + " has no camera " + std::to_string(camera));
  }
  return camera == 0 ? T_head_left : T_head_left * T_right_left.inverse();
}

std::chrono::nanoseconds rowTime(const RigCamera& camera, std::chrono::nanoseconds time,
                                 double row) {
  const double part = (row + 0.5) / camera.info.height - 0.5;
  return time + secondsOf(inSeconds(camera.readout) * part);
}

Rig readRig(const std::filesystem::path& file) {
  const YamlField root = YamlField::open(file);
  root.allowOnly({"name", "left", "right", "T_right_left", "T_head_left"});
  Rig rig;
  if (const auto field = root.find("name")) rig.name = field->text();
  if (const auto field = root.find("T_head_left")) rig.T_head_left = field->pose();
  rig.cameras.push_back(readCamera(root.at("left")));
  if (const auto right = root.find("right")) {
    rig.cameras.push_back(readCamera(*right));
    rig.T_right_left = root.at("T_right_left").pose();
  } else if (const auto field = root.find("T_right_left")) {
    field->reject("is given, but no camera `right`");
  }
  return rig;
}

void writeRig(const Rig& rig, const std::filesystem::path& file) {
  std::string text = "name: " + YAML::Dump(YAML::Node(rig.name)) + "\n";
  text += "T_head_left: " + yamlPose(rig.T_head_left) + "\n";
  if (rig.cameras.size() > 1) text += "T_right_left: " + yamlPose(rig.T_right_left) + "\n";
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    text += (i == 0 ? "left:\n" : "right:\n") + cameraText(rig.cameras[i]);
  }
  writeText(file, text);
}

Rig guessedRig(int width, int height, std::size_t cameras) {
  if (cameras < 1 || cameras > 2) throw std::invalid_argument("a rig has one camera or two");
  Rig rig;
  rig.name = "uncalibrated";
  rig.calibrated = false;
  for (std::size_t i = 0; i < cameras; ++i) {
    rig.cameras.push_back({.info = guessedCameraInfo(width, height), .display = {}});
  }
  rig.T_right_left.translation().x() = cameras > 1 ? -kEyeDistance : 0;
  return rig;
}

}  // namespace slamscope::tracking

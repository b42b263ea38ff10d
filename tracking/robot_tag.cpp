// SPDX-License-Identifier: MIT
#include "tracking/robot_tag.hpp"

#include <numbers>

#include "tracking/yaml_fields.hpp"

namespace slamscope::tracking {
namespace {

constexpr double kPerDegree = std::numbers::pi / 180;

}  // namespace

RobotTag readRobotTag(const std::filesystem::path& file) {
  const YamlField root = YamlField::open(file);
  root.allowOnly({"family", "id", "size_m", "T_robot_tag"});
  RobotTag tag;
  if (const auto field = root.find("family")) tag.family = field->text();
  if (const auto field = root.find("id")) {
    tag.id = field->integer();
    if (tag.id < 0) field->reject("expected a whole number not below 0");
  }
  if (const auto field = root.find("size_m")) tag.size_m = field->positive();
  if (const auto field = root.find("T_robot_tag")) tag.T_robot_tag = field->pose();
  return tag;
}

void writeRobotTag(const RobotTag& tag, const std::filesystem::path& file) {
  writeText(file, "family: " + tag.family + "\nid: " + std::to_string(tag.id) +
                      "\nsize_m: " + yamlNumber(tag.size_m) +
                      "\nT_robot_tag: " + yamlPose(tag.T_robot_tag) + "\n");
}

CameraPose readCameraPose(const std::filesystem::path& file) {
  const YamlField root = YamlField::open(file);
  root.allowOnly({"T_world_camera", "T_camera_world", "sigma_position_m", "sigma_rotation_deg"});
  CameraPose pose;
  const auto camera_world = root.find("T_camera_world");
  const auto world_camera = root.find("T_world_camera");
  if (camera_world.has_value() == world_camera.has_value()) {
    root.reject("expected either T_world_camera or T_camera_world");
  }
  pose.T_camera_world = camera_world ? camera_world->pose() : world_camera->pose().inverse();
  if (const auto field = root.find("sigma_position_m"))
    pose.sigma_position_m = field->notNegative();
  if (const auto field = root.find("sigma_rotation_deg")) {
    pose.sigma_rotation_rad = field->notNegative() * kPerDegree;
  }
  return pose;
}

void writeCameraPose(const CameraPose& pose, const std::filesystem::path& file) {
  writeText(file, "T_world_camera: " + yamlPose(pose.T_camera_world.inverse()) +
                      "\nsigma_position_m: " + yamlNumber(pose.sigma_position_m) +
                      "\nsigma_rotation_deg: " + yamlNumber(pose.sigma_rotation_rad / kPerDegree) +
                      "\n");
}

}  // namespace slamscope::tracking

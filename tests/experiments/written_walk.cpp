// SPDX-License-Identifier: MIT
#include "tests/experiments/written_walk.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <iterator>
#include <stdexcept>
#include <string>

#include "tests/experiments/progress.hpp"
#include "tracking/codecs.hpp"
#include "tracking/rig.hpp"
#include "tracking/robot_tag.hpp"
#include "tracking/stereo_lab.hpp"
#include "tracking/tag_layout.hpp"

namespace slamscope::tracking::experiments {
namespace {

BgrPicture sideBySide(const Frame& left, const Frame& right) {
  BgrPicture both{.width = left.width + right.width, .height = left.height, .bgr = {}};
  const auto of_left = std::size_t{3} * static_cast<std::size_t>(left.width);
  const auto of_right = std::size_t{3} * static_cast<std::size_t>(right.width);
  both.bgr.reserve(left.bgr.size() + right.bgr.size());
  for (std::size_t row = 0; row < static_cast<std::size_t>(left.height); ++row) {
    std::copy_n(&left.bgr[row * of_left], of_left, std::back_inserter(both.bgr));
    std::copy_n(&right.bgr[row * of_right], of_right, std::back_inserter(both.bgr));
  }
  return both;
}

}  // namespace

void writeWalk(const WrittenWalkOptions& options) {
  StereoLabOptions lab_options = defaultStereoLab();
  lab_options.room.fps = options.fps;
  const StereoLab lab(lab_options);
  const auto pictures = options.folder / "pictures";
  std::filesystem::create_directories(pictures);
  writeRig(lab_options.rig, options.folder / "rig.yaml");
  writeTagLayout(lab.tags().value(), options.folder / "room.yaml");
  writeRobotTag({.id = lab_options.room.robot_tag_id,
                 .size_m = lab_options.room.robot_tag_size,
                 .T_robot_tag = lab_options.room.T_robot_tag},
                options.folder / "robot.yaml");
  slam::experiments::Progress progress("pairs written", options.pairs);
  for (int k = 0; k < options.pairs; ++k) {
    const StereoFrame pair = lab.pair(static_cast<std::uint64_t>(k));
    char name[16];
    std::snprintf(name, sizeof name, "%05d.jpg", k);
    if (!codecs().write(pictures / name, sideBySide(pair.eyes[0].value(), pair.eyes[1].value())))
      throw std::runtime_error((pictures / name).string() + ": can't be written");
    progress.done();
  }
}

}  // namespace slamscope::tracking::experiments

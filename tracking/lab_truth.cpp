// SPDX-License-Identifier: MIT
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tracking/lab.hpp"

namespace slamscope::tracking {
namespace {

using Json = nlohmann::ordered_json;

template <typename Matrix>
Json rows(const Matrix& matrix) {
  Json result = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j));
    result.push_back(row);
  }
  return result;
}

Json list(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

const char* nameOf(DistortionModel model) {
  switch (model) {
    case DistortionModel::rational_polynomial:
      return "rational_polynomial";
    case DistortionModel::equidistant:
      return "equidistant";
    case DistortionModel::plumb_bob:
      break;
  }
  return "plumb_bob";
}

Json describe(const LabTag& tag) {
  Json corners = Json::array();
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    corners.push_back(list(tag.T_world_tag * (Eigen::Vector3d(x, y, 0) * tag.size / 2)));
  return {{"id", tag.id},
          {"size_m", tag.size},
          {"T_world_tag", rows(tag.T_world_tag.matrix())},
          {"corners_world", corners}};
}

}  // namespace

void writeLabTruth(const LabOptions& options, const std::filesystem::path& file) {
  Json truth;
  truth["format"] = "slamscope-lab-truth";
  truth["pixels"] = "OpenCV: integer coordinates are pixel centres";
  truth["image_size"] = {options.camera.width, options.camera.height};
  truth["camera_matrix"] = rows(options.camera.K);
  truth["distortion"] = {{"model", nameOf(options.camera.model)},
                         {"coefficients", options.camera.D}};
  truth["T_camera_world"] = rows(options.T_world_camera.inverse().matrix());
  truth["T_world_map"] = rows(options.T_world_map.matrix());
  truth["features"] = Json::array();
  for (const LabPost& post : options.posts) {
    const Eigen::Vector3d p_map(post.p_map.x(), post.p_map.y(), 0);
    const Eigen::Vector3d p_world = options.T_world_map * p_map;
    truth["features"].push_back(
        {{"id", post.id}, {"map", {p_map.x(), p_map.y()}}, {"world", {p_world.x(), p_world.y()}}});
  }
  truth["robot_tag"] = {{"id", options.robot_tag_id},
                        {"size_m", options.robot_tag_size},
                        {"T_robot_tag", rows(options.T_robot_tag.matrix())}};
  truth["floor_tags"] = Json::array();
  for (const LabTag& tag : options.tags) truth["floor_tags"].push_back(describe(tag));

  std::ofstream out(file);
  out << truth.dump(1) << '\n';
  if (!out.flush()) throw std::runtime_error(file.string() + ": can't write the lab's truth here");
}

}  // namespace slamscope::tracking

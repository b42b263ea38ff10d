// SPDX-License-Identifier: MIT
#include "tracking/camera_info.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tracking/camera_info_yaml.hpp"

namespace slamscope::tracking {
namespace {

const char* name(DistortionModel model) {
  switch (model) {
    case DistortionModel::plumb_bob:
      return "plumb_bob";
    case DistortionModel::rational_polynomial:
      return "rational_polynomial";
    case DistortionModel::equidistant:
      return "equidistant";
  }
  return "";
}

DistortionModel readModel(const YamlField& field) {
  for (const auto model : {DistortionModel::plumb_bob, DistortionModel::rational_polynomial,
                           DistortionModel::equidistant}) {
    if (field.text() == name(model)) return model;
  }
  field.reject("is \"" + field.text() +
               "\"; expected plumb_bob, rational_polynomial or equidistant");
}

Eigen::Matrix3d readMatrix(const YamlField& field) {
  const YamlField data = field.at("data");
  const Eigen::VectorXd values = data.vector(9);
  const Eigen::Matrix3d K =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(values.data());
  const bool camera =
      K(0, 0) > 0 && K(1, 1) > 0 && K(1, 0) == 0 && K(2, 0) == 0 && K(2, 1) == 0 && K(2, 2) == 1;
  if (!camera) data.reject("expected [fx, skew, cx, 0, fy, cy, 0, 0, 1] with positive fx, fy");
  return K;
}

std::vector<double> readCoefficients(const YamlField& field, DistortionModel model) {
  const YamlField data = field.at("data");
  std::vector<double> D = data.numbers();
  const std::size_t n = D.size();
  switch (model) {
    case DistortionModel::plumb_bob:
      if (n != 0 && n != 4 && n != 5) data.reject("expected 4 or 5 numbers for plumb_bob");
      break;
    case DistortionModel::rational_polynomial:
      if (n != 0 && n != 8) data.reject("expected 8 numbers for rational_polynomial");
      break;
    case DistortionModel::equidistant:
      if (n != 0 && n != 4) data.reject("expected 4 numbers for equidistant");
      break;
  }
  return D;
}

int readSize(const YamlField& field) {
  if (field.integer() <= 0) field.reject("expected a positive number of pixels");
  return field.integer();
}

std::string size(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

}  // namespace

CameraInfo cameraInfoOf(const YamlField& field) {
  CameraInfo info;
  info.width = readSize(field.at("image_width"));
  info.height = readSize(field.at("image_height"));
  if (const auto name = field.find("camera_name")) info.name = name->text();
  info.K = readMatrix(field.at("camera_matrix"));
  if (const auto model = field.find("distortion_model")) info.model = readModel(*model);
  if (const auto coefficients = field.find("distortion_coefficients")) {
    info.D = readCoefficients(*coefficients, info.model);
  }
  return info;
}

CameraInfo readCameraInfo(const std::filesystem::path& file) {
  return cameraInfoOf(YamlField::open(file));
}

std::string cameraInfoText(const CameraInfo& info, const std::string& indent) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> K = info.K;
  const int n = static_cast<int>(info.D.size());
  Eigen::Matrix<double, 3, 4, Eigen::RowMajor> P;
  P << info.K, Eigen::Vector3d::Zero();
  const Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  std::string text;
  const auto line = [&](const std::string& key, const std::string& value) {
    text += indent + key + ": " + value + "\n";
  };
  const auto matrix = [&](const std::string& key, int rows, int cols, const double* values) {
    text += indent + key + ":\n";
    text += indent + "  rows: " + std::to_string(rows) + "\n";
    text += indent + "  cols: " + std::to_string(cols) + "\n";
    text += indent + "  data: " + yamlNumbers(values, rows * cols) + "\n";
  };
  line("image_width", std::to_string(info.width));
  line("image_height", std::to_string(info.height));
  line("camera_name", YAML::Dump(YAML::Node(info.name)));
  matrix("camera_matrix", 3, 3, K.data());
  line("distortion_model", name(info.model));
  matrix("distortion_coefficients", 1, n, info.D.data());
  matrix("rectification_matrix", 3, 3, R.data());
  matrix("projection_matrix", 3, 4, P.data());
  return text;
}

void writeCameraInfo(const CameraInfo& info, const std::filesystem::path& file) {
  writeText(file, cameraInfoText(info));
}

void requireSize(const CameraInfo& info, int frame_width, int frame_height) {
  if (info.width == frame_width && info.height == frame_height) return;
  throw std::runtime_error("camera info is for " + size(info.width, info.height) +
                           ", the frames are " + size(frame_width, frame_height));
}

CameraInfo guessedCameraInfo(int width, int height) {
  CameraInfo info;
  info.name = "uncalibrated";
  info.width = width;
  info.height = height;
  const double f = width / 2.0 / std::tan(std::numbers::pi / 6);
  info.K << f, 0, (width - 1) / 2.0, 0, f, (height - 1) / 2.0, 0, 0, 1;
  return info;
}

CameraInfo idealPinhole(const CameraInfo& info) {
  CameraInfo pinhole = info;
  pinhole.model = DistortionModel::plumb_bob;
  pinhole.D.clear();
  pinhole.K(0, 1) = 0;
  return pinhole;
}

CameraInfo idealPinhole(const CameraInfo& info, int width, int height) {
  CameraInfo pinhole = idealPinhole(info);
  const double s = std::max(double(width) / info.width, double(height) / info.height);
  pinhole.width = width;
  pinhole.height = height;
  pinhole.K(0, 0) *= s;
  pinhole.K(1, 1) *= s;
  // The part that does not fit is cut off evenly at both sides.
  pinhole.K(0, 2) = (info.K(0, 2) + 0.5) * s - 0.5 - (info.width * s - width) / 2;
  pinhole.K(1, 2) = (info.K(1, 2) + 0.5) * s - 0.5 - (info.height * s - height) / 2;
  return pinhole;
}

}  // namespace slamscope::tracking

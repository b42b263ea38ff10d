// SPDX-License-Identifier: MIT
#include "tracking/yaml_fields.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace slamscope::tracking {
namespace {

constexpr double kYamlDegree = std::numbers::pi / 180;

Eigen::Matrix3d fromRollPitchYaw(const Eigen::Vector3d& rpy) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return (AngleAxisd(rpy.z(), Vector3d::UnitZ()) * AngleAxisd(rpy.y(), Vector3d::UnitY()) *
          AngleAxisd(rpy.x(), Vector3d::UnitX()))
      .toRotationMatrix();
}

}  // namespace

YamlField::YamlField(std::filesystem::path file, std::string name, const YAML::Node& node)
    : file_(std::move(file)), name_(std::move(name)), node_(node) {}

YamlField YamlField::open(const std::filesystem::path& file) {
  if (!std::ifstream(file) || std::filesystem::is_directory(file)) {
    throw std::runtime_error(file.string() + ": no such file, or it can't be read");
  }
  YAML::Node root;
  try {
    root = YAML::LoadFile(file.string());
  } catch (const YAML::Exception& error) {
    throw std::runtime_error(file.string() + ": line " + std::to_string(error.mark.line + 1) +
                             ": expected YAML: " + error.msg);
  }
  YamlField field(file, "", root);
  if (!root.IsMap()) field.reject("expected a YAML map (field: value)");
  return field;
}

void YamlField::reject(const std::string& expected) const {
  throw std::runtime_error(file_.string() + ": " + (name_.empty() ? "" : name_ + ": ") + expected);
}

std::optional<YamlField> YamlField::find(const std::string& key) const {
  if (!node_.IsMap()) reject("expected a map (field: value)");
  const YAML::Node child = node_[key];
  if (!child.IsDefined() || child.IsNull()) return std::nullopt;
  return YamlField(file_, name_.empty() ? key : name_ + "." + key, child);
}

YamlField YamlField::at(const std::string& key) const {
  if (auto field = find(key)) return *field;
  reject("expected the field " + key);
}

std::vector<YamlField> YamlField::list() const {
  if (!node_.IsSequence()) reject("expected a list");
  std::vector<YamlField> fields;
  for (std::size_t i = 0; i < node_.size(); ++i) {
    fields.push_back(YamlField(file_, name_ + "[" + std::to_string(i) + "]", node_[i]));
  }
  return fields;
}

void YamlField::allowOnly(std::initializer_list<const char*> keys) const {
  if (!node_.IsMap()) reject("expected a map (field: value)");
  for (const auto& entry : node_) {
    const auto key = entry.first.as<std::string>();
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    std::string expected = key + " is unknown; expected one of";
    for (const char* known : keys) expected += std::string(" ") + known;
    reject(expected);
  }
}

double YamlField::number() const {
  double value = std::numeric_limits<double>::quiet_NaN();
  const bool read = node_.IsScalar() && YAML::convert<double>::decode(node_, value);
  if (!read || !std::isfinite(value)) reject("expected a number");
  return value;
}

double YamlField::positive() const {
  if (!node_.IsScalar() || !(number() > 0)) reject("expected a positive number");
  return number();
}

double YamlField::notNegative() const {
  if (!node_.IsScalar() || !(number() >= 0)) reject("expected a number not below 0");
  return number();
}

int YamlField::integer() const {
  int value = 0;
  if (!node_.IsScalar() || !YAML::convert<int>::decode(node_, value)) {
    reject("expected a whole number");
  }
  return value;
}

std::string YamlField::text() const {
  if (!node_.IsScalar()) reject("expected text");
  return node_.as<std::string>();
}

std::vector<double> YamlField::numbers() const {
  std::vector<double> values;
  for (const YamlField& field : list()) values.push_back(field.number());
  return values;
}

Eigen::VectorXd YamlField::vector(int size) const {
  const std::string expected = "expected " + std::to_string(size) + " numbers";
  if (!node_.IsSequence() || node_.size() != static_cast<std::size_t>(size)) reject(expected);
  const std::vector<double> values = numbers();
  return Eigen::Map<const Eigen::VectorXd>(values.data(), size);
}

Eigen::Isometry3d YamlField::matrix() const {
  std::vector<double> values;
  const std::string expected = "expected 4 rows of 4 numbers (or 16 numbers) of a rigid motion";
  for (const YamlField& row : list()) {
    if (row.node_.IsSequence()) {
      const Eigen::VectorXd numbers = row.vector(4);
      values.insert(values.end(), numbers.begin(), numbers.end());
    } else {
      values.push_back(row.number());
    }
  }
  if (values.size() != 16) reject(expected);
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> M(values.data());
  const Eigen::Matrix3d R = M.topLeftCorner<3, 3>();
  const bool rigid = (R * R.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-3 &&
                     R.determinant() > 0 &&
                     (M.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).norm() < 1e-9;
  if (!rigid) reject(expected);
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::Quaterniond(R).normalized().toRotationMatrix();
  // Rotations written to the last digit come back as they were.
  if ((T.linear() - R).norm() < 1e-14) T.linear() = R;
  T.translation() = M.topRightCorner<3, 1>();
  return T;
}

Eigen::Isometry3d YamlField::pose() const {
  if (node_.IsSequence()) return matrix();
  allowOnly({"position_m", "rpy_deg", "rpy_rad", "quaternion_xyzw", "matrix"});
  if (const auto field = find("matrix")) return field->matrix();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = at("position_m").vector(3);
  if (const auto rpy = find("rpy_deg")) T.linear() = fromRollPitchYaw(rpy->vector(3) * kYamlDegree);
  if (const auto rpy = find("rpy_rad")) T.linear() = fromRollPitchYaw(rpy->vector(3));
  if (const auto field = find("quaternion_xyzw")) {
    const Eigen::Quaterniond q(Eigen::Vector4d(field->vector(4)));
    if (std::abs(q.norm() - 1) > 1e-3) field->reject("expected a quaternion of length 1");
    T.linear() = q.normalized().toRotationMatrix();
  }
  return T;
}

std::string yamlNumber(double value) {
  std::array<char, 32> digits;  // shortest text that reads back as the same double
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return {digits.data(), end};
}

std::string yamlNumbers(const double* values, int count) {
  std::string text = "[";
  for (int i = 0; i < count; ++i) text += (i == 0 ? "" : ", ") + yamlNumber(values[i]);
  return text + "]";
}

std::string yamlPose(const Eigen::Isometry3d& T) {
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> M = T.matrix();
  std::string text;
  for (int row = 0; row < 4; ++row) {
    text += (row == 0 ? "[" : ", ") + yamlNumbers(M.data() + 4 * row, 4);
  }
  return text + "]";
}

void writeText(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(file.string() + ": can't be written");
}

}  // namespace slamscope::tracking

// SPDX-License-Identifier: MIT
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace slamscope::tracking {

/// A field of a YAML file that knows its file and name, so that each complaint states file, field
/// and what was expected: "robot.yaml: size_m: expected a positive number". Every function throws
/// std::runtime_error of that form. (For .cpp files of tracking only: yaml-cpp stays inside.)
class YamlField {
 public:
  /// The whole file, which must be a map.
  static YamlField open(const std::filesystem::path& file);

  [[nodiscard]] YamlField at(const std::string& key) const;  ///< must be there
  [[nodiscard]] std::optional<YamlField> find(const std::string& key) const;
  [[nodiscard]] std::vector<YamlField> list() const;  ///< elements, named by position
  void allowOnly(std::initializer_list<const char*> keys) const;

  [[nodiscard]] double number() const;  ///< finite
  [[nodiscard]] double positive() const;
  [[nodiscard]] double notNegative() const;
  [[nodiscard]] int integer() const;
  [[nodiscard]] std::string text() const;
  [[nodiscard]] std::vector<double> numbers() const;
  [[nodiscard]] Eigen::VectorXd vector(int size) const;
  /// {position_m, rpy_deg | rpy_rad | quaternion_xyzw} or {matrix} or 4 rows of 4 or 16 numbers.
  [[nodiscard]] Eigen::Isometry3d pose() const;

  [[noreturn]] void reject(const std::string& expected) const;
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] bool isText() const { return node_.IsScalar(); }  ///< rather than a map or list

 private:
  YamlField(std::filesystem::path file, std::string name, const YAML::Node& node);
  [[nodiscard]] Eigen::Isometry3d matrix() const;

  std::filesystem::path file_;
  std::string name_;
  YAML::Node node_;
};

/// Every digit; whole numbers and the like stay short.
[[nodiscard]] std::string yamlNumber(double value);
/// "[a, b, …]" of such numbers.
[[nodiscard]] std::string yamlNumbers(const double* values, int count);
/// 4 rows of 4.
[[nodiscard]] std::string yamlPose(const Eigen::Isometry3d& T);
/// Writes text to a file; throws std::runtime_error naming it where it can't.
void writeText(const std::filesystem::path& file, const std::string& text);

}  // namespace slamscope::tracking

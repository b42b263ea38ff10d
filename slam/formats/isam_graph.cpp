// SPDX-License-Identifier: MIT
#include "slam/formats/isam_graph.hpp"

#include <filesystem>

#include "slam/csv_table.hpp"

namespace slamscope::slam {
namespace {

using namespace std::chrono_literals;

constexpr auto kPosePeriod = 100ms;

/// Covariance from the upper triangle of R, information Rᵀ R, that begins at cell `first`.
template <int Size>
Eigen::Matrix<double, Size, Size> covarianceFrom(const TextTable& table, std::size_t first) {
  Eigen::Matrix<double, Size, Size> root = Eigen::Matrix<double, Size, Size>::Zero();
  for (int row = 0; row < Size; ++row) {
    for (int col = row; col < Size; ++col) root(row, col) = table.number(first++, "sqrtinf");
    if (root(row, row) == 0.0) table.fail("sqrtinf", "a diagonal without zeros", "0");
  }
  const Eigen::Matrix<double, Size, Size> inverse =
      root.template triangularView<Eigen::Upper>().solve(
          Eigen::Matrix<double, Size, Size>::Identity());
  return inverse * inverse.transpose();
}

class IsamReader {
 public:
  explicit IsamReader(const std::string& path) : table_(path, TextTable::Separator::blank) {
    recording_.name = std::filesystem::path(path).stem().string();
    recording_.odometry_kind = Recording::Odometry::increment;
    recording_.sensor = Sensor::relative_position;
    recording_.odometry.push_back({});
  }

  Recording read() {
    while (table_.next()) {
      if (table_.text(0) == "ODOMETRY") {
        readOdometry();
      } else if (table_.text(0) == "LANDMARK") {
        readLandmark();
      } else {
        table_.fail("line", "ODOMETRY or LANDMARK", table_.text(0));
      }
    }
    requireInput(recording_, table_.path());
    return std::move(recording_);
  }

 private:
  /// Poses and landmarks share their numbers, so that those of poses have holes.
  void readOdometry() {
    table_.expectCells(12, "ODOMETRY, two poses, three of motion, six of sqrtinf");
    expectNewestPose();
    const FeatureId to = table_.id(2, "pose");
    if (to <= newest_) table_.fail("pose", "above " + std::to_string(newest_), table_.text(2));
    recording_.odometry.push_back(
        {timeOf(to),
         {table_.number(3, "dx"), table_.number(4, "dy"), table_.number(5, "dtheta")},
         covarianceFrom<3>(table_, 6)});
    newest_ = to;
  }

  void readLandmark() {
    table_.expectCells(8, "LANDMARK, pose, landmark, two of position, three of sqrtinf");
    expectNewestPose();
    const Sighting seen{table_.id(2, "landmark"),
                        {table_.number(3, "dx"), table_.number(4, "dy")},
                        covarianceFrom<2>(table_, 5)};
    addSighting(recording_, timeOf(newest_), seen);
  }

  void expectNewestPose() {
    if (table_.id(1, "pose") == newest_) return;
    table_.fail("pose", std::to_string(newest_) + ", the newest one", table_.text(1));
  }

  static std::chrono::nanoseconds timeOf(FeatureId pose) {
    return static_cast<std::int64_t>(pose) * kPosePeriod;
  }

  TextTable table_;
  Recording recording_;
  FeatureId newest_ = 0;
};

}  // namespace

Recording readIsamGraph(const std::string& path) {
  return IsamReader(path).read();
}

}  // namespace slamscope::slam

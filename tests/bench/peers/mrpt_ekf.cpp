// SPDX-License-Identifier: MIT
#include "tests/bench/peers/mrpt_ekf.hpp"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/slam/CRangeBearingKFSLAM2D.h>

#include <cmath>
#include <numbers>

namespace slamscope::slam::bench {

struct MrptEkf::Filter {
  explicit Filter(Settings settings) : fast(settings == Settings::fastest) {
    slam.options.std_sensor_range = std::sqrt(0.0036F);
    slam.options.std_sensor_yaw = std::sqrt(0.0016F);
    slam.setMinLoggingLevel(mrpt::system::LVL_ERROR);
    if (!fast) return;
    slam.KF_options.method = mrpt::bayes::kfEKFAlaDavison;
    slam.options.create_simplemap = false;
  }

  void process(const Motion& motion, const std::vector<Observation>& readings) {
    mrpt::obs::CActionRobotMovement2D moved;
    mrpt::math::CMatrixDouble33 covariance;
    for (int row = 0; row < 3; ++row) {
      for (int col = 0; col < 3; ++col) covariance(row, col) = motion.M(row, col);
    }
    moved.poseChange = mrpt::poses::CPosePDFGaussian::Create(
        mrpt::poses::CPose2D(motion.increment[0], motion.increment[1], motion.increment[2]),
        covariance);
    auto actions = mrpt::obs::CActionCollection::Create();
    actions->insert(moved);
    auto seen = mrpt::obs::CObservationBearingRange::Create();
    seen->maxSensorDistance = fast ? 0.0F : 20.0F;
    seen->fieldOfView_yaw = fast ? 0.0F : 2.0F * std::numbers::pi_v<float>;
    for (const Observation& o : readings) {
      mrpt::obs::CObservationBearingRange::TMeasurement reading;
      reading.range = static_cast<float>(o.z[0]);
      reading.yaw = static_cast<float>(o.z[1]);
      reading.pitch = 0.0F;
      reading.landmarkID = static_cast<std::int32_t>(o.id);
      seen->sensedData.push_back(reading);
    }
    auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(seen);
    slam.processActionObservation(actions, frame);
  }

  bool fast;
  mrpt::slam::CRangeBearingKFSLAM2D slam;
};

MrptEkf::MrptEkf(Settings settings, const std::vector<Observation>& first)
    : filter_(std::make_unique<Filter>(settings)) {
  filter_->process(Motion{}, first);
}
MrptEkf::~MrptEkf() = default;
MrptEkf::MrptEkf(MrptEkf&&) noexcept = default;

void MrptEkf::step(const Motion& motion, const std::vector<Observation>& readings) {
  filter_->process(motion, readings);
}

Eigen::Vector3d MrptEkf::pose() const {
  mrpt::poses::CPosePDFGaussian pose;
  filter_->slam.getCurrentRobotPose(pose);
  return {pose.mean.x(), pose.mean.y(), pose.mean.phi()};
}

int MrptEkf::featureCount() const {
  return static_cast<int>(filter_->slam.getNumberOfLandmarksInTheMap());
}

}  // namespace slamscope::slam::bench

// SPDX-License-Identifier: MIT
// Bugs in the update of the covariance, equation (10).
#include <algorithm>
#include <array>
#include <map>

#include "slam/fault_entry.hpp"
#include "slam/faults_single_precision.hpp"

namespace slamscope::slam {
namespace {

/// The paper's fault (section 4): for certain features the block P_ii is written wrongly in every
/// update. Instead of losing W S Wᵀ (10) it gains a two-hundredth of the covariance that the
/// feature was born with. All else is updated rightly, so only pairs with these features go bad,
/// and P stays positive; the growth is linear in the number of updates, so it stays finite.
class PaperFault final : public EkfEquations {
 public:
  PaperFault(Sensor sensor, std::vector<FeatureId> features)
      : EkfEquations(sensor), features_(std::move(features)) {}

  void initialiseCovariance(EkfState& state, const Matrix23d& G_v, const Eigen::Matrix2d& G_z,
                            const Eigen::Matrix2d& R) override {
    EkfEquations::initialiseCovariance(state, G_v, G_z, R);
    const FeatureId id = state.ids.back();
    if (std::find(features_.begin(), features_.end(), id) == features_.end()) return;
    born_with_[id] = state.P.bottomRightCorner<2, 2>();
  }

  void updateCovariance(EkfState& state, const Correction& correction) override {
    std::map<int, Eigen::Matrix2d> wrong;
    for (const auto& [id, P_born] : born_with_) {
      if (const auto row = state.rowOf(id)) {
        wrong[*row] = state.P.block<2, 2>(*row, *row) + kGrowth * P_born;
      }
    }
    EkfEquations::updateCovariance(state, correction);
    for (const auto& [row, P_ii] : wrong) {
      state.P.block<2, 2>(row, row).triangularView<Eigen::Lower>() = P_ii;
    }
  }

 private:
  static constexpr double kGrowth = 0.005;

  std::vector<FeatureId> features_;
  std::map<FeatureId, Eigen::Matrix2d> born_with_;
};

/// P_vm is left out of the update.
class CrossNotUpdated final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  void updateCovariance(EkfState& state, const Correction& correction) override {
    const Eigen::MatrixXd P_mv = state.P.bottomLeftCorner(state.size() - 3, 3);
    EkfEquations::updateCovariance(state, correction);
    state.P.bottomLeftCorner(state.size() - 3, 3) = P_mv;
  }
};

/// Only the blocks on the diagonal are updated: that of the robot and that of each feature.
class DiagonalOnly final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  void updateCovariance(EkfState& state, const Correction& correction) override {
    Eigen::MatrixXd before = state.P;
    EkfEquations::updateCovariance(state, correction);
    before.topLeftCorner<3, 3>() = state.P.topLeftCorner<3, 3>();
    for (int row = 3; row < state.size(); row += 2) {
      before.block<2, 2>(row, row) = state.P.block<2, 2>(row, row);
    }
    state.P = std::move(before);
  }
};

/// One observation, the first, is applied a second time before the record is written.
class ObservedTwice final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  Correction update(EkfState& state, std::span<const Observation> observations) override {
    Correction correction = EkfEquations::update(state, observations);
    if (correction.applied) EkfEquations::update(state, observations.first(1));
    return correction;
  }
};

std::unique_ptr<EkfEquations> plantPaperFault(const FaultOptions& options) {
  const std::vector<FeatureId> by_default{2, 8, 14};
  return std::make_unique<PaperFault>(options.sensor,
                                      options.features.empty() ? by_default : options.features);
}

constexpr std::array kCovarianceFaults = {
    FaultEntry{{"paper", "the covariance of certain features grows with every update",
                FaultKind::code, 1, FaultBlame::chosen_features},
               plantPaperFault},
    FaultEntry{{"cross-not-updated", "covariance of robot and map left out of the update",
                FaultKind::code, 1},
               plant<CrossNotUpdated>},
    FaultEntry{
        {"diagonal-only", "only diagonal blocks of the covariance are updated", FaultKind::code, 1},
        plant<DiagonalOnly>},
    FaultEntry{{"single-precision", "P computed as (I - K H) P in float and never symmetrised",
                FaultKind::code, 1},
               plant<SinglePrecision>},
    FaultEntry{{"observed-twice", "one observation is applied twice", FaultKind::code, 2},
               plant<ObservedTwice>},
};

}  // namespace

std::span<const FaultEntry> covarianceFaults() {
  return kCovarianceFaults;
}

}  // namespace slamscope::slam

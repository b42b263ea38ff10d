// SPDX-License-Identifier: MIT
#include "slam/faults.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <string>

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

constexpr std::array kFaults = {
    FaultDescription{"none", "a correct filter"},
    FaultDescription{"paper", "the covariance of certain features grows with every update"},
};

}  // namespace

std::span<const FaultDescription> faultNames() {
  return kFaults;
}

std::unique_ptr<EkfEquations> makeFault(std::string_view name, const FaultOptions& options) {
  if (name == "none") return std::make_unique<EkfEquations>(options.sensor);
  if (name == "paper") {
    const std::vector<FeatureId> by_default{2, 8, 14};
    return std::make_unique<PaperFault>(options.sensor,
                                        options.features.empty() ? by_default : options.features);
  }
  std::string known;
  for (const FaultDescription& fault : kFaults) {
    known += (known.empty() ? "" : ", ") + std::string(fault.name);
  }
  throw std::invalid_argument("no fault of the name '" + std::string(name) + "'; known: " + known);
}

}  // namespace slamscope::slam

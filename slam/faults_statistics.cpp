// SPDX-License-Identifier: MIT
// Bugs that leave every exact law whole: innovation, association, and noise that is not the
// sensor's.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "slam/fault_entry.hpp"
#include "slam/simulation_random.hpp"

namespace slamscope::slam {
namespace {

/// The expected bearing is atan2(…) − θ and the innovation is not wrapped: off by a whole turn
/// wherever one of the two angles passes ±π.
class InnovationUnwrapped final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  Eigen::Vector2d innovation(const EkfState& state, int row, const Eigen::Vector2d& z) override {
    const Eigen::Vector2d d = state.x.segment<2>(row) - state.x.head<2>();
    return z - Eigen::Vector2d(d.norm(), std::atan2(d.y(), d.x()) - state.x[2]);
  }
};

/// ẑ − z for z − ẑ.
class InnovationSign final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  Eigen::Vector2d innovation(const EkfState& state, int row, const Eigen::Vector2d& z) override {
    return -EkfEquations::innovation(state, row, z);
  }
};

/// One reading in ten of known features is taken for that feature's nearest neighbour in the map.
/// Where the neighbour is read at the same time the two are mixed up, so that no feature is read
/// twice: what a one-to-one association gets wrong.
class WrongAssociation final : public EkfEquations {
 public:
  WrongAssociation(Sensor sensor, std::uint64_t seed) : EkfEquations(sensor), random_(seed) {}

  std::span<const Observation> perceive(const EkfState& state,
                                        std::span<const Observation> readings) override {
    std::vector<Observation>& perceived = perceived_;
    perceived.assign(readings.begin(), readings.end());
    for (Observation& reading : perceived) {
      const auto row = state.rowOf(reading.id);
      if (!row) continue;
      const FeatureId neighbour = nearestOther(state, *row);
      const auto other = std::find_if(perceived.begin(), perceived.end(),
                                      [&](const Observation& o) { return o.id == neighbour; });
      const bool both = other != perceived.end();
      if (random_.uniform() >= (both ? kShare / 2.0 : kShare)) continue;  // a swap spoils two
      if (both) other->id = reading.id;
      reading.id = neighbour;
    }
    return perceived;
  }

 private:
  static constexpr double kShare = 0.1;

  /// The feature itself where it is the only one.
  static FeatureId nearestOther(const EkfState& state, int row) {
    int nearest = row;
    double distance = std::numeric_limits<double>::infinity();
    for (int other = 3; other < state.size(); other += 2) {
      const double d = (state.x.segment<2>(other) - state.x.segment<2>(row)).norm();
      if (other == row || !(d < distance)) continue;
      nearest = other;
      distance = d;
    }
    return state.ids[static_cast<std::size_t>((nearest - 3) / 2)];
  }

  RandomSource random_;
  std::vector<Observation> perceived_;
};

/// σ given where σ² is meant.
class NoiseSigma final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  Eigen::Matrix2d observationNoise(const Eigen::Matrix2d& R) override {
    return R.diagonal().cwiseSqrt().asDiagonal();
  }
};

/// The bearing's variance given in degrees².
class NoiseDegrees final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  Eigen::Matrix2d observationNoise(const Eigen::Matrix2d& R) override {
    const Eigen::DiagonalMatrix<double, 2> unit(1.0, 180.0 / std::numbers::pi);
    return unit * R * unit;
  }
};

/// R nine times too large: σ taken three times.
class NoiseNinefold final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  Eigen::Matrix2d observationNoise(const Eigen::Matrix2d& R) override { return 9.0 * R; }
};

std::unique_ptr<EkfEquations> plantWrongAssociation(const FaultOptions& options) {
  return std::make_unique<WrongAssociation>(options.sensor, options.seed);
}

constexpr std::array kStatisticsFaults = {
    FaultEntry{{"innovation-unwrapped", "innovation of the bearing is not wrapped",
                FaultKind::statistics, 1},
               plantInBearing<InnovationUnwrapped>},
    FaultEntry{{"innovation-sign", "innovation has the wrong sign", FaultKind::statistics, 1},
               plant<InnovationSign>},
    FaultEntry{{"wrong-association", "one reading in ten is taken for the feature's neighbour",
                FaultKind::statistics, 1},
               plantWrongAssociation},
    FaultEntry{{"noise-sigma", "sensor noise: sigma given for sigma squared", FaultKind::statistics,
                1, FaultBlame::nobody, true},
               plant<NoiseSigma>},
    FaultEntry{{"noise-degrees", "sensor noise: variance of the bearing in degrees squared",
                FaultKind::statistics, 1, FaultBlame::nobody, true},
               plantInBearing<NoiseDegrees>},
    FaultEntry{{"noise-9x", "sensor noise: R nine times too large", FaultKind::statistics, 1,
                FaultBlame::nobody, true},
               plant<NoiseNinefold>},
};

}  // namespace

std::span<const FaultEntry> statisticsFaults() {
  return kStatisticsFaults;
}

}  // namespace slamscope::slam

// SPDX-License-Identifier: MIT
#include "slam/monte_carlo.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>

#include "slam/angle.hpp"
#include "slam/audit/chi_square.hpp"
#include "slam/parallel.hpp"

namespace slamscope::slam {
namespace {

/// Squared normalised errors and their degrees of freedom.
struct Sum {
  double squared = 0.0;
  double dof = 0.0;

  Sum& operator+=(const Sum& other) {
    squared += other.squared;
    dof += other.dof;
    return *this;
  }
};

struct StepSums {
  double time_s = 0.0;
  Sum pose, features, nis;
};

struct Run {
  std::vector<StepSums> steps;
  bool broken = false;
};

/// errorᵀ C⁻¹ error, C scaled to a unit diagonal. Directions in which C is all but zero (just after
/// a start that is exactly known: a robot that drives straight ahead can't yet be off sideways) are
/// left out with their degrees of freedom. Absent where C is not positive semidefinite or not
/// finite.
std::optional<Sum> normalised(const Eigen::VectorXd& error, const Eigen::MatrixXd& C) {
  constexpr double kSingular = 1e-6;
  if (!error.allFinite() || !C.allFinite() || C.diagonal().minCoeff() < 0.0) return std::nullopt;
  const Eigen::VectorXd unit =
      C.diagonal().unaryExpr([](double c) { return c > 0.0 ? 1.0 / std::sqrt(c) : 0.0; });
  const Eigen::VectorXd e = unit.cwiseProduct(error);
  const Eigen::MatrixXd scaled = unit.asDiagonal() * C * unit.asDiagonal();
  const Eigen::LLT<Eigen::MatrixXd> factor(scaled);
  if (factor.info() == Eigen::Success &&
      factor.matrixLLT().diagonal().array().square().minCoeff() > kSingular) {
    return Sum{factor.matrixL().solve(e).squaredNorm(), static_cast<double>(e.size())};
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
  if (eigen.eigenvalues()[0] < -kSingular) return std::nullopt;
  Sum sum;
  for (Eigen::Index k = 0; k < e.size(); ++k) {
    const double variance = eigen.eigenvalues()[k];
    if (variance <= kSingular) continue;
    const double along = eigen.eigenvectors().col(k).dot(e);
    sum += {along * along / variance, 1.0};
  }
  return sum;
}

/// Listens to one simulation.
class RunListener {
 public:
  explicit RunListener(Run& run) : run_(run) {}

  void hear(const Snapshot& snapshot) {
    if (snapshot.event == Event::update) nis_ += nisOf(snapshot);
    if (snapshot.event == Event::step) closeStep(snapshot);
    P_ = snapshot.covariance.dense();
  }

 private:
  /// S of all observations at once from the filter's own H and R: in the record stand only the
  /// blocks of S that belong to one observation.
  Sum nisOf(const Snapshot& snapshot) {
    const auto rows = static_cast<Eigen::Index>(2 * snapshot.observations.size());
    Eigen::MatrixXd H(rows, P_.rows());
    Eigen::VectorXd innovation(rows);
    Eigen::MatrixXd R = Eigen::MatrixXd::Zero(rows, rows);
    Eigen::Index row = 0;
    for (const ObservationRecord& o : snapshot.observations) {
      H.middleRows<2>(row) = o.H;
      innovation.segment<2>(row) = o.innovation;
      R.block<2, 2>(row, row) = o.R;
      row += 2;
    }
    return noted(normalised(innovation, H * P_ * H.transpose() + R));
  }

  void closeStep(const Snapshot& snapshot) {
    StepSums sums;
    sums.time_s = std::chrono::duration<double>(snapshot.time).count();
    sums.nis = nis_;
    nis_ = {};
    const Eigen::MatrixXd P = snapshot.covariance.dense();
    const Truth& truth = snapshot.truth.value();
    Eigen::Vector3d pose_error = snapshot.pose - truth.pose;
    pose_error[2] = wrapAngle(pose_error[2]);
    sums.pose = noted(normalised(pose_error, P.topLeftCorner<3, 3>()));
    const auto size = 2 * static_cast<Eigen::Index>(snapshot.ids.size());
    if (size > 0) {
      sums.features = noted(normalised(featureError(snapshot), P.bottomRightCorner(size, size)));
    }
    run_.steps.push_back(sums);
  }

  static Eigen::VectorXd featureError(const Snapshot& snapshot) {
    Eigen::VectorXd error(2 * static_cast<Eigen::Index>(snapshot.ids.size()));
    const Truth& truth = *snapshot.truth;
    for (std::size_t k = 0; k < snapshot.ids.size(); ++k) {
      const auto found = std::find(truth.ids.begin(), truth.ids.end(), snapshot.ids[k]);
      const auto index = static_cast<std::size_t>(found - truth.ids.begin());
      error.segment<2>(2 * static_cast<Eigen::Index>(k)) =
          snapshot.features[k] - truth.features[index];
    }
    return error;
  }

  Sum noted(const std::optional<Sum>& sum) {
    if (!sum) run_.broken = true;
    return sum.value_or(Sum{});
  }

  Run& run_;
  Eigen::MatrixXd P_;  ///< before the event
  Sum nis_;
};

/// `band_dof`: what the band is taken of, where that is not the sum's own.
Consistency consistency(const Sum& sum, double band_dof, double confidence) {
  if (!(sum.dof > 0.0)) return {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0, 0.0};
  const double tail = (1.0 - confidence) / 2.0;
  return {sum.squared / sum.dof, chiSquareQuantile(1.0 - tail, band_dof) / band_dof,
          chiSquareQuantile(tail, band_dof) / band_dof, sum.dof};
}

Consistency consistency(const Sum& sum, double confidence) {
  return consistency(sum, sum.dof, confidence);
}

struct Inside {
  int inside = 0;
  int all = 0;

  void count(const Consistency& c) {
    if (c.dof == 0.0) return;
    ++all;
    inside += c.inside() ? 1 : 0;
  }
  [[nodiscard]] double share() const { return all == 0 ? 1.0 : double(inside) / all; }
};

MonteCarloResult summarise(const std::vector<Run>& runs, const MonteCarloOptions& options) {
  MonteCarloResult result;
  result.runs = options.runs;
  result.confidence = options.confidence;
  Sum pose, features, nis;
  Inside pose_inside, features_inside, nis_inside;
  for (std::size_t k = 0; k < runs.front().steps.size(); ++k) {
    StepSums all;
    for (const Run& run : runs) {
      all.pose += run.steps[k].pose;
      all.features += run.steps[k].features;
      all.nis += run.steps[k].nis;
    }
    const MonteCarloStep step{
        runs.front().steps[k].time_s, consistency(all.pose, options.confidence),
        consistency(all.features, options.confidence), consistency(all.nis, options.confidence)};
    pose_inside.count(step.pose);
    features_inside.count(step.features);
    nis_inside.count(step.nis);
    pose += all.pose;
    features += all.features;
    nis += all.nis;
    result.steps.push_back(step);
  }
  const double map_dof = 2.0 * options.simulation.features * options.runs;
  result.pose = consistency(pose, 3.0 * options.runs, options.confidence);
  result.features = consistency(features, map_dof, options.confidence);
  result.nis = consistency(nis, options.confidence);
  result.pose_inside = pose_inside.share();
  result.features_inside = features_inside.share();
  result.nis_inside = nis_inside.share();
  return result;
}

}  // namespace

MonteCarloResult runMonteCarlo(const MonteCarloOptions& options) {
  return runMonteCarlo(options, [&](std::uint64_t seed, const Subject::Callback& listener) {
    SimulationOptions mine = options.simulation;
    mine.seed = seed;
    mine.record_jacobians = true;
    Simulation simulation(mine);
    const Subscription subscription = simulation.filter().observe(listener);
    while (simulation.step()) {
    }
  });
}

MonteCarloResult runMonteCarlo(const MonteCarloOptions& options, const MonteCarloRun& run) {
  if (options.runs < 1 || !(options.confidence > 0.0 && options.confidence < 1.0)) {
    throw std::invalid_argument("Monte Carlo needs runs ≥ 1 and a confidence in (0, 1), got " +
                                std::to_string(options.runs) + " and " +
                                std::to_string(options.confidence));
  }
  std::vector<Run> runs(static_cast<std::size_t>(options.runs));
  std::mutex mutex;
  int done = 0;
  parallelFor(options.runs, options.threads, [&](int k) {
    RunListener listener(runs[static_cast<std::size_t>(k)]);
    run(options.simulation.seed + static_cast<std::uint64_t>(k),
        [&](const SnapshotPtr& snapshot) { listener.hear(*snapshot); });
    const std::lock_guard lock(mutex);
    ++done;
    if (options.progress) options.progress(done);
  });
  MonteCarloResult result = summarise(runs, options);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (runs[k].broken) result.broken_seeds.push_back(options.simulation.seed + k);
  }
  return result;
}

}  // namespace slamscope::slam

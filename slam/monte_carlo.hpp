// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "slam/simulation.hpp"

namespace slamscope::slam {

struct MonteCarloOptions {
  SimulationOptions simulation;  ///< run k has the seed simulation.seed + k
  int runs = 50;
  unsigned threads = 0;      ///< 0: one per core; the result is the same for any number
  double confidence = 0.95;  ///< of the two-sided bands, in (0, 1)
  /// Called after each run with the number of those done; one call at a time, on any thread.
  std::function<void(int done)> progress;
};

/// A sum of squared, normalised errors divided by its degrees of freedom: 1 on average where the
/// filter is consistent, more where it is overconfident. `low` and `high`: its two-sided band by
/// χ². No degrees of freedom (nothing observed, pose exactly known): mean NaN, inside.
struct Consistency {
  double mean = 0.0;
  double low = 0.0;
  double high = 0.0;
  double dof = 0.0;

  [[nodiscard]] bool inside() const { return dof == 0.0 || (mean >= low && mean <= high); }
};

/// One time step over all runs.
struct MonteCarloStep {
  double time_s = 0.0;
  Consistency pose;      ///< ANEES of x, y, θ
  Consistency features;  ///< ANEES of all features of the map at once, by the whole of P_mm
  Consistency nis;       ///< innovations of the time step
};

struct MonteCarloResult {
  int runs = 0;
  double confidence = 0.95;
  std::vector<MonteCarloStep> steps;
  /// Averages over all time. The innovations of a consistent filter are white, so `nis` has the
  /// band of all its degrees of freedom. Errors of one run are not independent in time: the bands
  /// of `pose` and `features` count each run once, as if it had one error for ever; wider than
  /// need be, never too narrow.
  Consistency pose, features, nis;
  /// Shares of time steps inside their bands, 0 … 1; of a consistent filter about `confidence`.
  double pose_inside = 0.0, features_inside = 0.0, nis_inside = 0.0;
  /// Seeds of runs with a number that is not finite or a covariance that is not positive;
  /// what could not be normalised is left out above.
  std::vector<std::uint64_t> broken_seeds;
};

/// N simulations of different seeds, and whether the filter's covariance is honest: average
/// normalised estimation error squared and normalised innovation squared (Bar-Shalom, Li and
/// Kirubarajan, "Estimation with Applications to Tracking and Navigation", section 5.4). Throws
/// std::invalid_argument for options out of range.
[[nodiscard]] MonteCarloResult runMonteCarlo(const MonteCarloOptions& options);

/// One run of something else than Simulation: has `listener` hear all events of its filter, with
/// Jacobians recorded and the truth of pose and features in every snapshot. All seeds have the same
/// number of time steps.
using MonteCarloRun = std::function<void(std::uint64_t seed, const Subject::Callback& listener)>;

/// The same of such runs; of `options.simulation` only the seed and the number of features count.
[[nodiscard]] MonteCarloResult runMonteCarlo(const MonteCarloOptions& options,
                                             const MonteCarloRun& run);

}  // namespace slamscope::slam

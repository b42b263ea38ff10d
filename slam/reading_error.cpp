// SPDX-License-Identifier: MIT
#include "slam/reading_error.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace slamscope::slam {
namespace {

/// Correlation of two errors `since` s apart.
double correlationAfter(double since, double memory) {
  return memory > 0.0 ? std::exp(-std::abs(since) / memory) : 0.0;
}

/// Readings at one time are no better than one: a correlation of 1 would divide by 0.
constexpr double kLeastNews = 0.001;
/// Least share of the variance by which a range differs from the one just before.
constexpr double kLeastInnovation = 0.02;

}  // namespace

double logNormal(const Eigen::Vector2d& innovation, const Eigen::Matrix2d& S) {
  const double determinant = S.determinant();
  if (!(determinant > 0.0 && S(0, 0) > 0.0)) return -std::numeric_limits<double>::infinity();
  const double squared = innovation.dot(S.inverse() * innovation);
  return -0.5 * (squared + std::log(determinant)) - std::log(2.0 * std::numbers::pi);
}

ReadingErrorOptions ReadingErrorOptions::withMemory(double seconds) const {
  ReadingErrorOptions changed = *this;
  changed.slow_memory = memory > 0.0 ? slow_memory / memory * seconds : seconds;
  changed.memory = seconds;
  return changed;
}

ReadingError::ReadingError(const ReadingErrorOptions& options) : options_(options) {
  const auto& o = options;
  if (!(o.range_sigma > 0.0 && o.range_share >= 0.0 && o.bearing_sigma > 0.0 && o.memory >= 0.0 &&
        o.slow_memory >= 0.0 && o.jump_share >= 0.0 && o.jump_share <= 1.0)) {
    throw std::invalid_argument(
        "errors of readings: a sigma must be above 0, a memory not negative, a share from 0 to 1");
  }
}

Eigen::Matrix2d ReadingError::covariance(double range) const {
  const double range_sigma = options_.range_sigma + options_.range_share * std::abs(range);
  return Eigen::Vector2d(range_sigma, options_.bearing_sigma).cwiseAbs2().asDiagonal();
}

/// The mean of many errors with correlation g from one to the next has (1 + g) / (1 − g) times the
/// variance that the mean of as many independent ones would have.
Eigen::Matrix2d ReadingError::correctionCovariance(const Eigen::Matrix2d& R, double since) const {
  const double g = correlationAfter(since, options_.slow_memory);
  const double wider = 1.0 / std::max(kLeastNews, (1.0 - g) / (1.0 + g));
  const Eigen::Vector2d scale(std::sqrt(wider), 1.0);
  return scale.asDiagonal() * R * scale.asDiagonal();
}

/// With error e(k) = g e(k − 1) + w, and e(k − 1) known but for what the map is unsure of, the
/// innovation has mean g e(k − 1) and the map's part of its covariance counts (1 − g) times.
double ReadingError::logLikelihood(const ComparedReading& reading) const {
  const auto& [innovation, HPHt, R, last_error, since] = reading;
  const double alone = logNormal(innovation, HPHt + R);
  const double g = correlationAfter(since, options_.memory);
  if (g == 0.0) return alone;
  const Eigen::Vector2d news = innovation - Eigen::Vector2d(g * last_error, 0.0);
  const Eigen::Vector2d unshared(1.0 - g, 1.0);
  Eigen::Matrix2d S = unshared.asDiagonal() * HPHt * unshared.asDiagonal();
  S += R;
  S(0, 0) -= R(0, 0) * std::min(g * g, 1.0 - kLeastInnovation);
  const double correlated = logNormal(news, S);
  const double most = std::max(alone, correlated);
  const double jump = options_.jump_share;
  return most +
         std::log((1.0 - jump) * std::exp(correlated - most) + jump * std::exp(alone - most));
}

}  // namespace slamscope::slam

// SPDX-License-Identifier: MIT
#include "tracking/tag_edge.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "tracking/median.hpp"
#include "tracking/symmetric_solve.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Vector2d;
using Vector7d = Eigen::Matrix<double, 7, 1>;
using Matrix7d = Eigen::Matrix<double, 7, 7>;

constexpr double kLeastContrast = 12;  // grey levels
constexpr double kLeastBlur = 0.15;  // px; sharper, and an edge between two pixels can't be placed
constexpr int kEdgeIterations = 12;
// What differs by more than noise and by more than this part of the step belongs to something else;
// not so in the first iterations, when it may be the edge itself.
constexpr double kForeign = 0.1;
constexpr double kMostRows = 96;  // along a side; more only cost time

struct Sample {
  double u, across, bow, grey;  // u: −1 … 1 along the side
};

/// Normal distribution by table: density φ, its integral Φ, and the integral of that, g = xΦ + φ.
class Normal {
 public:
  struct Value {
    double g, Phi, phi;
  };
  Normal() {
    for (int i = 0; i <= kCount; ++i) {
      const double x = i / kPerUnit - kEnd;
      const double phi = std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi);
      const double Phi = std::erfc(-x / std::numbers::sqrt2) / 2;
      table_[static_cast<std::size_t>(i)] = {x * Phi + phi, Phi, phi};
    }
  }
  [[nodiscard]] Value operator()(double x) const {
    if (x <= -kEnd) return {0, 0, 0};
    if (x >= kEnd) return {x, 1, 0};
    const double at = (x + kEnd) * kPerUnit;
    const auto i = static_cast<std::size_t>(at);
    const double f = at - static_cast<double>(i);
    const Value &a = table_[i], &b = table_[i + 1];
    return {a.g + f * (b.g - a.g), a.Phi + f * (b.Phi - a.Phi), a.phi + f * (b.phi - a.phi)};
  }

 private:
  static constexpr double kEnd = 6, kPerUnit = 128;
  static constexpr int kCount = static_cast<int>(2 * kEnd * kPerUnit);
  std::array<Value, kCount + 2> table_{};
};

/// A step at 0, blurred by a Gaussian (s) and by a pixel as seen along the edge's normal (a box).
struct Step {
  double value, by_distance, by_s;
};

Step blurredStep(double distance, double s, double box) {
  static const Normal normal;
  const auto high = normal((distance + box / 2) / s), low = normal((distance - box / 2) / s);
  return {s * (high.g - low.g) / box, (high.Phi - low.Phi) / box, (high.phi - low.phi) / box};
}

/// Pixels of the window: whole rows (or columns, whichever the edge crosses) of pixels.
std::optional<std::vector<Sample>> collect(const ImageView& grey, const Chord& chord,
                                           const Bow& bow, const EdgeWindow& window) {
  const int major = std::abs(chord.direction.x()) > std::abs(chord.direction.y()) ? 0 : 1;
  const int minor = 1 - major;
  const double usable = chord.half - window.margin;
  if (usable < 4) return std::nullopt;
  const double end = usable * std::abs(chord.direction[major]);
  const double slope = chord.direction[minor] / chord.direction[major];
  const double reach = window.half_width / std::abs(chord.normal[minor]);
  const int first = static_cast<int>(std::ceil(chord.middle[major] - end));
  const int last = static_cast<int>(std::floor(chord.middle[major] + end));
  const int stride = std::max(1, static_cast<int>(std::ceil((last - first) / kMostRows)));
  const int size_major = major == 0 ? grey.width : grey.height;
  const int size_minor = major == 0 ? grey.height : grey.width;
  if (first < 0 || last >= size_major) return std::nullopt;
  std::vector<Sample> samples;
  for (int m = first; m <= last; m += stride) {
    const double run = m - chord.middle[major];
    const double u = run / chord.direction[major] / chord.half;
    const double lift = bow.at(u);
    const double centre = chord.middle[minor] + run * slope + lift / chord.normal[minor];
    const int low = static_cast<int>(std::ceil(centre - reach));
    const int high = static_cast<int>(std::floor(centre + reach));
    if (low < 0 || high >= size_minor) return std::nullopt;
    for (int k = low; k <= high; ++k) {
      Vector2d p;
      p[major] = m;
      p[minor] = k;
      const auto row = static_cast<std::size_t>(p.y()), column = static_cast<std::size_t>(p.x());
      samples.push_back({chord.along(p) / chord.half, chord.across(p), lift,
                         double(grey.pixels[row * grey.row_bytes + column])});
    }
  }
  if (samples.size() < 20) return std::nullopt;
  return samples;
}

/// x = (offset, slope, grey behind the edge, its change along u, grey ahead of it, its change, s),
/// ahead being where the normal points.
Vector7d guess(const std::vector<Sample>& samples, const EdgeWindow& window) {
  double behind = 0, ahead = 0;
  int n_behind = 0, n_ahead = 0;
  for (const Sample& sample : samples) {
    const double across = sample.across - sample.bow;
    if (across < -0.45 * window.half_width) behind += sample.grey, ++n_behind;
    if (across > 0.45 * window.half_width) ahead += sample.grey, ++n_ahead;
  }
  Vector7d x;
  x << 0, 0, behind / std::max(n_behind, 1), 0, ahead / std::max(n_ahead, 1), 0, 0.8;
  return x;
}

/// One Gauss–Newton step of the robust fit: J'WJ and J'Wr, and the noise seen (median based).
struct EdgeEquations {
  Matrix7d H = Matrix7d::Zero();
  Vector7d g = Vector7d::Zero();
  double noise = 0;
};

EdgeEquations linearise(const std::vector<Sample>& samples, const Vector7d& x, double box,
                        double foreign) {
  std::vector<Vector7d> rows(samples.size());
  std::vector<double> residuals(samples.size()), sizes(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto& [u, across, bow, grey] = samples[i];
    const Step step = blurredStep(across - bow - x[0] - x[1] * u, x[6], box);
    const double behind = x[2] + x[3] * u, contrast = x[4] + x[5] * u - behind;
    const double by_offset = -contrast * step.by_distance;
    rows[i] << by_offset, by_offset * u, 1 - step.value, (1 - step.value) * u, step.value,
        step.value * u, contrast * step.by_s;
    residuals[i] = grey - behind - contrast * step.value;
    sizes[i] = std::abs(residuals[i]);
  }
  EdgeEquations result;
  result.noise = std::max(0.3, 1.4826 * medianOf(std::move(sizes)));
  const double scale = std::max(3 * result.noise, foreign * std::abs(x[4] - x[2]));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double weight = 1 / (1 + std::pow(residuals[i] / scale, 2));
    result.H.selfadjointView<Eigen::Lower>().rankUpdate(rows[i], weight);
    result.g += weight * residuals[i] * rows[i];
  }
  result.H.triangularView<Eigen::Upper>() = result.H.transpose();
  return result;
}

/// Takes the grey levels out of what is solved for.
void holdLevels(EdgeEquations& at) {
  for (int k = 2; k < 6; ++k) {
    at.H.row(k).setZero();
    at.H.col(k).setZero();
    at.H(k, k) = 1;
    at.g[k] = 0;
  }
}

}  // namespace

double EdgeFit::varianceAt(const Vector2d& p) const {
  const Vector2d along(-normal.y(), normal.x());
  const Vector2d h(1, along.dot(p - point) / half);
  return h.dot(covariance * h);
}

std::optional<EdgeFit> fitEdge(const ImageView& grey, const Chord& chord, const Bow& bow,
                               const EdgeWindow& window) {
  const auto samples = collect(grey, chord, bow, window);
  if (!samples) return std::nullopt;
  // A square pixel seen along the normal is a trapezoid: a box by the longer of its two widths, and
  // a Gaussian for the shorter one. Exact where it matters, on edges along rows and columns.
  const double box = chord.normal.cwiseAbs().maxCoeff(),
               narrow = chord.normal.cwiseAbs().minCoeff();
  const double pixel_variance = narrow * narrow / 12;
  const double least_s = std::sqrt(pixel_variance + kLeastBlur * kLeastBlur);
  Vector7d x = guess(*samples, window);
  if (window.known) x.segment<4>(2) << window.known->behind, 0, window.known->ahead, 0;
  EdgeEquations at;
  for (int i = 0; i < kEdgeIterations; ++i) {
    if (std::abs(x[4] - x[2]) < kLeastContrast) return std::nullopt;
    at = linearise(*samples, x, box, i < 4 ? 1.0 : kForeign);
    if (window.known) holdLevels(at);
    Matrix7d damped = at.H;
    damped.diagonal() *= 1 + 1e-6;
    damped(6, 6) *= 1.01;
    Vector7d step = solveSymmetric(damped, at.g);
    if (!step.allFinite()) return std::nullopt;
    const double most = std::max(std::abs(step[0]) / 0.7, std::abs(step[6]) / 0.4);
    if (most > 1) step /= most;
    x += step;
    x[6] = std::clamp(x[6], least_s, 3.0);
    if (i >= 4 && std::abs(step[0]) + std::abs(step[1]) < 2e-4 && std::abs(step[6]) < 2e-3) break;
  }
  const bool at_rest = std::abs(x[0]) < window.half_width && std::abs(x[1]) < window.half_width &&
                       x[6] < window.half_width && at.noise < 0.2 * std::abs(x[4] - x[2]);
  if (!at_rest) return std::nullopt;
  EdgeFit fit;
  fit.point = chord.middle + x[0] * chord.normal;
  fit.normal = (chord.normal - x[1] / chord.half * chord.direction).normalized();
  fit.blur = std::sqrt(std::max(0.0, x[6] * x[6] - pixel_variance));
  fit.levels = {x[2], x[4]};
  fit.contrast = x[4] - x[2];
  fit.half = chord.half;
  // Blur, symmetric about the edge, tells nothing of its place; without any it can't be told
  // itself.
  const UpTo12 P = inverseOfSymmetric(at.H.topLeftCorner<6, 6>());
  fit.covariance = at.noise * at.noise * P.topLeftCorner<2, 2>();
  return fit;
}

}  // namespace slamscope::tracking

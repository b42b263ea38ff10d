// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace slamscope::slam {

class HelperThread;

/// P ← P − Y Yᵀ in the lower triangle of P (N×N); what stands above the diagonal is left alone. Y
/// is N×m with small m: the covariance update of a batch of observations, equation (10), and nearly
/// all the time of an EKF step.
///
/// Tiles of 8×4 sums stay in registers; rows go in blocks whose part of Y stays in the first cache.
/// Large P are shared with a second thread, which starts with the first of them; the numbers are
/// the same to the bit. Compiled for several instruction sets, the best one taken at run time.
/// Memory is kept from call to call.
class RankUpdate {
 public:
  RankUpdate();
  ~RankUpdate();
  RankUpdate(const RankUpdate&) = delete;
  RankUpdate& operator=(const RankUpdate&) = delete;

  /// At most so many threads, 1 or 2.
  void setThreads(int threads) { threads_ = threads; }

  void subtract(Eigen::MatrixXd& P, const Eigen::MatrixXd& Y);

 private:
  int threads_ = 2;
  std::vector<double> panels_;
  std::unique_ptr<HelperThread> helper_;
};

}  // namespace slamscope::slam

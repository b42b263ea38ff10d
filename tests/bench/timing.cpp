// SPDX-License-Identifier: MIT
#include "tests/bench/timing.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <vector>

namespace slamscope {

double wallSeconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double medianSeconds(const std::function<void(std::size_t)>& work, double budget) {
  std::vector<double> times;
  double spent = 0.0;
  work(0);
  for (std::size_t k = 1; times.size() < 5 || (spent < budget && times.size() < 20000); ++k) {
    times.push_back(wallSeconds([&] { work(k); }));
    spent += times.back();
  }
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

double machineLoad() {
  std::array<double, 1> one{};
  return getloadavg(one.data(), 1) == 1 ? one[0] : -1.0;
}

}  // namespace slamscope

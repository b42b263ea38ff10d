// SPDX-License-Identifier: MIT
// slamscope_peers: one EKF-SLAM step, predict + update with ten range-bearing observations at n
// features, of our filter, of the textbook's, of the machine's limit and, where it is installed, of
// MRPT's: medians of wall time, all in one run. Prints the table of tests/bench/README.md.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <vector>

#include "slam/ekf_slam.hpp"
#include "tests/bench/ekf_drive.hpp"
#include "tests/bench/machine_limit.hpp"
#include "tests/bench/textbook_ekf.hpp"
#ifdef SLAMSCOPE_MRPT
#include "tests/bench/peers/mrpt_ekf.hpp"
#endif

namespace slamscope::slam::bench {
namespace {

constexpr std::array kCounts{15, 100, 300, 1000};
using Step = std::function<void(std::size_t)>;

/// Median seconds of a step: as many as fit into `budget` seconds, 5 at least.
double medianSeconds(const Step& step, double budget) {
  std::vector<double> times;
  double spent = 0.0;
  step(0);
  for (std::size_t k = 1; times.size() < 5 || (spent < budget && times.size() < 20000); ++k) {
    times.push_back(wallSeconds([&] { step(k % kSteps); }));
    spent += times.back();
  }
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

double ours(const Drive& drive, UpdateMode update) {
  EkfOptions options;
  options.update = update;
  EkfSlam filter(options);
  filter.observe(std::chrono::nanoseconds(0), drive.first);
  std::chrono::nanoseconds time{0};
  return medianSeconds([&](std::size_t k) { filter.step(++time, drive.motion, drive.readings[k]); },
                       1.0);
}

double textbook(const Drive& drive) {
  Textbook filter(drive.first);
  return medianSeconds([&](std::size_t k) { filter.step(drive.motion, drive.readings[k]); }, 1.0);
}

#ifdef SLAMSCOPE_MRPT
double mrpt(const Drive& drive, MrptEkf::Settings settings) {
  MrptEkf filter(settings, drive.first);
  const double seconds =
      medianSeconds([&](std::size_t k) { filter.step(drive.motion, drive.readings[k]); }, 1.0);
  if (filter.featureCount() != static_cast<int>(drive.first.size())) {
    std::printf("MRPT maps %d features of %zu: not compared\n", filter.featureCount(),
                drive.first.size());
    std::exit(1);
  }
  return seconds;
}
#endif

double load() {
  std::array<double, 1> one{};
  return getloadavg(one.data(), 1) == 1 ? one[0] : -1.0;
}

void printRow(const char* name, const std::function<double(const Drive&)>& measure) {
  std::printf("| %s |", name);
  for (const int count : kCounts) {
    std::printf(" %.4f |", 1e3 * measure(Drive(count)));
    std::fflush(stdout);
  }
  std::printf("\n");
}

}  // namespace
}  // namespace slamscope::slam::bench

int main() {
  using namespace slamscope::slam;
  using namespace slamscope::slam::bench;
  std::printf(
      "load before: %.1f\n\n| ms | n = 15 | 100 | 300 | 1000 |\n| --- | --- | --- | --- | --- |\n",
      load());
#ifdef SLAMSCOPE_MRPT
  printRow("MRPT, default", [](const Drive& d) { return mrpt(d, MrptEkf::Settings::by_default); });
  printRow("MRPT, its fastest", [](const Drive& d) { return mrpt(d, MrptEkf::Settings::fastest); });
#endif
  printRow("textbook, dense", textbook);
  printRow("ours, sequential", [](const Drive& d) { return ours(d, UpdateMode::sequential); });
  printRow("ours, batch", [](const Drive& d) { return ours(d, UpdateMode::batch); });
  printRow("the machine's limit",
           [](const Drive& d) { return machineLimit(static_cast<int>(d.first.size())); });
  std::printf("\nload after: %.1f\n", load());
}

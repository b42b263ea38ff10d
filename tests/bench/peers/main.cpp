// SPDX-License-Identifier: MIT
// slamscope_peers: one EKF-SLAM step, predict + update with ten range-bearing observations at n
// features, of our filter, of the textbook's, of the machine's limit and, where it is installed, of
// MRPT's: medians of wall time, all in one run. Prints the table of tests/bench/README.md.
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "slam/ekf_slam.hpp"
#include "tests/bench/ekf_drive.hpp"
#include "tests/bench/machine_limit.hpp"
#include "tests/bench/textbook_ekf.hpp"
#include "tests/bench/timing.hpp"
#ifdef SLAMSCOPE_MRPT
#include "tests/bench/peers/mrpt_ekf.hpp"
#endif

namespace slamscope::slam::bench {
namespace {

constexpr std::array kCounts{15, 100, 300, 1000};

double ours(const Drive& drive, UpdateMode update) {
  EkfOptions options;
  options.update = update;
  EkfSlam filter(options);
  filter.observe(std::chrono::nanoseconds(0), drive.first);
  std::chrono::nanoseconds time{0};
  return medianSeconds(
      [&](std::size_t k) { filter.step(++time, drive.motion, drive.readings[k % kSteps]); }, 1.0);
}

double textbook(const Drive& drive) {
  Textbook filter(drive.first);
  return medianSeconds(
      [&](std::size_t k) { filter.step(drive.motion, drive.readings[k % kSteps]); }, 1.0);
}

#ifdef SLAMSCOPE_MRPT
double mrpt(const Drive& drive, MrptEkf::Settings settings) {
  MrptEkf filter(settings, drive.first);
  const double seconds = medianSeconds(
      [&](std::size_t k) { filter.step(drive.motion, drive.readings[k % kSteps]); }, 1.0);
  if (filter.featureCount() != static_cast<int>(drive.first.size())) {
    std::printf("MRPT maps %d features of %zu: not compared\n", filter.featureCount(),
                drive.first.size());
    std::exit(1);
  }
  return seconds;
}
#endif

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
  using namespace slamscope;
  using namespace slamscope::slam;
  using namespace slamscope::slam::bench;
  std::printf(
      "load before: %.1f\n\n| ms | n = 15 | 100 | 300 | 1000 |\n| --- | --- | --- | --- | --- |\n",
      machineLoad());
#ifdef SLAMSCOPE_MRPT
  printRow("MRPT, default", [](const Drive& d) { return mrpt(d, MrptEkf::Settings::by_default); });
  printRow("MRPT, its fastest", [](const Drive& d) { return mrpt(d, MrptEkf::Settings::fastest); });
#endif
  printRow("textbook, dense", textbook);
  printRow("ours, sequential", [](const Drive& d) { return ours(d, UpdateMode::sequential); });
  printRow("ours, batch", [](const Drive& d) { return ours(d, UpdateMode::batch); });
  printRow("the machine's limit",
           [](const Drive& d) { return machineLimit(static_cast<int>(d.first.size())); });
  std::printf("\nload after: %.1f\n", machineLoad());
}

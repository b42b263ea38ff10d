// SPDX-License-Identifier: MIT
#include "apps/lib/view/latency_log.hpp"

#include <cstdio>
#include <stdexcept>

namespace slamscope::apps {
namespace {

double steadySeconds(std::chrono::steady_clock::time_point time) {
  return std::chrono::duration<double>(time.time_since_epoch()).count();
}

}  // namespace

LatencyLog::LatencyLog(const std::filesystem::path& file) : out_(file) {
  out_ << "frame,mid_exposure_s,dequeue_s,pose_s,present_s\n";
  if (!out_) throw std::runtime_error(file.string() + ": can't be written");
}

void LatencyLog::add(const FrameStations& stations) {
  char line[160];
  std::snprintf(line, sizeof line, "%llu,%.6f,%.6f,%.6f,%.6f\n",
                static_cast<unsigned long long>(frames_++),
                std::chrono::duration<double>(stations.mid_exposure).count(),
                steadySeconds(stations.dequeued), steadySeconds(stations.pose),
                steadySeconds(stations.presented));
  out_ << line << std::flush;
}

double softwareLatencyMs(const FrameStations& stations) {
  return std::chrono::duration<double, std::milli>(stations.presented - stations.dequeued).count();
}

std::optional<double> wholeLatencyMs(const FrameStations& stations) {
  const std::chrono::duration<double, std::milli> whole =
      stations.presented.time_since_epoch() - stations.mid_exposure;
  // Another clock is off by hours, not by seconds.
  if (whole.count() < 0.0 || whole > std::chrono::seconds(5)) return std::nullopt;
  return whole.count();
}

}  // namespace slamscope::apps

// SPDX-License-Identifier: MIT
#include "apps/lib/json_reports.hpp"

#include <nlohmann/json.hpp>
#include <optional>

#include "slam/jsonl.hpp"

namespace slamscope::apps {
namespace {

using nlohmann::ordered_json;

ordered_json orNull(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

}  // namespace

std::string scoreJson(const slam::Score& score, const slam::RecordingRun& run) {
  const slam::EkfCounters& counters = run.filter().counters();
  ordered_json json{{"features_found", score.features_found},
                    {"features_rms_aligned_m", orNull(score.features_rms_aligned)},
                    {"path_rms_aligned_m", orNull(score.path_rms_aligned)},
                    {"features_rms_m", orNull(score.features_rms)},
                    {"path_rms_m", orNull(score.path_rms)},
                    {"path_samples", score.path_samples},
                    {"updates", counters.updates},
                    {"observed", counters.observed},
                    {"gated_out", counters.gated_out},
                    {"features", run.filter().state().featureCount()}};
  if (const auto map = run.mapCounters()) {
    json["paired"] = map->paired;
    json["mispaired"] = run.mispaired();
    json["ambiguous"] = map->ambiguous;
    json["crowded"] = map->crowded;
    json["born"] = map->born;
    json["confirmed"] = map->confirmed;
    json["dropped"] = map->dropped;
    json["duplicates_taken_out"] = map->duplicates;
    json["duplicates"] = score.duplicates;
  }
  return json.dump(2) + '\n';
}

std::string summaryJson(const slam::RunSummary& run) {
  ordered_json events = ordered_json::object();
  for (std::size_t k = 0; k < run.events.size(); ++k) {
    if (run.events[k] == 0) continue;
    events[std::string(slam::eventName(static_cast<slam::Event>(k)))] = run.events[k];
  }
  const ordered_json json{{"records", run.records},
                          {"steps", run.steps},
                          {"events", events},
                          {"features_at_end", run.features_at_end},
                          {"features_at_most", run.features_at_most},
                          {"different_features", run.different_features},
                          {"start_s", slam::seconds(run.first)},
                          {"duration_s", slam::seconds(run.duration())},
                          {"level", run.levelName()},
                          {"truth", run.truth},
                          {"sensor", std::string(slam::sensorName(run.header.sensor))},
                          {"robot", run.header.robot},
                          {"warnings", run.warnings}};
  return json.dump(2) + '\n';
}

}  // namespace slamscope::apps

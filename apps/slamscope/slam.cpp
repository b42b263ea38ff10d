// SPDX-License-Identifier: MIT
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "apps/lib/json_reports.hpp"
#include "apps/lib/progress.hpp"
#include "apps/lib/whole_file.hpp"
#include "apps/slamscope/slam_flags.hpp"
#include "apps/slamscope/verbs.hpp"
#include "slam/recorder.hpp"
#include "slam/run_recording.hpp"
#include "slam/score.hpp"

namespace slamscope::apps {
namespace {

void print(const slam::Score& score, const slam::RecordingRun& run) {
  const auto line = [](const char* what, const std::optional<double>& aligned,
                       const std::optional<double>& as_it_is) {
    if (!aligned) {
      std::printf("%-9s no truth to compare with\n", what);
    } else if (!as_it_is) {
      std::printf("%-9s %.3f m RMS after alignment\n", what, *aligned);
    } else {
      std::printf("%-9s %.3f m RMS after alignment, %.3f m without\n", what, *aligned, *as_it_is);
    }
  };
  std::printf("%-9s %d found, %d in the map\n", "features", score.features_found,
              run.filter().state().featureCount());
  if (const auto map = run.mapCounters()) {
    std::printf(
        "%-9s %llu readings paired, %llu ambiguous, %llu mispaired; features: %llu born, "
        "%llu dropped, %llu duplicates taken out, %d left\n",
        "", static_cast<unsigned long long>(map->paired),
        static_cast<unsigned long long>(map->ambiguous),
        static_cast<unsigned long long>(run.mispaired()),
        static_cast<unsigned long long>(map->born), static_cast<unsigned long long>(map->dropped),
        static_cast<unsigned long long>(map->duplicates), score.duplicates);
  }
  line("features", score.features_rms_aligned, score.features_rms);
  line("path", score.path_rms_aligned, score.path_rms);
}

void run(const SlamFlags& flags) {
  slam::Recording recording = readRecording(flags);
  const slam::RecordingRunOptions options = runOptions(flags, recording);
  slam::RecordingRun run(std::move(recording), options);
  for (const std::string& warning : run.recording().warnings) spdlog::warn("{}", warning);
  const slam::Scorer scorer(run.filter(), run.recording());
  const auto score = [&] {
    const auto names = run.hiddenNames();
    return names.empty() ? scorer.score() : scorer.score(run.recording(), names);
  };
  std::optional<slam::Recorder> recorder;
  if (!flags.output.empty()) {
    recorder.emplace(run.filter(), flags.output, run.header(),
                     flags.record == "all" ? slam::kRecordAll : slam::kRecordSteps);
  }
  {
    Progress progress(run.recording().name);
    while (run.step()) progress.show(run.progress());
  }
  if (recorder) {
    recorder->finish();
    spdlog::info("{}: {} records", flags.output, recorder->records());
  }
  for (const std::string& remark : run.remarks()) spdlog::warn("{}", remark);
  const slam::EkfCounters& counters = run.filter().counters();
  if (counters.gated_out > 0) {
    spdlog::info("{} of {} sightings were outside the gate", counters.gated_out,
                 counters.observed + counters.gated_out);
  }
  if (!flags.score_json.empty()) writeWhole(flags.score_json, scoreJson(score(), run));
  if (flags.score || (flags.output.empty() && flags.score_json.empty())) {
    print(score(), run);
  }
}

}  // namespace

void addSlam(CLI::App& program) {
  const auto flags = std::make_shared<SlamFlags>();
  CLI::App* verb = program.add_subcommand("slam", "our EKF-SLAM on recorded data");
  addSlamFlags(*verb, *flags);
  verb->callback([flags] { run(*flags); });
}

}  // namespace slamscope::apps

// SPDX-License-Identifier: MIT
#include <spdlog/spdlog.h>

#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "apps/lib/progress.hpp"
#include "apps/slamscope/verbs.hpp"
#include "slam/csv_recording.hpp"
#include "slam/mrclam.hpp"
#include "slam/recorder.hpp"
#include "slam/run_recording.hpp"
#include "slam/score.hpp"

namespace slamscope::apps {
namespace {

template <typename Vector>
std::vector<double> list(const Vector& vector) {
  return {vector.begin(), vector.end()};
}

struct SlamFlags {
  std::string mrclam;
  int robot = 0;
  std::string csv;
  std::string association = "known";
  std::string update = "batch";
  std::vector<double> sensor_sigma = list(slam::RecordingRunOptions{}.sensor_sigma);
  std::vector<double> odometry_sigma = list(slam::RecordingRunOptions{}.odometry_sigma);
  std::vector<double> initial_sigma = list(slam::RecordingRunOptions{}.initial_sigma);
  double gate = slam::RecordingRunOptions{}.gate_probability.value_or(0.0);  ///< 0: no gate
  std::string record = "steps";
  std::string output;
  bool score = false;
  std::string score_json;
};

constexpr const char* kSlamHelp =
    "Examples:\n"
    "  slamscope slam --mrclam DIR --robot 3 --score -o run.jsonl.zst\n"
    "  slamscope slam --csv DIR --sensor-sigma 0.1,0.02 -o run.jsonl\n"
    "\n"
    "Choosing the noise\n"
    "  --sensor-sigma is what one sighting may be off by, all causes together: the sensor's data "
    "sheet\n"
    "  is a lower bound, features that aren't points and wrong time stamps come on top. Start "
    "with\n"
    "  two or three times the data sheet; too tight noise makes the filter sure of a wrong map, "
    "and\n"
    "  that shows as observations that a gate throws out, or as a map that bends.\n"
    "  --odometry-sigma is what dead reckoning is off by after 1 s of driving; it grows with the "
    "root\n"
    "  of time. Drive 1 m straight and turn once: the spread of where you end, per root second.\n"
    "Choosing a gate\n"
    "  --gate 0.99 leaves out sightings outside the ellipse that holds 99 % of what the filter "
    "expects\n"
    "  (chi-squared, 2 degrees of freedom, of the squared distance). Without known ids it is "
    "needed;\n"
    "  with known ids it guards against outliers. When many percent are left out, the noise is "
    "too\n"
    "  tight: widen it rather than the gate.\n"
    "\n"
    "DIR of --csv: odometry.csv (time_s,forward_mps,turn_radps or time_s,dx_m,dy_m,dtheta_rad),\n"
    "  range_bearing.csv (time_s,id,range_m,bearing_rad[,sigma_range_m,sigma_bearing_rad]),\n"
    "  optional truth_path.csv (time_s,x_m,y_m,theta_rad) and truth_features.csv (id,x_m,y_m).";

Eigen::Vector3d three(const std::vector<double>& values) {
  return {values.at(0), values.at(1), values.at(2)};
}

slam::Recording read(const SlamFlags& flags) {
  if (flags.mrclam.empty() == flags.csv.empty()) {
    throw std::runtime_error("say what to read: --mrclam DIR --robot N, or --csv DIR");
  }
  if (!flags.csv.empty()) return slam::readCsv(flags.csv);
  if (flags.robot < 1) throw std::runtime_error("--mrclam needs --robot N (1 to 5)");
  return slam::readMrclam(flags.mrclam, flags.robot);
}

slam::RecordingRunOptions runOptions(const SlamFlags& flags) {
  slam::RecordingRunOptions options;
  options.sensor_sigma = {flags.sensor_sigma.at(0), flags.sensor_sigma.at(1)};
  options.odometry_sigma = three(flags.odometry_sigma);
  options.initial_sigma = three(flags.initial_sigma);
  if (flags.update == "sequential") options.update = slam::UpdateMode::sequential;
  options.gate_probability.reset();
  if (flags.gate > 0.0) options.gate_probability = flags.gate;
  return options;
}

nlohmann::ordered_json asJson(const slam::Score& score, const slam::EkfCounters& counters) {
  const auto number = [](const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
  };
  return {{"features_found", score.features_found},
          {"features_rms_aligned_m", number(score.features_rms_aligned)},
          {"path_rms_aligned_m", number(score.path_rms_aligned)},
          {"features_rms_m", number(score.features_rms)},
          {"path_rms_m", number(score.path_rms)},
          {"path_samples", score.path_samples},
          {"updates", counters.updates},
          {"observed", counters.observed},
          {"gated_out", counters.gated_out}};
}

void print(const slam::Score& score) {
  const auto line = [](const char* what, const std::optional<double>& aligned,
                       const std::optional<double>& as_it_is) {
    if (!aligned) return std::printf("%-9s no truth to compare with\n", what);
    return std::printf("%-9s %.3f m RMS after alignment, %.3f m without\n", what, *aligned,
                       as_it_is.value_or(0.0));
  };
  std::printf("%-9s %d found\n", "features", score.features_found);
  line("features", score.features_rms_aligned, score.features_rms);
  line("path", score.path_rms_aligned, score.path_rms);
}

void writeJson(const std::string& file, const nlohmann::ordered_json& json) {
  std::ofstream out(file);
  out << json.dump(2) << '\n';
  out.close();
  if (!out) throw std::runtime_error(file + ": can't be written");
}

void run(const SlamFlags& flags) {
  slam::RecordingRun run(read(flags), runOptions(flags));
  for (const std::string& warning : run.recording().warnings) spdlog::warn("{}", warning);
  const slam::Scorer scorer(run.filter());
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
  const slam::EkfCounters& counters = run.filter().counters();
  if (counters.gated_out > 0) {
    spdlog::info("{} of {} sightings were outside the gate", counters.gated_out,
                 counters.observed + counters.gated_out);
  }
  if (!flags.score_json.empty()) writeJson(flags.score_json, asJson(scorer.score(), counters));
  if (flags.score || (flags.output.empty() && flags.score_json.empty())) print(scorer.score());
}

}  // namespace

void addSlam(CLI::App& program) {
  const auto flags = std::make_shared<SlamFlags>();
  CLI::App* verb = program.add_subcommand("slam", "our EKF-SLAM on recorded data");
  verb->footer(kSlamHelp);
  verb->add_option("--mrclam", flags->mrclam, "directory of a UTIAS MR.CLAM data set");
  verb->add_option("--robot", flags->robot, "which of its robots")->check(CLI::Range(1, 5));
  verb->add_option("--csv", flags->csv, "directory of anybody's data, see below");
  verb->add_option("--association", flags->association,
                   "which feature a sighting belongs to: known (by its id)")
      ->check(CLI::IsMember({"known"}));
  verb->add_option("--sensor-sigma", flags->sensor_sigma,
                   "RANGE,BEARING (m, rad), where the data gives none")
      ->delimiter(',')
      ->expected(2);
  verb->add_option("--odometry-sigma", flags->odometry_sigma,
                   "FORWARD,SIDEWAYS,TURN (m, m, rad) after 1 s of driving")
      ->delimiter(',')
      ->expected(3);
  verb->add_option("--initial-sigma", flags->initial_sigma,
                   "X,Y,THETA of the start pose (m, m, rad)")
      ->delimiter(',')
      ->expected(3);
  verb->add_option("--gate", flags->gate, "probability of the gate; 0: none")
      ->check(CLI::Range(0.0, 0.9999999));
  verb->add_option("--update", flags->update, "all observations of a step at once, or one by one")
      ->check(CLI::IsMember({"batch", "sequential"}));
  verb->add_option("--record", flags->record,
                   "steps: one record per time; all: every prediction, update and initialisation")
      ->check(CLI::IsMember({"steps", "all"}));
  verb->add_option("-o,--output", flags->output, "run to write (.jsonl, .jsonl.zst)");
  verb->add_flag("--score", flags->score, "print the errors against the truth");
  verb->add_option("--score-json", flags->score_json, "write them as JSON");
  verb->callback([flags] { run(*flags); });
}

}  // namespace slamscope::apps

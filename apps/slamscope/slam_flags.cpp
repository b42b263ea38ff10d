// SPDX-License-Identifier: MIT
#include "apps/slamscope/slam_flags.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "slam/csv_recording.hpp"
#include "slam/formats/isam_graph.hpp"
#include "slam/formats/mrpt_sightings.hpp"
#include "slam/formats/victoria_park.hpp"
#include "slam/mrclam.hpp"
#include "slam/recording_defaults.hpp"

namespace slamscope::apps {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

constexpr const char* kSlamHelp =
    "Examples:\n"
    "  slamscope slam --mrclam DIR --robot 3 --score -o run.jsonl.zst\n"
    "  slamscope slam --mrclam DIR --robot 3 --association joint --hypotheses 50 --score\n"
    "  slamscope slam --csv DIR --sensor-sigma 0.1,0.02 -o run.jsonl\n"
    "  slamscope slam --csv DIR --vehicle ackermann --wheelbase 2.83 --laser 3.78,0.5,0 --score\n"
    "  slamscope slam --victoria-park DIR --score\n"
    "  slamscope slam --laser-lab 3 --score -o run.jsonl\n"
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
    "  --gate 0.99 lets through 99 % of right sightings (chi-squared of the squared Mahalanobis\n"
    "  distance, 2 degrees of freedom a pairing). With known ids it guards against outliers. When "
    "many\n"
    "  percent are left out, the noise is too tight: widen it rather than the gate.\n"
    "Without ids\n"
    "  nearest takes the nearest feature for each sighting; joint the largest set of pairings that "
    "is\n"
    "  compatible as a whole (JCBB), which tells neighbours apart when the pose is poorly known. A "
    "new\n"
    "  feature is tentative until it was seen --confirm times; a tentative one goes when it was "
    "expected\n"
    "  in view and not seen --drop times in a row. A laser knows what it looks past; for other "
    "sensors\n"
    "  say --view RANGE,DEGREES.\n"
    "Among close features or after blind drives\n"
    "  --hypotheses 50: where it can't be told what a sighting of range and bearing is of, all\n"
    "  stories go on until one is much likelier. The run then takes the best one's names as ids.\n"
    "  State noise as it is, not wide, and --view as what may well be seen. Features of less than\n"
    "  --confirm sightings (4) are left out; --fresh-density (2e-5) says how readily a new one is\n"
    "  believed in.\n"
    "\n"
    "DIR of --csv: odometry.csv (time_s,forward_mps,turn_radps or time_s,speed_mps,steering_rad "
    "or\n"
    "  time_s,dx_m,dy_m,dtheta_rad), range_bearing.csv (time_s,[id,]range_m,bearing_rad\n"
    "  [,sigma_range_m,sigma_bearing_rad]) or scans.csv (time_s,angle_min_rad,angle_step_rad,r0,r1,"
    "...;\n"
    "  nan: no return) with optional intensities.csv of the same shape; optional truth_path.csv\n"
    "  (time_s,x_m,y_m,theta_rad) and truth_features.csv (id,x_m,y_m).";

void addInput(CLI::App& verb, SlamFlags& flags) {
  const std::string group = "Input";
  verb.add_option("--mrclam", flags.mrclam, "directory of a UTIAS MR.CLAM data set")->group(group);
  verb.add_option("--robot", flags.robot, "which of its robots")
      ->check(CLI::Range(1, 5))
      ->group(group);
  verb.add_option("--csv", flags.csv, "directory of anybody's data, see below")->group(group);
  verb.add_option("--victoria-park", flags.victoria_park,
                  "directory with victoria_park_ascii.zip (raw scans)")
      ->group(group);
  verb.add_option("--isam", flags.isam, "graph in iSAM's text form: ODOMETRY, LANDMARK")
      ->group(group);
  verb.add_option("--laser-lab", flags.laser_lab.loops,
                  "no recording but a simulated robot with a laser among five posts: so many loops")
      ->check(CLI::Range(1, 10000))
      ->group(group);
  verb.add_option("--seed", flags.laser_lab.seed, "of the laser lab's noise")->group(group);
  verb.add_option("--mrpt", flags.mrpt, "range-bearing sightings as rawlog-edit writes them")
      ->group(group);
}

void addRobot(CLI::App& verb, SlamFlags& flags) {
  const std::string group = "Robot and sensor";
  verb.add_option("--vehicle", flags.vehicle, "ackermann: odometry is speed and steering")
      ->check(CLI::IsMember({"ackermann"}))
      ->group(group);
  verb.add_option("--wheelbase", flags.wheelbase, "of the car, m")
      ->check(CLI::PositiveNumber)
      ->group(group);
  verb.add_option("--encoder-left", flags.encoder_left,
                  "how far left of the middle the wheel runs whose speed is measured, m")
      ->group(group);
  verb.add_option("--laser", flags.laser_pose, "X,Y,DEGREES of the laser on the robot (m, m, deg)")
      ->delimiter(',')
      ->expected(3)
      ->group(group);
  verb.add_option("--laser-range", flags.laser_range, "from here on: no return, m")
      ->check(CLI::PositiveNumber)
      ->group(group);
  verb.add_option("--sweep", flags.sweep, "time from the first return of a scan to its last, s")
      ->check(CLI::NonNegativeNumber)
      ->group(group);
  verb.add_option("--diameter", flags.diameters, "LEAST,GREATEST of poles and trunks (m)")
      ->delimiter(',')
      ->expected(2)
      ->group(group);
  verb.add_option("--reflector", flags.reflector,
                  "features are what shines at least so brightly (intensities.csv)")
      ->group(group);
  verb.add_option("--view", flags.view,
                  "RANGE,DEGREES: what the sensor surely sees, degrees to each side")
      ->delimiter(',')
      ->expected(2)
      ->group(group);
}

void addAssociation(CLI::App& verb, SlamFlags& flags) {
  const std::string group = "Association";
  verb.add_option("--association", flags.association,
                  "which feature a sighting is of: known (by its id), nearest, or joint; default: "
                  "known where there are ids, else joint")
      ->check(CLI::IsMember({"known", "nearest", "joint"}))
      ->group(group);
  verb.add_option("--gate", flags.gate,
                  "share of right sightings that the gate lets through; 0 (known only): no gate")
      ->check(CLI::Range(0.0, 0.9999999))
      ->group(group);
  verb.add_option("--fresh-gate", flags.fresh_gate,
                  "outside of this wider gate of all features a sighting is of a new one")
      ->check(CLI::Range(0.5, 0.9999999999))
      ->group(group);
  verb.add_option(
          "--fresh-density", flags.fresh_density,
          "features a m^2 that are not in the map yet; a sighting is paired only where that "
          "is likelier than that it is of one of these (default: next to none)")
      ->check(CLI::Range(1e-12, 1e6))
      ->group(group);
  verb.add_option("--odds", flags.odds,
                  "a pairing counts only where it is so many times likelier than its rivals")
      ->check(CLI::Range(1.0, 1e12))
      ->group(group);
  verb.add_option("--confirm", flags.confirm, "sightings that confirm a feature")
      ->check(CLI::PositiveNumber)
      ->group(group);
  verb.add_option("--drop", flags.drop, "misses in a row after which a tentative feature goes")
      ->check(CLI::PositiveNumber)
      ->group(group);
  verb.add_option("--drop-confirmed", flags.drop_confirmed, "the same of a confirmed one; 0: never")
      ->group(group);
  verb.add_option("--longest-doubt", flags.longest_doubt,
                  "s; a tentative feature that was not seen for so long goes; 0: never")
      ->check(CLI::NonNegativeNumber)
      ->group(group);
  verb.add_option("--hypotheses", flags.hypotheses,
                  "joint, but go through the recording first with so many maps side by side, one "
                  "for each story of what the sightings are of, and let the whole recording decide "
                  "(range and bearing, tens of features); 0: decide at once")
      ->check(CLI::Range(0, 100000))
      ->group(group);
  verb.add_option("--error-memory", flags.error_memory,
                  "s for which the range of a feature stays wrong once it is (--hypotheses); 0: "
                  "each sighting errs by itself; default 3")
      ->check(CLI::NonNegativeNumber)
      ->group(group);
  verb.add_option("--separation", flags.separation,
                  "features nearer to each other than this are one, m; 0: never")
      ->check(CLI::NonNegativeNumber)
      ->group(group);
}

void addNoise(CLI::App& verb, SlamFlags& flags) {
  const std::string group = "Filter";
  verb.add_option("--sensor-sigma", flags.sensor_sigma,
                  "RANGE,BEARING (m, rad), where the data gives none")
      ->delimiter(',')
      ->expected(2)
      ->group(group);
  verb.add_option("--odometry-sigma", flags.odometry_sigma,
                  "FORWARD,SIDEWAYS,TURN (m, m, rad) after 1 s of driving; of a car "
                  "SPEED,SIDEWAYS,STEERING (m/s, m, rad)")
      ->delimiter(',')
      ->expected(3)
      ->group(group);
  verb.add_option("--initial-sigma", flags.initial_sigma, "X,Y,THETA of the start pose (m, m, rad)")
      ->delimiter(',')
      ->expected(3)
      ->group(group);
  verb.add_option("--linearisation", flags.linearisation,
                  "newest: at the newest estimate, as the EKF does; first-estimates: of pose and "
                  "features (more consistent on long drives)")
      ->check(CLI::IsMember({"newest", "first-estimates"}))
      ->group(group);
  verb.add_option("--update", flags.update, "all observations of a step at once, or one by one")
      ->check(CLI::IsMember({"batch", "sequential"}))
      ->group(group);
}

Eigen::Vector3d three(const std::vector<double>& values) {
  return {values.at(0), values.at(1), values.at(2)};
}

slam::Recording readInput(const SlamFlags& flags) {
  int inputs = flags.laser_lab.loops > 0 ? 1 : 0;
  for (const std::string* input :
       {&flags.mrclam, &flags.csv, &flags.victoria_park, &flags.isam, &flags.mrpt}) {
    inputs += input->empty() ? 0 : 1;
  }
  if (inputs != 1) {
    throw std::runtime_error(
        "say what to read, one of: --mrclam DIR --robot N, --csv DIR, --victoria-park DIR, "
        "--isam FILE, --mrpt FILE, --laser-lab LOOPS");
  }
  if (!flags.csv.empty()) return slam::readCsv(flags.csv);
  if (!flags.victoria_park.empty()) return slam::readVictoriaPark(flags.victoria_park);
  if (!flags.isam.empty()) return slam::readIsamGraph(flags.isam);
  if (!flags.mrpt.empty()) return slam::readMrptSightings(flags.mrpt);
  if (flags.laser_lab.loops > 0) return slam::LaserLab(flags.laser_lab).record();
  if (flags.robot < 1) throw std::runtime_error("--mrclam needs --robot N (1 to 5)");
  return slam::readMrclam(flags.mrclam, flags.robot);
}

slam::Association associationOf(const SlamFlags& flags, const slam::Recording& recording) {
  if (flags.association == "nearest") return slam::Association::nearest;
  if (flags.association == "joint") return slam::Association::joint;
  if (flags.association.empty() && flags.hypotheses > 0) return slam::Association::joint;
  if (flags.association == "known" || recording.ids_known) return slam::Association::known;
  return slam::Association::joint;
}

/// What the flags say of hypotheses. Noise that is stated is all there is: a range's does not grow
/// with it, nor the odometry's with turns.
void setHypotheses(const SlamFlags& flags, slam::HypothesisOptions& options) {
  if (!flags.sensor_sigma.empty()) {
    options.error.range_sigma = flags.sensor_sigma.at(0);
    options.error.range_share = 0.0;
    options.error.bearing_sigma = flags.sensor_sigma.at(1);
  }
  if (flags.error_memory) options.error = options.error.withMemory(*flags.error_memory);
  if (!flags.odometry_sigma.empty()) {
    options.odometry_sigma = three(flags.odometry_sigma);
    options.turn_sigma = 0.0;
  }
  if (!flags.view.empty()) options.view = {flags.view.at(0), flags.view.at(1) * kDegree};
  options.fresh_density = flags.fresh_density.value_or(options.fresh_density);
  options.confirm_after = flags.confirm.value_or(options.confirm_after);
}

}  // namespace

void addSlamFlags(CLI::App& verb, SlamFlags& flags) {
  verb.footer(kSlamHelp);
  addInput(verb, flags);
  addRobot(verb, flags);
  addAssociation(verb, flags);
  addNoise(verb, flags);
  verb.add_option("--record", flags.record,
                  "steps: one record per time; all: every prediction, update and initialisation")
      ->check(CLI::IsMember({"steps", "all"}));
  verb.add_option("-o,--output", flags.output, "run to write (.jsonl, .jsonl.zst)");
  verb.add_flag("--score", flags.score, "print the errors against the truth");
  verb.add_option("--score-json", flags.score_json, "write them as JSON");
}

slam::Recording readRecording(const SlamFlags& flags) {
  slam::Recording recording = readInput(flags);
  const bool car = recording.odometry_kind == slam::Recording::Odometry::ackermann;
  if (!flags.vehicle.empty() && !car) {
    throw std::runtime_error(recording.name +
                             ": --vehicle ackermann needs odometry of speed and steering");
  }
  if (flags.wheelbase > 0.0) recording.vehicle = {flags.wheelbase, flags.encoder_left};
  if (!flags.laser_pose.empty()) {
    recording.laser.pose_robot = three(flags.laser_pose);
    recording.laser.pose_robot[2] *= kDegree;
  }
  if (flags.sweep) recording.laser.sweep = *flags.sweep;
  return recording;
}

slam::RecordingRunOptions runOptions(const SlamFlags& flags, const slam::Recording& recording) {
  slam::RecordingRunOptions options =
      flags.laser_lab.loops > 0
          ? slam::LaserLab(flags.laser_lab).runOptions()
          : slam::usualOptions(recording, associationOf(flags, recording), flags.hypotheses);
  options.association = associationOf(flags, recording);
  options.gates.fresh = flags.fresh_gate.value_or(options.gates.fresh);
  options.gates.fresh_density = flags.fresh_density.value_or(options.gates.fresh_density);
  options.gates.odds = flags.odds.value_or(options.gates.odds);
  slam::FeatureLifeOptions& life = options.life;
  life.confirm_after = flags.confirm.value_or(life.confirm_after);
  life.drop_after = flags.drop.value_or(life.drop_after);
  life.drop_confirmed_after = flags.drop_confirmed.value_or(life.drop_confirmed_after);
  life.separation = flags.separation.value_or(life.separation);
  if (flags.longest_doubt) {
    life.longest_doubt =
        std::chrono::nanoseconds(static_cast<std::int64_t>(*flags.longest_doubt * 1e9));
  }
  options.laser.max_range = flags.laser_range.value_or(options.laser.max_range);
  options.laser.reflector_intensity = flags.reflector;
  if (!flags.sensor_sigma.empty()) {
    options.sensor_sigma = {flags.sensor_sigma.at(0), flags.sensor_sigma.at(1)};
  }
  if (!flags.odometry_sigma.empty()) options.odometry_sigma = three(flags.odometry_sigma);
  if (!flags.initial_sigma.empty()) options.initial_sigma = three(flags.initial_sigma);
  options.first_estimates = flags.linearisation == "first-estimates";
  if (flags.update == "sequential") options.update = slam::UpdateMode::sequential;
  if (flags.gate) options.gate_probability.reset();
  if (flags.gate.value_or(0.0) > 0.0) options.gate_probability = options.gates.pair = *flags.gate;
  if (!flags.diameters.empty()) {
    options.laser.min_diameter = flags.diameters.at(0);
    options.laser.max_diameter = flags.diameters.at(1);
  }
  if (!flags.view.empty()) options.view = {flags.view.at(0), flags.view.at(1) * kDegree};
  options.hypotheses.most = flags.hypotheses;
  setHypotheses(flags, options.hypotheses);
  return options;
}

}  // namespace slamscope::apps

// SPDX-License-Identifier: MIT
#include "tests/experiments/healthy_run.hpp"

#include "slam/simulation_random.hpp"
#include "tests/experiments/log_conversion.hpp"
#include "tests/slam/variants/variants.hpp"

namespace slamscope::slam::experiments {
namespace {

constexpr double kMillimetres = 1000.0;

template <typename T, std::size_t N>
T pick(RandomSource& random, const std::array<T, N>& choices) {
  return choices[static_cast<std::size_t>(random.uniform() * N)];
}

/// σ of the start's heading stays where the linearisation does no harm.
Eigen::Vector3d drawStart(RandomSource& random) {
  if (random.uniform() < 0.5) return Eigen::Vector3d::Zero();
  return Eigen::Vector3d(0.1, 0.1, 0.005) * random.uniform(0.2, 1.0);
}

void drawNoise(RandomSource& random, SimulationOptions& options) {
  const double sensor = random.uniform(0.5, 1.5);
  options.sensor_sigma =
      sensor * (options.sensor == Sensor::range_bearing ? Eigen::Vector2d(0.06, 0.04)
                                                        : Eigen::Vector2d(0.05, 0.03));
  options.odometry_sigma = random.uniform(0.5, 1.5) * Eigen::Vector2d(0.03, 0.06);
}

/// Takes a feature out every few seconds of simulated time; it comes back when it is seen again.
void removeSome(EkfSlam& filter, int step) {
  const std::vector<FeatureId> ids = filter.state().ids;
  if (step % 37 != 36 || ids.size() < 2) return;
  filter.remove(ids[static_cast<std::size_t>(step) % ids.size()]);
}

}  // namespace

std::string HealthyRun::describe() const {
  const SimulationOptions& s = simulation;
  std::string text = "seed " + std::to_string(s.seed) + ", " + std::string(worldName(s.world)) +
                     ", n " + std::to_string(s.features) + ", " + variant;
  text += s.update == UpdateMode::batch ? ", batch" : ", sequential";
  text += s.sensor == Sensor::range_bearing ? ", range-bearing" : ", relative-position";
  text += s.motion == MotionInput::velocity ? ", velocity" : ", increment";
  text += s.initial_sigma.isZero() ? ", exact start" : ", loose start";
  if (removal) text += ", removal";
  if (millimetres) text += ", mm";
  if (unwrapped) text += ", unwrapped";
  return text;
}

HealthyRun drawHealthyRun(std::uint64_t number) {
  RandomSource random(number * 104729 + 5);
  HealthyRun run;
  SimulationOptions& s = run.simulation;
  s.seed = number;
  s.world = pick(random,
                 std::array{WorldKind::three_clusters, WorldKind::uniform, WorldKind::one_cluster});
  s.features = pick(random, std::array{2, 3, 5, 8, 15, 15, 15, 15, 25, 40});
  s.sensor = pick(random, std::array{Sensor::range_bearing, Sensor::relative_position});
  s.motion = pick(random, std::array{MotionInput::velocity, MotionInput::increment});
  s.update = pick(random, std::array{UpdateMode::batch, UpdateMode::sequential});
  s.initial_sigma = drawStart(random);
  drawNoise(random, s);
  s.loops = pick(random, std::array{1, 2, 3});
  run.variant = pick(random, std::array<std::string, 6>{"plain", "plain", "plain", "joseph",
                                                        "square-root", "information"});
  if (run.variant == "information" && s.initial_sigma.isZero()) run.variant = "joseph";
  run.removal = random.uniform() < 0.2;
  run.millimetres = random.uniform() < 0.2;
  run.unwrapped = random.uniform() < 0.2;
  if (number % 20 == 0) {  // large maps cost most of the time: fewer of them, and shorter
    s.features = number % 60 == 0 ? 300 : 100;
    s.loops = 1;
    run.max_steps = s.features == 300 ? 25 : 80;
    run.variant = s.features == 300 ? "plain" : run.variant;
  }
  return run;
}

void runHealthy(const HealthyRun& run, const std::function<void(const RunHeader&)>& begin,
                const std::function<void(const SnapshotPtr&)>& hear) {
  const Sensor sensor = run.simulation.sensor;
  const auto compass = std::make_shared<testing::Compass>();
  Simulation simulation(run.simulation, testing::makeVariant(run.variant, sensor, compass));
  begin(run.millimetres ? inUnits(simulation.header(), kMillimetres) : simulation.header());
  Unwrapper unwrap;
  const Subscription subscription = simulation.filter().observe([&](SnapshotPtr snapshot) {
    if (run.unwrapped) snapshot = unwrap(snapshot);
    if (run.millimetres) snapshot = inUnits(snapshot, sensor, kMillimetres);
    hear(snapshot);
  });
  RandomSource compass_noise(run.simulation.seed + 4242);
  for (int step = 0; step < run.max_steps; ++step) {
    const double heading = simulation.truePose(step * simulation.timeStep())[2];
    compass->heading = wrapAngle(heading + compass->sigma * compass_noise.normal());
    if (!simulation.step()) break;
    if (run.removal) removeSome(simulation.filter(), step);
  }
}

}  // namespace slamscope::slam::experiments

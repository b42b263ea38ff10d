// SPDX-License-Identifier: MIT
#include "apps/lib/monte_carlo_report.hpp"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace slamscope::apps {
namespace {

using nlohmann::ordered_json;
using slam::Consistency;
using slam::MonteCarloResult;

template <typename... Values>
std::string format(const char* pattern, Values... values) {
  char text[200];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

const char* verdict(const Consistency& c) {
  if (c.inside()) return "consistent";
  return c.mean > c.high ? "overconfident" : "underconfident";
}

std::string row(const char* name, const Consistency& c, double inside) {
  if (c.dof == 0.0) return format("%-17s%8s\n", name, "nothing to judge");
  return format("%-17s%8.4f   %.4f … %.4f   %5.1f %%   %s\n", name, c.mean, c.low, c.high,
                100.0 * inside, verdict(c));
}

ordered_json orNull(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json toJson(const Consistency& c) {
  return {{"mean", orNull(c.mean)},
          {"low", orNull(c.low)},
          {"high", orNull(c.high)},
          {"degrees_of_freedom", c.dof},
          {"inside", c.inside()}};
}

ordered_json toJson(const Consistency& c, double share) {
  ordered_json json = toJson(c);
  json["share_of_steps_inside"] = share;
  return json;
}

ordered_json stepsJson(const MonteCarloResult& result) {
  ordered_json steps = ordered_json::array();
  for (const slam::MonteCarloStep& step : result.steps) {
    steps.push_back({{"time_s", step.time_s},
                     {"anees_pose", toJson(step.pose)},
                     {"anees_features", toJson(step.features)},
                     {"nis", toJson(step.nis)}});
  }
  return steps;
}

std::uint64_t lastSeed(const MonteCarloResult& result, const slam::SimulationOptions& simulation) {
  return simulation.seed + static_cast<std::uint64_t>(result.runs) - 1;
}

}  // namespace

std::string monteCarloText(const MonteCarloResult& result,
                           const slam::SimulationOptions& simulation) {
  std::string text =
      format("%d runs, seeds %llu to %llu, fault %s, %zu time steps; two-sided bands of %g %%\n",
             result.runs, static_cast<unsigned long long>(simulation.seed),
             static_cast<unsigned long long>(lastSeed(result, simulation)),
             simulation.fault.c_str(), result.steps.size(), 100.0 * result.confidence);
  text += "per degree of freedom mean   band              steps inside\n";
  text += row("ANEES, pose", result.pose, result.pose_inside);
  text += row("ANEES, features", result.features, result.features_inside);
  text += row("NIS", result.nis, result.nis_inside);
  if (!result.broken_seeds.empty()) {
    text += format("%zu runs with numbers that are not finite or a P that is not positive; seeds",
                   result.broken_seeds.size());
    for (const std::uint64_t seed : result.broken_seeds)
      text.append(" ").append(std::to_string(seed));
    text += '\n';
  }
  return text;
}

std::string monteCarloJson(const MonteCarloResult& result,
                           const slam::SimulationOptions& simulation) {
  const ordered_json json{{"runs", result.runs},
                          {"first_seed", simulation.seed},
                          {"last_seed", lastSeed(result, simulation)},
                          {"fault", simulation.fault},
                          {"confidence", result.confidence},
                          {"anees_pose", toJson(result.pose, result.pose_inside)},
                          {"anees_features", toJson(result.features, result.features_inside)},
                          {"nis", toJson(result.nis, result.nis_inside)},
                          {"broken_seeds", result.broken_seeds},
                          {"steps", stepsJson(result)}};
  return json.dump(1) + '\n';
}

}  // namespace slamscope::apps

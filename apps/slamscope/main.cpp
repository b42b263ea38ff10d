// SPDX-License-Identifier: MIT
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>
#include <string>
#include <vector>

#include "apps/lib/freed_memory.hpp"
#include "apps/lib/nearest_word.hpp"
#include "apps/slamscope/verbs.hpp"

namespace slamscope::apps {
namespace {

constexpr int kBadRequest = 2;

/// The verb that was asked for, or the verb within a verb (`calibrate tags`), and its full name.
struct Asked {
  const CLI::App* verb;
  std::string name;
};

Asked askedOf(const CLI::App& program) {
  Asked asked{.verb = &program, .name = "slamscope"};
  while (!asked.verb->get_subcommands().empty()) {
    asked.verb = asked.verb->get_subcommands().front();
    asked.name += " " + asked.verb->get_name();
  }
  return asked;
}

/// Everything that could have been meant at this place: verbs and options.
std::vector<std::string> knownWords(const CLI::App& at) {
  std::vector<std::string> words;
  for (const CLI::App* verb : at.get_subcommands([](const CLI::App*) { return true; })) {
    words.push_back(verb->get_name());
  }
  for (const CLI::Option* option : at.get_options()) {
    for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
  }
  return words;
}

int complain(const CLI::App& program, const CLI::ParseError& error) {
  const bool asked_for_help = error.get_exit_code() == 0;
  if (asked_for_help) return program.exit(error);

  std::string message = error.what();
  const Asked asked = askedOf(program);
  std::vector<std::string> unknown = asked.verb->remaining();
  if (unknown.empty()) unknown = program.remaining();
  if (!unknown.empty()) {
    message = "unknown: " + unknown.front();
    if (const auto meant = nearestWord(unknown.front(), knownWords(*asked.verb))) {
      message += "; did you mean " + *meant + "?";
    }
  }
  spdlog::error("{} ({} --help lists what there is)", message, asked.name);
  return kBadRequest;
}

}  // namespace

int run(int argc, char** argv) {
  keepFreedMemory();
  spdlog::set_default_logger(spdlog::stderr_color_mt("slamscope"));
  spdlog::set_pattern("slamscope: %^%l%$: %v");
  std::signal(SIGPIPE,
              SIG_IGN);  // NOLINT: a reader that goes away is an error of write, not a death

  CLI::App program{
      "slamscope draws, over a camera picture, what an EKF-SLAM filter believes: pose, path,\n"
      "features, and the relative covariance of each pair of features as an ellipsoid that must\n"
      "shrink."};
  program.name("slamscope");
  program.set_version_flag("--version", "slamscope " SLAMSCOPE_VERSION);
  program.footer("Example: slamscope demo\nEach verb has its own --help with an example.");
  program.require_subcommand(1);
  program.option_defaults()->always_capture_default();
  for (const AddVerb add : verbs()) add(program);
  try {
    program.parse(argc, argv);
  } catch (const CLI::RuntimeError& result) {  // a verb that answers by its exit status
    return result.get_exit_code();
  } catch (const CLI::ParseError& error) {
    return complain(program, error);
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    return kBadRequest;
  }
  return 0;
}

}  // namespace slamscope::apps

int main(int argc, char** argv) {
  return slamscope::apps::run(argc, argv);
}

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

/// Everything that could have been meant at this place: verbs, and the options of the chosen one.
std::vector<std::string> knownWords(const CLI::App& program) {
  std::vector<std::string> words;
  const auto verbs = program.get_subcommands();
  if (verbs.empty()) {
    for (const CLI::App* verb : program.get_subcommands([](const CLI::App*) { return true; })) {
      words.push_back(verb->get_name());
    }
    return words;
  }
  for (const CLI::Option* option : verbs.front()->get_options()) {
    for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
  }
  return words;
}

int complain(const CLI::App& program, const CLI::ParseError& error) {
  const bool asked_for_help = error.get_exit_code() == 0;
  if (asked_for_help) return program.exit(error);

  std::string message = error.what();
  const CLI::App* at =
      program.get_subcommands().empty() ? &program : program.get_subcommands().front();
  std::vector<std::string> unknown = at->remaining();
  if (unknown.empty()) unknown = program.remaining();
  if (!unknown.empty()) {
    message = "unknown: " + unknown.front();
    if (const auto meant = nearestWord(unknown.front(), knownWords(program))) {
      message += "; did you mean " + *meant + "?";
    }
  }
  const std::string verb = at == &program ? "" : " " + at->get_name();
  spdlog::error("{} (slamscope{} --help lists what there is)", message, verb);
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

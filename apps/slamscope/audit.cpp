// SPDX-License-Identifier: MIT
#include "slam/audit/audit.hpp"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "apps/lib/progress.hpp"
#include "apps/lib/whole_file.hpp"
#include "apps/slamscope/verbs.hpp"
#include "slam/audit/report_html.hpp"
#include "slam/audit/report_json.hpp"
#include "slam/audit/report_junit.hpp"
#include "slam/audit/report_series.hpp"
#include "slam/audit/report_text.hpp"
#include "slam/run_reader.hpp"

namespace slamscope::apps {
namespace {

struct AuditFlags {
  std::string run;
  std::string json, junit, html;
  std::vector<std::string> allow;
  std::vector<std::string> fail_on{"code", "statistics"};
  double alpha = 1e-3;
  bool quiet = false;
};

constexpr const char* kAuditHelp =
    "Examples:\n"
    "  slamscope audit run.jsonl.zst\n"
    "  slamscope audit run.jsonl --junit audit.xml --fail-on code      one line in CI\n"
    "  slamscope audit run.jsonl --html audit.html                     a page for a bug report\n"
    "  slamscope audit run.npz                   x and P of each step, saved from Python\n"
    "  your_filter | slamscope audit -\n"
    "\n"
    "Runs: .jsonl, .jsonl.zst; .npz, .npy (NumPy); .mat (MATLAB, Octave: cells, stacks, or a "
    "struct\n"
    "array with fields x and P); a directory of MRPT's kf-slam. Without a record of every event "
    "they\n"
    "prove less: the report says what to add; loggers are in apps/loggers.\n"
    "\n"
    "Classes of evidence: code (an exact law is broken: a programming fault), statistics (noise,\n"
    "association, a moved feature), linearisation (the EKF's own inconsistency; never fails by\n"
    "default). Words of --allow, for filters that break a law by design: moving-features,\n"
    "absolute-sensor, inflation, robocentric, fej, frozen-linearisation, iterated,\n"
    "diffuse-initialisation.\n"
    "\n"
    "Exit status: 0 nothing of --fail-on; 1 something; 2 the run can't be read; 3 too little to "
    "judge.";

int audit(const AuditFlags& flags) {
  slam::AuditOptions options{.allow = {}, .alpha = flags.alpha};
  for (const std::string& word : flags.allow) options.allow.insert(slam::allowFromName(word));
  std::set<slam::FaultClass> fail_on;
  for (const std::string& word : flags.fail_on) {
    if (word != "none") fail_on.insert(slam::faultClassFromName(word));
  }

  slam::RunReader reader(flags.run);
  options.means_known = reader.header().means_known;
  slam::Audit judge(options, reader.header());
  slam::ReportSeries series;
  {
    Progress progress("auditing " + flags.run);
    std::uint64_t records = 0;
    while (const auto snapshot = reader.next()) {
      judge.take(*snapshot);
      if (!flags.html.empty()) series.take(*snapshot, judge.lastRecord());
      progress.show(std::to_string(++records) + " records");
    }
  }
  for (const std::string& warning : reader.warnings()) spdlog::warn("{}", warning);
  const slam::AuditReport report = judge.report();
  if (!flags.json.empty()) writeWhole(flags.json, slam::reportJson(report));
  if (!flags.junit.empty()) writeWhole(flags.junit, slam::reportJunit(report, flags.run, fail_on));
  if (!flags.html.empty()) writeWhole(flags.html, slam::reportHtml(report, series, flags.run));
  if (!flags.quiet) std::fputs(slam::reportText(report).c_str(), stdout);
  return slam::exitStatus(report, fail_on);
}

}  // namespace

void addAudit(CLI::App& program) {
  const auto flags = std::make_shared<AuditFlags>();
  CLI::App* verb = program.add_subcommand(
      "audit", "check a run by the laws that a correct EKF-SLAM obeys; name the feature at fault");
  verb->footer(kAuditHelp);
  verb->add_option("RUN", flags->run,
                   "run to judge (.jsonl, .jsonl.zst, .npz, .npy, .mat, MRPT's directory; - is "
                   "standard input)")
      ->required();
  verb->add_option("--json", flags->json, "the report as JSON");
  verb->add_option("--junit", flags->junit, "the report as JUnit XML, a test case a law");
  verb->add_option("--html", flags->html, "the report as a page with plots, for a browser");
  verb->add_option("--allow", flags->allow, "laws that the filter breaks by design, see below")
      ->delimiter(',');
  verb->add_option("--fail-on", flags->fail_on,
                   "classes that make exit status 1: code, statistics, linearisation, none")
      ->delimiter(',');
  verb->add_option("--alpha", flags->alpha, "family-wise error of all statistical laws, per run")
      ->check(CLI::Range(1e-12, 0.5));
  verb->add_flag("--quiet", flags->quiet, "no text, exit status and files only");
  verb->callback([flags] {
    const int status = audit(*flags);
    if (status != 0) throw CLI::RuntimeError(status);
  });
}

}  // namespace slamscope::apps

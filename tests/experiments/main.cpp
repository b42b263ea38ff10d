// SPDX-License-Identifier: MIT
// slamscope_experiments: the tables of what the audit finds and of what it wrongly finds, and of
// what association makes of an ambiguous world, how consistent the models are, how well heads are
// tracked.
#include <CLI/CLI.hpp>

#include "tests/experiments/association_table.hpp"
#include "tests/experiments/consistency_table.hpp"
#include "tests/experiments/fault_table.hpp"
#include "tests/experiments/healthy_table.hpp"
#ifdef SLAMSCOPE_VIEW
#include "tests/experiments/tracking_table.hpp"
#include "tests/experiments/written_walk.hpp"
#endif

int main(int argc, char** argv) {
  namespace experiments = slamscope::slam::experiments;
  CLI::App app{"Experiments on audit, association, consistency and tracking"};
  app.require_subcommand(1);
  CLI::App* audit = app.add_subcommand("audit", "faults found, false alarms, lawful variants");
  experiments::FaultTableOptions faults;
  experiments::HealthyTableOptions healthy;
  experiments::HealthyTableOptions variants;
  variants.runs = 20;
  audit->add_option("--seeds", faults.seeds, "runs of each fault and kind of update")
      ->capture_default_str();
  audit->add_option("--fault", faults.faults, "only these faults");
  audit->add_option("--healthy", healthy.runs, "runs of correct filters")->capture_default_str();
  audit->add_option("--first", healthy.first, "number of the first of them")->capture_default_str();
  audit->add_option("--variant", variants.only, "only this lawful variant");
  audit->add_option("--variants", variants.runs, "runs of each lawful variant")
      ->capture_default_str();
  audit->add_option("--alpha", healthy.alpha, "family-wise error of the statistical laws")
      ->capture_default_str();
  audit->add_option("--threads", healthy.threads, "0: one per core")->capture_default_str();
#ifdef SLAMSCOPE_VIEW
  slamscope::tracking::experiments::TrackingTableOptions tracking;
  CLI::App* track =
      app.add_subcommand("tracking", "how well heads are tracked: the table T3 to T14");
  track->add_option("--frames", tracking.frames, "of each walk through the lab")
      ->capture_default_str();
  track->add_option("--trials", tracking.trials, "of what needs no pictures")
      ->capture_default_str();
  track->add_flag("--pictures,!--no-pictures", tracking.pictures,
                  "the walks through the lab at all");
  slamscope::tracking::experiments::WrittenWalkOptions written;
  CLI::App* walk =
      app.add_subcommand("walk", "a walk through the lab as if recorded, for slamscope hmd");
  walk->add_option("folder", written.folder, "where to write it")->required();
  walk->add_option("--pairs", written.pairs, "of pictures")->capture_default_str();
  walk->add_option("--fps", written.fps, "pairs a second")->capture_default_str();
#endif
  CLI::App* association =
      app.add_subcommand("association", "nearest and joint in an ambiguous world");
  experiments::AssociationTableOptions ambiguous;
  association->add_option("--seeds", ambiguous.seeds, "runs of each line")->capture_default_str();
  association->add_option("--hypotheses", ambiguous.hypotheses, "maps side by side")
      ->capture_default_str();
  association->add_option("--threads", ambiguous.threads, "0: one per core")->capture_default_str();
  CLI::App* consistency = app.add_subcommand("consistency", "NIS and ANEES over the models");
  experiments::ConsistencyTableOptions models;
  consistency->add_option("--runs", models.runs, "of each line")->capture_default_str();
  consistency->add_option("--loops", models.loops, "driven in each run")->capture_default_str();
  consistency->add_option("--threads", models.threads, "0: one per core")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
#ifdef SLAMSCOPE_VIEW
  if (*walk) {
    slamscope::tracking::experiments::writeWalk(written);
    return 0;
  }
  if (*track) return slamscope::tracking::experiments::printTrackingTable(tracking) == 0 ? 0 : 1;
#endif
  if (*consistency) return experiments::printConsistencyTable(models) == 0 ? 0 : 1;
  if (*association) return experiments::printAssociationTable(ambiguous) == 0 ? 0 : 1;
  faults.alpha = variants.alpha = healthy.alpha;
  faults.threads = variants.threads = healthy.threads;
  int wrong_verdicts = 0;
  if (faults.seeds > 0) experiments::printFaultTable(faults);
  if (healthy.runs > 0) wrong_verdicts += experiments::printHealthyTable(healthy);
  if (variants.runs > 0) wrong_verdicts += experiments::printVariantTable(variants);
  return wrong_verdicts == 0 ? 0 : 1;
}

// SPDX-License-Identifier: MIT
// slamscope_bench, with the program's own way of handling memory.
#include <benchmark/benchmark.h>

#include "apps/lib/freed_memory.hpp"

int main(int argc, char** argv) {
  slamscope::apps::keepFreedMemory();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

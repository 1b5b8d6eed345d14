// SPDX-License-Identifier: Apache-2.0
//
// Options are Google Benchmark's. Exits 3 on an option that is not, and where there was nothing to measure.
#include <benchmark/benchmark.h>

#include "bench/bench.h"

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 3;
  return noli::bench::run() ? 0 : 3;
}

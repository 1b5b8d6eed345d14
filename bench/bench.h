// SPDX-License-Identifier: Apache-2.0
//
// What a benchmark program is made of: bench/main.cpp, and one definition of run().
#pragma once

namespace noli::bench {

/// Registers and runs the benchmarks and prints the tables. Returns whether there was anything to measure.
bool run();

}  // namespace noli::bench

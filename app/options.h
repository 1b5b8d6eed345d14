// SPDX-License-Identifier: Apache-2.0
//
// Options that several commands have, in the same words.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "app/output.h"

namespace noli::app {

/// --json OUT, --porcelain, -q, -v: what Output writes where.
void add_output_options(CLI::App& command, OutputOptions& options);

/// --threads N: 0 for all there are.
void add_threads_option(CLI::App& command, int& threads);

/// Accepts whole numbers from least to greatest, in decimal digits only: what CLI11 makes of signs, leading zeros and
/// numbers that do not fit is not what a reader would expect.
CLI::Validator whole_number(std::uint64_t least, std::uint64_t greatest);

/// Accepts numbers above 0 that are finite.
CLI::Validator is_positive();

/// Accepts 0 too.
CLI::Validator is_not_negative();

/// Accepts 0, 1, 2, ...
CLI::Validator is_count();

/// Accepts 2 and 3.
CLI::Validator is_dimension();

}  // namespace noli::app

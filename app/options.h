// SPDX-License-Identifier: Apache-2.0
//
// Options that several commands have, in the same words.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "app/output.h"
#include "trajectory/formats/frame_order.h"
#include "trajectory/formats/polygons.h"

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

/// Accepts numbers from 0 to 1.
CLI::Validator is_share();

/// Accepts 2 and 3.
CLI::Validator is_dimension();

/// "60s", "1.5m", "500ms", "2h"; a bare number is seconds. Positive, at most ten years.
/// Throws UsageError, naming `option`, for anything else.
std::chrono::nanoseconds parse_duration(const std::string& text, const std::string& option);

/// --time-limit TIME, kept as text.
void add_time_limit_option(CLI::App& command, std::string& text,
                           const std::string& help = "Stop after this time, undecided: 500ms, 60s, 5m, 1h");

/// The work of a command begins: from now on Ctrl-C is heard everywhere, and so is the time limit, if `text` is not
/// empty. Returns when that is. Throws UsageError for a text that is no duration.
std::optional<std::chrono::steady_clock::time_point> begin_work(const std::string& text);

/// One of several parts of some work.
struct ShardNumber {
  std::uint64_t number = 1, of = 1;
};

/// "3/64". Throws UsageError for anything but K/N with 1 <= K <= N.
ShardNumber parse_shard(const std::string& text);

/// --order natural | given; neither: the order given has to be that of the numbers in the names.
void add_order_option(CLI::App& command, FrameOrder& order);

/// --keys POSITIONS,FACES
void add_keys_option(CLI::App& command, std::vector<std::string>& keys);

/// --polygons fan | refuse
void add_polygons_option(CLI::App& command, PolygonRule& polygons);

}  // namespace noli::app

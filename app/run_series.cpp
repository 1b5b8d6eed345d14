// SPDX-License-Identifier: Apache-2.0
#include "noli/app/run_series.h"

#include <stdexcept>

#include "noli/trajectory/bytes.h"
#include "noli/trajectory/error.h"

namespace noli::app {
namespace {

constexpr std::size_t reals = 3 + 3 * integrator::force_kinds + 6, counts = 3;

/// Calls f on each real of a row, in order.
template <class Row, class F>
void each_real(Row& row, F&& f) {
  f(row.time);
  f(row.kinetic);
  f(row.kinetic_mean);
  for (auto* list : {&row.potential, &row.work, &row.damping_work}) {
    for (auto& x : *list) f(x);
  }
  for (auto* list : {&row.momentum, &row.angular_momentum}) {
    for (auto& x : *list) f(x);
  }
}

}  // namespace

std::string encode(const SeriesRow& row) {
  std::string bytes;
  each_real(row, [&bytes](double x) { put(bytes, x); });
  put(bytes, row.events);
  put(bytes, row.breakpoints);
  put(bytes, row.halvings);
  return bytes;
}

SeriesRow decode_row(std::string_view bytes) {
  if (bytes.size() != 8 * (reals + counts)) throw std::invalid_argument("a window's series has another size");
  SeriesRow row;
  const char* at = bytes.data();
  const auto take = [&at]<class T>(T& value) {
    value = get<T>(at);
    at += sizeof(T);
  };
  each_real(row, take);
  take(row.events);
  take(row.breakpoints);
  take(row.halvings);
  return row;
}

SeriesRow row_of(const RunWindow& window, const std::filesystem::path& run) {
  try {
    return decode_row(window.state);
  } catch (const std::invalid_argument& error) {
    throw InputError(trajectory_path(run).string(), "",
                     "the state of window " + std::to_string(window.index) + ": " + error.what());
  }
}

}  // namespace noli::app

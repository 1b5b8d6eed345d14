// SPDX-License-Identifier: Apache-2.0
#include "noli/app/run_series.h"

#include <bit>
#include <stdexcept>

namespace noli::app {
namespace {

constexpr std::size_t reals = 3 + 3 * integrator::force_kinds + 6, counts = 2;

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

void append(std::string& bytes, std::uint64_t word) {
  for (int i = 0; i < 8; ++i) bytes += static_cast<char>(word >> (8 * i) & 0xff);
}

std::uint64_t word_at(std::string_view bytes, std::size_t index) {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    word |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[8 * index + i])) << (8 * i);
  }
  return word;
}

}  // namespace

std::string encode(const SeriesRow& row) {
  std::string bytes;
  each_real(row, [&bytes](double x) { append(bytes, std::bit_cast<std::uint64_t>(x)); });
  append(bytes, row.events);
  append(bytes, row.breakpoints);
  return bytes;
}

SeriesRow decode_row(std::string_view bytes) {
  if (bytes.size() != 8 * (reals + counts)) throw std::invalid_argument("a window's series has another size");
  SeriesRow row;
  std::size_t index = 0;
  each_real(row, [&](double& x) { x = std::bit_cast<double>(word_at(bytes, index++)); });
  row.events = word_at(bytes, reals);
  row.breakpoints = word_at(bytes, reals + 1);
  return row;
}

}  // namespace noli::app

// SPDX-License-Identifier: Apache-2.0
//
// Fuzzes the reader of query files: any bytes give an InputError of one line, or queries that stay the same, bit for
// bit, when written and read again.
#include "check_frame.h"
#include "trajectory/formats/query_csv.h"

namespace {

using noli::fuzz::require;

bool same_bits(const std::array<noli::Position, 4>& a, const std::array<noli::Position, 4>& b) {
  using Bits = std::array<std::uint64_t, 12>;
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

void check_round_trip(const std::vector<noli::QueryRecord>& queries, noli::QueryKind kind) {
  const auto again = noli::parse_query_csv(noli::format_query_csv(kind, queries), "written", kind);
  require(again.size() == queries.size());
  for (std::size_t i = 0; i < queries.size(); ++i) {
    require(again[i].label == queries[i].label);
    require(same_bits(again[i].x_t0, queries[i].x_t0) && same_bits(again[i].x_t1, queries[i].x_t1));
  }
}

void check_kind(std::string_view text, noli::QueryKind kind) {
  std::vector<noli::QueryRecord> queries;
  try {
    queries = noli::parse_query_csv(text, "input", kind);
  } catch (const noli::InputError& error) {
    const std::string_view message = error.what();
    require(message.starts_with("input: ") && message.find('\n') == std::string_view::npos);
    return;
  }
  check_round_trip(queries, kind);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  check_kind(text, noli::QueryKind::vertex_face);
  check_kind(text, noli::QueryKind::vertex_edge);
  check_kind(text, noli::QueryKind::vertex_vertex);
  return 0;
}

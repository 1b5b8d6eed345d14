// SPDX-License-Identifier: Apache-2.0
//
// Fuzzes the predicates: for any query, kernel and oracle agree on contact, kind and first time.
//
// Input: a byte for the pair of features, the dimension and the coding of coordinates, then the coordinates of the
// points at t = 0, then those at t = 1. Missing bytes are 0.
//   coded   three bytes each: small integers in units of a power of two, perhaps an ulp off. Coincidences are likely.
//   raw     eight bytes each: a double. If it is not finite, its exponent is cleared.
// Or a file of `noli fuzz queries --corpus`: the rows of a query as CSV and the line that describes it.
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string_view>

#include <noli/contact.h>
#include <noli/errors.h>
#include <noli/time_of_impact.h>
#include "audit/fuzz/queries/saved_query.h"
#include "certify/queries/any_query.h"
#include "oracle/oracle.h"
#include "tests/kernel/oracle_motion.h"
#include "trajectory/formats/query_csv.h"

namespace {

using noli::FeaturePair;

void require(bool condition) {
  if (!condition) std::abort();
}

class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  std::uint8_t next() { return at_ < size_ ? data_[at_++] : std::uint8_t{0}; }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

double raw_coordinate(Bytes& bytes) {
  std::uint64_t bits = 0;
  for (int i = 0; i < 8; ++i) bits |= static_cast<std::uint64_t>(bytes.next()) << (8 * i);
  const double value = std::bit_cast<double>(bits);
  return std::isfinite(value) ? value : std::bit_cast<double>(bits & ~(std::uint64_t{0x7ff} << 52));
}

double coded_coordinate(Bytes& bytes) {
  const auto integer = static_cast<std::int8_t>(bytes.next());
  const auto exponent = static_cast<std::int8_t>(bytes.next());
  const std::uint8_t ulp = bytes.next();
  const double value = std::ldexp(static_cast<double>(integer), exponent);
  if (ulp == 1) return std::nextafter(value, std::numeric_limits<double>::max());
  return ulp == 2 ? std::nextafter(value, std::numeric_limits<double>::lowest()) : value;
}

template <FeaturePair Pair, int Dim>
noli::Query<Pair, Dim> decode(Bytes& bytes, bool raw) {
  noli::Query<Pair, Dim> query{};
  for (auto* points : {&query.x_t0, &query.x_t1}) {
    for (auto& point : *points) {
      for (double& x : point) x = raw ? raw_coordinate(bytes) : coded_coordinate(bytes);
    }
  }
  return query;
}

template <FeaturePair Pair, int Dim>
void compare(const noli::Query<Pair, Dim>& query) {
  const noli::oracle::Answer truth = noli::oracle::first_contact(noli::test::motion_of(query));
  const auto enclosure = noli::contact(query);
  const auto first = noli::first_contact(query);
  require(enclosure.has_value() == truth.time.has_value());
  require(first.has_value() == truth.time.has_value());
  if (!truth.time) return;
  require(truth.time->compare(enclosure->begin) >= 0 && truth.time->compare(enclosure->end) <= 0);
  require(noli::name(first->kind) == noli::oracle::name(truth.kind));
  require(first->time.lower() == truth.time->lower());
}

template <FeaturePair Pair, int Dim>
void compare(Bytes& bytes, bool raw) {
  compare(decode<Pair, Dim>(bytes, raw));
}

/// Compares the queries of a text; false if the input is not such a text.
bool compare_text(std::string_view text) {
  const auto type = noli::audit::saved_type(text);
  if (!type) return false;
  try {
    for (const noli::QueryRecord& record : noli::parse_query_csv(text, "input", noli::file_kind(type->pair))) {
      const noli::AnyQuery query{type->pair, type->dimension, record.x_t0, record.x_t1};
      noli::visit(query, [](const auto& typed) { compare(typed); });
    }
  } catch (const noli::InputError&) {
    return false;
  }
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (compare_text({reinterpret_cast<const char*>(data), size})) return 0;
  Bytes bytes(data, size);
  const std::uint8_t head = bytes.next();
  const bool raw = (head & 8) != 0;
  switch (head % 6) {
    case 0: compare<FeaturePair::vertex_face, 3>(bytes, raw); break;
    case 1: compare<FeaturePair::edge_edge, 3>(bytes, raw); break;
    case 2: compare<FeaturePair::vertex_edge, 3>(bytes, raw); break;
    case 3: compare<FeaturePair::vertex_vertex, 3>(bytes, raw); break;
    case 4: compare<FeaturePair::vertex_edge, 2>(bytes, raw); break;
    default: compare<FeaturePair::vertex_vertex, 2>(bytes, raw); break;
  }
  return 0;
}

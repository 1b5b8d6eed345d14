// SPDX-License-Identifier: Apache-2.0
//
// Splits a group of cells at the median.
//
// Notation
//   entry    a cell with its sort keys, one integer for each axis
//   before   by the integer of the axis, then by the number of the cell. No two entries of a group compare equal, so
//            nothing else decides which entries come before the middle
//
// A quickselect as in Floyd and Rivest, "Expected time bounds for selection" (1975): the pivot is taken from a sample,
// a little beyond the middle, so that two passes are usually enough. A pass has no branch that depends on the entries,
// as processors could not predict it.
//
// Both sides are left in unspecified order.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace noli {

/// Lanes: the integers of the axes, then the number of the cell. One vector, so that it is moved at once.
using Entry = std::int32_t __attribute__((vector_size(16)));

inline std::uint32_t cell_in(const Entry& e) { return static_cast<std::uint32_t>(e[3]); }

/// Maps floats (except NaN) to integers in the same order; 0 and -0 give the same integer.
inline std::int32_t ordered(float x) {
  const auto bits = std::bit_cast<std::int32_t>(x + 0.0F);
  return bits ^ (bits >> 31 & 0x7fffffff);
}

/// The inverse of ordered().
inline float from_ordered(std::int32_t i) { return std::bit_cast<float>(i ^ (i >> 31 & 0x7fffffff)); }

namespace detail {

template <std::size_t Axis>
std::int64_t key(const Entry& e) {
  return static_cast<std::int64_t>(e[Axis]) << 32 | cell_in(e);
}

template <std::size_t Axis>
bool before(const Entry& a, const Entry& b) {
  return key<Axis>(a) < key<Axis>(b);
}

/// Moves the entries before the pivot to the front; returns where they end.
template <std::size_t Axis>
Entry* partition(Entry* first, Entry* last, std::int64_t pivot) {
  Entry* end = first;
  for (Entry* i = first; i != last; ++i) {
    const Entry e = *i;
    *i = *end;
    *end = e;
    end += key<Axis>(e) < pivot ? 1 : 0;
  }
  return end;
}

/// An entry of about the given rank (0 to 1) in [first, last), from a sample of Size.
template <std::size_t Axis, std::size_t Size>
std::int64_t sampled(const Entry* first, const Entry* last, double rank) {
  std::array<std::int64_t, Size> sample;
  const auto count = static_cast<std::size_t>(last - first);
  for (std::size_t i = 0; i < Size; ++i) sample[i] = key<Axis>(first[(2 * i + 1) * count / (2 * Size)]);
  const auto at = sample.begin() + static_cast<std::ptrdiff_t>(rank * (Size - 1));
  std::nth_element(sample.begin(), at, sample.end());
  return *at;
}

template <std::size_t Axis>
void insertion_sort(Entry* first, Entry* last) {
  for (Entry* i = first; i != last; ++i) {
    const Entry e = *i;
    Entry* j = i;
    for (; j != first && before<Axis>(e, j[-1]); --j) *j = j[-1];
    *j = e;
  }
}

/// Moves the entries that come before the one at `middle` in order to [first, middle). Precondition: middle is in
/// [first, last).
template <std::size_t Axis>
void split_at(Entry* first, Entry* middle, Entry* last) {
  constexpr std::ptrdiff_t few = 16, many = 512;
  for (int passes = 0; last - first > few; ++passes) {
    if (passes == 40) return std::nth_element(first, middle, last, before<Axis>);  // samples were bad every time
    const std::ptrdiff_t size = last - first;
    const double rank = static_cast<double>(middle - first) / static_cast<double>(size);
    // Beyond the middle by a little more than the error of the sample, towards the larger side.
    const double margin = size > many ? 0.06 : 0.12;
    const double aim = std::clamp(rank < 0.5 ? rank + margin : rank - margin, 0.0, 1.0);
    const std::int64_t pivot = size > many ? sampled<Axis, 63>(first, last, aim) : sampled<Axis, 7>(first, last, aim);
    Entry* const end = partition<Axis>(first, last, pivot);
    if (end == first) {
      // the pivot is the first of all
      std::swap(*first, *std::find_if(first, last, [pivot](const Entry& e) { return key<Axis>(e) == pivot; }));
      if (middle == first) return;
      ++first;
    } else if (middle < end) {
      last = end;
    } else {
      first = end;
    }
  }
  insertion_sort<Axis>(first, last);
}

}  // namespace detail

/// The same along an axis that is known only at run time.
inline void split_at(Entry* first, Entry* middle, Entry* last, std::size_t axis) {
  if (axis == 0) return detail::split_at<0>(first, middle, last);
  return axis == 1 ? detail::split_at<1>(first, middle, last) : detail::split_at<2>(first, middle, last);
}

}  // namespace noli

// SPDX-License-Identifier: Apache-2.0
#include "trajectory/formats/arrays/array_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include <noli/errors.h>
#include "trajectory/text.h"

namespace noli {
namespace {

using Arrays = std::vector<const StoredArray*>;

bool is_real(const NpyHeader& header) { return header.kind == NpyHeader::Kind::real; }

bool is_coordinates(std::uint64_t n) { return n == 2 || n == 3; }

bool holds_frames(const StoredArray& array) {
  const auto& shape = array.header.shape;
  return is_real(array.header) && shape.size() == 3 && is_coordinates(shape[2]);
}

bool holds_one_frame(const StoredArray& array) { return is_one_frame(array.header); }

/// Of so many corners each; 1 is one number for each cell.
bool has_corners(const NpyHeader& header, std::uint64_t corners) {
  using Kind = NpyHeader::Kind;
  if (header.kind != Kind::signed_integer && header.kind != Kind::unsigned_integer) return false;
  return corners == 1 ? header.shape.size() == 1 : header.shape.size() == 2 && header.shape[1] == corners;
}

class Choice {
 public:
  Choice(const std::vector<StoredArray>& arrays, const std::string& where) : arrays_(arrays), where_(where) {}

  ChosenArrays operator()(const std::vector<std::string>& keys) {
    if (keys.empty()) {
      // One that is damaged might be the positions, or the faces.
      for (const StoredArray& array : arrays_) {
        if (!array.fault.empty())
          throw InputError(array.name, "", array.fault + "; --keys POSITIONS,FACES leaves it out");
      }
      chosen_.positions = the_positions();
      chosen_.cells = the_cells();
      require_no_doubt();
    } else {
      chosen_.positions = {&named(keys[0])};
      for (std::size_t i = 1; i < keys.size(); ++i) chosen_.cells.push_back(&named(keys[i]));
    }
    require_shapes();
    return chosen_;
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    constexpr std::size_t most_listed = 20;
    std::vector<std::string> there;
    for (const StoredArray& array : arrays_) {
      if (there.size() == most_listed) break;
      there.push_back(on_one_line(array.key) + " " + (array.fault.empty() ? array.header.text() : "(damaged)"));
    }
    const std::size_t more = arrays_.size() - there.size();
    throw InputError(where_, "",
                     fmt::format("{}; there {} {}{}", problem, arrays_.size() == 1 ? "is" : "are",
                                 there.empty() ? "no arrays" : fmt::format("{}", fmt::join(there, ", ")),
                                 more > 0 ? fmt::format(" and {} more", more) : ""));
  }

  template <class Fits>
  Arrays that(const Fits& fits) const {
    Arrays found;
    for (const StoredArray& array : arrays_) {
      if (fits(array)) found.push_back(&array);
    }
    return found;
  }

  const StoredArray& named(const std::string& key) const {
    const Arrays found = that([&](const StoredArray& array) { return array.key == key; });
    if (found.empty()) fail(fmt::format("--keys: there is no array {}", in_quotes(key)));
    if (found.size() > 1) fail(fmt::format("--keys: there are {} arrays {}", found.size(), in_quotes(key)));
    for (const std::string& why : {found[0]->fault, found[0]->header.refusal}) {
      if (!why.empty()) throw InputError(found[0]->name, "", why);
    }
    return *found[0];
  }

  Arrays the_positions() const {
    const Arrays all = that(holds_frames);
    if (all.size() == 1) return all;
    if (all.size() > 1) fail("several arrays may be the positions; name them: --keys POSITIONS,FACES");
    const Arrays frames = that(holds_one_frame);
    if (frames.empty()) fail("no array has positions, real numbers of shape (frames, vertices, 3)");
    const bool one_a_file = std::ranges::adjacent_find(frames, {}, &StoredArray::file) == frames.end();
    if (frames.size() > 1 && !one_a_file)
      fail("several arrays may be the positions; name them: --keys POSITIONS,FACES");
    return frames;
  }

  /// Faces; loose edges where there are none.
  Arrays the_cells() const {
    for (const std::uint64_t corners : {3U, 2U}) {
      const Arrays found = that([&](const StoredArray& array) { return has_corners(array.header, corners); });
      if (found.size() == 1) return found;
      if (found.size() > 1) {
        fail(fmt::format("several arrays may be the {}; name them: --keys POSITIONS,{}",
                         corners == 3 ? "faces" : "edges", corners == 3 ? "FACES" : "EDGES"));
      }
    }
    return {};
  }

  /// What was not chosen must not be cells or positions in any reading.
  void require_no_doubt() const {
    for (const StoredArray& array : arrays_) {
      if (std::ranges::count(chosen_.positions, &array) + std::ranges::count(chosen_.cells, &array) > 0) continue;
      const auto& shape = array.header.shape;
      const bool real = array.header.kind == NpyHeader::Kind::real;
      const bool may_be_cells = !real && shape.size() == 2 && shape[1] >= 2 && shape[1] <= 4;
      const bool may_be_frames = shape.size() == 3 && is_coordinates(shape[2]);
      if (!may_be_cells && !may_be_frames) continue;
      fail(fmt::format("{} may be {} too; name the arrays that count: --keys POSITIONS,FACES", on_one_line(array.key),
                       may_be_cells ? "cells" : "positions"));
    }
  }

  void require_shapes() {
    const StoredArray& first = *chosen_.positions[0];
    const bool together = holds_frames(first);
    if (!together && !holds_one_frame(first)) {
      throw InputError(
          first.name, "",
          fmt::format("is {}; expected positions, real numbers of shape (frames, vertices, 3)", first.header.text()));
    }
    for (const Arrays* const all : {&chosen_.positions, &chosen_.cells}) {
      for (const StoredArray* const array : *all) {
        if (!array->header.refusal.empty()) throw InputError(array->name, "", array->header.refusal);
      }
    }
    const auto& shape = first.header.shape;
    chosen_.frames = together ? shape[0] : chosen_.positions.size();
    chosen_.vertices = shape[together ? 1 : 0];
    chosen_.coordinates = shape.back();
    constexpr std::uint64_t most_vertices = 0xffffffff;
    if (chosen_.frames == 0 || chosen_.vertices == 0 || chosen_.vertices > most_vertices) {
      throw InputError(
          first.name, "",
          fmt::format("is {}: expected at least one frame, and 1 to {} vertices", first.header.text(), most_vertices));
    }
    for (const StoredArray* const one : chosen_.positions) {
      if (one->header.shape == shape) continue;
      throw InputError(one->name, "",
                       fmt::format("is {}, but {} is {}; all frames must have the same vertices", one->header.text(),
                                   first.name, first.header.text()));
    }
    for (const StoredArray* const cells : chosen_.cells) {
      if (is_cells(cells->header)) continue;
      throw InputError(cells->name, "",
                       fmt::format("is {}; expected cells, integers of shape (faces, 3), (edges, 2) or (points,)",
                                   cells->header.text()));
    }
  }

  const std::vector<StoredArray>& arrays_;
  const std::string& where_;
  ChosenArrays chosen_;
};

}  // namespace

bool is_one_frame(const NpyHeader& header) {
  return is_real(header) && header.shape.size() == 2 && is_coordinates(header.shape[1]);
}

bool is_cells(const NpyHeader& header) {
  return has_corners(header, 3) || has_corners(header, 2) || has_corners(header, 1);
}

ChosenArrays choose_arrays(const std::vector<StoredArray>& arrays, const std::vector<std::string>& keys,
                           const std::string& where) {
  return Choice(arrays, where)(keys);
}

}  // namespace noli

// SPDX-License-Identifier: Apache-2.0
//
// A whole pipeline on one step of a mesh: the library's search for candidates, then its query for each of them once.
// The candidates of a library that has no search are all pairs. All of it again and again, if that is asked for, to see
// whether memory grows.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

#include "noli/audit/host/library.h"
#include "noli/audit/host/resident.h"

namespace noli::audit {

class Pipeline {
 public:
  Pipeline(PipelineExchange& exchange, const Library& library) : e_(exchange), mesh_(exchange), library_(library) {}

  void run() {
    enter(e_, HostPhase::searching);
    search();
    enter(e_, HostPhase::answering);
    const double begin = seconds();
    if (e_.search_code >= 0) {
      for (const Pair& pair : pairs_) ask(pair);
    }
    e_.query_seconds = seconds() - begin;
    if (e_.repeat_seconds > 0 && e_.search_code >= 0) repeat();
    enter(e_, HostPhase::done);
  }

 private:
  struct Pair {
    std::uint32_t kind, first, second;
    friend auto operator<=>(const Pair&, const Pair&) = default;
  };

  static void take(void* data, int kind, std::uint32_t first, std::uint32_t second) {
    auto& pairs = *static_cast<std::vector<Pair>*>(data);
    if (kind == NOLI_CCD_EDGE_EDGE && first > second) std::swap(first, second);
    pairs.push_back({static_cast<std::uint32_t>(kind), first, second});
  }

  /// For half the time and for the other half, with a look at the memory before, between and after.
  void repeat() {
    enter(e_, HostPhase::repeating);
    e_.resident[0] = resident_bytes();
    const double begin = seconds();
    for (std::size_t half = 1; half <= 2; ++half) {
      const double end = begin + 0.5 * static_cast<double>(half) * e_.repeat_seconds;
      do pass();
      while (seconds() < end);
      e_.resident[half] = resident_bytes();
    }
  }

  void pass() {
    e_.calls.store(++calls_, std::memory_order_relaxed);
    e_.asked = {};
    if (library_.search != nullptr) {
      std::vector<Pair> found;
      const MeshSizes& n = e_.sizes;
      library_.search(n.vertices, mesh_.x_t0, mesh_.x_t1, n.edges, mesh_.edges, n.faces, mesh_.faces, 0, take, &found);
    }
    for (const Pair& pair : pairs_) {
      double ignored = 0;
      call(pair, ignored);
    }
  }

  /// Keeping the pairs is in the library's time, sorting them is not.
  void search() {
    const MeshSizes& n = e_.sizes;
    const double begin = seconds();
    if (library_.search != nullptr) {
      e_.search_code = library_.search(n.vertices, mesh_.x_t0, mesh_.x_t1, n.edges, mesh_.edges, n.faces, mesh_.faces,
                                       0, take, &pairs_);
    } else {
      take_all();
    }
    e_.search_seconds = seconds() - begin;
    std::sort(pairs_.begin(), pairs_.end());
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    std::erase_if(pairs_, [&](const Pair& pair) {
      const bool bad = !is_pair(pair);
      e_.bad_pairs += bad ? 1 : 0;
      return bad;
    });
    for (const Pair& pair : pairs_) ++e_.candidates[pair.kind];
  }

  void take_all() {
    const auto add = [&](const Pair& pair) {
      if (is_pair(pair)) pairs_.push_back(pair);
    };
    for (std::uint32_t v = 0; v < e_.sizes.vertices; ++v) {
      for (std::uint32_t f = 0; f < e_.sizes.faces; ++f) add({NOLI_CCD_VERTEX_FACE, v, f});
    }
    for (std::uint32_t a = 0; a < e_.sizes.edges; ++a) {
      for (std::uint32_t b = a + 1; b < e_.sizes.edges; ++b) add({NOLI_CCD_EDGE_EDGE, a, b});
    }
  }

  /// Two features that are there and share no vertex.
  bool is_pair(const Pair& pair) const {
    const bool edges = pair.kind == NOLI_CCD_EDGE_EDGE;
    if (!edges && pair.kind != NOLI_CCD_VERTEX_FACE) return false;
    if (pair.first >= (edges ? e_.sizes.edges : e_.sizes.vertices)) return false;
    if (pair.second >= (edges ? e_.sizes.edges : e_.sizes.faces)) return false;
    const std::array<std::uint32_t, 4> v = vertices(pair);
    if (edges) return v[0] != v[2] && v[0] != v[3] && v[1] != v[2] && v[1] != v[3];
    return v[0] != v[1] && v[0] != v[2] && v[0] != v[3];
  }

  std::array<std::uint32_t, 4> vertices(const Pair& pair) const {
    if (pair.kind == NOLI_CCD_EDGE_EDGE) {
      const std::uint32_t *const a = mesh_.edges + 2 * std::size_t{pair.first}, *const b = mesh_.edges +
                                                                                           2 * std::size_t{pair.second};
      return {a[0], a[1], b[0], b[1]};
    }
    const std::uint32_t* const f = mesh_.faces + 3 * std::size_t{pair.second};
    return {pair.first, f[0], f[1], f[2]};
  }

  /// Leaves word of what is under way.
  int call(const Pair& pair, double& time) {
    const std::array<std::uint32_t, 4> v = vertices(pair);
    AskedQuery query{};
    for (std::size_t i = 0; i < 4; ++i) {
      std::copy_n(mesh_.x_t0 + 3 * std::size_t{v[i]}, 3, query.x_t0.begin() + 3 * i);
      std::copy_n(mesh_.x_t1 + 3 * std::size_t{v[i]}, 3, query.x_t1.begin() + 3 * i);
    }
    e_.asked = named(pair);
    e_.calls.store(++calls_, std::memory_order_relaxed);
    time = std::numeric_limits<double>::quiet_NaN();
    return library_.ask(static_cast<int>(pair.kind), query.x_t0.data(), query.x_t1.data(), e_.tolerance, &time);
  }

  static MeshPair named(const Pair& pair) { return {pair.kind, pair.first, pair.second, 1}; }

  void ask(const Pair& pair) {
    double time = 0;
    const int code = call(pair, time);
    MeshContact* const contact = contact_of(pair);
    if (contact != nullptr) contact->found = 1;
    if (code != NOLI_CCD_HIT && code != NOLI_CCD_NO_HIT) {
      if (e_.failures++ == 0) e_.failed = named(pair);
      if (contact != nullptr) contact->failed = 1;
    }
    if (code != NOLI_CCD_HIT) return;
    e_.told = std::min(e_.told, std::isnan(time) ? 0 : time);
    if (contact == nullptr) {
      if (e_.false_positive.known == 0) e_.false_positive = named(pair);
      ++e_.false_positives[pair.kind];
    } else {
      contact->hit = 1;
      contact->time = time;
    }
  }

  /// Pairs come in the order of the contacts.
  MeshContact* contact_of(const Pair& pair) {
    const auto key = [](const MeshContact& c) { return Pair{c.kind, c.first, c.second}; };
    while (next_ < e_.sizes.contacts && key(mesh_.contacts[next_]) < pair) ++next_;
    const bool meets = next_ < e_.sizes.contacts && key(mesh_.contacts[next_]) == pair;
    return meets ? mesh_.contacts + next_ : nullptr;
  }

  PipelineExchange& e_;
  MeshArrays mesh_;
  Library library_;
  std::vector<Pair> pairs_;
  std::uint64_t calls_ = 0, next_ = 0;
};

}  // namespace noli::audit

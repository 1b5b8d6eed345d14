// SPDX-License-Identifier: Apache-2.0
//
// A whole pipeline on one step of a mesh: the library's search for candidates, then its query for each of them once.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

#include "noli/audit/host/library.h"

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

  /// Keeping the pairs is in the library's time, sorting them is not.
  void search() {
    const MeshSizes& n = e_.sizes;
    const double begin = seconds();
    e_.search_code = library_.search(n.vertices, mesh_.x_t0, mesh_.x_t1, n.edges, mesh_.edges, n.faces, mesh_.faces, 0,
                                     take, &pairs_);
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

  void ask(const Pair& pair) {
    const std::array<std::uint32_t, 4> v = vertices(pair);
    AskedQuery query{};
    for (std::size_t i = 0; i < 4; ++i) {
      std::copy_n(mesh_.x_t0 + 3 * std::size_t{v[i]}, 3, query.x_t0.begin() + 3 * i);
      std::copy_n(mesh_.x_t1 + 3 * std::size_t{v[i]}, 3, query.x_t1.begin() + 3 * i);
    }
    e_.calls.store(++calls_, std::memory_order_relaxed);
    double time = std::numeric_limits<double>::quiet_NaN();
    const int code =
        library_.ask(static_cast<int>(pair.kind), query.x_t0.data(), query.x_t1.data(), e_.tolerance, &time);
    MeshContact* const contact = contact_of(pair);
    if (contact != nullptr) contact->found = 1;
    if (code != NOLI_CCD_HIT && code != NOLI_CCD_NO_HIT) {
      ++e_.failures;
      if (contact != nullptr) contact->failed = 1;
    }
    if (code != NOLI_CCD_HIT) return;
    if (contact == nullptr) {
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

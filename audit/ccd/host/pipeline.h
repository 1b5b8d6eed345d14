// SPDX-License-Identifier: Apache-2.0
//
// A whole pipeline on one step of a mesh: the library's search for candidates, then its query for each of them once.
// The candidates of a library that has no search are all pairs. All of it again and again, if that is asked for, to see
// whether memory grows.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

#include "audit/ccd/host/library.h"

namespace noli::audit {

class Pipeline {
 public:
  /// `memory`: the descriptor of the file in which the exchange is.
  Pipeline(PipelineExchange& exchange, int memory, const Library& library)
      : e_(exchange), memory_(memory), mesh_(exchange), library_(library) {}

  void run() {
    enter(e_, HostPhase::searching);
    search();
    enter(e_, HostPhase::answering);
    const double begin = seconds();
    if (e_.search_code >= 0) {
      for (std::size_t i = 0; i < pairs_.size(); ++i) {
        if (is_pair(pairs_[i])) ask(i);
      }
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

  void repeat() {
    enter(e_, HostPhase::repeating);
    repeat_in_halves(e_, [this] {
      pass();
      return true;
    });
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
      if (is_pair(pair)) call(pair, ignored);
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
    make_room_for_answers();
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

  const std::uint32_t* edge(std::uint32_t e) const { return mesh_.edges + 2 * std::size_t{e}; }
  const std::uint32_t* face(std::uint32_t f) const { return mesh_.faces + 3 * std::size_t{f}; }
  bool is_pair(const Pair& pair) const {
    return audit::is_pair(
        pair, e_.sizes, [this](auto e) { return edge(e); }, [this](auto f) { return face(f); });
  }

  /// Behind what was asked.
  void make_room_for_answers() {
    const std::size_t begin = exchange_bytes(e_.sizes), size = begin + pairs_.size() * sizeof(PairAnswer);
    if (::ftruncate(memory_, static_cast<off_t>(size)) != 0) std::_Exit(out_of_memory);
    void* const all = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, memory_, 0);
    if (all == MAP_FAILED) std::_Exit(out_of_memory);
    answers_ = reinterpret_cast<PairAnswer*>(static_cast<char*>(all) + begin);
    for (std::size_t i = 0; i < pairs_.size(); ++i)
      answers_[i] = {0, pairs_[i].kind, pairs_[i].first, pairs_[i].second};
    e_.candidates = pairs_.size();
  }

  std::array<std::uint32_t, 4> vertices(const Pair& pair) const {
    if (pair.kind == NOLI_CCD_EDGE_EDGE) {
      const std::uint32_t *const a = edge(pair.first), *const b = edge(pair.second);
      return {a[0], a[1], b[0], b[1]};
    }
    const std::uint32_t* const f = face(pair.second);
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
    e_.asked = {pair.kind, pair.first, pair.second, 1};
    e_.calls.store(++calls_, std::memory_order_relaxed);
    time = std::numeric_limits<double>::quiet_NaN();
    return library_.ask(static_cast<int>(pair.kind), query.x_t0.data(), query.x_t1.data(), e_.tolerance, &time);
  }

  void ask(std::size_t i) {
    double time = 0;
    const int code = call(pairs_[i], time);
    answers_[i].code = code;
    answers_[i].time = time;
    answers_[i].answered = 1;
  }

  static constexpr int out_of_memory = 4;

  PipelineExchange& e_;
  int memory_;
  MeshArrays mesh_;
  Library library_;
  std::vector<Pair> pairs_;
  PairAnswer* answers_ = nullptr;  ///< of pairs_
  std::uint64_t calls_ = 0;
};

}  // namespace noli::audit

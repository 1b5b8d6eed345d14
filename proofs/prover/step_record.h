// SPDX-License-Identifier: Apache-2.0
//
// Steps kept for later: each task of a parallel verification records its own, and they are played in the order of the
// tasks.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "proofs/prover/events.h"

namespace noli {

/// A list of steps (proofs/prover/events.h), or, when switched off, nothing at no cost.
class StepRecord {
 public:
  explicit StepRecord(bool on) : on_(on) {}
  bool on() const { return on_; }
  std::size_t size() const { return steps_.size(); }

  void split_self() { add(Kind::split_self); }
  void split_first() { add(Kind::split_first); }
  void split_second() { add(Kind::split_second); }
  void halve() { add(Kind::halve); }
  void empty() { add(Kind::empty); }
  void cell() { add(Kind::cell); }
  void features() { add(Kind::features); }
  void at_begin(bool meet) { add(meet ? Kind::meets_at_begin : Kind::apart_at_begin); }
  void drop_vertex(VertexId v) {
    if (on_) steps_.push_back({Kind::drop_vertex, {}, {v}, {}});
  }
  void direction(const std::array<double, 3>& n) {
    if (on_) steps_.push_back({Kind::direction, {}, {}, n});
  }
  void decided(FeaturePair pair, const std::array<VertexId, 4>& vertices, bool contact) {
    if (on_) steps_.push_back({contact ? Kind::contact : Kind::apart, pair, vertices, {}});
  }

  /// Forgets all steps from number `size` on.
  void truncate(std::size_t size) { steps_.resize(size); }
  /// Tells the steps [begin, end) to `sink`, in order.
  void play(std::size_t begin, std::size_t end, StepSink& sink) const;
  void play(StepSink& sink) const { play(0, size(), sink); }
  /// Gives the memory back.
  void release() { std::vector<Step>().swap(steps_); }

 private:
  enum class Kind : std::uint8_t {
    split_self,
    split_first,
    split_second,
    drop_vertex,
    halve,
    direction,
    empty,
    cell,
    apart,
    contact,
    apart_at_begin,
    meets_at_begin,
    features
  };
  struct Step {
    Kind kind{};
    FeaturePair pair{};
    std::array<VertexId, 4> vertices{};
    std::array<double, 3> n{};
  };
  static void tell(const Step& step, StepSink& sink);
  void add(Kind kind) {
    if (on_) steps_.push_back({kind, {}, {}, {}});
  }

  bool on_;
  std::vector<Step> steps_;
};

}  // namespace noli

// SPDX-License-Identifier: Apache-2.0
//
// Implements certificates literally as Algorithm 1 of Harmon et al. (2009), for comparison with certificates/cells.h,
// which does the same at a small part of the cost. Every pair of features has a slab with a failure time. Whenever the
// velocity of a vertex may have changed, the failure times of all its pairs are computed anew (lines 11 to 13).
//
// Notation: that of certificates/cells.h, and
//   failure      the first time at which one of a slab's vertices reaches its wall
//   contingent   of a vertex: the pairs that contain it
//
// There is no broad phase: memory grows with the square of the number of features.
#pragma once

#include <limits>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "certificates/decisions.h"
#include "certificates/features.h"
#include "certificates/near_pair.h"

namespace noli::certificates {

template <int Dim, class Host>
class EveryPair {
 public:
  /// Host: as in certificates/cells.h. Only Cells uses the parameters after the mesh.
  explicit EveryPair(Host& host, const Mesh& mesh, std::span<const Vector<Dim>> = {}, double = 0)
      : host_(host), decisions_(host), contingent_(mesh.vertex_count) {
    const Features features(mesh, Dim);
    const auto cells = static_cast<std::uint32_t>(features.cells().size());
    for (std::uint32_t a = 0; a < cells; ++a) {
      for (std::uint32_t b = a + 1; b < cells; ++b) {
        features.for_each_pair(a, b, [this](const Stencil& s) { add(s); });
      }
    }
    failures_.resize(pairs_.size(), never);
  }

  void start(double t) {
    for (std::size_t i = 0; i < contingent_.size(); ++i) reach_out(static_cast<VertexId>(i), t);
    for (std::uint32_t p = 0; p < pairs_.size(); ++p) repair(p, t);
  }

  void look(VertexId i, double t) {
    reach_out(i, t);
    for (const std::uint32_t p : contingent_[i]) reschedule(p, t);
  }

  double next_time() const { return queue_.empty() ? never : queue_.begin()->first; }

  void run_next() {
    ++counts_.events;
    const auto [t, p] = *queue_.begin();
    if (t > instant_) {
      instant_ = t;
      at_once_ = 0;
    }
    require_progress(++at_once_, pairs_.size());
    repair(p, t);
  }

  void drop_if_clear(const Stencil& s, std::uint16_t material, std::uint32_t l, double distance, double t) {
    if (!is_clear(host_, material, l, distance, decisions_.recording())) return;
    const std::uint32_t p = index_.at(s.key);
    if (pairs_[p].layers != l) return;
    lose_layer(host_, pairs_[p], counts_);
    repair(p, t);
  }

  const CertificateCounts& counts() const { return counts_; }

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();

  void add(const Stencil& s) {
    const std::uint16_t material = material_of(host_, s);
    if (material == no_material) return;
    const auto p = static_cast<std::uint32_t>(pairs_.size());
    pairs_.emplace_back(s, material);
    index_.emplace(s.key, p);
    for (std::size_t k = 0; k < s.size(); ++k) contingent_[s.vertices[k]].push_back(p);
    counts_.most_near = pairs_.size();
  }

  void reach_out(VertexId i, double t) { decisions_.reach_out(host_.line(i), t); }

  void repair(std::uint32_t p, double t) {
    fit_slab(host_, pairs_[p], t, decisions_.recording(), counts_);
    reschedule(p, t);
  }

  void reschedule(std::uint32_t p, double t) {
    ++counts_.plans;
    const double s = failure_time(pairs_[p], t);
    if (s == failures_[p]) return;
    if (failures_[p] != never) queue_.erase({failures_[p], p});
    failures_[p] = s;
    if (s != never) queue_.insert({s, p});
  }

  /// The failure time, at least t.
  double failure_time(const NearPair<Dim>& pair, double t) const {
    double failure = never;
    for (std::size_t k = 0; k < pair.stencil.size(); ++k) {
      const Line<Dim> line = host_.line(pair.stencil.vertices[k]);
      failure = decisions_.time_of_failure(line, pair.slab, k < pair.stencil.first(), t, failure);
    }
    return failure;
  }

  Host& host_;
  Decisions<Dim, Host> decisions_;
  std::vector<NearPair<Dim>> pairs_;
  std::unordered_map<PairKey, std::uint32_t> index_;
  std::vector<std::vector<std::uint32_t>> contingent_;
  std::vector<double> failures_;
  std::set<std::pair<double, std::uint32_t>> queue_;
  double instant_ = -never;  ///< time of the last event; at_once_ counts the events at it
  std::size_t at_once_ = 0;
  CertificateCounts counts_;
};

}  // namespace noli::certificates

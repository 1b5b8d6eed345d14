// SPDX-License-Identifier: Apache-2.0
//
// Tests certificates without physics: bodies that never meet are kicked at random times, so that they approach and
// separate as often as needed, without the cost of forces.
//
// Notation: that of certificates_bodies.h, and
//   drift     the common velocity of all boxes
//   due       the latest time of a vertex's next kick; until then it does not move past its target
//   window    all vertices are advanced to its end, as in integrator/engine.h. The record is what the engine would
//             record: fl(x + (t - t_i) v) at each change of velocity
//   fault     an error made on purpose in what certificates receive, to test the test
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <queue>
#include <set>
#include <span>
#include <stdexcept>
#include <vector>

#include "certificates/features.h"
#include "certificates/near_pair.h"
#include "certificates_bodies.h"
#include "certificates_replay.h"
#include "tests/kernel/random_numbers.h"
#include "tests/kernel/rational_motion.h"

namespace noli::certificates::test {

enum class Fault {
  none,
  late,       ///< a layer becomes active a little later than requested
  thin,       ///< layers are two per cent thinner than stated
  forgetful,  ///< one look in eight is left out
  ulp_late,   ///< decisions are compared with what holds until the next double after their time
};

/// eta(l) = eta(1) l^(-1/4).
inline double layer(double eta, std::uint32_t l) { return eta / std::sqrt(std::sqrt(static_cast<double>(l))); }

/// Options of a random motion. Lengths in units of eta(1), times in units of the mean time between kicks of a vertex.
struct KickOptions {
  std::uint64_t seed = 0;
  double eta = 0.01, beat = 0.001;  ///< the units [m], [s]
  double offset = 0;                ///< of the origin
  double drift = 0;                 ///< speed
  double start = 0;                 ///< time
  int bodies = 6;
  double slice = 10;           ///< the longest slice
  std::size_t many_walls = 4;  ///< make a pen worth its while
  Fault fault = Fault::none;
};

/// A pair, and how many layers it had from which time on in this window.
template <int Dim>
struct Followed {
  struct Change {
    double t;
    std::uint32_t layers;
  };

  Stencil stencil;
  std::uint16_t material;
  std::vector<Change> changes;  ///< the first is at the window's beginning
  Vector<Dim> n = Vector<Dim>::Zero();
};

/// `Checked`: compares each decision of the certificates with rational arithmetic.
template <int Dim, template <int, class> class Certificates, bool Checked = false>
class RandomKicks {
 public:
  explicit RandomKicks(const KickOptions& o) : options_(o), random_(o.seed) {
    const MovingBodies<Dim> bodies = BodiesMaker<Dim>(random_, o.eta).make(o.bodies);
    mesh_ = bodies.mesh;
    group_ = bodies.group;
    immovable_ = bodies.immovable;
    reach_ = bodies.reach;
    t_ = o.start * o.beat;
    choose_frame();
    const Vector<Dim> origin = Vector<Dim>::Constant(0.7 * o.offset * o.eta);
    for (const Vector<Dim>& home : bodies.home) home_.push_back(origin + frame_ * home);
    for (std::size_t i = 0; i < home_.size(); ++i) bodies_.push_back({home_[i], t_, drift_});
    excluded_ = random_.below(4) == 0;
    follow_all();
    set_clocks();
    make_certificates();
    begin_window();
    certificates_->start(t_);
  }
  RandomKicks(const RandomKicks&) = delete;
  RandomKicks& operator=(const RandomKicks&) = delete;

  /// Kicks each vertex about sixty times.
  void run_window() {
    const double end = t_ + 64 * options_.beat;
    while (due_.top().first <= end) {
      const auto [t, i] = due_.top();
      due_.pop();
      run_certificates(t);
      t_ = t;
      figure(i);
    }
    run_certificates(end);
    t_ = end;
    for (std::size_t i = 0; i < bodies_.size(); ++i) advance(static_cast<VertexId>(i), end);
  }

  /// A pair that was nearer than its next layer in this window, if there is one. Then the next window may begin.
  std::optional<Stencil> replay() {
    Replay<Dim> replay(tracks_);
    std::optional<Stencil> late;
    for (Followed<Dim>& pair : followed_) {
      for (std::size_t k = 0; k < pair.changes.size() && !late; ++k) {
        const double begin = pair.changes[k].t;
        const double end = k + 1 < pair.changes.size() ? std::min(pair.changes[k + 1].t, t_) : t_;
        const double eta = layer(eta_of(pair.material), pair.changes[k].layers + 1);
        if (begin < end && !replay.stays_farther(pair.stencil, begin, end, eta, pair.n)) late = pair.stencil;
      }
    }
    counts_ += replay.counts();
    begin_window();
    return late;
  }

  std::uint64_t decisions() const { return decisions_; }
  std::uint64_t wrong_decisions() const { return wrong_decisions_; }
  std::uint64_t kicks() const { return kicks_; }
  const ReplayCounts& replayed() const { return counts_; }
  const CertificateCounts& certificates() const { return certificates_->counts(); }

  // --- Host of the certificates --------------------------------------------------------------------------------------

  Line<Dim> line(VertexId i) const { return bodies_[i]; }
  bool immovable(VertexId i) const { return immovable_[i]; }
  std::uint16_t material(const Stencil& s) const {
    const std::uint16_t g = group_[s.vertices[0]], h = group_[s.vertices[s.first()]];
    if (excluded_ && g + h == 3) return no_material;
    return g < 2 && h < 2 ? 0 : 1;
  }
  double thickness(std::uint16_t material, std::uint32_t l) const {
    return (options_.fault == Fault::thin ? 0.98 : 1) * layer(eta_of(material), l);
  }
  double look_step(VertexId i) const { return steps_[i]; }
  std::uint32_t least_layers() const { return 0; }
  std::size_t many_walls() const { return options_.many_walls; }
  double greatest_thickness(VertexId) const { return eta_of(0); }
  int in_broad_phase() const { return 0; }

  void activate(const Stencil& s, std::uint16_t, std::uint32_t l, double t) {
    if (l > 1000) throw std::logic_error("kicks: a pair came too near");
    change(s, l, options_.fault == Fault::late ? t + 0.02 * options_.beat : t);
  }
  void deactivate(const Stencil& s, std::uint16_t, std::uint32_t l) { change(s, l - 1, t_); }

  template <class Certificate>
  void decided(const Ray<Dim>& p, const Certificate& certificate, double from, double until,
               bool holds) requires Checked {
    if (options_.fault == Fault::ulp_late) until = std::nextafter(until, never);
    until = std::min(until, std::numeric_limits<double>::max());
    const auto exactly = [&](double t) { return noli::test::holds<Dim>(p, certificate, mpq_class(t)); };
    ++decisions_;
    if (holds != (exactly(until) && (from == until || exactly(from)))) ++wrong_decisions_;
  }

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();

  double eta_of(std::uint16_t material) const { return material == 0 ? options_.eta : 0.7 * options_.eta; }

  double signed_unit() { return 2 * random_.unit() - 1; }

  // --- Setup ---------------------------------------------------------------------------------------------------------

  /// Chooses a frame, orthonormal up to rounding, and the direction of the drift.
  void choose_frame() {
    for (int d = 0; d < Dim; ++d) {
      Vector<Dim> e;
      do {
        for (int k = 0; k < Dim; ++k) e[k] = signed_unit();
        for (int k = 0; k < d; ++k) e -= frame_.col(k).dot(e) * Vector<Dim>(frame_.col(k));
      } while (e.squaredNorm() < 0.01);
      frame_.col(d) = e / std::sqrt(e.squaredNorm());
    }
    for (int k = 0; k < Dim; ++k) drift_[k] = options_.drift * options_.eta / options_.beat * signed_unit();
  }

  /// Follows all pairs that have a contact material.
  void follow_all() {
    const Features features(mesh_, Dim);
    const auto cells = static_cast<std::uint32_t>(features.cells().size());
    for (std::uint32_t a = 0; a < cells; ++a) {
      for (std::uint32_t b = a + 1; b < cells; ++b) {
        features.for_each_pair(a, b, [this](const Stencil& s) {
          const std::uint16_t m = material_of(*this, s);
          if (m == no_material) return;
          index_.emplace(s.key, followed_.size());
          followed_.push_back({s, m, {{t_, 0}}, Vector<Dim>::Zero()});
        });
      }
    }
  }

  /// Some vertices are kicked at multiples of a step, others at random times.
  void set_clocks() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const bool regular = !immovable_[i] && random_.below(2) == 0;
      steps_.push_back(regular ? options_.beat * (0.3 + random_.unit()) : never);
      next_.push_back(0);
      choose_due(static_cast<VertexId>(i));
    }
  }

  void make_certificates() {
    if constexpr (std::is_constructible_v<Certificates<Dim, RandomKicks>, RandomKicks&, const Mesh&>) {
      certificates_.emplace(*this, mesh_);
    } else {
      certificates_.emplace(*this, mesh_, std::span<const Vector<Dim>>(home_), options_.slice * options_.beat);
    }
  }

  // --- Kicks ---------------------------------------------------------------------------------------------------------

  void choose_due(VertexId i) {
    const double h = steps_[i], u = random_.unit();
    double t = t_ + options_.beat * (0.05 + 2 * u * u);
    if (h != never) {
      auto k = static_cast<std::uint64_t>(t_ / h);
      while (static_cast<double>(k) * h <= t_) ++k;
      t = static_cast<double>(k) * h;
    }
    next_[i] = t;
    due_.push({t, i});
  }

  void run_certificates(double until) {
    while (certificates_->next_time() <= until) {
      t_ = certificates_->next_time();
      certificates_->run_next();
    }
  }

  /// Kicks the vertex, which is due, and perhaps others with it, as a layer would.
  void figure(VertexId i) {
    choose_due(i);
    std::vector<VertexId> struck{i};
    if (random_.below(4) == 0) {
      const Stencil& s = followed_[static_cast<std::size_t>(random_.below(static_cast<int>(followed_.size())))].stencil;
      struck.insert(struck.end(), s.vertices.begin(), s.vertices.begin() + static_cast<std::ptrdiff_t>(s.size()));
    }
    for (const VertexId v : struck) {
      if (v == i || random_.below(8) > 0) kick(v);
    }
    for (const VertexId v : struck) look(v);
    drop_some();
  }

  void look(VertexId v) {
    if (options_.fault == Fault::forgetful && random_.below(8) == 0) return;
    certificates_->look(v, t_);
  }

  /// Sends the vertex to a random place in its box; sometimes it rests or creeps instead.
  void kick(VertexId i) {
    const int mood = random_.below(16);
    if (!(next_[i] > t_)) return;
    advance(i, t_);
    ++kicks_;
    Line<Dim>& body = bodies_[i];
    Vector<Dim> place;
    for (int d = 0; d < Dim; ++d) place[d] = reach_[i][d] * signed_unit();
    const Vector<Dim> target = home_[i] + (t_ - options_.start * options_.beat) * drift_ + frame_ * place;
    Vector<Dim> v = (target - body.x) / (next_[i] - t_);
    const double most = 20 * options_.eta / options_.beat, speed = v.cwiseAbs().maxCoeff();
    if (speed > most) v *= most / speed;
    if (mood == 1) v *= 1e-3;
    if (mood == 2) v.setZero();
    body.v = drift_ + v;
  }

  /// Advances a vertex as an event does (integrator/kick.h).
  void advance(VertexId i, double t) {
    Line<Dim>& body = bodies_[i];
    if (body.t == t) return;
    body.x = body.at(t);
    body.t = t;
    tracks_[i].push_back({t, body.x});
  }

  /// Drops layers as after a firing: pairs outside a layer may lose it.
  void drop_some() {
    for (int k = 0; k < 4 && !active_.empty(); ++k) {
      auto at = active_.lower_bound(static_cast<std::size_t>(random_.below(static_cast<int>(followed_.size()))));
      if (at == active_.end()) at = active_.begin();
      const Followed<Dim>& pair = followed_[*at];
      const std::uint32_t layers = pair.changes.back().layers;
      const std::uint32_t l = layers - (random_.below(4) == 0 && layers > 1 ? 1 : 0);
      std::array<Vector<Dim>, 4> x;
      for (std::size_t j = 0; j < pair.stencil.size(); ++j) x[j] = bodies_[pair.stencil.vertices[j]].at(t_);
      const double d =
          closest<Dim>(pair.stencil.kind, std::span<const Vector<Dim>>(x.data(), pair.stencil.size())).distance();
      if (d > layer(eta_of(pair.material), l)) certificates_->drop_if_clear(pair.stencil, pair.material, l, d, t_);
    }
  }

  // --- The record ----------------------------------------------------------------------------------------------------

  void begin_window() {
    tracks_.assign(bodies_.size(), {});
    for (std::size_t i = 0; i < bodies_.size(); ++i) tracks_[i].push_back({t_, bodies_[i].at(t_)});
    for (Followed<Dim>& pair : followed_) pair.changes = {{t_, pair.changes.back().layers}};
  }

  /// Records that a pair gained or lost one layer. Of several changes at one time, the last counts.
  void change(const Stencil& s, std::uint32_t layers, double t) {
    const std::size_t p = index_.at(s.key);
    Followed<Dim>& pair = followed_[p];
    const std::uint32_t before = pair.changes.back().layers;
    if (layers != before + 1 && layers + 1 != before) throw std::logic_error("kicks: not one layer more or less");
    if (pair.changes.back().t >= t) {
      pair.changes.back().layers = layers;
    } else {
      pair.changes.push_back({t, layers});
    }
    layers > 0 ? void(active_.insert(p)) : void(active_.erase(p));
  }

  KickOptions options_;
  noli::test::Random random_;
  Mesh mesh_;
  std::vector<Vector<Dim>> home_, reach_;
  std::vector<std::uint16_t> group_;
  std::vector<bool> immovable_;
  bool excluded_ = false;
  Eigen::Matrix<double, Dim, Dim, Eigen::DontAlign> frame_;
  Vector<Dim> drift_;
  double t_ = 0;  ///< now
  std::vector<Line<Dim>> bodies_;
  std::vector<double> steps_, next_;  ///< by vertex: the step of its kicks, or never; when it is due
  std::priority_queue<std::pair<double, VertexId>, std::vector<std::pair<double, VertexId>>, std::greater<>> due_;
  std::vector<Followed<Dim>> followed_;
  std::map<PairKey, std::size_t> index_;
  std::set<std::size_t> active_;  ///< pairs with layers
  std::vector<Track<Dim>> tracks_;
  std::optional<Certificates<Dim, RandomKicks>> certificates_;
  std::uint64_t kicks_ = 0, decisions_ = 0, wrong_decisions_ = 0;
  ReplayCounts counts_;
};

}  // namespace noli::certificates::test

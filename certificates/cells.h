// SPDX-License-Identifier: Apache-2.0
//
// Certifies that no two features are nearer than their next layer, by regions of space-time that each vertex promises
// not to leave.
//
// Notation (design, "Certificates"; slabs: Harmon et al. 2009, section 5)
//   eta(l)      thickness of layer l of a pair; L: the number of layers that are active for it
//   certificate   of a pair: it is farther apart than eta(L + 1). Layers beyond L then give no impulse
//   slice       a time interval that the broad phase covers in one pass
//   tube        a vertex's plan for the slice. A pair is settled, and not stored, if some direction keeps it eta(1)
//               apart for the whole slice, the tubes' radii included
//   near pair   a pair that is not settled; it has a slab of thickness eta(L + 1), whose two sides are walls of its
//               vertices
//   guard       a vertex's plan inside its tube and inside all its walls. A change of velocity is compared only with
//               the guard, which takes a few operations; the walls are checked when the guard is used up
//   look        a check of a vertex, whenever its velocity changes and at least every look_step(i) if that is finite.
//               The vertex must stay in its guard until the next look, or until the event that is due for it. If it
//               does not, an event is queued for when it will leave the guard. If it is near the border, it gets a new
//               guard; if its walls are too near for that, an event is queued for the end of the new guard
//   repair      replaces a wall that is used up by a new slab at the pair's current position, or by the next layer if
//               there is no room
//
// Activating a layer early does not change the motion, since its impulses are zero. So everything here may err on that
// side, and does: thresholds for activation lie half of a layer's width outside. Times are chosen in double;
// whether a guard or a wall holds until then is decided exactly (certificates/decisions.h).
//
// Host, the dynamics:
//   Line<Dim> line(v)                 how a vertex moves now
//   bool immovable(v)                 pinned or scripted: two features with only such vertices are not a pair
//   std::uint16_t material(stencil)   of contact of this pair, or no_material
//   double thickness(material, l)     eta(l), decreasing to 0
//   double look_step(v)
//   std::uint32_t least_layers()      the number of layers that are always active for a near pair
//   std::size_t many_walls()          the number of walls from which a pen is worth the effort
//   double greatest_thickness(v)      the largest eta(1) of any pair of a feature that v is part of
//   in_broad_phase()                  returns an object that is kept while near pairs are searched for
//   void activate(stencil, material, l, t), deactivate(stencil, material, l)
//
// Nothing here proves the motion: recorded windows are verified exactly elsewhere.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <queue>
#include <stdexcept>
#include <utility>
#include <vector>

#include "certificates/decisions.h"
#include "certificates/features.h"
#include "certificates/hierarchy.h"
#include "certificates/near_pair.h"
#include "certificates/near_pairs.h"
#include "certificates/pen.h"
#include "trajectory/stop.h"

namespace noli::certificates {

/// A vertex is so near a wall that doubles know no time until which it stays beyond it.
struct WallFails : std::runtime_error {
  WallFails() : std::runtime_error("certificates: a wall fails again at once") {}
};

template <int Dim, class Host>
class Cells {
 public:
  /// `longest_slice`: in the unit of time. Nothing is certified before start().
  Cells(Host& host, const Mesh& mesh, std::span<const Vector<Dim>> x, double longest_slice)
      : host_(host),
        decisions_(host),
        features_(mesh, Dim),
        longest_(longest_slice),
        length_(longest_slice / 8),
        courses_(x.size()),
        tubes_(x.size()),
        ends_(x.size()),
        guards_(x.size()),
        due_(x.size(), never),
        nears_(x.size()),
        pens_(x.size()),
        waiting_(x.size(), false) {
    std::vector<Vector<Dim>> centres;
    std::vector<bool> fixed;
    for (const auto& cell : features_.cells()) {
      end_if_stopped();
      centres.push_back(x[cell.vertices[0]]);
      fixed.push_back(std::ranges::all_of(cell.all(), [this](VertexId v) { return host_.immovable(v); }));
    }
    hierarchy_ = Hierarchy<Dim>(centres, fixed);
    measure(x);
  }

  /// Certifies the present state, activating as many layers as needed.
  void start(double t) { begin_slice(t); }

  /// Call this for a vertex at time t after its velocity may have changed, and as often as look_step says.
  void look(VertexId i, double t) {
    const double ahead = std::min({t + host_.look_step(i), slice_end_, due_[i]});
    // If the next slice begins at once, it checks everything.
    if (slice_due_ <= t || decisions_.holds(guards_[i], host_.line(i), ahead)) return;
    if (!keep_guard(i, t)) plan_at_once(i, t);
  }

  /// The time of the next event of a certificate.
  double next_time() {
    while (!events_.empty() && due_[events_.top().second] != events_.top().first) events_.pop();
    return events_.empty() ? slice_due_ : std::min(slice_due_, events_.top().first);
  }

  /// Precondition: nothing else happens before next_time().
  void run_next() {
    ++counts_.events;
    const double t = next_time();
    if (t == slice_due_) return begin_slice(t);
    const VertexId i = events_.top().second;
    events_.pop();
    due_[i] = never;
    if (!keep_guard(i, t)) plan_at_once(i, t);
  }

  const CertificateCounts& counts() const { return counts_; }

  /// Drops layer l of this pair, which gives no impulse at this distance, if it is the deepest and not needed soon.
  /// Precondition: the pair has it.
  void drop_if_clear(const Stencil& s, std::uint16_t material, std::uint32_t l, double distance, double t) {
    if (!is_clear(host_, material, l, distance, decisions_.recording())) return;
    const std::uint32_t near = nears_.number(s);
    if (nears_[near].layers != l) return;
    lose_layer(host_, nears_[near], counts_);
    nears_.note_layers(near, true);
    put_up_slab(near, t);
    settle(t);
  }

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();
  /// The share of a slab's slack below which the slab is replaced.
  static constexpr double worn = 0.4;
  /// The share of the time to a wall at which a plan ends.
  static constexpr double reach = 0.9;
  /// The share of a guard's squared radius beyond which a vertex gets a new guard.
  static constexpr double well_inside = 0.5;
  /// The share of the time until a vertex leaves its guard after which it is checked; it is then no longer well inside.
  static constexpr double way_out = 0.9;

  using Event = std::pair<double, VertexId>;

  /// A vertex's position when the slice began, and its mean velocity in the slice before.
  struct Course {
    Vector<Dim> x = Vector<Dim>::Zero(), v = Vector<Dim>::Zero();
  };

  using Vertices = std::span<const VertexId>;

  /// What the broad phase reads of a vertex's tube, in one place: where it is when the slice begins and ends. A tube
  /// that was set later is extended back, to where its vertex may never have been; so it settles fewer pairs.
  struct TubeEnds {
    Vector<Dim> begin, end;
    double radius;

    Vector<Dim> between(double share) const { return (1 - share) * begin + share * end; }
  };

  Line<Dim> line_at(VertexId i, double t) const {
    const Line<Dim> line = host_.line(i);
    return {line.at(t), t, line.v};
  }

  // --- Slices --------------------------------------------------------------------------------------------------------

  /// Sets the radii of tubes, a share of the shortest edge at a vertex; and the distance that each cell keeps clear
  /// around it: in a pair of features, each cell has at least half of the thickness.
  void measure(std::span<const Vector<Dim>> x) {
    constexpr double part = 0.12;
    sizes_.assign(x.size(), never);
    for (const auto& [a, b] : features_.edges()) {
      const double length = part * std::sqrt((x[a] - x[b]).squaredNorm());
      sizes_[a] = std::min(sizes_[a], length);
      sizes_[b] = std::min(sizes_[b], length);
    }
    double widest_of_all = 0;
    for (VertexId i = 0; i < x.size(); ++i) widest_of_all = std::max(widest_of_all, host_.greatest_thickness(i));
    for (VertexId i = 0; i < x.size(); ++i) {
      const double own = host_.greatest_thickness(i);  // 0 if it may pass through everything
      if (sizes_[i] == never) sizes_[i] = 2 * (own > 0 ? own : widest_of_all);
    }
    for (const auto& cell : features_.cells()) {
      end_if_stopped();
      double widest = 0;
      for (const VertexId v : cell.all()) widest = std::max(widest, host_.greatest_thickness(v));
      halves_.push_back(0.5 * widest);
    }
  }

  void begin_slice(double t) {
    ++counts_.slices;
    adapt_length();
    const double before = slice_begin_;
    const double next_before = t - before;
    slice_begin_ = t;
    slice_end_ = slice_due_ = t + length_;
    retubed_ = 0;
    decisions_.forget_reach();
    for (std::size_t i = 0; i < tubes_.size(); ++i) {
      end_if_stopped();
      begin_tube(static_cast<VertexId>(i), before, t);
    }
    length_before_ = next_before;
    std::fill(due_.begin(), due_.end(), never);
    events_ = {};
    find_near(t);
    nears_at_begin_ = nears_.size();
    if (is_swept()) slice_due_ = t + 0.25 * length_;
    for (std::size_t i = 0; i < tubes_.size(); ++i) plan_soon(static_cast<VertexId>(i));
    settle(t);
  }

  /// Makes slices longer while no vertex leaves its tube, and shorter when many do, or when many pairs are near only
  /// because of the distance that vertices move in a slice.
  void adapt_length() {
    const std::size_t n = tubes_.size();
    if (is_swept()) {
      length_ /= 4;
    } else if (retubed_ * 8 > n) {
      length_ = std::max(length_ / 2, longest_ * 0x1p-12);
    } else if (retubed_ * 64 < n && 8 * swept_ < n && counts_.slices > 2) {
      length_ = std::min(length_ * 2, longest_);
    }
  }
  /// Whether many pairs are near only because of fast motion. Not in very short slices: shorter ones would cost more
  /// than they save.
  bool is_swept() const {
    return length_ > longest_ * 0x1p-8 && swept_ > tubes_.size() && 2 * swept_ > nears_at_begin_;
  }

  /// The tube continues the vertex's mean velocity since the last slice began, and its change. So a vibrating vertex
  /// stays in the middle, and a falling one falls on.
  void begin_tube(VertexId i, double before, double t) {
    const Line<Dim> now = line_at(i, t);
    Line<Dim> line = now;
    Course& course = courses_[i];
    if (counts_.slices > 1 && t > before && !host_.immovable(i)) {
      const Vector<Dim> mean = (now.x - course.x) / (t - before);
      line.v = mean;
      if (counts_.slices > 2)
        line.v += ((length_ + (t - before)) / ((t - before) + length_before_)) * (mean - course.v);
      course.v = mean;
    }
    course.x = now.x;
    set_tube(i, now, line);
  }

  /// Sets a tube along `line`, or along the current motion if the vertex would leave that tube before the next look.
  void set_tube(VertexId i, const Line<Dim>& now, Line<Dim> line) {
    const double look = std::min(host_.look_step(i), slice_end_ - now.t);
    if (!((line.v - now.v).squaredNorm() * look * look <= 0.25 * sizes_[i] * sizes_[i])) line.v = now.v;
    tubes_[i] = {line, sizes_[i], slice_end_};
    ends_[i] = {line.at(slice_begin_), line.at(slice_end_), sizes_[i]};
    const Line<Dim> from_begin{ends_[i].begin, slice_begin_, line.v};  // its reach is at least the tube's
    decisions_.reach_out(Plan<Dim>{from_begin, sizes_[i], slice_end_});
    decisions_.reach_out(now, slice_end_);
  }

  /// The distance that directions and boxes keep clear on each side when they settle pairs.
  double margin() const { return decisions_.recording() + decisions_.rounding(); }

  MovingBox<Dim> box_of(std::uint32_t cell) const {
    const double room_of_cell = halves_[cell] + margin();
    MovingBox<Dim> box = MovingBox<Dim>::empty();
    for (const VertexId v : features_.cells()[cell].all()) {
      const auto& [begin, end, radius] = ends_[v];
      const Vector<Dim> room = Vector<Dim>::Constant(radius + room_of_cell);
      box.add({{begin - room, end - room}, {begin + room, end + room}});
    }
    return box;
  }

  /// Finds all near pairs anew; pairs that were near before keep their layers.
  void find_near(double t) {
    for (Pen<Dim>& pen : pens_) pen.take_down();
    nears_.begin_slice();
    find_pairs();
    nears_.for_each_left_out([this](LayeredPair& pair) {
      while (pair.layers > 0) lose_layer(host_, pair, counts_);
    });
    swept_ = 0;
    for (std::uint32_t n = 0; n < nears_.size(); ++n) {
      end_if_stopped();
      const double distance = put_up_slab(n, t);
      const Stencil& s = nears_[n].stencil;
      const double room = sizes_[s.vertices[0]] + sizes_[s.vertices[s.first()]];
      if (distance > 4 * (host_.thickness(nears_[n].material, 1) + room)) ++swept_;
    }
  }

  void find_pairs() {
    [[maybe_unused]] const auto searching = host_.in_broad_phase();
    hierarchy_.refit([this](std::uint32_t cell) { return box_of(cell); });
    hierarchy_.for_each_pair([&](std::uint32_t a, std::uint32_t b) {
      if (cells_settled(a, b)) return;
      features_.for_each_pair(a, b, [&](const Stencil& stencil) { consider(stencil); });
    });
  }

  // --- Pairs ---------------------------------------------------------------------------------------------------------

  /// Stores a pair that the tubes do not settle. The caller must put up its slab. Precondition: it is not stored yet.
  void consider(const Stencil& s) {
    const std::uint16_t material = material_of(host_, s);
    if (material == no_material || settled(s, material)) return;
    nears_.add(s, material);
    counts_.most_near = std::max<std::uint64_t>(counts_.most_near, nears_.size());
  }

  /// Whether some direction keeps the tubes apart for the whole slice: one between centres, which is enough for most
  /// pairs, or between closest points.
  bool settled(const Stencil& s, std::uint16_t material) const {
    const double eta = host_.thickness(material, 1) + 2 * margin();
    const Vertices a(s.vertices.data(), s.first()), b(s.vertices.data() + s.first(), s.size() - s.first());
    if (centres_keep_apart(a, b, eta)) return true;
    for (const double share : {0.0, 1.0, 0.5}) {
      std::array<Vector<Dim>, 4> x;
      for (std::size_t k = 0; k < s.size(); ++k) x[k] = ends_[s.vertices[k]].between(share);
      const Closest<Dim> c = closest<Dim>(s.kind, std::span<const Vector<Dim>>(x.data(), s.size()));
      const double d = c.distance();
      if (!(d > eta)) return false;
      if (keeps_apart(a, b, direction<Dim>(c.r, d), eta)) return true;
    }
    return false;
  }

  /// The same for all pairs of two cells, by the direction between their centres. False if the cells share a vertex.
  bool cells_settled(std::uint32_t a, std::uint32_t b) const {
    const auto p = features_.cells()[a].all(), q = features_.cells()[b].all();
    if (std::ranges::find_first_of(p, q) != p.end()) return false;
    return centres_keep_apart(p, q, halves_[a] + halves_[b] + 2 * margin());
  }

  /// Whether the direction between the centres of a and b keeps their tubes apart by more than eta.
  bool centres_keep_apart(Vertices a, Vertices b, double eta) const {
    const Vector<Dim> n = centre(a) - centre(b);
    const double length = std::sqrt(n.squaredNorm());
    return length > 0 && keeps_apart(a, b, direction<Dim>(n, length), eta);
  }

  /// When the slice begins.
  Vector<Dim> centre(Vertices vertices) const {
    Vector<Dim> sum = Vector<Dim>::Zero();
    for (const VertexId v : vertices) sum += ends_[v].begin;
    return sum / static_cast<double>(vertices.size());
  }

  bool keeps_apart(Vertices a, Vertices b, const Vector<Dim>& n, double eta) const {
    return gap(a, b, n, &TubeEnds::begin) > eta && gap(a, b, n, &TubeEnds::end) > eta;
  }

  double gap(Vertices a, Vertices b, const Vector<Dim>& n, Vector<Dim> TubeEnds::*when) const {
    double low = never, high = -never;
    for (const VertexId v : a) low = std::min(low, n.dot(ends_[v].*when) - ends_[v].radius);
    for (const VertexId v : b) high = std::max(high, n.dot(ends_[v].*when) + ends_[v].radius);
    return low - high;
  }

  /// Puts up a slab at the pair's current position. Plans that cross it must be made anew. Returns the pair's distance.
  double put_up_slab(std::uint32_t near, double t, bool thinner = false) {
    NearPair<Dim>& pair = nears_[near];
    const bool had_layers = pair.layers > 0;
    for (std::size_t k = 0; k < pair.stencil.size(); ++k) {
      decisions_.reach_out(line_at(pair.stencil.vertices[k], t), slice_end_);
    }
    if (thinner) gain_layer(host_, pair, t, counts_);
    const double distance = fit_slab(host_, pair, t, decisions_.recording(), counts_);
    const Stencil& s = pair.stencil;
    nears_.note_layers(near, had_layers);
    for (std::size_t k = 0; k < s.size(); ++k) {
      const VertexId v = s.vertices[k];
      const bool of_a = k < s.first();
      if (!respects(guards_[v], pair.slab, of_a, t)) plan_soon(v);
      if (pens_[v].is_up(t) && !respects(pens_[v].plan(), pair.slab, of_a, t)) pens_[v].add_gate({near, of_a});
    }
    return distance;
  }

  bool respects(const Plan<Dim>& plan, const Slab<Dim>& slab, bool of_a, double t) const {
    return plan.until >= t && decisions_.stays_beyond(plan, slab, of_a, t);
  }

  // --- Vertices ------------------------------------------------------------------------------------------------------

  /// If a vertex is still well inside its guard, queues an event for when it will leave it, and returns true. This
  /// helps vibrating vertices, whose velocity changes again and again but which hardly move.
  bool keep_guard(VertexId i, double t) {
    const Plan<Dim>& guard = guards_[i];
    const Line<Dim> line = host_.line(i);
    const Vector<Dim> e = line.at(t) - guard.line.at(t);
    if (!(guard.until > t && e.squaredNorm() <= well_inside * guard.radius * guard.radius)) return false;
    const double leaves = t + way_out * time_to_leave<Dim>(e, line.v - guard.line.v, guard.radius);
    const double end = std::min({leaves, guard.until, slice_end_});
    if (!(end > t) || !decisions_.holds(guard, line, end)) return false;
    due_[i] = end;
    events_.push({end, i});
    return true;
  }

  void plan_at_once(VertexId i, double t) {
    plan_soon(i);
    settle(t);
  }

  void plan_soon(VertexId i) {
    if (waiting_[i]) return;
    waiting_[i] = true;
    work_.push_back(i);
  }

  [[gnu::noinline]] void settle(double t) {
    for (std::size_t done = 0; done < work_.size(); ++done) {
      end_if_stopped();
      waiting_[work_[done]] = false;
      if (slice_due_ <= t) continue;
      require_progress(done + 1, tubes_.size());
      plan(work_[done], t);
    }
    work_.clear();
  }

  /// Gives a vertex a new guard.
  void plan(VertexId i, double t) {
    ++counts_.plans;
    const Line<Dim> now = line_at(i, t);
    decisions_.reach_out(now, slice_end_);
    const double ahead = std::min(t + host_.look_step(i), slice_end_);
    if (must_leave_tube(i, now, ahead)) leave_tube(i, now);
    Plan<Dim>& guard = guards_[i];
    guard = nears_.of(i).empty() ? tubes_[i] : plan_within(i, now);
    due_[i] = decisions_.holds(guard, now, ahead) ? never : guard.until;
    if (due_[i] != never) events_.push({due_[i], i});
  }

  /// A vertex without walls must stay in its tube until the next look; one with walls needs some room in it.
  bool must_leave_tube(VertexId i, const Line<Dim>& now, double ahead) const {
    const Plan<Dim>& tube = tubes_[i];
    if (nears_.of(i).empty()) return !decisions_.holds(tube, now, ahead);
    return (now.x - tube.line.at(now.t)).squaredNorm() > 0.5 * tube.radius * tube.radius;
  }

  void leave_tube(VertexId i, const Line<Dim>& now) {
    ++counts_.tubes;
    ++retubed_;
    Line<Dim> line = now;
    const double elapsed = now.t - tubes_[i].line.t;
    if (elapsed > 0.25 * length_ && !host_.immovable(i)) line.v = (now.x - courses_[i].x) / (now.t - slice_begin_);
    set_tube(i, now, line);
    pens_[i].take_down();
    const std::size_t known = nears_.size();
    find_near_cells(i);
    for (std::size_t n = known; n < nears_.size(); ++n) put_up_slab(static_cast<std::uint32_t>(n), now.t);
    const bool crowded = nears_.size() > 2 * nears_at_begin_ + tubes_.size();
    if (retubed_ * 8 > tubes_.size() + 64 || crowded) slice_due_ = now.t;
  }

  /// Finds pairs that the vertex is part of, after its tube has changed.
  void find_near_cells(VertexId i) {
    [[maybe_unused]] const auto searching = host_.in_broad_phase();
    known_.clear();
    for (const Side side : nears_.of(i)) known_.push_back(nears_[side.near()].stencil.key);
    std::sort(known_.begin(), known_.end());
    for (const std::uint32_t cell : features_.cells_of(i)) hierarchy_.enlarge(cell, box_of(cell));
    for (const std::uint32_t cell : features_.cells_of(i)) find_near_cell(i, cell);
  }

  /// Finds unknown pairs of this cell that the vertex is part of. Of pairs with another cell of the vertex, takes only
  /// those with a later cell, so that none is found twice.
  void find_near_cell(VertexId i, std::uint32_t cell) {
    const auto of_i = features_.cells_of(i);
    hierarchy_.for_each_near(box_of(cell), [&](std::uint32_t other) {
      if (other <= cell && std::binary_search(of_i.begin(), of_i.end(), other)) return;
      features_.for_each_pair(cell, other, [&](const Stencil& s) {
        const auto end = s.vertices.begin() + s.size();
        if (std::find(s.vertices.begin(), end, i) == end) return;
        if (!std::binary_search(known_.begin(), known_.end(), s.key)) consider(s);
      });
    });
  }

  /// Plans inside the vertex's pen if it has one. Otherwise, a vertex with many walls gets a pen for next time.
  Plan<Dim> plan_within(VertexId i, const Line<Dim>& now) {
    Pen<Dim>& pen = pens_[i];
    if (pen.holds(now)) {
      ++counts_.penned;
      return plan_between(pen.plan(), pen.gates(), now);
    }
    pen.take_down(now);
    Plan<Dim> guard = plan_between(tubes_[i], nears_.of(i), now);
    if (nears_.of(i).size() >= host_.many_walls()) put_up_pen(i, now, guard.until);
    return guard;
  }

  void put_up_pen(VertexId i, const Line<Dim>& now, double until) {
    const Plan<Dim>& tube = tubes_[i];
    const double end = std::min(slice_end_, now.t + pens_[i].plans() * (until - now.t));
    const double rounding = 2 * decisions_.rounding();
    clearances_.clear();
    for (const Side side : nears_.of(i)) {
      const Slab<Dim>& slab = nears_[side.near()].slab;
      const bool of_a = side.of_a();
      clearances_.emplace_back(std::min(slab.clearance(of_a, now.x, now.t), slab.clearance(of_a, now.at(end), end)),
                               side);
    }
    const double off_now = (now.x - tube.line.at(now.t)).squaredNorm();
    const double off_end = (now.at(end) - tube.line.at(end)).squaredNorm();
    pens_[i].put_up(now, end, tube.radius - std::sqrt(std::max(off_now, off_end)) - rounding, clearances_,
                    rounding + decisions_.recording());
  }

  /// A plan along the vertex's own motion, inside `outer`, until it has covered part of the way to one of these walls.
  Plan<Dim> plan_between(const Plan<Dim>& outer, std::span<const Side> walls, const Line<Dim>& now) {
    const Vector<Dim> e = now.x - outer.line.at(now.t), w = now.v - outer.line.v;
    const double edge = 0.5 * (outer.radius + std::sqrt(e.squaredNorm()));
    double until = std::min(outer.until, now.t + time_to_leave<Dim>(e, w, edge));
    double room = outer.radius - edge;
    for (const Side side : walls) {
      const auto [clearance, closing] = wall(side, now);
      if (closing > 0) until = std::min(until, now.t + reach * (clearance / closing));
    }
    for (const Side side : walls) {
      const Slab<Dim>& slab = nears_[side.near()].slab;
      const bool of_a = side.of_a();
      const double clearance = slab.clearance(of_a, now.x, now.t) - decisions_.recording();
      room = std::min(room, clearance - std::max(0.0, slab.closing(of_a, now.v)) * (until - now.t));
    }
    const double radius = room - 2 * decisions_.rounding();
    if (!(radius > 0 && until > now.t)) return without_room(outer, walls, now, until);
    return {now, radius, until};  // beyond all walls by more than rounding, so no decision is needed
  }

  /// A plan of radius 0 for a vertex so near a wall that doubles cannot tell whether it stays beyond it.
  Plan<Dim> without_room(const Plan<Dim>& outer, std::span<const Side> walls, const Line<Dim>& now,
                         double until) const {
    // Half of the last bit of a time rounds to that bit again, or to nothing.
    for (double last = now.t;; until = now.t + 0.5 * (until - now.t)) {
      if (!(until > now.t) || until == last) throw WallFails();
      last = until;
      const Plan<Dim> plan{now, 0, until};
      const bool beyond_all = std::ranges::all_of(walls, [&](Side side) {
        return decisions_.stays_beyond(plan, nears_[side.near()].slab, side.of_a(), now.t);
      });
      if (beyond_all && decisions_.holds(outer, now, until)) return plan;
    }
  }

  struct Wall {
    double clearance, closing;
  };

  /// A wall; its slab is replaced if it is worn.
  Wall wall(Side side, const Line<Dim>& now) {
    const std::uint32_t near = side.near();
    const bool of_a = side.of_a();
    for (;;) {
      const Slab<Dim>& slab = nears_[near].slab;
      const double clearance = slab.clearance(of_a, now.x, now.t);
      if (clearance > worn * slab.slack) return {clearance, slab.closing(of_a, now.v)};
      put_up_slab(near, now.t, slab.since == now.t);  // if a new one is already worn, only a thinner one can help
    }
  }

  Host& host_;
  Decisions<Dim, Host> decisions_;
  Features features_;
  Hierarchy<Dim> hierarchy_;
  double longest_, length_;
  double slice_begin_ = 0, slice_end_ = 0, length_before_ = 0;
  double slice_due_ = 0;  ///< when the next slice begins: before the end if too many vertices have left their tubes
  std::size_t retubed_ = 0;
  std::size_t nears_at_begin_ = 0;  ///< near pairs when the slice began
  std::size_t swept_ = 0;           ///< those of them that were far apart then
  std::vector<double> sizes_;       ///< radii of tubes
  std::vector<double> halves_;      ///< by cell: half of the largest eta(1) of its features
  std::vector<Course> courses_;
  std::vector<Plan<Dim>> tubes_;
  std::vector<TubeEnds> ends_;  ///< of tubes
  std::vector<Plan<Dim>> guards_;
  std::vector<double> due_;  ///< by vertex: the time of its event, or never
  std::priority_queue<Event, std::vector<Event>, std::greater<>> events_;
  NearPairs<Dim> nears_;
  std::vector<Pen<Dim>> pens_;
  std::vector<PairKey> known_;                            ///< for find_near_cells, ascending
  std::vector<typename Pen<Dim>::Clearance> clearances_;  ///< for put_up_pen
  std::vector<VertexId> work_;
  std::vector<bool> waiting_;
  CertificateCounts counts_;
};

}  // namespace noli::certificates

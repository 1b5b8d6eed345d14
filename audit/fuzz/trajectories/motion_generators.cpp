// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/trajectories/motion_generators.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "audit/fuzz/queries/query_generators.h"
#include "audit/fuzz/trajectories/delicate_motions.h"
#include "audit/fuzz/trajectories/floor_motion.h"
#include "trajectory/cells.h"

namespace noli::audit {

namespace {

/// k / n with n = 2, 4, ..., 64 and 0 < k < n.
StepTime time_inside(Random& random) {
  const std::int64_t n = std::int64_t{1} << random.between(1, 6);
  return {random.between(1, n - 1), n};
}

/// The end of a step of so many parts.
StepTime time_at_end(Random& random) {
  const std::int64_t n = std::int64_t{1} << random.between(0, 4);
  return {n, n};
}

FloorPlan plan_of_a_contact(Random& random) {
  FloorPlan plan;
  plan.type = random.one_of(all_query_types);
  plan.place = random.one_of(meeting_places);
  plan.when = time_inside(random);
  plan.rigid = random.one_in(2);
  plan.before = random.below(3);
  plan.after = random.below(2);
  return plan;
}

/// They come up to each other, but for the last unit: beside each other in the floor, or one unit above it.
FloorPlan plan_of_a_near_miss(Random& random) {
  FloorPlan plan = plan_of_a_contact(random);
  plan.when = time_at_end(random);
  if (random.one_in(2)) {
    plan.place = Place::missed;
  } else {
    ++plan.when.k;
    plan.fall = 1;
  }
  return plan;
}

FloorPlan contact_or_near_miss(Random& random) {
  return random.one_in(2) ? plan_of_a_contact(random) : plan_of_a_near_miss(random);
}

GeneratedMotion finished(const FloorPlan& plan, Random& random, Numbers numbers = Numbers::small,
                         std::size_t crowd = 0) {
  FloorMotion made = floor_motion(plan, random);
  if (crowd > 0) add_crowd(made.motion, random, crowd);
  return finish(std::move(made.motion), std::move(made.planted), numbers, random);
}

GeneratedMotion planted(Random& random) { return finished(plan_of_a_contact(random), random); }

GeneratedMotion near_miss(Random& random) { return finished(plan_of_a_near_miss(random), random); }

/// Small bodies that are out on the other side at the end of the step.
GeneratedMotion tunnel(Random& random) {
  FloorPlan plan = plan_of_a_contact(random);
  plan.rigid = true;
  plan.size = 4;
  plan.speed = 1;
  plan.fall = 1 << 20;
  return finished(plan, random);
}

GeneratedMotion border(Random& random) {
  FloorPlan plan = plan_of_a_contact(random);
  plan.when = time_at_end(random);
  plan.after = 1 + random.below(2);
  return finished(plan, random);
}

GeneratedMotion begin_only(Random& random) {
  FloorPlan plan = plan_of_a_contact(random);
  plan.when = {0, 1};
  plan.away = true;
  plan.before = 0;
  return finished(plan, random);
}

GeneratedMotion at_rest(Random& random) {
  FloorPlan plan = plan_of_a_contact(random);
  plan.at_rest = true;
  plan.when = {0, 1};
  if (random.one_in(2)) plan.place = Place::missed;
  return finished(plan, random);
}

GeneratedMotion one_body(Random& random) {
  FloorPlan plan = contact_or_near_miss(random);
  plan.type = all_query_types[random.below(4)];  // those in space
  plan.rigid = plan.joined = true;
  return finished(plan, random);
}

GeneratedMotion crowd(Random& random) {
  const FloorPlan plan = contact_or_near_miss(random);
  const std::size_t cells = 1 + random.below(40);
  return finished(plan, random, Numbers::small, cells);
}

GeneratedMotion scaled(Random& random) { return finished(contact_or_near_miss(random), random, Numbers::scaled); }

GeneratedMotion offset(Random& random) { return finished(contact_or_near_miss(random), random, Numbers::offset); }

Directions two_directions(Random& random, int axes, std::int64_t size) {
  Directions d = {random_direction(random, axes, size), random_direction(random, axes, size)};
  while (parallel(d.p, d.q)) d.q = random_direction(random, axes, size);
  return d;
}

/// An edge through the inside of a face; in the plane two edges through each other, or a point inside of a face.
GeneratedMotion pierced(Random& random) {
  WholeMotion motion;
  motion.dimension = random.one_in(2) ? 3 : 2;
  const bool edges = motion.dimension == 2 && random.one_in(2);
  const QueryType type{edges ? FeaturePair::edge_edge : FeaturePair::vertex_face, 3};
  const Ratios ratios = random_ratios(random);
  const Meeting met = meeting(type, Place::inside, ratios, two_directions(random, 2, 16));
  std::vector<Whole> x(met.x.begin(), met.x.end());
  motion.cells = edges ? std::vector<Feature>{{0, 1}, {2, 3}} : std::vector<Feature>{{1, 2, 3}, {0}};
  if (motion.dimension == 3) {
    Whole along = random_whole(random, 2, 16);
    along[2] = random.between(1, 16);
    x[0] = ratios[2] * along;
    x.push_back((-ratios[3]) * along);
    motion.cells = {{1, 2, 3}, {0, 4}};
  }
  motion.frames = {x};
  for (std::uint64_t i = random.below(3); i > 0; --i) {
    const Whole by = random_whole(random, motion.dimension, 1 << 10);
    motion.frames.push_back(motion.frames.back());
    for (Whole& place : motion.frames.back()) place = place + by;
  }
  return finish(std::move(motion), {true, 0, true, {}, {}}, Numbers::small, random);
}

/// Two faces that share an edge, or a vertex, and fold onto each other (side 1), fold to a straight angle and beyond
/// (side -1), or, sharing an edge, to an angle whose tip comes to lie on the line of that edge (side 0).
GeneratedMotion hinge(Random& random) {
  const bool share_edge = random.one_in(2);
  const std::int64_t side = random.between(-1, 1), size = 64;
  const StepTime when = time_inside(random);
  const auto somewhere = [&](std::int64_t sign, std::int64_t z) {
    return Whole{sign * random.between(1, size), random.between(-size, size), z};
  };
  const Whole a{0, -random.between(1, size), 0}, b{0, random.between(1, size), 0}, d = somewhere(1, 0);
  std::vector<Whole> x, v;
  WholeMotion motion;
  PlantedTruth truth;
  if (share_edge) {
    const Whole c = side == 0 ? Whole{0, random.between(-size, size), 0} : somewhere(side, 0);
    x = {a, b, d, c};
    motion.cells = {{0, 1, 2}, {0, 1, 3}};
    truth.contact = side >= 0;
  } else {
    // In the cone of the one at the shared vertex, or in the opposite one; the other tip of this face is off the floor.
    const Whole e = somewhere(1, 0);
    const std::int64_t sign = side >= 0 ? 1 : -1;
    const std::int64_t of_d = random.between(1, 3), of_e = random.between(1, 3);
    const Whole c = sign * (of_d * d + of_e * e);
    x = {Whole{}, d, e, c, somewhere(sign, random.between(1, size))};
    motion.cells = {{0, 1, 2}, {0, 3, 4}};
    truth.contact = side >= 0;
  }
  v.assign(x.size(), Whole{});
  v[3] = Whole{0, random.between(-size, size), -random.between(1, size)};
  if (!share_edge) v[4] = Whole{0, 0, v[3][2]};
  motion.frames = {x, x};
  const Whole carried = random_whole(random, 3, size);
  for (std::size_t i = 0; i < x.size(); ++i) {
    motion.frames[0][i] = x[i] - when.k * v[i];
    motion.frames[1][i] = x[i] + (when.n - when.k) * v[i] + carried;
  }
  if (truth.contact.value()) truth.time = static_cast<double>(when.k) / static_cast<double>(when.n);
  truth.initial = false;
  return finish(std::move(motion), std::move(truth), Numbers::small, random);
}

/// A generated query (audit/fuzz/queries/query_generators.h) as two loose cells.
GeneratedMotion query(Random& random) {
  const auto generators = query_generators();
  const Generated made = generators[random.below(generators.size())](random);
  GeneratedMotion result;
  FrameMotion& motion = result.motion;
  const std::size_t first = first_size(made.query.pair), all = made.query.size();
  motion.mesh.vertex_count = all;
  Feature p, q;
  for (VertexId v = 0; v < all; ++v) (v < first ? p : q).push_back(v);
  add_polygon(motion.mesh, p);
  add_polygon(motion.mesh, q);
  motion.frames = {{made.query.x_t0.begin(), made.query.x_t0.begin() + static_cast<std::ptrdiff_t>(all)},
                   {made.query.x_t1.begin(), made.query.x_t1.begin() + static_cast<std::ptrdiff_t>(all)}};
  motion.format = static_cast<FrameFormat>(random.below(3));
  if (made.truth) result.planted.contact = *made.truth != ContactKind::apart;
  return result;
}

/// Anything on a small grid: cells that share vertices, have one twice, are listed twice; one frame or some.
GeneratedMotion soup(Random& random) {
  WholeMotion motion;
  motion.dimension = random.one_in(3) ? 2 : 3;
  const std::uint64_t vertices = 3 + random.below(6), cells = 2 + random.below(4), frames = 1 + random.below(4);
  const std::int64_t size = std::int64_t{1} << random.between(0, 4);
  const bool calm = random.one_in(2);  // steps of one unit at most
  for (std::uint64_t i = 0; i < cells; ++i) {
    Feature cell(1 + random.below(3));
    for (VertexId& v : cell) v = static_cast<VertexId>(random.below(vertices));
    if (cell.size() == 2 && cell[0] == cell[1]) cell.pop_back();
    motion.cells.push_back(cell);
  }
  for (std::uint64_t i = 0; i < frames; ++i) {
    std::vector<Whole> frame(vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
      frame[v] = random_whole(random, motion.dimension, i > 0 && calm ? 1 : size);
      if (i > 0 && calm) frame[v] = frame[v] + motion.frames.back()[v];
    }
    motion.frames.push_back(frame);
  }
  return finish(std::move(motion), {}, Numbers::small, random);
}

constexpr std::array<MotionGenerator, 17> generators = {{
    {"planted", "one contact at a known time, place and kind, in any of several steps", planted},
    {"near_miss", "features that pass each other, or stop, one unit from contact, and turn back", near_miss},
    {"tunnel", "bodies that pass through each other within a step: an even number of crossings", tunnel},
    {"border", "contact at the border between two steps and at no other time", border},
    {"begin_only", "contact at the first time of all and at no other time", begin_only},
    {"at_rest", "single frames, touching or a unit apart", at_rest},
    {"one_body", "contact, or nearly, of a body with itself", one_body},
    {"crowd", "the search: a contact or a near miss beside up to forty cells that nothing meets", crowd},
    {"scaled", "subnormal and huge coordinates, a scale of its own for each axis", scaled},
    {"offset", "coordinates whose last bit is the unit", offset},
    {"pierced", "cells that intersect all the time, although no two of their features ever meet", pierced},
    {"hinge", "neighbours that share an edge or a vertex and fold onto each other", hinge},
    {"query", "the generators of `noli fuzz queries`, as loose cells", query},
    {"soup", "anything on a small grid: shared, repeated, degenerate, several contacts at once", soup},
    {"last_ulp", "contact in the last instants of a step, or the first, with a root at its end, or beginning",
     last_ulp},
    {"huge", "coordinates up to the greatest double, alone or beside tiny ones", huge},
    {"landing", "coming to rest on something, a few units in the last place off, frame after frame", landing},
}};

}  // namespace

std::span<const MotionGenerator> motion_generators() { return generators; }

std::vector<MotionGenerator> motion_generators(std::span<const std::string> names) {
  if (names.empty()) return {generators.begin(), generators.end()};
  std::vector<MotionGenerator> chosen;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(generators, name, &MotionGenerator::name);
    if (found == generators.end()) throw std::invalid_argument("no generator of motions has the name " + name);
    chosen.push_back(*found);
  }
  return chosen;
}

}  // namespace noli::audit

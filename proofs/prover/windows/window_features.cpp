// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/windows/window_features.h"

#include <algorithm>
#include <cmath>

#include "kernel/motion.h"
#include "proofs/prover/feature_pairs.h"
#include "proofs/prover/windows/chord.h"

namespace noli {

namespace {

template <int Dim>
LinearPath<Dim> path_of(const WorldLine& line, std::size_t segment) {
  LinearPath<Dim> path{line.t[segment], line.t[segment + 1], {}, {}};
  std::copy_n(line.x[segment].begin(), Dim, path.x_t0.begin());
  std::copy_n(line.x[segment + 1].begin(), Dim, path.x_t1.begin());
  return path;
}

/// The first time at which two features meet, and the kind of contact.
struct TimeAndKind {
  Moment time;
  ContactKind kind;
};

/// A pair of features and the lines of its vertices.
template <FeaturePair Pair, int Dim>
struct Lines {
  std::array<VertexId, 4> vertices;
  const WorldLines& lines;

  WorldLine line(std::size_t i) const { return {lines, vertices[i]}; }

  /// From `begin` to the next breakpoint. Precondition: begin < T1.
  MotionQuery<Pair, Dim> piece_after(double begin) const {
    MotionQuery<Pair, Dim> piece{{}, begin, lines.last_time()};
    for (std::size_t i = 0; i < piece.paths.size(); ++i) {
      piece.paths[i] = path_of<Dim>(line(i), line(i).segment_after(begin));
      piece.end = std::min(piece.end, piece.paths[i].t1);
    }
    return piece;
  }

  /// From the breakpoint before `end` to it. Precondition: T0 < end.
  MotionQuery<Pair, Dim> piece_before(double end) const {
    MotionQuery<Pair, Dim> piece{{}, lines.first_time(), end};
    for (std::size_t i = 0; i < piece.paths.size(); ++i) {
      piece.paths[i] = path_of<Dim>(line(i), line(i).segment_before(end));
      piece.begin = std::max(piece.begin, piece.paths[i].t0);
    }
    return piece;
  }

  Moment moment(double begin, double end, const TimeOfImpact& s) const {
    return {{lines.first_time(), lines.last_time()}, begin, end, s};
  }

  TimeAndKind at_border(double t) const {
    if (t == lines.last_time()) {
      return {moment(lines.first_time(), t, TimeOfImpact::from_double(1)), ContactKind::touching};
    }
    const auto after = piece_after(t);
    if (t == lines.first_time())
      return {moment(t, lines.last_time(), TimeOfImpact()), first_contact(after).value().kind};
    return {moment(t, after.end, TimeOfImpact()), kind_at_border(piece_before(t), after)};
  }

  TimeAndKind contact_from(double t) const {
    while (t < lines.last_time()) {
      const auto piece = piece_after(t);
      const auto contact = first_contact(piece);
      if (contact) {
        const Moment time = moment(piece.begin, piece.end, contact->time);
        if (time.compare(piece.begin) == 0) return at_border(piece.begin);
        if (time.compare(piece.end) == 0) return at_border(piece.end);
        return {time, contact->kind};
      }
      t = piece.end;
    }
    return at_border(t);
  }

  std::optional<TimeEnclosure> meet_between(double begin, double end) const {
    auto piece = piece_after(begin);
    piece.end = end;
    const auto contact = first_contact(piece);
    if (!contact) return std::nullopt;
    return enclosure_in_window({contact->time.lower(), contact->time.upper()}, begin, end);
  }
};

}  // namespace

TimeEnclosure enclosure_in_window(TimeEnclosure s, double begin, double end) {
  const double length = end - begin, slack = 0x1p-50 * std::max(std::abs(begin), std::abs(end)) + 0x1p-1021;
  const auto at = [&](double x, double away) {
    if (x == 0 || x == 1) return x == 0 ? begin : end;
    return std::clamp(begin + x * length + away, begin, end);
  };
  if (!std::isfinite(2 * length)) return {begin, end};
  return {at(s.begin, -slack), at(s.end, slack)};
}

std::optional<TimeEnclosure> meet_in_piece(FeaturePair pair, const std::array<VertexId, 4>& vertices,
                                           const WorldLines& lines, int dimension, double begin, double end) {
  return with_pair(pair, dimension, [&]<FeaturePair Pair, int Dim>() {
    return Lines<Pair, Dim>{vertices, lines}.meet_between(begin, end);
  });
}

FirstInWindow ExactlyInWindow::operator()(const FeatureContact& contact) const {
  TimeAndKind exact = with_pair(contact.pair, dimension, [&]<FeaturePair Pair, int Dim>() {
    return Lines<Pair, Dim>{contact.vertices, *lines}.contact_from(contact.first.begin);
  });
  FirstInWindow first{contact, exact.kind, std::move(exact.time)};
  first.contact.first = {first.time.lower(), first.time.upper()};
  return first;
}

}  // namespace noli

// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/windows/charts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "kernel/formula.h"
#include "kernel/static_predicates.h"

namespace noli {

namespace {

/// Larger groups are not tried, smaller groups are not worth it.
constexpr std::uint32_t most_faces = 256;
constexpr std::uint32_t least_faces = 4;
/// The cosine of the largest angle between a face of a chart and the mean normal, about 75 degrees.
constexpr double least_cosine = 0.26;

/// The faces at each vertex.
struct Incidence {
  std::vector<std::uint32_t> begin, faces;

  explicit Incidence(const Mesh& mesh) : begin(mesh.vertex_count + 1, 0), faces(3 * mesh.faces.size()) {
    for (const auto& f : mesh.faces) {
      for (const VertexId v : f) ++begin[v + 1];
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
      for (const VertexId v : mesh.faces[f]) faces[next[v]++] = f;
    }
  }

  std::span<const std::uint32_t> at(VertexId v) const {
    return std::span(faces).subspan(begin[v], begin[v + 1] - begin[v]);
  }
};

/// A closed rectangle.
struct Rectangle {
  Point2 low, high;

  /// Whether the interior of this rectangle has a point in common with the other.
  bool overlaps(const Rectangle& o) const {
    return low[0] < o.high[0] && o.low[0] < high[0] && low[1] < o.high[1] && o.low[1] < high[1];
  }
  bool holds(const Rectangle& o) const {
    return low[0] <= o.low[0] && o.high[0] <= high[0] && low[1] <= o.low[1] && o.high[1] <= high[1];
  }
};

Rectangle joined(const Rectangle& a, const Rectangle& b) {
  return {{std::min(a.low[0], b.low[0]), std::min(a.low[1], b.low[1])},
          {std::max(a.high[0], b.high[0]), std::max(a.high[1], b.high[1])}};
}

using Vector = std::array<double, 3>;

Vector unit(const Vector& a) {
  const double per_length = 1 / std::sqrt(formula::dot(a, a));
  return {a[0] * per_length, a[1] * per_length, a[2] * per_length};
}

}  // namespace

/// Makes charts, one group after another.
class ChartMaker {
 public:
  ChartMaker(const Mesh& mesh, std::span<const Position> x, int dimension, std::span<const std::uint32_t> cells,
             Charts& charts)
      : mesh_(mesh),
        x_(x),
        dimension_(dimension),
        cells_(cells),
        charts_(charts),
        incidence_(mesh),
        leaf_of_(mesh.faces.size(), Charts::none),
        seen_(mesh.faces.size(), 0) {
    for (std::uint32_t i = 0; i < cells.size(); ++i) {
      if (cells[i] < leaf_of_.size()) leaf_of_[cells[i]] = i;
    }
  }

  /// A chart for the group or for parts of it.
  void cover(Group g) {
    if (g.count < least_faces || (g.count <= most_faces && make(g))) return;
    cover(g.left());
    cover(g.right());
  }

 private:
  bool make(Group g) {
    group_ = g;
    ++stamp_;
    const auto frame = frame_of(g);
    if (!frame) return false;
    frame_ = *frame;
    faces_.clear();
    for (std::uint32_t i = g.begin; i < g.begin + g.count; ++i) {
      if (!take(cells_[i])) return false;
    }
    if (!take_neighbours()) return false;
    find_q();
    if (!take_what_overlaps_q() || !edges_allow_it() || !covers_once()) return false;
    keep();
    return true;
  }

  /// The plane to which the group is projected: two axes, the normal, and the origin.
  struct Frame {
    Vector u, v, normal;
    Position origin;
  };

  /// Twice the area, along the normal.
  Vector area(std::uint32_t f) const {
    const auto& [a, b, c] = mesh_.faces[f];
    using formula::operator-;
    return formula::cross(x_[b] - x_[a], x_[c] - x_[a]);
  }

  std::optional<Frame> frame_of(Group g) const {
    const Position& origin = x_[mesh_.faces[cells_[g.begin]][0]];
    if (dimension_ == 2) return Frame{{1, 0, 0}, {0, 1, 0}, {0, 0, 0}, origin};
    Vector n{};
    for (std::uint32_t i = g.begin; i < g.begin + g.count; ++i) {
      const Vector more = area(cells_[i]);
      for (std::size_t k = 0; k < 3; ++k) n[k] += more[k];
    }
    const Vector normal = unit(n);
    if (!std::isfinite(normal[0] + normal[1] + normal[2])) return std::nullopt;
    const bool along_x = std::abs(normal[0]) > 0.8;
    const Vector u = unit(formula::cross(normal, along_x ? Vector{0, 1, 0} : Vector{1, 0, 0}));
    return Frame{u, formula::cross(normal, u), normal, origin};
  }

  Point2 place(VertexId v) const {
    const Vector d = formula::operator-(x_[v], frame_.origin);
    return {formula::dot(frame_.u, d), formula::dot(frame_.v, d)};
  }

  Rectangle rectangle(std::uint32_t f) const {
    const Point2 a = place(mesh_.faces[f][0]), b = place(mesh_.faces[f][1]), c = place(mesh_.faces[f][2]);
    return joined(joined({a, a}, {b, b}), {c, c});
  }

  bool is_steep(std::uint32_t f) const {
    if (dimension_ == 2) return false;
    const Vector n = area(f);
    return !(formula::dot(n, frame_.normal) >= least_cosine * std::sqrt(formula::dot(n, n)));
  }

  /// Puts a face into S, unless it is there. False if it is steep or not laid out counterclockwise.
  bool take(std::uint32_t f) {
    if (seen_[f] == stamp_) return true;
    seen_[f] = stamp_;
    faces_.push_back(f);
    const auto& [a, b, c] = mesh_.faces[f];
    const Point2 ra = place(a), rb = place(b), rc = place(c);
    return !is_steep(f) && laid_face({a, b, c}, ra, rb, rc).usable && orientation(ra, rb, rc) > 0;
  }

  bool take_neighbours_of(std::uint32_t f, const Rectangle* q) {
    for (const VertexId v : mesh_.faces[f]) {
      for (const std::uint32_t other : incidence_.at(v)) {
        if ((q == nullptr || q->overlaps(rectangle(other))) && !take(other)) return false;
      }
    }
    return true;
  }

  bool take_neighbours() {
    for (std::size_t i = 0; i < group_.count; ++i) {
      if (!take_neighbours_of(faces_[i], nullptr)) return false;
    }
    return true;
  }

  void find_q() {
    q_ = rectangle(faces_[0]);
    for (const std::uint32_t f : faces_) q_ = joined(q_, rectangle(f));
  }

  bool take_what_overlaps_q() {
    for (std::size_t i = group_.count; i < faces_.size(); ++i) {
      if (!take_neighbours_of(faces_[i], &q_)) return false;
    }
    return true;
  }

  /// Tests (2) and (3).
  bool edges_allow_it() {
    edges_.clear();
    for (const std::uint32_t f : faces_) {
      const auto& v = mesh_.faces[f];
      for (std::size_t i = 0; i < 3; ++i) {
        const VertexId a = v[i], b = v[i == 2 ? 0 : i + 1];
        edges_.push_back({std::min(a, b), std::max(a, b), a < b});
      }
    }
    std::sort(edges_.begin(), edges_.end());
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const bool more = i + 1 < edges_.size();
      if (more && edges_[i] == edges_[i + 1]) return false;
      if (more && edges_[i].low == edges_[i + 1].low && edges_[i].high == edges_[i + 1].high) {
        ++i;
        if (i + 1 < edges_.size() && edges_[i] == edges_[i + 1]) return false;
        continue;
      }
      const Point2 a = place(edges_[i].low), b = place(edges_[i].high);
      if (q_.overlaps(joined({a, a}, {b, b}))) return false;
    }
    return true;
  }

  /// Tests (4), for a point near the middle of the group's first face.
  bool covers_once() const {
    const auto& first = mesh_.faces[faces_[0]];
    const Point2 a = place(first[0]), b = place(first[1]), c = place(first[2]);
    const Point2 p = {(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3};
    if (orientation(a, b, p) <= 0 || orientation(b, c, p) <= 0 || orientation(c, a, p) <= 0) return false;
    if (!q_.overlaps({p, p})) return false;
    return std::none_of(faces_.begin() + 1, faces_.end(), [&](std::uint32_t f) {
      const auto& v = mesh_.faces[f];
      return rectangle(f).holds({p, p}) && intersects(p, Triangle2{place(v[0]), place(v[1]), place(v[2])});
    });
  }

  void keep() {
    const auto chart = static_cast<std::uint32_t>(charts_.groups_.size());
    charts_.groups_.push_back(group_);
    for (std::uint32_t i = group_.begin; i < group_.begin + group_.count; ++i) charts_.chart_of_leaf_[i] = chart;
    leaves_.clear();
    for (const std::uint32_t f : faces_) {
      const auto& [a, b, c] = mesh_.faces[f];
      charts_.faces_.push_back(laid_face({a, b, c}, place(a), place(b), place(c)));
      if (q_.holds(rectangle(f)) && leaf_of_[f] != Charts::none) leaves_.push_back(leaf_of_[f]);
    }
    charts_.first_face_.push_back(charts_.faces_.size());
    std::sort(leaves_.begin(), leaves_.end());
    for (const std::uint32_t leaf : leaves_) {
      const bool fresh = charts_.runs_.size() == charts_.first_run_.back();
      if (fresh || charts_.runs_.back().end != leaf) charts_.runs_.push_back({leaf, leaf});
      charts_.runs_.back().end = leaf + 1;
    }
    charts_.first_run_.push_back(charts_.runs_.size());
  }

  /// An edge by its vertices, and whether it goes from the lower to the higher.
  struct Edge {
    VertexId low, high;
    bool up;
    friend auto operator<=>(const Edge&, const Edge&) = default;
  };

  const Mesh& mesh_;
  std::span<const Position> x_;
  int dimension_;
  std::span<const std::uint32_t> cells_;
  Charts& charts_;
  Incidence incidence_;
  std::vector<std::uint32_t> leaf_of_;  ///< by face
  std::vector<std::uint32_t> seen_;     ///< by face, the stamp of the last attempt that visited it
  std::uint32_t stamp_ = 0;

  // The current attempt.
  Group group_;
  Frame frame_{};
  Rectangle q_{};
  std::vector<std::uint32_t> faces_, leaves_;
  std::vector<Edge> edges_;
};

Charts::Charts(const Mesh& mesh, std::span<const Position> x, int dimension, std::span<const std::uint32_t> cells,
               std::span<const Group> roots)
    : chart_of_leaf_(cells.size(), none) {
  if (roots.empty()) return;
  ChartMaker maker(mesh, x, dimension, cells, *this);
  for (const Group root : roots) maker.cover(root);
}

std::uint32_t Charts::chart_of(Group g) const {
  const std::uint32_t chart = chart_of_leaf_[g.begin];
  if (chart == none) return none;
  return g.begin + g.count <= groups_[chart].begin + groups_[chart].count ? chart : none;
}

bool Charts::covers(std::uint32_t chart, Group g) const {
  const auto first = runs_.begin() + static_cast<std::ptrdiff_t>(first_run_[chart]);
  const auto last = runs_.begin() + static_cast<std::ptrdiff_t>(first_run_[chart + 1]);
  const auto run = std::upper_bound(first, last, g.begin, [](std::uint32_t i, const Run& r) { return i < r.end; });
  return run != last && run->begin <= g.begin && g.begin + g.count <= run->end;
}

}  // namespace noli

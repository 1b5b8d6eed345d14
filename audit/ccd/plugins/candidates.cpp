// SPDX-License-Identifier: Apache-2.0
//
// noli_ccd_candidates of all the libraries here: the boxes in which features stay during the step, sorted along the
// axis on which their centres spread most, and swept (Cohen, Lin, Manocha and Ponamgi 1995, "I-COLLIDE", section 4,
// along one axis).
//
// What was not done: threads, and the inflation of boxes for methods whose tolerance reaches further than contact.
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "points.h"

namespace {

struct Box {
  std::array<double, 3> low, high;
  std::array<std::uint32_t, 3> vertices;  ///< the last one repeated where it has fewer
  std::uint32_t number;

  bool meets(const Box& b) const {
    for (std::size_t i = 0; i < 3; ++i) {
      if (low[i] > b.high[i] || b.low[i] > high[i]) return false;
    }
    return true;
  }
  bool shares_a_vertex_with(const Box& b) const {
    return std::any_of(vertices.begin(), vertices.end(), [&](std::uint32_t v) {
      return std::find(b.vertices.begin(), b.vertices.end(), v) != b.vertices.end();
    });
  }
};

class Boxes {
 public:
  Boxes(const double* x_t0, const double* x_t1, double distance) : x_{x_t0, x_t1}, inflation_(0.5 * distance) {}

  void add(std::uint32_t number, const std::array<std::uint32_t, 3>& vertices) {
    Box box{{}, {}, vertices, number};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double low = x_[0][3 * std::size_t{vertices[0]} + axis], high = low;
      for (const double* const x : x_) {
        for (const std::uint32_t v : vertices) {
          low = std::min(low, x[3 * std::size_t{v} + axis]);
          high = std::max(high, x[3 * std::size_t{v} + axis]);
        }
      }
      box.low[axis] = std::nextafter(low - inflation_, -HUGE_VAL);
      box.high[axis] = std::nextafter(high + inflation_, HUGE_VAL);
    }
    boxes_.push_back(box);
  }

  void sort(std::size_t axis) {
    std::sort(boxes_.begin(), boxes_.end(), [=](const Box& a, const Box& b) { return a.low[axis] < b.low[axis]; });
  }

  std::size_t widest_axis() const {
    std::array<double, 3> sum{}, squares{};
    for (const Box& box : boxes_) {
      for (std::size_t i = 0; i < 3; ++i) {
        const double centre = 0.5 * (box.low[i] + box.high[i]);
        sum[i] += centre;
        squares[i] += centre * centre;
      }
    }
    const auto n = static_cast<double>(boxes_.size());
    const auto variance = [&](std::size_t i) { return squares[i] / n - (sum[i] / n) * (sum[i] / n); };
    std::size_t best = 0;
    for (std::size_t i = 1; i < 3; ++i) best = variance(i) > variance(best) ? i : best;
    return best;
  }

  const std::vector<Box>& all() const { return boxes_; }

 private:
  std::array<const double*, 2> x_;
  double inflation_;
  std::vector<Box> boxes_;
};

struct Sink {
  noli_ccd_candidate found;
  void* data;
  int kind;

  void operator()(const Box& a, const Box& b) const {
    if (a.meets(b) && !a.shares_a_vertex_with(b)) found(data, kind, a.number, b.number);
  }
};

/// Each box against those that begin behind it and before its end.
void sweep_one(const std::vector<Box>& boxes, std::size_t axis, const Sink& sink) {
  for (auto a = boxes.begin(); a != boxes.end(); ++a) {
    for (auto b = a + 1; b != boxes.end() && b->low[axis] <= a->high[axis]; ++b) sink(*a, *b);
  }
}

/// The same between two lists, the pairs in the order (first, second).
void sweep_two(const std::vector<Box>& first, const std::vector<Box>& second, std::size_t axis, const Sink& sink) {
  auto i = first.begin(), k = second.begin();
  while (i != first.end() && k != second.end()) {
    if (i->low[axis] <= k->low[axis]) {
      for (auto b = k; b != second.end() && b->low[axis] <= i->high[axis]; ++b) sink(*i, *b);
      ++i;
    } else {
      for (auto a = i; a != first.end() && a->low[axis] <= k->high[axis]; ++a) sink(*a, *k);
      ++k;
    }
  }
}

}  // namespace

extern "C" int noli_ccd_candidates(size_t vertices, const double* x_t0, const double* x_t1, size_t edges,
                                   const uint32_t* edge_vertices, size_t faces, const uint32_t* face_vertices,
                                   double distance, noli_ccd_candidate found, void* data) try {
  if (edges > 0) {
    Boxes boxes(x_t0, x_t1, distance);
    for (std::uint32_t e = 0; e < edges; ++e) {
      const std::uint32_t* const v = edge_vertices + 2 * std::size_t{e};
      boxes.add(e, {v[0], v[1], v[1]});
    }
    const std::size_t axis = boxes.widest_axis();
    boxes.sort(axis);
    sweep_one(boxes.all(), axis, {found, data, NOLI_CCD_EDGE_EDGE});
  }
  Boxes points(x_t0, x_t1, distance), triangles(x_t0, x_t1, distance);
  for (std::uint32_t v = 0; v < vertices; ++v) points.add(v, {v, v, v});
  for (std::uint32_t f = 0; f < faces; ++f) {
    const std::uint32_t* const v = face_vertices + 3 * std::size_t{f};
    triangles.add(f, {v[0], v[1], v[2]});
  }
  const std::size_t axis = points.widest_axis();
  points.sort(axis);
  triangles.sort(axis);
  sweep_two(points.all(), triangles.all(), axis, {found, data, NOLI_CCD_VERTEX_FACE});
  return 0;
} catch (...) {  // no memory
  return NOLI_CCD_FAILED;
}

// SPDX-License-Identifier: Apache-2.0
#include "certify/listed_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <unordered_map>
#include <utility>

#include "certificates/closest.h"
#include "certify/contact_report.h"
#include "trajectory/sample.h"

namespace noli {
namespace {

using certificates::Closest;
using certificates::Vector;

/// Halfway between the closest points of two edges.
template <int Dim>
Position between_edges(FeaturePair pair, std::span<const Position> x) {
  double greatest = 0;
  for (const Position& corner : x) {
    for (const double coordinate : corner) greatest = std::max(greatest, std::abs(coordinate));
  }
  const int exponent = greatest > 0 ? std::ilogb(greatest) : 0;  // scaled by it, squares do not overflow
  std::array<Vector<Dim>, 4> corners;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t d = 0; d < Dim; ++d) corners[i][d] = std::ldexp(x[i][d], -exponent);
  }
  const Closest<Dim> closest = certificates::closest<Dim>(pair, std::span<const Vector<Dim>>(corners.data(), x.size()));
  Position point = x[0];
  for (std::size_t d = 0; d < Dim; ++d) {
    point[d] = 0;
    for (std::size_t i = 0; i < x.size(); ++i) point[d] += 0.5 * std::abs(closest.weights[i]) * x[i][d];
  }
  return point;
}

std::span<const VertexId> feature(const FeatureContact& contact, std::size_t which) {
  const std::size_t first = first_size(contact.pair), size = point_count(contact.pair);
  const std::span<const VertexId> all(contact.vertices.data(), size);
  return which == 0 ? all.first(first) : all.subspan(first);
}

/// Two faces of the same vertices have equal contacts.
void erase_one(std::vector<FeatureContact>& contacts, const FeatureContact& contact) {
  const auto found = std::ranges::find(contacts, contact);
  if (found != contacts.end()) contacts.erase(found);
}

/// Finds the cells of all requested features in one pass over the mesh.
class Owners {
 public:
  explicit Owners(std::span<ListedContact*> contacts) {
    for (ListedContact* const listed : contacts) {
      for (const std::size_t which : {std::size_t{0}, std::size_t{1}}) {
        const auto vertices = feature(listed->contact, which);
        wanted_.emplace(vertices.front(), Wanted{vertices, &listed->cells[which]});
      }
    }
  }

  void look_at(std::uint32_t cell, std::span<const VertexId> corners) {
    for (const VertexId corner : corners) {
      const auto [begin, end] = wanted_.equal_range(corner);
      for (auto at = begin; at != end; ++at) {
        const auto& [vertices, cells] = at->second;
        const auto has = [&](VertexId v) { return std::ranges::find(corners, v) != corners.end(); };
        const bool again = !cells->empty() && cells->back() == cell;
        if (!again && cells->size() < ListedContact::most_cells && std::ranges::all_of(vertices, has)) {
          cells->push_back(cell);
        }
      }
    }
  }

 private:
  struct Wanted {
    std::span<const VertexId> vertices;
    std::vector<std::uint32_t>* cells;
  };
  std::unordered_multimap<VertexId, Wanted> wanted_;  ///< by the first vertex of the feature
};

}  // namespace

Position meeting_point(FeaturePair pair, int dimension, std::span<const Position> x) {
  if (pair != FeaturePair::edge_edge) return x[0];  // the first feature is a vertex
  return dimension == 2 ? between_edges<2>(pair, x) : between_edges<3>(pair, x);
}

ListedContact listed_in_window(const FeatureContact& contact, ContactKind kind, double time, const WorldLines& lines,
                               int dimension) {
  std::array<Position, 4> x{};
  const std::size_t size = point_count(contact.pair);
  for (std::size_t i = 0; i < size; ++i) x[i] = sample(lines, contact.vertices[i], time);
  return {contact, 0, kind, time, meeting_point(contact.pair, dimension, {x.data(), size}), {}, {}};
}

std::vector<std::size_t> fair_shares(std::span<const std::size_t> counts, std::size_t most) {
  std::vector<std::size_t> sorted(counts.begin(), counts.end());
  std::ranges::sort(sorted);
  std::size_t left = most, share = 0, more = 0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const std::size_t steps = sorted.size() - i;
    share = left / steps;
    more = left % steps;
    if (sorted[i] > share) break;  // and so have all that follow
    share = sorted[i];
    more = 0;
    left -= sorted[i];
  }
  std::vector<std::size_t> shares;
  shares.reserve(counts.size());
  for (const std::size_t count : counts) {
    const bool one_more = count > share && more > 0;
    more -= one_more ? 1 : 0;
    shares.push_back(std::min(count, share) + (one_more ? 1 : 0));
  }
  return shares;
}

void ContactList::add(std::size_t step, const std::optional<ListedContact>& first,
                      std::span<const FeatureContact> contacts, const Exactly& exactly,
                      const std::function<bool()>& stopped) {
  std::vector<FeatureContact> others(contacts.begin(), contacts.end());
  if (first) erase_one(others, first->contact);
  const std::size_t count = others.size() + (first ? 1 : 0);
  if (count == 0 || counts_.size() >= most_) return;  // each step then has its one contact already
  counts_.push_back(count);
  const std::vector<std::size_t> shares = fair_shares(counts_, most_);
  cut_to(shares);
  const std::size_t share = shares.back();
  std::vector<ListedContact> listed;
  if (first && share > 0) listed.push_back(*first);
  constexpr std::size_t between_looks = 256;
  for (std::size_t i = 0; listed.size() < share; ++i) {
    if (i % between_looks == between_looks - 1 && stopped()) break;
    listed.push_back(exactly(others[i]));
    listed.back().step = step;
  }
  steps_.push_back(std::move(listed));
}

void ContactList::cut_to(std::span<const std::size_t> shares) {
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    if (steps_[i].size() > shares[i]) steps_[i].resize(shares[i]);
  }
}

std::vector<ListedContact> ContactList::take() {
  std::vector<ListedContact> all;
  for (auto& step : steps_) std::ranges::move(step, std::back_inserter(all));
  steps_.clear();
  counts_.clear();
  return all;
}

void name_owners(const Mesh& mesh, const BodyNames& names, std::span<ListedContact*> contacts) {
  if (contacts.empty()) return;
  Owners owners(contacts);
  std::uint32_t cell = 0;
  for (const auto& face : mesh.faces) owners.look_at(cell++, face);
  for (const auto& edge : mesh.edges) owners.look_at(cell++, edge);
  for (const VertexId& point : mesh.points) owners.look_at(cell++, {&point, 1});
  for (ListedContact* const listed : contacts) {
    for (const std::size_t which : {std::size_t{0}, std::size_t{1}}) {
      const auto bodies = names.bodies_of(feature(listed->contact, which));
      if (!bodies.empty()) listed->bodies[which] = bodies.front();
      for (const VertexId v : feature(listed->contact, which)) {
        const BodyNames::Body* const body = names.body_of(v);
        if (body == nullptr || !body->first_face) continue;
        listed->own[which].push_back(static_cast<VertexId>(v - body->first));
        if (const auto face = face_of(*listed); face && which == 1) listed->own_face = *face - *body->first_face;
      }
    }
  }
}

}  // namespace noli

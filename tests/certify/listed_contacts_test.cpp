// SPDX-License-Identifier: Apache-2.0
#include "certify/listed_contacts.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace noli {
namespace {

using Counts = std::vector<std::size_t>;

TEST(FairShares, ArePartsOfEqualSize) {
  EXPECT_EQ(fair_shares(Counts{10, 10, 10}, 30), (Counts{10, 10, 10}));
  EXPECT_EQ(fair_shares(Counts{10, 10, 10}, 9), (Counts{3, 3, 3}));
  EXPECT_EQ(fair_shares(Counts{10, 10, 10}, 11), (Counts{4, 4, 3}));
  EXPECT_EQ(fair_shares(Counts{1, 100, 2, 100}, 13), (Counts{1, 5, 2, 5}));
  EXPECT_EQ(fair_shares(Counts{100, 1, 100}, 4), (Counts{2, 1, 1}));
  EXPECT_EQ(fair_shares(Counts{5, 5, 5}, 2), (Counts{1, 1, 0}));
  EXPECT_EQ(fair_shares(Counts{}, 4), Counts{});
  EXPECT_EQ(fair_shares(Counts{7}, 0), Counts{0});
}

TEST(FairShares, UseAllThereIsAndDifferByOneAtMost) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    Counts counts(random() % 8);
    for (std::size_t& count : counts) count = random() % 12;
    const std::size_t all = std::accumulate(counts.begin(), counts.end(), std::size_t{0}), most = random() % 60;
    const Counts shares = fair_shares(counts, most);
    EXPECT_EQ(std::accumulate(shares.begin(), shares.end(), std::size_t{0}), std::min(all, most));
    for (std::size_t i = 0; i < counts.size(); ++i) {
      ASSERT_LE(shares[i], counts[i]);
      if (shares[i] == counts[i]) continue;
      for (const std::size_t other : shares) ASSERT_LE(other, shares[i] + 1);
    }
  }
}

/// ContactList relies on this to shorten earlier lists.
TEST(FairShares, NeverGrowWhenAStepComes) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 2000; ++trial) {
    Counts counts;
    Counts before;
    const std::size_t most = 1 + random() % 20;
    for (int step = 0; step < 8; ++step) {
      counts.push_back(1 + random() % 9);
      const Counts shares = fair_shares(counts, most);
      for (std::size_t i = 0; i < before.size(); ++i) ASSERT_LE(shares[i], before[i]);
      before = shares;
    }
  }
}

FeatureContact vertex_face(VertexId v) { return {FeaturePair::vertex_face, {v, 0, 1, 2}, {}}; }

ListedContact listed(const FeatureContact& contact) { return {contact, 0, ContactKind::crossing, 0.5, {}, {}, {}}; }

TEST(ContactList, SharesItsRoomAndPutsTheFirstFirst) {
  ContactList list(4);
  std::size_t asked = 0;
  const auto exactly = [&](const FeatureContact& contact) {
    ++asked;
    return listed(contact);
  };
  const std::vector<FeatureContact> contacts = {vertex_face(3), vertex_face(4), vertex_face(5), vertex_face(6)};
  ListedContact first = listed(vertex_face(5));
  first.step = 1;
  list.add(1, first, contacts, exactly, [] { return false; });
  list.add(3, std::nullopt, contacts, exactly, [] { return false; });
  const std::vector<ListedContact> all = list.take();
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[0].contact.vertices[0], 5U);
  EXPECT_EQ(all[1].contact.vertices[0], 3U);
  EXPECT_EQ(all[0].step, 1U);
  EXPECT_EQ(all[2].step, 3U);
  EXPECT_EQ(all[3].contact.vertices[0], 4U);
  EXPECT_EQ(asked, 5U);  // three of the first step besides the known one, and two of the other
}

TEST(ContactList, ListsTheContactsOfEachOfTwoEqualFaces) {
  ContactList list(10);
  const std::vector<FeatureContact> contacts = {vertex_face(3), vertex_face(3), vertex_face(4), vertex_face(4)};
  list.add(1, listed(vertex_face(3)), contacts, listed, [] { return false; });
  const std::vector<ListedContact> all = list.take();
  ASSERT_EQ(all.size(), 4U);
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i].contact, contacts[i]);
}

TEST(ContactList, OfManyStepsAsksForNoMoreThanAreListed) {
  ContactList list(10);
  std::size_t asked = 0;
  const auto exactly = [&](const FeatureContact& contact) {
    ++asked;
    return listed(contact);
  };
  const std::vector<FeatureContact> contacts(50, vertex_face(3));
  for (std::size_t step = 1; step <= 1000; ++step)
    list.add(step, std::nullopt, contacts, exactly, [] { return false; });
  const auto all = list.take();
  EXPECT_EQ(all.size(), 10U);
  EXPECT_EQ(all.back().step, 10U);
  EXPECT_LT(asked, 40U);
}

TEST(ContactList, EndsWhenItIsStopped) {
  ContactList list(100'000);
  const std::vector<FeatureContact> contacts(100'000, vertex_face(3));
  list.add(1, std::nullopt, contacts, listed, [] { return true; });
  EXPECT_LT(list.take().size(), 1000U);
}

TEST(MeetingPoint, OfAVertexIsTheVertex) {
  const std::array<Position, 4> x = {Position{0.25, 0.25, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(meeting_point(FeaturePair::vertex_face, 3, x), x[0]);
  EXPECT_EQ(meeting_point(FeaturePair::vertex_vertex, 3, std::span(x).first(2)), x[0]);
}

TEST(MeetingPoint, OfEdgesIsWhereTheyCross) {
  for (const double scale : {1.0, 0x1p-1000, 0x1p1020}) {
    const std::array<Position, 4> x = {Position{0, 0, 0}, {scale, scale, 0}, {0, scale, 0}, {scale, 0, 0}};
    const Position point = meeting_point(FeaturePair::edge_edge, 3, x);
    EXPECT_DOUBLE_EQ(point[0], 0.5 * scale);
    EXPECT_DOUBLE_EQ(point[1], 0.5 * scale);
    EXPECT_EQ(point[2], 0);
  }
}

TEST(MeetingPoint, OfParallelOrDegenerateEdgesIsOnBoth) {
  const std::array<Position, 4> parallel = {Position{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {3, 0, 0}};
  const Position overlap = meeting_point(FeaturePair::edge_edge, 3, parallel);
  EXPECT_GE(overlap[0], 1);
  EXPECT_LE(overlap[0], 2);
  const std::array<Position, 4> point = {Position{1, 0, 0}, {1, 0, 0}, {0, 0, 0}, {2, 0, 0}};
  EXPECT_EQ(meeting_point(FeaturePair::edge_edge, 3, point), (Position{1, 0, 0}));
}

TEST(NameOwners, FindsCellsAndBodies) {
  Mesh mesh{8, {{0, 1, 2}, {2, 1, 3}}, {{4, 5}}, {6}};
  ListedContact edges = listed({FeaturePair::edge_edge, {1, 2, 4, 5}, {}});
  ListedContact vertex = listed({FeaturePair::vertex_face, {6, 0, 1, 2}, {}});
  std::array all = {&edges, &vertex};
  name_owners(mesh, BodyNames({{"sheet", 0, 4}, {"rod", 4, 2}}), all);
  EXPECT_EQ(edges.cells[0], (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(edges.cells[1], std::vector<std::uint32_t>{2});
  EXPECT_EQ(edges.bodies, (std::array<std::string, 2>{"sheet", "rod"}));
  EXPECT_EQ(vertex.cells[0], std::vector<std::uint32_t>{3});
  EXPECT_EQ(vertex.cells[1], std::vector<std::uint32_t>{0});
  EXPECT_EQ(vertex.bodies, (std::array<std::string, 2>{"", "sheet"}));
}

TEST(NameOwners, ListsNoMoreCellsThanItSays) {
  Mesh mesh{202, {}, {}, {}};
  for (VertexId v = 1; v + 1 < 202; ++v) mesh.faces.push_back({0, v, v + 1});
  ListedContact contact = listed({FeaturePair::vertex_vertex, {0, 5, 0, 0}, {}});
  std::array all = {&contact};
  name_owners(mesh, BodyNames(), all);
  EXPECT_EQ(contact.cells[0].size(), ListedContact::most_cells);
  EXPECT_EQ(contact.cells[1], (std::vector<std::uint32_t>{3, 4}));
}

}  // namespace
}  // namespace noli

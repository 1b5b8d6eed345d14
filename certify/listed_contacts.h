// SPDX-License-Identifier: Apache-2.0
//
// Chooses the contacts that a result lists, and finds time, kind, point, cells and bodies of each.
//
// Notation
//   share   how many of a step's contacts are listed. All steps have the same share; a step with fewer contacts leaves
//           the rest to the others. What does not divide goes to the earlier steps
//
// A share never grows when a further step comes. So a step is looked at for what it has at that time, and cut later.
//
// What this does not do: it finds no contacts. The point is computed in double, for people and pictures.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <noli/findings.h>
#include <noli/mesh.h>
#include "certify/body_names.h"
#include "proofs/prover/windows/window_verifier.h"
#include "trajectory/world_lines.h"

namespace noli {

/// Where the two features meet, whose vertices are at x: those of the first feature come first.
Position meeting_point(FeaturePair pair, int dimension, std::span<const Position> x);

/// The first contact of a window with these lines, without its step.
ListedContact listed_in_window(const FirstInWindow& first, const WorldLines& lines, int dimension);

/// How many of `counts` each step may list, `most` in all.
std::vector<std::size_t> fair_shares(std::span<const std::size_t> counts, std::size_t most);

/// Lists the contacts of steps that come one after another.
class ContactList {
 public:
  /// Tells kind, time and point of a contact of the step.
  using Exactly = std::function<ListedContact(const FeatureContact&)>;

  explicit ContactList(std::size_t most) : most_(most) {}

  /// The contacts of the next step. `first`: the one that is listed first, or nothing. `stopped`: no more is listed
  /// once it says so.
  void add(std::size_t step, const std::optional<ListedContact>& first, std::span<const FeatureContact> contacts,
           const Exactly& exactly, const std::function<bool()>& stopped);
  std::vector<ListedContact> take();

 private:
  void cut_to(std::span<const std::size_t> shares);

  std::size_t most_;
  std::vector<std::size_t> counts_;                ///< of the steps that have any: how many could be listed
  std::vector<std::vector<ListedContact>> steps_;  ///< what is listed of them
};

/// Fills in cells and bodies. Precondition: the contacts are about vertices of the mesh.
void name_owners(const Mesh& mesh, const BodyNames& names, std::span<ListedContact*> contacts);

}  // namespace noli

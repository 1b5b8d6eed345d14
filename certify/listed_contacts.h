// SPDX-License-Identifier: Apache-2.0
//
// Chooses the contacts that a result lists, and finds time, kind, point, cells and bodies of each.
//
// Notation
//   share   how many of a step's contacts are listed. All steps have the same share; a step with fewer contacts leaves
//           the rest to the others. A remainder goes to the earlier steps
//
// A share never grows when a further step comes. So each step lists as many as its share is at that time, and is cut
// later.
//
// The point is computed in double, for people and pictures.
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

/// The point at which two features meet. x: the positions of their vertices, those of the first feature first.
Position meeting_point(FeaturePair pair, int dimension, std::span<const Position> x);

/// A contact of a window with these lines, without its step. `time`: when it begins.
ListedContact listed_in_window(const FeatureContact& contact, ContactKind kind, double time, const WorldLines& lines,
                               int dimension);

/// How many contacts each step may list: at most its entry of `counts`, and `most` in all.
std::vector<std::size_t> fair_shares(std::span<const std::size_t> counts, std::size_t most);

/// Lists the contacts of steps that come one after another.
class ContactList {
 public:
  /// Finds kind, time and point of a contact of the step.
  using Exactly = std::function<ListedContact(const FeatureContact&)>;

  explicit ContactList(std::size_t most) : most_(most) {}

  /// The contacts of the next step. `first`: the one that is listed first, or nothing. Lists no more once `stopped`
  /// returns true.
  void add(std::size_t step, const std::optional<ListedContact>& first, std::span<const FeatureContact> contacts,
           const Exactly& exactly, const std::function<bool()>& stopped);
  std::vector<ListedContact> take();

 private:
  void cut_to(std::span<const std::size_t> shares);

  std::size_t most_;
  std::vector<std::size_t> counts_;                ///< of the steps that have any: how many could be listed
  std::vector<std::vector<ListedContact>> steps_;  ///< the listed contacts of these steps
};

/// Fills in cells and bodies. Precondition: the contacts are about vertices of the mesh.
void name_owners(const Mesh& mesh, const BodyNames& names, std::span<ListedContact*> contacts);

}  // namespace noli

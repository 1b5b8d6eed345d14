// SPDX-License-Identifier: Apache-2.0
//
// Sequences of frames that are known to be free of contact, or known not to be, for the tests of proofs.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <noli/mesh.h>

namespace noli::app_tests {

/// A mesh, and where its vertices are in each frame.
struct Sequence {
  std::string name;
  Mesh mesh;
  std::vector<std::vector<Position>> frames;
  std::vector<std::string> options = {};  ///< of `noli verify`
};

/// At least thirty, none of which has a contact: sheets that slide and wave, rods that twist, stacks that fall, near
/// misses down to one unit in the last place, in the plane, loose edges and points, 2 to 200 frames. Coordinates are
/// made with + - * / alone.
std::vector<Sequence> untouched_sequences();

/// The same in large: about so many faces.
Sequence large_sequence(std::size_t faces);

/// Writes the frames as ASCII PLY with as many digits as it takes and returns their paths.
std::vector<std::string> write_frames(const Sequence& sequence,
                                      const std::function<std::string(const std::string&, const std::string&)>& write);

}  // namespace noli::app_tests

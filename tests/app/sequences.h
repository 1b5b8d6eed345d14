// SPDX-License-Identifier: Apache-2.0
//
// Builds sequences of frames with or without contact, as known by construction, for the tests of proofs.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <noli/mesh.h>

namespace noli::app_tests {

/// A mesh, and the positions of its vertices in each frame.
struct Sequence {
  std::string name;
  Mesh mesh;
  std::vector<std::vector<Position>> frames;
  std::vector<std::string> options = {};  ///< of `noli verify`
};

/// At least thirty sequences without contact: sheets that slide and wave, rods that twist, stacks that fall, near
/// misses down to one unit in the last place, motions in the plane, loose edges and points, 2 to 200 frames.
/// Coordinates are computed with only + - * /.
std::vector<Sequence> untouched_sequences();

/// A large sequence without contact, with about `faces` faces.
Sequence large_sequence(std::size_t faces);

/// Writes the frames as ASCII PLY with enough digits to be exact; returns their paths.
std::vector<std::string> write_frames(const Sequence& sequence,
                                      const std::function<std::string(const std::string&, const std::string&)>& write);

}  // namespace noli::app_tests

// SPDX-License-Identifier: Apache-2.0
//
// Small inputs for the command: a folder that is removed after the test, and simple meshes with known contacts.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <noli/mesh.h>
#include "tests/support/real_data.h"
#include "tests/support/temporary_folder.h"

namespace noli::app_tests {

using test::read_text;
using test::real_data;

/// A temporary folder whose paths are strings for a command line.
class Folder {
 public:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  /// Writes a file and returns its path.
  std::string write(const std::string& name, std::string_view content) const {
    return folder_.write(name, content).string();
  }
  /// Names of its files, sorted.
  std::vector<std::string> names() const { return folder_.names(); }

 private:
  test::TemporaryFolder folder_;
};

/// An ASCII PLY file of these points, with these faces.
std::string ply_text(const std::vector<Position>& points, const std::vector<std::array<VertexId, 3>>& faces);

/// Two triangles in the planes z = 0 and z = height. The upper one, vertices 3 to 5, lies well inside the outline of
/// the lower one. When it passes through z = 0, only its three vertices meet the lower face.
std::string two_triangles(double height);

/// A triangle, and a second one that stands in its middle like a sail through a deck: no vertex meets a face, and no
/// edge meets an edge.
std::string sail_through_deck();

/// Two sheets of about `faces` faces in all that move together and never touch. Binary PLY.
std::string sheets(std::size_t faces, double height);

}  // namespace noli::app_tests

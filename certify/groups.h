// SPDX-License-Identifier: Apache-2.0
//
// Groups of vertices whose cells are not compared with each other: `noli verify --ignore GROUPS.json`.
//
//   {"groups": {"cloth": [[0, 4999]], "body": [[5000, 9999], 12000]}, "ignore": [["cloth", "body"], ["body", "body"]]}
//
// Vertices are numbers or [first, last], both included. Those of no group belong to none of the pairs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <noli/mesh.h>

namespace noli {

struct Groups {
  std::vector<std::string> names;  ///< of group g from 1 on at g; 0 are the vertices of no group
  Exclusions exclusions;
};

/// For meshes of so many vertices. Throws InputError, with the JSON pointer: no such file, no JSON, other fields, a
/// vertex that is not there or in two groups, a pair that names no group, no pair at all.
Groups read_groups(const std::filesystem::path& file, std::size_t vertices);

/// Throws InputError when a cell has vertices of two groups.
void require_whole_cells(const std::filesystem::path& file, const Groups& groups, const Mesh& mesh);

}  // namespace noli

// SPDX-License-Identifier: Apache-2.0
//
// Groups of vertices whose cells are not compared with each other: `noli verify --ignore GROUPS.json`.
//
//   {"groups": {"cloth": [[0, 4999]], "body": [[5000, 9999], 12000]}, "ignore": [["cloth", "body"], ["body", "body"]]}
//
// Vertices are numbers or [first, last], both included. Vertices without a group are compared with everything. Bodies
// that have names are groups, and "groups" may be missing then: {"ignore": [["shirt", "avatar"]]}.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <noli/mesh.h>
#include "certify/body_names.h"

namespace noli {

struct Groups {
  std::vector<std::string> names;  ///< by group, from 1 on; group 0 has the vertices without a group
  Exclusions exclusions;
};

/// `vertices`: the number of vertices of the mesh. Throws InputError, with the JSON pointer: no such file, not JSON,
/// other fields, a vertex that does not exist or is in two groups, a pair that names no group, no pair at all.
Groups read_groups(const std::filesystem::path& file, std::size_t vertices, const BodyNames& bodies = BodyNames());

/// Throws InputError when a cell has vertices of two groups.
void require_whole_cells(const std::filesystem::path& file, const Groups& groups, const Mesh& mesh);

}  // namespace noli

// SPDX-License-Identifier: Apache-2.0
//
// Who may include whom. The table is that of the design: geometry and trajectories know nothing of the project, physics
// and proof never meet below certify, the checker knows nobody, the oracle knows nobody, and only the command knows
// all.
//
// What this does not do: it does not run the preprocessor. An include counts even where an #if leaves it out.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace noli::repository {

/// One #include line. `target` is what stands between the quotes or brackets, and empty where a macro names it.
struct Include {
  int line = 0;
  std::string target;
};

std::vector<Include> includes(std::string_view text);

/// The layer a path relative to the project's root is in: its row of the table ("kernel", "proofs/checker",
/// "oracle", ...), else its first folder.
std::string layer_of(const std::filesystem::path& relative);

/// The layer that an include of `file` (relative to `root`) leads to; nothing if it leads out of the project.
std::optional<std::string> included_layer(const std::filesystem::path& root, const std::filesystem::path& file,
                                          const std::string& target);

/// Whether a file of layer `from` may include one of layer `to`. A layer without a row may include everything.
bool may_include(const std::string& from, const std::string& to);

/// One line for each include below `root` that the table forbids: "FILE:LINE: ...".
std::vector<std::string> layering_violations(const std::filesystem::path& root);

}  // namespace noli::repository

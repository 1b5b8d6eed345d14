// SPDX-License-Identifier: Apache-2.0
//
// Checks which layer includes which, by the table of the design. Kernel and trajectory include no other layer. Physics
// and proof never meet below certify. Checker and oracle include nothing of the project; only the command includes all.
//
// The preprocessor does not run, so an include counts even where an #if leaves it out.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace noli::repository {

/// One #include line. `target` is the text between the quotes or brackets; empty if a macro names the file.
struct Include {
  int line = 0;
  std::string target;
};

std::vector<Include> includes(std::string_view text);

/// The layer of a path relative to the project's root: its row of the table ("kernel", "proofs/checker", "oracle",
/// ...), else its first folder.
std::string layer_of(const std::filesystem::path& relative);

/// The layer that an include of `file` (relative to `root`) leads to; nullopt if it leads out of the project.
std::optional<std::string> included_layer(const std::filesystem::path& root, const std::filesystem::path& file,
                                          const std::string& target);

/// Whether a file of layer `from` may include one of layer `to`. A layer without a row may include everything.
bool may_include(const std::string& from, const std::string& to);

/// One line for each include below `root` that the table forbids: "FILE:LINE: ...".
std::vector<std::string> layering_violations(const std::filesystem::path& root);

}  // namespace noli::repository

// SPDX-License-Identifier: Apache-2.0
//
// The files that a command is about to write: checked once, before the work begins.
//
// The rule for all of them: a file that exists is an error without `--force`; so is, in any case, an output that the
// command also reads, two outputs that are one file, and a file that belongs to a run. Two paths are one file when they
// lead to one place, by symbolic links (also to a file that does not exist yet) or by hard links.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace noli::app {

/// A file that an option names. A device, a pipe or a link may stand in its place, except where `only_files`.
struct OutputFile {
  std::string option;  ///< "--json"
  std::filesystem::path path;
  bool only_files = false;  ///< written piece by piece, and read again
};

/// The output of an option that may not be given.
std::vector<OutputFile> outputs(const std::string& option, const std::optional<std::string>& path);

/// The file of a scene and all files that it names, which a command reads; the first alone where it is no regular file,
/// or no scene: reading it says so later.
std::vector<std::filesystem::path> inputs_of_scene(const std::filesystem::path& scene);

/// Throws UsageError, naming the option, when one of the outputs breaks the rule or cannot be written. Leaves nothing
/// behind. `inputs`: files, and folders of runs, also one that the command is about to make. The output "-" is standard
/// output, and no file.
void require_output_files(const std::vector<OutputFile>& outputs, const std::vector<std::filesystem::path>& inputs,
                          bool force);

}  // namespace noli::app

// SPDX-License-Identifier: Apache-2.0
//
// Where results go: words to standard output, and all of it as JSON to a file when asked for.
//
// Standard output carries one of: the words, with the verdict in the last line; with `--porcelain` one line
// `verdict=WORD key=value ...`; with `-q` nothing; with `--json -` the JSON document. Each JSON document begins with
// the name and version of its schema (`noli schema NAME` prints it) and with the program that wrote it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/answer.h"
#include "app/json.h"
#include "app/output_files.h"

namespace noli::app {

struct OutputOptions {
  std::optional<std::string> json;  ///< where the JSON goes, "-" for standard output, nothing for nowhere
  bool porcelain = false;
  bool quiet = false;
  bool verbose = false;
  bool force = false;  ///< outputs may replace what is there
};

class Output {
 public:
  /// Checks all outputs of the command, the JSON and `others`, by the rule of output_files.h. Throws UsageError.
  Output(OutputOptions options, const std::vector<std::filesystem::path>& inputs, std::vector<OutputFile> others = {});

  /// Writes the results. `schema` names that of the JSON, `noli schema NAME`: "verify". A file is written under another
  /// name first and then renamed: it is complete or absent, and has the owner and permissions of the one that it
  /// replaces. A file that may be written but not replaced (in a folder without write permission, say) is written in
  /// place. It comes before the text, so that no verdict is printed by a run that fails. Throws WriteError.
  void write(std::string_view schema, const Answer& answer, Json json) const;

 private:
  std::string words(const Answer& answer) const;

  OutputOptions options_;
};

/// Throws UsageError, naming `option`, when the file cannot be written: one that is there, or a new one in its folder.
/// Leaves nothing behind.
void require_writable_file(const std::filesystem::path& file, const std::string& option);

/// Throws UsageError, naming `option`, when files cannot be made in this folder or, where there is none yet, in the one
/// that it would be in. Leaves nothing behind.
void require_writable_folder(const std::string& folder, const std::string& option);

/// Throws UsageError, naming `option`, when this is no program that can be started.
void require_program(const std::filesystem::path& program, const std::string& option);

/// Makes a folder, and those that it is in, unless it is there. Throws UsageError, naming `option`, when it cannot be
/// made, or no files in it.
void make_writable_folder(const std::filesystem::path& folder, const std::string& option);

/// Writes to standard output, all of it. Throws WriteError.
void write_standard_output(const std::string& text);

}  // namespace noli::app

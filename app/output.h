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

#include "app/output_files.h"
#include "certify/json.h"
#include "report/answer.h"

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
  void write(std::string_view schema, const report::Answer& answer, Json json) const;

 private:
  std::string words(const report::Answer& answer) const;

  OutputOptions options_;
};

/// Writes the text, and the verdict last: of a command without JSON. Throws WriteError.
void write_words(const report::Answer& answer);

/// Writes to standard output, all of it. Throws WriteError.
void write_standard_output(const std::string& text);

}  // namespace noli::app

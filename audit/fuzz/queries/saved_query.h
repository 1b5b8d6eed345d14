// SPDX-License-Identifier: Apache-2.0
//
// Single queries as files that `noli ccd`, `noli audit ccd` and `noli fuzz queries --replay` read: the points, the
// truth about contact as their label, and comments. The first comment is "# query vertex_edge 2d": what the text is
// about even without the name of its file.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "audit/fuzz/queries/probe.h"
#include "certify/queries/any_query.h"

namespace noli::audit {

/// "vertex-face", "vertex-edge-2d", ...: with what the name of a file has to end for `noli ccd` to know its kind.
std::string file_suffix(const QueryType& type);

/// Writes `query`, labelled with `contact`, and then each comment on a line of its own. Comments begin with "# " and
/// have one line each. Makes the folder. Throws std::system_error; then nothing is left of the file.
void save_query(const std::filesystem::path& file, const AnyQuery& query, bool contact,
                std::span<const std::string> comments);

/// A query of a file, and what else it was asked if the file says so.
struct SavedQuery {
  AnyQuery query;
  std::optional<Probe> probe;
};

/// What such a text says it is about; nothing where it does not say.
std::optional<QueryType> saved_type(std::string_view text);

/// All queries of a file whose name tells their kind. Its comments say their dimension, which is 3 otherwise, and what
/// else they were asked: "# noli-fuzz ..." (audit/fuzz/queries/probe.h). Throws InputError.
std::vector<SavedQuery> read_saved_queries(const std::filesystem::path& file);

/// "double x[2][4][3] = {{...}, {...}};": its points at t = 0 and at t = 1, to paste into a test in C or C++.
std::string c_array(const AnyQuery& query);

/// A word of a shell's command line.
std::string quoted(const std::string& word);

}  // namespace noli::audit

// SPDX-License-Identifier: Apache-2.0
//
// What `noli audit ccd` says: text, JSON, and a picture of errors against run time.
#pragma once

#include <string>
#include <vector>

#include "audit/ccd/ccd_audit.h"
#include "certify/json.h"
#include "report/answer.h"

namespace noli::audit {

report::Answer audit_answer(const AuditOutcome& outcome);

Json audit_json(const AuditOutcome& outcome);

/// Wrong answers over time per query, one point for each library and tolerance, both logarithmic.
std::string audit_svg(const AuditOutcome& outcome);

/// How a library is called in tables: the name of its file, without folders unless two are then the same.
std::string audit_name(const AuditOutcome& outcome, const std::filesystem::path& library);

/// What a library wrote to its standard error, at most twenty lines: from a sanitizer's last error on or, without one,
/// the last lines. `who`: the library, in words.
std::string said_text(const std::string& who, const std::string& said);

/// How far times are off, for JSON.
Json errors_json(const TimeErrors& errors);

using TableRow = std::vector<std::string>;

/// Columns as wide as their widest cell; the first `words` columns to the left, the rest to the right. Precondition:
/// all rows have as many cells, and there is one.
std::string table_text(const std::vector<TableRow>& rows, std::size_t words);

}  // namespace noli::audit

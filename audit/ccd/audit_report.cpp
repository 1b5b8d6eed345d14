// SPDX-License-Identifier: Apache-2.0
#include "audit/ccd/audit_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <sstream>
#include <vector>

#include <noli/errors.h>

namespace noli::audit {
namespace {

namespace fs = std::filesystem;

/// "disagreement": a label in a file is wrong.
const char* audit_verdict(const AuditOutcome& outcome) {
  if (outcome.findings() > 0) return "finding";
  if (outcome.wrong_labels() > 0) return "disagreement";
  return outcome.complete ? "no_finding" : "undecided";
}

// --- JSON ------------------------------------------------------------------------------------------------------------

Json counts_json(const AuditCounts& counts) {
  return {{"queries", counts.queries},
          {"answered", counts.answered},
          {"false_positives", counts.false_positives},
          {"false_negatives", counts.false_negatives},
          {"times", counts.times},
          {"late", errors_json(counts.late)},
          {"early", errors_json(counts.early)},
          {"bad_times", counts.bad_times},
          {"no_times", counts.no_times},
          {"changed", counts.changed},
          {"failures", counts.failures},
          {"crashes", counts.crashes},
          {"hangs", counts.hangs},
          {"memory", counts.memory},
          {"leaks", counts.leaks}};
}

Json file_audit_json(const AuditOutcome& outcome, const FileAudit& file) {
  Json json = {{"file", outcome.files[file.file].path.string()}};
  json.update(counts_json(file.counts));
  json["complete"] = file.complete;
  json["reports"] = Json::array();
  for (const auto& [query, what, words] : file.findings) {
    json["reports"].push_back({{"query", query}, {"finding", what}, {"words", words}});
  }
  json["false_positive_reports"] = file.false_positives;
  return json;
}

Json library_json(const AuditOutcome& outcome, const LibraryAudit& audit) {
  Json json = {{"library", audit.plugin.string()}, {"tolerance", audit.tolerance}};
  if (!audit.description.empty()) json["description"] = audit.description;
  if (!audit.said.empty()) json["standard_error"] = audit.said;
  json.update(counts_json(audit.total));
  json["files"] = Json::array();
  for (const FileAudit& file : audit.files) json["files"].push_back(file_audit_json(outcome, file));
  return json;
}

Json audited_file_json(const AuditedFile& file) {
  return {{"file", file.path.string()}, {"kind", file.kind == QueryKind::edge_edge ? "edge_edge" : "vertex_face"},
          {"queries", file.queries},    {"contacts", file.contacts},
          {"labelled", file.labelled},  {"wrong_labels", file.wrong_labels}};
}

Json times_json(const AuditCounts& counts) {
  return {{"ns_per_query", counts.ns_per_query()}, {"textbook", counts.units()}, {"slowest_ns", counts.slowest_ns}};
}

Json timing_json(const AuditOutcome& outcome) {
  Json json = {{"textbook", Json::array()}, {"audits", Json::array()}};
  for (const AuditedFile& file : outcome.files) {
    json["textbook"].push_back({{"file", file.path.string()}, {"ns_per_query", file.unit_ns}});
  }
  for (const LibraryAudit& audit : outcome.audits) {
    Json times = {{"library", audit.plugin.string()}, {"tolerance", audit.tolerance}};
    times.update(times_json(audit.total));
    times["files"] = Json::array();
    for (const FileAudit& file : audit.files) {
      times["files"].push_back({{"file", outcome.files[file.file].path.string()}});
      times["files"].back().update(times_json(file.counts));
      times["files"].back()["growth_bytes_per_query"] = file.growth_per_query;
    }
    json["audits"].push_back(times);
  }
  return json;
}

// --- text ------------------------------------------------------------------------------------------------------------

AuditCounts sum_of(const AuditOutcome& outcome) {
  AuditCounts sum;
  for (const LibraryAudit& audit : outcome.audits) sum += audit.total;
  return sum;
}

using Row = TableRow;

Row heading(const std::string& first) {
  return {first,        "tolerance",    "queries",     "false+",    "false-",    "late",
          "worst-late", "early-median", "early-worst", "bad-times", "changed",   "failures",
          "crashes",    "hangs",        "leaks",       "ns/query",  "x-textbook"};
}

std::string number(double x) { return fmt::format("{:.3g}", x); }

Row row_of(const std::string& first, double tolerance, const AuditCounts& counts) {
  const bool times = counts.times > 0;
  const auto of_times = [&](const std::string& text) { return times ? text : std::string("-"); };
  return {first,
          fmt::format("{:g}", tolerance),
          std::to_string(counts.queries),
          std::to_string(counts.false_positives),
          std::to_string(counts.false_negatives),
          of_times(std::to_string(counts.late.count())),
          of_times(number(counts.late.worst())),
          of_times(number(counts.early.median())),
          of_times(number(counts.early.worst())),
          of_times(std::to_string(counts.bad_times)),
          std::to_string(counts.changed),
          std::to_string(counts.failures),
          std::to_string(counts.crashes + counts.memory),
          std::to_string(counts.hangs),
          std::to_string(counts.leaks),
          number(counts.ns_per_query()),
          number(counts.units())};
}

std::string table_of_libraries(const AuditOutcome& outcome) {
  std::vector<Row> rows = {heading("library")};
  for (const LibraryAudit& audit : outcome.audits) {
    rows.push_back(row_of(audit_name(outcome, audit.plugin), audit.tolerance, audit.total));
  }
  return table_text(rows, 1);
}

std::string table_of_file(const AuditOutcome& outcome, std::size_t file) {
  std::vector<Row> rows = {heading("library")};
  for (const LibraryAudit& audit : outcome.audits) {
    for (const FileAudit& part : audit.files) {
      if (part.file != file) continue;
      rows.push_back(row_of(audit_name(outcome, audit.plugin), audit.tolerance, part.counts));
    }
  }
  return table_text(rows, 1);
}

/// What libraries say that they are.
void append_descriptions(const AuditOutcome& outcome, std::string& text) {
  const fs::path* last = nullptr;  // all tolerances of a library come together
  for (const LibraryAudit& audit : outcome.audits) {
    if (audit.description.empty() || (last != nullptr && *last == audit.plugin)) continue;
    last = &audit.plugin;
    text += fmt::format("{} is {}\n", audit_name(outcome, audit.plugin), on_one_line(audit.description));
  }
}

void append_said(const AuditOutcome& outcome, std::string& text) {
  for (const LibraryAudit& audit : outcome.audits) {
    if (!audit.said.empty()) text += said_text(audit_name(outcome, audit.plugin), audit.said);
  }
}

void append_file(const AuditOutcome& outcome, std::size_t i, std::string& text) {
  const AuditedFile& file = outcome.files[i];
  const std::string path = on_one_line(file.path.string());
  fmt::format_to(std::back_inserter(text), "{}: queries {} contacts {} labelled {}, textbook {:.1f} ns a query\n", path,
                 file.queries, file.contacts, file.labelled, file.unit_ns);
  for (const std::size_t query : file.wrong_labels) {
    fmt::format_to(std::back_inserter(text), "{}: query {}: its label is not the exact answer\n", path, query);
  }
  text += table_of_file(outcome, i);
}

void append_findings(const AuditOutcome& outcome, const LibraryAudit& audit, std::string& text) {
  const std::string name = on_one_line(audit_name(outcome, audit.plugin));
  const auto out = std::back_inserter(text);
  for (const FileAudit& file : audit.files) {
    const std::string path = on_one_line(outcome.files[file.file].path.string());
    const std::string place = fmt::format("{}, tolerance {:g}: {}", name, audit.tolerance, path);
    for (const auto& [query, what, words] : file.findings) {
      fmt::format_to(out, "{}: query {}: {}{}{}\n", place, query, what, words.empty() ? "" : ": ", words);
    }
    if (file.counts.leaks > 0) {
      fmt::format_to(out, "{}: leak: {:.1f} bytes a query\n", place, file.growth_per_query);
    }
    if (!file.complete) fmt::format_to(out, "{}: some were not asked\n", place);
  }
}

/// Below the tables.
constexpr const char* columns_explained =
    "  false-  no hit, but the features meet: a missed contact    false+  a hit, but they stay apart\n"
    "  late    the time is after the first contact: how often, and by which part of the step at worst\n"
    "  early-  by which part of the step times before the first contact are early: median, worst\n"
    "  bad-times  outside [0, 1], or none    changed  another answer when the same query is asked again\n"
    "  x-textbook  time per query as a multiple of the textbook cubic solver's, in this run\n";

}  // namespace

Json errors_json(const TimeErrors& errors) {
  const auto figure = [&](double value) { return errors.count() == 0 ? Json() : Json(value); };
  return {{"count", errors.count()},
          {"median", figure(errors.median())},
          {"worst", figure(errors.worst())},
          {"median_relative", figure(errors.median_relative())},
          {"worst_relative", figure(errors.worst_relative())}};
}

/// Columns as wide as their widest cell; the first `words` columns to the left, the rest to the right.
std::string table_text(const std::vector<TableRow>& rows, std::size_t words) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const TableRow& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const TableRow& row : rows) {
    std::string line = " ";
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += i < words ? fmt::format(" {:<{}}", row[i], widths[i]) : fmt::format(" {:>{}}", row[i], widths[i]);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  }
  return text;
}

std::string audit_name(const AuditOutcome& outcome, const std::filesystem::path& library) {
  const auto same = [&](const LibraryAudit& other) {
    return other.plugin != library && other.plugin.stem() == library.stem();
  };
  const bool unique = std::none_of(outcome.audits.begin(), outcome.audits.end(), same);
  return on_one_line(unique ? library.stem().string() : library.string());
}

std::string said_text(const std::string& who, const std::string& said) {
  constexpr std::size_t most = 20, most_of_line = 1000;
  std::vector<std::string> lines;
  std::istringstream in(said);
  for (std::string line; std::getline(in, line);) lines.push_back(on_one_line(line.substr(0, most_of_line)));
  if (lines.size() == 1) return fmt::format("{} wrote to its standard error: {}\n", who, lines.front());
  // Of a sanitizer's report the beginning tells most, of anything else the end.
  const auto error = std::find_if(lines.rbegin(), lines.rend(), [](const std::string& line) {
    return line.find("ERROR: ") != std::string::npos || line.find("WARNING: ThreadSanitizer") != std::string::npos ||
           line.find("runtime error: ") != std::string::npos;
  });
  std::size_t begin = lines.size() > most ? lines.size() - most : 0;
  if (error != lines.rend()) begin = static_cast<std::size_t>(lines.rend() - error) - 1;
  const std::size_t end = std::min(lines.size(), begin + most);
  std::string text = fmt::format("{} wrote to its standard error", who);
  text += end - begin < lines.size() ? fmt::format(" {} lines (--json has them); of these:\n", lines.size()) : ":\n";
  for (std::size_t i = begin; i < end; ++i) text += "  " + lines[i] + '\n';
  return text;
}

report::Answer audit_answer(const AuditOutcome& outcome) {
  const AuditCounts sum = sum_of(outcome);
  report::Answer answer(audit_verdict(outcome), {{"audits", outcome.audits.size()},
                                                 {"queries", sum.queries},
                                                 {"findings", outcome.findings()},
                                                 {"false_positives", sum.false_positives},
                                                 {"false_negatives", sum.false_negatives},
                                                 {"late", sum.late.count()},
                                                 {"bad_times", sum.bad_times},
                                                 {"changed", sum.changed},
                                                 {"failures", sum.failures},
                                                 {"crashes", sum.crashes},
                                                 {"hangs", sum.hangs},
                                                 {"memory", sum.memory},
                                                 {"leaks", sum.leaks},
                                                 {"wrong_labels", outcome.wrong_labels()},
                                                 {"complete", outcome.complete}});
  std::string& text = answer.text;
  append_descriptions(outcome, text);
  append_said(outcome, text);
  if (outcome.files.size() > 1) text += "All files:\n" + table_of_libraries(outcome);
  for (std::size_t i = 0; i < outcome.files.size(); ++i) append_file(outcome, i, text);
  text += columns_explained;
  for (const LibraryAudit& audit : outcome.audits) append_findings(outcome, audit, text);
  return answer;
}

Json audit_json(const AuditOutcome& outcome) {
  Json json = {{"verdict", audit_verdict(outcome)},
               {"findings", outcome.findings()},
               {"wrong_labels", outcome.wrong_labels()},
               {"complete", outcome.complete}};
  json["files"] = Json::array();
  for (const AuditedFile& file : outcome.files) json["files"].push_back(audited_file_json(file));
  json["audits"] = Json::array();
  for (const LibraryAudit& audit : outcome.audits) json["audits"].push_back(library_json(outcome, audit));
  json["timing"] = timing_json(outcome);
  return json;
}

}  // namespace noli::audit

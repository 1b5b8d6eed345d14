// SPDX-License-Identifier: Apache-2.0
#include "audit/ccd/ccd_audit.h"

#include <fmt/format.h>
#include <noli/ccd_plugin.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include <noli/errors.h>
#include "audit/ccd/library_answers.h"

namespace noli::audit {
namespace {

namespace fs = std::filesystem;

/// The queries of a file with the first time of each that is in contact, rounded down: a double is later than the exact
/// time just when it is greater than that.
struct QueriesWithTruth {
  int kind = 0;
  std::vector<AskedQuery> queries;
  std::vector<std::optional<double>> truth;
};

QueryKind kind_of(const fs::path& path) {
  const auto kind = kind_from_file_name(path);
  if (kind == QueryKind::vertex_face || kind == QueryKind::edge_edge) return *kind;
  throw InputError(path.string(), "", "the name does not say what is asked; expected vertex-face or edge-edge in it");
}

/// Nothing when a stop was asked for meanwhile: what is known of other files is kept.
std::optional<std::vector<QueryRecord>> read_queries(const AuditedFile& file) {
  try {
    return read_query_csv(file.path, file.kind);
  } catch (const Stopped&) {
    return std::nullopt;
  }
}

/// Nothing once stopped or out of time.
std::optional<QueriesWithTruth> prepare(AuditedFile& file, const AuditRequest& request) {
  const auto read = read_queries(file);
  if (!read) return std::nullopt;
  const std::vector<QueryRecord>& records = *read;
  const bool edges = file.kind == QueryKind::edge_edge;
  const FeaturePair pair = edges ? FeaturePair::edge_edge : FeaturePair::vertex_face;
  QueriesWithTruth known{edges ? NOLI_CCD_EDGE_EDGE : NOLI_CCD_VERTEX_FACE, {}, {}};
  file.queries = records.size();
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (request.host.over()) return std::nullopt;
    const QueryRecord& record = records[i];
    known.queries.push_back(asked(record));
    const auto exact = exact_contact({pair, 3, record.x_t0, record.x_t1});
    const bool contact = exact.has_value();
    known.truth.push_back(contact ? std::optional(exact->time) : std::nullopt);
    file.contacts += contact ? 1 : 0;
    file.labelled += record.label ? 1 : 0;
    if (record.label && *record.label != contact) file.wrong_labels.push_back(i + 1);
  }
  return known;
}

/// Compares the answers to one file with the truth.
class AnswerComparison {
 public:
  AnswerComparison(const QueriesWithTruth& known, const LibraryAnswers& answers, std::size_t max_reports)
      : known_(known), answers_(answers), max_reports_(max_reports) {}

  FileAudit run() {
    counts_.queries = known_.queries.size();
    knows_times_ = std::any_of(answers_.answers.begin(), answers_.answers.end(), [](const GivenAnswer& answer) {
      return answer.state == AnswerState::answered && answer.code == NOLI_CCD_HIT && !std::isnan(answer.time);
    });
    for (std::size_t i = 0; i < known_.queries.size(); ++i) mark(i);
    counts_.crashes = answers_.crashes;
    counts_.hangs = answers_.hangs;
    counts_.memory = answers_.memory;
    counts_.leaks = answers_.leaks ? 1 : 0;
    counts_.seconds = answers_.ns_per_query * 1e-9 * static_cast<double>(counts_.queries);
    if (answers_.repeated > 0) {
      audit_.growth_per_query = static_cast<double>(answers_.growth) / static_cast<double>(answers_.repeated);
    }
    audit_.complete = answers_.complete;
    for (AuditFinding& late : late_) {
      if (audit_.findings.size() < max_reports_) audit_.findings.push_back(std::move(late));
    }
    return std::move(audit_);
  }

 private:
  void report(std::size_t i, std::string_view what, const std::string& words = "") {
    auto& list = what == "late" ? late_ : audit_.findings;
    if (list.size() < max_reports_) list.push_back({i + 1, std::string(what), words});
  }

  void mark(std::size_t i) {
    const GivenAnswer& answer = answers_.answers[i];
    const std::string& ending = answers_.endings[i];
    if (answer.state == AnswerState::not_asked) return;
    if (const auto ended = ending_of(answer.state)) return report(i, name(*ended), ending);
    ++counts_.answered;
    counts_.slowest_ns = std::max(counts_.slowest_ns, answer.ns);
    if (!ending.empty()) report(i, "ended", ending);
    if (answer.changed != 0) {
      ++counts_.changed;
      report(i, "changed");
    }
    if (answer.code != NOLI_CCD_HIT && answer.code != NOLI_CCD_NO_HIT) {
      ++counts_.failures;
      return report(i, "failure", fmt::format("code {}", answer.code));
    }
    mark_answer(i, answer.code != NOLI_CCD_NO_HIT, answer.time);
  }

  void mark_answer(std::size_t i, bool hit, double time) {
    const std::optional<double>& truth = known_.truth[i];
    if (hit && truth) return mark_time(i, time, *truth);
    if (hit) {
      ++counts_.false_positives;
      if (audit_.false_positives.size() < max_reports_) audit_.false_positives.push_back(i + 1);
    } else if (truth) {
      ++counts_.false_negatives;
      report(i, "false_negative", fmt::format("exact first time {:.17g}", *truth));
    }
  }

  void mark_time(std::size_t i, double time, double exact) {
    if (std::isnan(time)) {
      counts_.no_times += knows_times_ ? 1 : 0;
      if (knows_times_) report(i, "no_time", fmt::format("exact first time {:.17g}", exact));
      return;
    }
    ++counts_.times;
    const double error = exact - time, relative = exact > 0 ? std::abs(error) / exact : 0;
    if (!(time >= 0 && time <= 1)) {
      ++counts_.bad_times;
      report(i, "bad_time", fmt::format("{:.17g}", time));
    } else if (time > exact) {
      counts_.late.add(-error, relative);
      report(i, "late", fmt::format("{:.17g}, exact first time {:.17g}", time, exact));
    } else {
      counts_.early.add(error, relative);
    }
  }

  const QueriesWithTruth& known_;
  const LibraryAnswers& answers_;
  std::size_t max_reports_;
  std::vector<AuditFinding> late_;  ///< reported where others leave room
  bool knows_times_ = false;
  FileAudit audit_;
  AuditCounts& counts_ = audit_.counts;
};

class Audit {
 public:
  explicit Audit(const AuditRequest& request) : request_(request) {}

  AuditOutcome run() {
    for (const fs::path& file : request_.files) outcome_.files.push_back({file, kind_of(file), 0, 0, 0, {}, 0});
    for (const fs::path& library : request_.libraries) require_ccd_library(library, request_.host);
    for (const fs::path& library : request_.libraries) {
      for (const double tolerance : request_.tolerances)
        outcome_.audits.push_back({library, tolerance, "", "", {}, {}});
    }
    for (std::size_t i = 0; i < outcome_.files.size() && !over_; ++i) examine(i);
    for (LibraryAudit& audit : outcome_.audits) {
      for (const FileAudit& file : audit.files) audit.total += file.counts;
    }
    return std::move(outcome_);
  }

 private:
  /// All libraries on one file, so that their times are of the same minute.
  void examine(std::size_t file) {
    const auto known = prepare(outcome_.files[file], request_);
    if (!known) return end_it();
    const LibraryAnswers unit = ask_library(std::nullopt, known->kind, known->queries, 0, request_.host);
    if (!unit.complete) return end_it();
    outcome_.files[file].unit_ns = unit.ns_per_query;
    for (LibraryAudit& audit : outcome_.audits) {
      const LibraryAnswers answers =
          ask_library(audit.plugin, known->kind, known->queries, audit.tolerance, request_.host);
      FileAudit compared = AnswerComparison(*known, answers, request_.max_reports).run();
      compared.file = file;
      audit.description = answers.description;
      if (!answers.said.empty()) audit.said = answers.said;
      compared.counts.unit_seconds = unit.ns_per_query * 1e-9 * static_cast<double>(known->queries.size());
      outcome_.complete = outcome_.complete && compared.complete;
      audit.files.push_back(std::move(compared));
      ++done_;
      if (request_.progress) request_.progress(share());
      if (is_over()) return end_it();
    }
  }

  double share() const {
    return static_cast<double>(done_) / static_cast<double>(outcome_.audits.size() * outcome_.files.size());
  }

  bool is_over() const { return done_ < outcome_.audits.size() * outcome_.files.size() && request_.host.over(); }

  void end_it() {
    over_ = true;
    outcome_.complete = false;
  }

  const AuditRequest& request_;
  AuditOutcome outcome_;
  std::size_t done_ = 0;
  bool over_ = false;
};

}  // namespace

void TimeErrors::add(double error, double relative) {
  errors_.push_back(error);
  relative_.push_back(relative);
}

void TimeErrors::add(const TimeErrors& other) {
  errors_.insert(errors_.end(), other.errors_.begin(), other.errors_.end());
  relative_.insert(relative_.end(), other.relative_.begin(), other.relative_.end());
}

double TimeErrors::quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

AuditCounts& AuditCounts::operator+=(const AuditCounts& other) {
  queries += other.queries;
  answered += other.answered;
  failures += other.failures;
  false_positives += other.false_positives;
  false_negatives += other.false_negatives;
  times += other.times;
  bad_times += other.bad_times;
  no_times += other.no_times;
  changed += other.changed;
  crashes += other.crashes;
  hangs += other.hangs;
  memory += other.memory;
  leaks += other.leaks;
  late.add(other.late);
  early.add(other.early);
  unit_seconds += other.unit_seconds;
  seconds += other.seconds;
  slowest_ns = std::max(slowest_ns, other.slowest_ns);
  return *this;
}

std::uint64_t AuditCounts::findings() const {
  return false_negatives + late.count() + bad_times + no_times + changed + failures + crashes + hangs + memory + leaks;
}

double AuditCounts::ns_per_query() const { return queries > 0 ? seconds * 1e9 / static_cast<double>(queries) : 0; }

double AuditCounts::units() const { return unit_seconds > 0 ? seconds / unit_seconds : 0; }

std::uint64_t AuditOutcome::findings() const {
  std::uint64_t sum = 0;
  for (const LibraryAudit& audit : audits) sum += audit.total.findings();
  return sum;
}

std::uint64_t AuditOutcome::wrong_labels() const {
  std::uint64_t sum = 0;
  for (const AuditedFile& file : files) sum += file.wrong_labels.size();
  return sum;
}

AuditOutcome audit_ccd(const AuditRequest& request) { return Audit(request).run(); }

}  // namespace noli::audit

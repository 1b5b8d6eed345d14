// SPDX-License-Identifier: Apache-2.0
#include "certify/queries/ccd_run.h"

#include <algorithm>
#include <array>
#include <span>

#include <noli/contact.h>
#include <noli/errors.h>
#include "certify/queries/any_query.h"
#include "certify/stopwatch.h"
#include "trajectory/formats/query_csv.h"
#include "trajectory/stop.h"

namespace noli {
namespace {

bool stopped(const CcdRequest& request) {
  return stop_asked() || (request.stop != nullptr && request.stop->load(std::memory_order_relaxed));
}

constexpr std::size_t passes = 5;
constexpr double enough_seconds = 1;

template <class Query>
class FileRun {
 public:
  FileRun(const CcdRequest& request, std::span<const QueryRecord> records, CcdFile& file)
      : request_(request), records_(records), file_(file) {
    queries_.reserve(records.size());
    for (const QueryRecord& record : records) {
      const AnyQuery query{file.pair, request.dimension, record.x_t0, record.x_t1};
      queries_.push_back(noli::detail::typed<Query::pair, Query::dimension>(query));
    }
  }

  /// Returns whether everything was decided.
  bool operator()() {
    const Stopwatch watch;
    const std::size_t decided = decide();
    const double seconds = watch.seconds();
    file_.counts.ns_per_query = per_query(seconds, decided);
    if (seconds < enough_seconds && !stopped(request_)) measure();
    if (request_.times) find_times(decided);
    return decided == queries_.size();
  }

 private:
  static double per_query(double seconds, std::size_t count) {
    return count == 0 ? 0 : seconds * 1e9 / static_cast<double>(count);
  }

  std::size_t decide() {
    contact_.assign(queries_.size(), 0);
    std::size_t i = 0;
    for (; i < queries_.size() && !stopped(request_); ++i) contact_[i] = meet(queries_[i], &file_.counts.stages);
    for (std::size_t k = 0; k < i; ++k) compare(k);
    return i;
  }

  void compare(std::size_t i) {
    CcdCounts& counts = file_.counts;
    const bool contact = contact_[i] != 0;
    ++counts.queries;
    counts.contacts += contact;
    if (!records_[i].label) return;
    ++counts.labelled;
    if (*records_[i].label == contact) return;
    ++counts.disagreements;
    if (file_.disagreements.size() < request_.max_reports) file_.disagreements.push_back({i + 1, !contact});
  }

  void measure() {
    std::array<double, passes> ns{};
    std::uint64_t contacts = 0;
    for (double& pass : ns) {
      const Stopwatch watch;
      for (const Query& query : queries_) contacts += meet(query);
      pass = per_query(watch.seconds(), queries_.size());
    }
    if (contacts != passes * file_.counts.contacts) throw std::logic_error("a query was decided in two ways");
    std::nth_element(ns.begin(), ns.begin() + passes / 2, ns.end());
    file_.counts.ns_per_query = ns[passes / 2];
  }

  void find_times(std::size_t decided) {
    for (std::size_t i = 0; i < decided && !stopped(request_); ++i) {
      const auto first = first_contact(queries_[i]);
      if (first.has_value() != (contact_[i] != 0))
        throw std::logic_error("two parts of the kernel disagree on a contact");
      if (first) file_.times.push_back({i + 1, first->kind, first->time.lower()});
    }
  }

  const CcdRequest& request_;
  std::span<const QueryRecord> records_;
  CcdFile& file_;
  std::vector<Query> queries_;
  std::vector<char> contact_;
};

/// The kind that was asked for, or that of the file's name.
FeaturePair kind_of(const std::filesystem::path& path, std::optional<FeaturePair> asked) {
  const std::optional<FeaturePair> kind = asked ? asked : query_kind(path);
  if (kind) return *kind;
  throw UsageError(path.string() +
                   ": the name does not say what the queries are; expected one of vertex-face, edge-edge, vertex-edge, "
                   "vertex-vertex in it, or --kind");
}

void require_decided(const CcdFile& file, int dimension) {
  const auto& types = all_query_types;
  if (std::find(types.begin(), types.end(), QueryType{file.pair, dimension}) != types.end()) return;
  throw UsageError(file.path.string() + ": no " + std::string(name(file.pair)) +
                   " queries in 2 dimensions; expected vertex-edge or vertex-vertex");
}

/// The queries of all files. The outcome is not complete if the user stopped the reading.
std::vector<std::vector<QueryRecord>> read_all(CcdOutcome& outcome) {
  std::vector<std::vector<QueryRecord>> records;
  try {
    for (const CcdFile& file : outcome.files) records.push_back(read_query_csv(file.path, file_kind(file.pair)));
  } catch (const Stopped&) {
    outcome.complete = false;
  }
  return records;
}

}  // namespace

CcdCounts& CcdCounts::operator+=(const CcdCounts& other) {
  const auto sum = static_cast<double>(queries + other.queries);
  const double ns =
      ns_per_query * static_cast<double>(queries) + other.ns_per_query * static_cast<double>(other.queries);
  ns_per_query = sum > 0 ? ns / sum : 0;
  queries += other.queries;
  contacts += other.contacts;
  labelled += other.labelled;
  disagreements += other.disagreements;
  stages += other.stages;
  return *this;
}

std::optional<FeaturePair> query_kind(const std::filesystem::path& path) {
  const auto kind = kind_from_file_name(path);
  for (const FeaturePair pair : all_feature_pairs) {
    if (kind == file_kind(pair)) return pair;
  }
  return std::nullopt;
}

CcdOutcome run_ccd(const CcdRequest& request) {
  CcdOutcome outcome;
  for (const auto& path : request.files) {
    outcome.files.push_back({path, kind_of(path, request.pair), {}, {}, {}});
    require_decided(outcome.files.back(), request.dimension);
  }
  const auto records = read_all(outcome);
  for (std::size_t i = 0; i < outcome.files.size() && outcome.complete; ++i) {
    if (request.progress) request.progress(static_cast<double>(i) / static_cast<double>(outcome.files.size()));
    CcdFile& file = outcome.files[i];
    outcome.complete = visit({file.pair, request.dimension, {}, {}},
                             [&]<class Query>(const Query&) { return FileRun<Query>(request, records[i], file)(); });
    outcome.total += file.counts;
  }
  outcome.complete = outcome.complete && !stopped(request);
  return outcome;
}

}  // namespace noli

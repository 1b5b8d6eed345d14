// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/queries/replay_queries.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include <noli/errors.h>
#include "audit/fuzz/queries/minimise_query.h"
#include "audit/fuzz/queries/probe.h"
#include "audit/fuzz/save_finding.h"

namespace noli::audit {
namespace {

namespace fs = std::filesystem;

/// What a replay says where the library hung so often that it was not asked any more.
std::string not_asked_text(const SavedQueryFile& file) {
  const std::size_t left = file.queries().size() - file.asked();
  return left == 0
             ? ""
             : fmt::format("Skipped after too many hangs or an interruption: {} of {}.\n", left, file.queries().size());
}

/// What a replay found, in all files.
struct Replayed {
  std::vector<std::string> differences;
  std::size_t queries = 0, not_asked = 0;
  bool probe = false;
  std::string text;
};

Replayed replay_all(const std::vector<std::string>& files, const LibraryUnderTest* library,
                    const std::atomic<bool>& stop) {
  Replayed all;
  const bool one = files.size() == 1;
  for (const std::string& path : files) {
    const SavedQueryFile file(path, library);
    for (const std::string& difference : file.differences()) {
      all.differences.push_back(one ? difference : on_one_line(path) + ": " + difference);
      all.text += all.differences.back() + '\n';
    }
    all.queries += file.asked();
    all.not_asked += file.queries().size() - file.asked();
    all.probe = all.probe || file.queries().at(0).probe.has_value();
    all.text += not_asked_text(file);
    if (stop) break;
  }
  return all;
}

void save(const Finding& finding, const fs::path& file, bool with_probe, const std::string& command) {
  std::vector<std::string> comments = {"# " + on_one_line(finding.difference), "# " + command};
  if (with_probe) comments.push_back(probe_line(finding.shrunk, finding.probe));
  save_query(file, finding.shrunk, finding.truth != ContactKind::apart, comments);
}

}  // namespace

SavedQueryFile::SavedQueryFile(fs::path file, const LibraryUnderTest* library)
    : path_(std::move(file)), library_(library), saved_(read_saved_queries(path_)) {
  const AnyQuery& first = saved_.at(0).query;
  if (!library_) return;
  if (!is_library_query({first.pair, first.dimension})) {
    throw InputError(path_.string(), "", "a library is asked about a vertex and a face or two edges in 3D");
  }
  require_ccd_library(library_->path, library_->host);
  knows_times_ = knows_times(*library_);
  std::vector<AnyQuery> queries;
  for (const SavedQuery& saved : saved_) queries.push_back(saved.query);
  found_ = faults_of(*library_, first.pair, queries, knows_times_);
}

std::vector<std::string> SavedQueryFile::differences() const {
  std::vector<std::string> result;
  for (const auto& fault : found_.faults) {
    if (fault) result.push_back(fault->words);
  }
  if (library_) return result;
  for (const SavedQuery& saved : saved_) {
    const auto found = replay(saved.query, saved.probe);
    result.insert(result.end(), found.begin(), found.end());
  }
  return result;
}

std::vector<Finding> SavedQueryFile::minimised(const std::atomic<bool>& stop) const {
  std::vector<Finding> result;
  const auto keep = [&](Finding finding) {
    const auto same = [&](const Finding& other) { return other.shrunk == finding.shrunk; };
    if (std::none_of(result.begin(), result.end(), same)) result.push_back(std::move(finding));
  };
  for (std::size_t i = 0; i < saved_.size() && !stop; ++i) {
    if (!library_) {
      auto finding = shrunk_finding(saved_[i].query, saved_[i].probe);
      if (!finding) continue;
      finding->index = i;
      keep(std::move(*finding));
    } else if (found_.faults[i]) {
      const auto shrunk = shrink_for_library(*library_, saved_[i].query, *found_.faults[i], knows_times_);
      Finding finding;
      finding.index = i;
      finding.query = saved_[i].query;
      finding.shrunk = shrunk.query;
      finding.difference = shrunk.found.words;
      finding.truth = shrunk.found.kind;
      keep(std::move(finding));
    }
  }
  return result;
}

ReplayedQueries replay_files(const std::vector<std::string>& files, const LibraryUnderTest* library,
                             const std::atomic<bool>& stop) {
  const Replayed found = replay_all(files, library, stop);
  ReplayedQueries result;
  result.finding = !found.differences.empty();
  result.undecided = stop || (found.not_asked > 0 && !result.finding);
  const char* const word = result.undecided ? "undecided"
                           : result.finding ? "finding"
                           : library        ? "no_finding"
                                            : "no_difference";
  result.json = {{"verdict", word},
                 {"queries", found.queries},
                 {"not_asked", found.not_asked},
                 {"findings", found.differences.size()},
                 {"probe", found.probe},
                 {"differences", found.differences}};
  result.text = found.text;
  return result;
}

fs::path minimised_name(const fs::path& file, const fs::path& folder, std::size_t query) {
  return folder / fmt::format("{}-query{}-minimised.csv", file.stem().string(), query);
}

ReplayedQueries minimise_file(const SavedQueryFile& file, const fs::path& folder,
                              const std::function<std::string(const fs::path&)>& command,
                              const std::atomic<bool>& stop) {
  const std::vector<Finding> findings = file.minimised(stop);
  ReplayedQueries result;
  result.undecided = stop;
  result.finding = !findings.empty();
  const char* const word = result.undecided ? "undecided" : result.finding ? "finding" : "nothing_fails";
  result.json = {
      {"verdict", word}, {"queries", file.queries().size()}, {"findings", findings.size()}, {"reports", Json::array()}};
  for (const Finding& finding : findings) {
    const fs::path saved = unused(minimised_name(file.path(), folder, finding.index + 1));
    const std::string again = command(saved);
    save(finding, saved, file.queries()[finding.index].probe.has_value(), again);
    result.text +=
        fmt::format("query {}: {}; {} different numbers; saved as {}\n  again: {}\n", finding.index + 1,
                    finding.difference, distinct_coordinates(finding.shrunk), on_one_line(saved.string()), again);
    result.json["reports"].push_back({{"query", finding.index + 1},
                                      {"difference", finding.difference},
                                      {"distinct_coordinates", distinct_coordinates(finding.shrunk)},
                                      {"file", saved.string()},
                                      {"command", again}});
  }
  return result;
}

}  // namespace noli::audit

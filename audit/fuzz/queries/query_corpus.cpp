// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/queries/query_corpus.h"

#include <fmt/format.h>
#include <noli/ccd_plugin.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "audit/fuzz/queries/oracle_bridge.h"
#include "oracle/features.h"
#include "oracle/integer_path.h"

namespace noli::audit {

namespace {

namespace fs = std::filesystem;

std::string roots(const AnyQuery& query) {
  const oracle::Motion motion = oracle_motion(query);
  const auto orientation = oracle::orientation(motion, oracle::integer_paths(motion, oracle::Unit::per_axis).x);
  if (!orientation) return "no_orientation";
  if (orientation->is_zero()) return "coplanar";
  return fmt::format("{}_roots", oracle::Time::roots_of(*orientation).size());
}

const char* when(ContactKind kind, double first) {
  if (kind == ContactKind::apart) return "never";
  return first == 0 ? "at_begin" : first == 1 ? "at_end" : "inside";
}

std::string time_class(double time, double exact) {
  if (std::isnan(time)) return "hit_no_time";
  if (!(time >= 0 && time <= 1)) return "hit_bad_time";
  if (time == exact) return "hit_exact";
  if (time > exact) return "hit_late";
  constexpr int bucket = 8, most = 48;
  const int bits = -std::ilogb(exact - time) - 1;
  return fmt::format("hit_early_{}_bits", std::clamp(bits / bucket * bucket, 0, most));
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().extension() == ".csv") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::optional<Stage> deciding_stage(const StageCounters& counters) {
  const auto found = std::ranges::find_if(all_stages, [&](Stage stage) { return counters[stage] > 0; });
  return found == all_stages.end() ? std::nullopt : std::optional(*found);
}

std::string signature(const AnyQuery& query, std::optional<Stage> stage, ContactKind kind, double first) {
  return fmt::format("{}-{}d-{}-{}-{}-{}", name(query.pair), query.dimension, stage ? name(*stage) : "no_stage",
                     name(kind), when(kind, first), roots(query));
}

std::string signature_of_answer(const LibraryAnswer& answer, const std::optional<double>& exact) {
  if (answer.given.state == AnswerState::not_asked) return "not_asked";
  if (const auto ended = ending_of(answer.given.state)) return std::string(name(*ended));
  if (answer.given.code < 0) return "failure";
  if (answer.given.code == NOLI_CCD_NO_HIT) return "no_hit";
  return exact ? time_class(answer.given.time, *exact) : "false_hit";
}

QueryCorpus::QueryCorpus(fs::path folder) : folder_(std::move(folder)) {
  for (const fs::path& file : files_in(folder_)) {
    std::vector<SavedQuery> saved = read_saved_queries(file);
    for (std::size_t i = 0; i < saved.size(); ++i) queries_.push_back({saved[i], file.stem().string(), i});
  }
}

void QueryCorpus::keep(const std::string& signature, const SavedQuery& saved, bool contact) {
  std::vector<std::string> comments;
  if (saved.probe) comments.push_back(probe_line(saved.query, *saved.probe));
  fs::path file = folder_ / (signature + ".csv");
  for (int again = 2; fs::exists(file); ++again) file = folder_ / fmt::format("{}-{}.csv", signature, again);
  save_query(file, saved.query, contact, comments);
  ++kept_;
}

void QueryCorpus::keep_new(const Reached& reached, NotSaved& not_saved) {
  for (const auto& one : reached) {
    const std::string& signature = one.first;
    if (!reached_.insert(signature).second) continue;
    not_saved.attempt([&] { keep(signature, one.second.saved, one.second.contact); });
  }
}

}  // namespace noli::audit

// SPDX-License-Identifier: Apache-2.0
//
// What a broad phase finds in real pairs of frames (bench/candidates.h), mostly apart: textbook cubic and kernel over
// the same shuffled sample of each pair. Also how many candidates there are, and how many of all of them are in
// contact.
#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include <noli/contact.h>
#include "bench/bench.h"
#include "bench/candidates.h"
#include "bench/data.h"
#include "bench/report.h"
#include "bench/textbook.h"
#include "trajectory/formats/frames.h"

namespace noli::bench {
namespace {

constexpr std::size_t sample_size = 1'000'000;

/// Candidates of one kind in one pair of frames.
struct Kind {
  std::string name;
  std::size_t candidates = 0, contacts = 0, sampled = 0;
  StageCounters stages;
};

template <class Query>
Kind register_kind(const std::string& name, std::vector<Candidate> candidates, const Frame& frame_t0,
                   const Frame& frame_t1) {
  const auto query = [&](const Candidate& candidate) {
    return query_of<Query>(candidate, frame_t0.positions, frame_t1.positions);
  };
  Kind kind{name, candidates.size(), 0, 0, {}};
  kind.contacts = count_true(candidates, [&](const Candidate& c) { return meet(query(c), &kind.stages); });
  shuffle(candidates, 1);
  candidates.resize(std::min(candidates.size(), sample_size));
  std::vector<Query> sample;
  sample.reserve(candidates.size());
  for (const Candidate& candidate : candidates) sample.push_back(query(candidate));
  const auto work = std::make_shared<std::vector<Query>>(workload(sample));
  kind.sampled = work->size();
  register_passes("textbook/" + name,
                  [work] { return count_true(*work, [](const Query& q) { return textbook_meet(q); }); });
  register_passes("noli/" + name, [work] { return count_true(*work, [](const Query& q) { return meet(q); }); });
  return kind;
}

/// Measures one pair, then forgets its queries: those of several pairs need not fit in memory together.
class PairBench {
 public:
  explicit PairBench(const FramePair& pair) : name_(pair.name) {
    const Frame frame_t0 = read_frame(pair.path_t0), frame_t1 = read_frame(pair.path_t1);
    require_same_mesh(frame_t0.mesh, pair.path_t0, frame_t1.mesh, pair.path_t1);
    Candidates candidates = find_candidates(frame_t0.mesh, frame_t0.positions, frame_t1.positions);
    kinds_ = {register_kind<VertexFace3>(name_ + "/vertex_face", std::move(candidates.vertex_face), frame_t0, frame_t1),
              register_kind<EdgeEdge3>(name_ + "/edge_edge", std::move(candidates.edge_edge), frame_t0, frame_t1)};
    benchmark::RunSpecifiedBenchmarks(&reporter_);
    benchmark::ClearRegisteredBenchmarks();
  }

  void rows(Table& table) const {
    for (const Kind& kind : kinds_) {
      if (ns(kind, "textbook/") > 0) row(kind, table);
    }
    const double ratio = pooled("noli/") / pooled("textbook/");
    if (pooled("textbook/") > 0) table.row({name_ + ", pooled", "", "", "", "", fmt::format("{:.2f}", ratio), ""});
  }

  /// Time of all candidates, from the mean of the sample, in ns. 0 when it was not measured.
  double pooled(const std::string& method) const {
    double sum = 0;
    for (const Kind& kind : kinds_) sum += ns(kind, method) * static_cast<double>(kind.candidates);
    return sum;
  }

 private:
  double ns(const Kind& kind, const std::string& method) const {
    const double* const pass = reporter_.median_ns(method + kind.name);
    return pass == nullptr || kind.sampled == 0 ? 0 : *pass / static_cast<double>(kind.sampled);
  }

  void row(const Kind& kind, Table& table) const {
    table.row({kind.name, fmt::format("{}", kind.candidates), fmt::format("{}", kind.contacts),
               fmt::format("{:.1f}", ns(kind, "textbook/")), fmt::format("{:.1f}", ns(kind, "noli/")),
               fmt::format("{:.2f}", ns(kind, "noli/") / ns(kind, "textbook/")), shares(kind.stages, kind.candidates)});
  }

  std::string name_;
  std::vector<Kind> kinds_;
  MedianReporter reporter_;
};

}  // namespace

bool run() {
  Table table({"candidates", "number", "in contact", "textbook ns", "noli ns", "ratio", shares_head()});
  double textbook = 0, noli = 0;
  for (const FramePair& pair : frame_pairs()) {
    if (pair.name == "rod-twist-clean") continue;  // nothing moves far there, and nothing touches
    const PairBench bench(pair);
    bench.rows(table);
    textbook += bench.pooled("textbook/");
    noli += bench.pooled("noli/");
  }
  if (textbook > 0) table.row({"all, pooled", "", "", "", "", fmt::format("{:.2f}", noli / textbook), ""});
  std::fputs(("\n" + table.text()).c_str(), stdout);
  return textbook > 0;
}

}  // namespace noli::bench

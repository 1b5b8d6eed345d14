// SPDX-License-Identifier: Apache-2.0
#include "audit/ccd/ccd_pipeline.h"

#include <fmt/format.h>
#include <noli/ccd_plugin.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <utility>

#include "audit/ccd/library_answers.h"
#include "certify/stopwatch.h"
#include "certify/verification.h"
#include "proofs/prover/verifier.h"
#include "trajectory/cells.h"
#include "trajectory/formats/frame_inputs.h"
#include "trajectory/formats/frame_sequence.h"
#include "trajectory/formats/frames.h"

namespace noli::audit {
namespace {

namespace fs = std::filesystem;
using Edge = std::array<VertexId, 2>;
using Face = std::array<VertexId, 3>;

/// Two features that meet, by their numbers as noli_ccd_candidates has them.
struct MeshContact {
  std::uint32_t kind = 0, first = 0, second = 0;
  friend auto operator<=>(const MeshContact&, const MeshContact&) = default;
};

/// A step as libraries are told it: without vertices that nothing refers to, and with the edges of faces as a list.
struct Step {
  std::vector<Position> x_t0, x_t1;
  std::vector<Edge> edges;  ///< ascending, each once
  std::vector<Face> faces;
  std::vector<MeshContact> contacts;  ///< sorted by kind, first, second
  std::vector<double> times;          ///< the exact first time of each, rounded down
  std::vector<VertexId> number;       ///< of each vertex, in the frames
};

std::vector<Position> chosen(std::span<const Position> x, const std::vector<VertexId>& vertices) {
  std::vector<Position> result;
  result.reserve(vertices.size());
  for (const VertexId v : vertices) result.push_back(x[v]);
  return result;
}

std::vector<Edge> edges_of(const Mesh& mesh) {
  std::vector<Edge> edges;
  const auto add = [&](VertexId a, VertexId b) {
    if (a != b) edges.push_back({std::min(a, b), std::max(a, b)});
  };
  for (const Face& f : mesh.faces) {
    for (std::size_t i = 0; i < 3; ++i) add(f[i], f[(i + 1) % 3]);
  }
  for (const Edge& e : mesh.edges) add(e[0], e[1]);
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

template <class Pair>
auto key(const Pair& c) {
  return std::array{c.kind, c.first, c.second};
}

/// The number of an edge. Nothing for one from a vertex to itself, as a face has that lists a vertex twice: libraries
/// are told edges of two vertices.
std::optional<std::uint32_t> number_of(const Edge& edge, const std::vector<Edge>& edges) {
  const auto found = std::lower_bound(edges.begin(), edges.end(), edge);
  if (found == edges.end() || *found != edge) return std::nullopt;
  return static_cast<std::uint32_t>(found - edges.begin());
}

/// All numbers of the two features of a contact: a face may be listed more than once.
void add_contact(const FeatureContact& contact, const std::vector<Edge>& edges,
                 const std::multimap<Face, std::uint32_t>& faces, std::vector<MeshContact>& out) {
  const auto& v = contact.vertices;
  MeshContact found;
  if (contact.pair == FeaturePair::edge_edge) {
    const auto first = number_of({v[0], v[1]}, edges), second = number_of({v[2], v[3]}, edges);
    if (!first || !second) return;
    found.kind = NOLI_CCD_EDGE_EDGE;
    std::tie(found.first, found.second) = std::minmax({*first, *second});
    out.push_back(found);
  } else if (contact.pair == FeaturePair::vertex_face) {
    found.kind = NOLI_CCD_VERTEX_FACE;
    found.first = v[0];
    const auto [begin, end] = faces.equal_range({v[1], v[2], v[3]});
    for (auto face = begin; face != end; ++face) {
      found.second = face->second;
      out.push_back(found);
    }
  }
}

/// The pair in the step's numbers.
template <class Pair>
FeatureContact features_of(const Step& step, const Pair& pair) {
  FeatureContact result;
  if (pair.kind == NOLI_CCD_EDGE_EDGE) {
    const Edge &a = step.edges[pair.first], &b = step.edges[pair.second];
    result.pair = FeaturePair::edge_edge;
    result.vertices = {a[0], a[1], b[0], b[1]};
  } else {
    const Face& f = step.faces[pair.second];
    result.vertices = {pair.first, f[0], f[1], f[2]};
  }
  return result;
}

double first_time(const Step& step, const MeshContact& contact) {
  return exact_contact(query_of(features_of(step, contact), 3, step.x_t0, step.x_t1)).value().time;
}

/// The pair in the frames' own numbers.
template <class Pair>
FeatureContact named(const Step& step, const Pair& pair) {
  FeatureContact result = features_of(step, pair);
  for (VertexId& v : result.vertices) v = step.number[v];
  return result;
}

MeshSizes sizes_of(const Step& step) { return {step.x_t0.size(), step.edges.size(), step.faces.size()}; }

template <class Pair>
bool is_pair_of(const Step& step, const Pair& pair) {
  return is_pair(
      pair, sizes_of(step), [&](auto e) { return step.edges[e]; }, [&](auto f) { return step.faces[f]; });
}

/// Of a pair that the library had to do with, and so may have written over; nothing if it is none of the step.
std::optional<FeatureContact> told(const Step& step, const MeshPair& pair) {
  return pair.known != 0 && is_pair_of(step, pair) ? std::optional(named(step, pair)) : std::nullopt;
}

/// What the host left, as far as it is whole: the library may have written over it. `whole`: each candidate is there,
/// and each that is a pair has been asked.
struct Answers {
  std::vector<PairAnswer> pairs;
  bool whole = true;
};

Answers answers_in(const SharedMemory& memory, const Step& step, std::uint64_t said, std::uint64_t most) {
  const std::size_t begin = exchange_bytes(sizes_of(step));
  Answers answers;
  answers.pairs.resize(std::min(std::min(said, most), memory.bytes_behind(begin) / sizeof(PairAnswer)));
  answers.whole = memory.read(begin, std::as_writable_bytes(std::span(answers.pairs))) && answers.pairs.size() == said;
  for (std::size_t i = 0; i < answers.pairs.size(); ++i) {
    const PairAnswer& answer = answers.pairs[i];
    const bool ascends = i == 0 || key(answers.pairs[i - 1]) < key(answer);
    if (!ascends || (answer.answered != 1 && is_pair_of(step, answer))) answers.whole = false;
  }
  return answers;
}

/// In either half of the repetitions, by more than an allocator takes at a time.
bool grew(const Resident& resident) {
  return resident[0] > 0 && resident[1] >= resident[0] + leak_slack && resident[2] >= resident[1] + leak_slack;
}

class PipelineRun {
 public:
  explicit PipelineRun(const PipelineRequest& request) : request_(request) {}

  PipelineOutcome run(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1) {
    if (!prepare(mesh, x_t0, x_t1)) {
      outcome_.complete = false;
      return std::move(outcome_);
    }
    for (const fs::path& library : request_.libraries) {
      for (const double tolerance : request_.tolerances) {
        if (!over_) ask(library, tolerance);
      }
    }
    return std::move(outcome_);
  }

 private:
  /// Finds all contacts; false once stopped or out of time.
  bool prepare(const Mesh& mesh, std::span<const Position> x_t0, std::span<const Position> x_t1) {
    Mesh kept = mesh;
    step_.number = drop_unreferenced_vertices(kept);
    step_.x_t0 = chosen(x_t0, step_.number);
    step_.x_t1 = chosen(x_t1, step_.number);
    step_.edges = edges_of(kept);
    step_.faces = kept.faces;
    outcome_.vertices = kept.vertex_count;
    outcome_.edges = step_.edges.size();
    outcome_.faces = step_.faces.size();
    return find_contacts(kept) && find_times();
  }

  bool find_contacts(const Mesh& mesh) {
    VerifyOptions options;
    options.threads = 1;
    options.initial = false;
    options.max_reports = std::numeric_limits<std::size_t>::max();
    options.stop = request_.host.stop;
    options.deadline = request_.host.deadline;
    const Stopwatch watch;
    const VerifyResult result = verify_step(mesh, step_.x_t0, step_.x_t1, options);
    outcome_.noli_seconds = watch.seconds();
    std::multimap<Face, std::uint32_t> faces;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) faces.emplace(mesh.faces[f], f);
    auto& contacts = step_.contacts;
    for (const FeatureContact& contact : result.reports) add_contact(contact, step_.edges, faces, contacts);
    std::sort(contacts.begin(), contacts.end());
    contacts.erase(std::unique(contacts.begin(), contacts.end()), contacts.end());
    for (const MeshContact& contact : contacts) ++outcome_.contacts[contact.kind];
    return result.complete;
  }

  bool find_times() {
    for (const MeshContact& contact : step_.contacts) {
      if (request_.host.over()) return false;
      step_.times.push_back(first_time(step_, contact));
    }
    if (!step_.times.empty()) outcome_.first_time = std::ranges::min(step_.times);
    return true;
  }

  void ask(const fs::path& library, double tolerance) {
    const MeshSizes sizes = sizes_of(step_);
    const SharedMemory memory(exchange_bytes(sizes));
    auto& exchange = *new (memory.begin()) PipelineExchange;
    exchange.sizes = sizes;
    exchange.tolerance = tolerance;
    exchange.needs_search = request_.needs_search ? 1 : 0;
    exchange.repeat_seconds = request_.looks_for_leaks ? request_.host.repeat_seconds : 0;
    const MeshArrays arrays(exchange);
    for (std::size_t v = 0; v < sizes.vertices; ++v) {
      std::copy(step_.x_t0[v].begin(), step_.x_t0[v].end(), arrays.x_t0 + 3 * v);
      std::copy(step_.x_t1[v].begin(), step_.x_t1[v].end(), arrays.x_t1 + 3 * v);
    }
    for (std::size_t e = 0; e < sizes.edges; ++e) std::copy_n(step_.edges[e].begin(), 2, arrays.edges + 2 * e);
    for (std::size_t f = 0; f < sizes.faces; ++f) std::copy_n(step_.faces[f].begin(), 3, arrays.faces + 3 * f);
    Ending ending = HostProcess(library, memory, exchange, request_.host, true).wait();
    const bool lacks_search = exchange.loaded == LoadResult::no_candidates && request_.needs_search;
    if (ending.kind == Ending::Kind::finished && lacks_search) require_loaded(library, exchange, ending);
    const bool searched = exchange.search_code >= 0;
    const Answers answers =
        answers_in(memory, step_, exchange.candidates, request_.host.most_memory / sizeof(PairAnswer));
    if (ending.kind == Ending::Kind::finished && searched && !answers.whole) {
      ending.kind = Ending::Kind::crashed;
      ending.words = "answers are missing: the library writes to memory that is not its own";
    }
    outcome_.complete = outcome_.complete && ending.kind == Ending::Kind::finished;
    over_ = ending.kind == Ending::Kind::stopped;
    outcome_.audits.push_back(marked(library, tolerance, exchange, answers, ending));
  }

  PipelineAudit marked(const fs::path& library, double tolerance, const PipelineExchange& exchange,
                       const Answers& answers, const Ending& ending) const {
    PipelineAudit audit;
    audit.plugin = library;
    audit.tolerance = tolerance;
    audit.ending = ending;
    audit.search_seconds = exchange.search_seconds;
    audit.query_seconds = exchange.query_seconds;
    const bool finished = ending.kind == Ending::Kind::finished;
    const HostPhase phase = exchange.phase.load();
    const bool again = phase == HostPhase::repeating && exchange.asked.known == 0;
    audit.in_search = !finished && (phase == HostPhase::searching || again);
    audit.searched = exchange.search_code >= 0;
    audit.failures = audit.searched ? 0 : 1;
    audit.leaks = grew(exchange.resident);
    if (!finished) audit.asked = told(step_, exchange.asked);
    const bool reports = finished && audit.searched;
    compare(answers, reports, audit);
    return audit;
  }

  /// The answers and the contacts both ascend.
  void compare(const Answers& answers, bool reports, PipelineAudit& audit) const {
    std::size_t next = 0;
    double first_hit = 2;
    std::optional<FeatureContact> false_positive;
    for (const PairAnswer& answer : answers.pairs) {
      if (!is_pair_of(step_, answer)) {
        ++audit.bad_pairs;
        continue;
      }
      ++audit.candidates[answer.kind];
      for (; next < step_.contacts.size() && key(step_.contacts[next]) < key(answer); ++next) {
        if (reports) mark(next, nullptr, audit);
      }
      const bool meets = next < step_.contacts.size() && key(step_.contacts[next]) == key(answer);
      if (answer.answered != 0) add(answer, meets, first_hit, false_positive, audit);
      if (meets && reports) mark(next, &answer, audit);
      next += meets ? 1 : 0;
    }
    for (; next < step_.contacts.size() && reports; ++next) mark(next, nullptr, audit);
    audit.through = reports && outcome_.first_time && first_hit > *outcome_.first_time;
    if (!reports || !request_.exact || !false_positive || audit.reports.size() >= request_.max_reports) return;
    audit.reports.push_back({*false_positive, "false_positive", "they stay apart", {}});
  }

  /// What an answer is, whether its pair meets or not. `first_hit`: the first time of impact; a hit without one is 0.
  void add(const PairAnswer& answer, bool meets, double& first_hit, std::optional<FeatureContact>& false_positive,
           PipelineAudit& audit) const {
    if (answer.code != NOLI_CCD_HIT && answer.code != NOLI_CCD_NO_HIT) {
      ++audit.failures;
      if (!audit.failed) audit.failed = named(step_, answer);
    }
    if (answer.code != NOLI_CCD_HIT) return;
    first_hit = std::min(first_hit, std::isnan(answer.time) ? 0 : answer.time);
    if (meets) return;
    ++audit.false_positives[answer.kind];
    if (!false_positive) false_positive = named(step_, answer);
  }

  /// Of a contact, and what was answered; nothing where it was no candidate.
  void mark(std::size_t i, const PairAnswer* answer, PipelineAudit& audit) const {
    const MeshContact& contact = step_.contacts[i];
    const double exact = step_.times[i];
    const bool hit = answer != nullptr && answer->code == NOLI_CCD_HIT;
    const auto report = [&](const char* what) {
      if (audit.reports.size() >= request_.max_reports) return;
      const std::string truth = fmt::format("exact first time {:.17g}", exact);
      audit.reports.push_back(
          {named(step_, contact), what, hit ? fmt::format("{:.17g}, {}", answer->time, truth) : truth, exact});
    };
    if (answer == nullptr) {
      ++audit.not_found;
      return report("not_found");
    }
    if (!hit && answer->code != NOLI_CCD_NO_HIT) return report("failure");
    if (!hit) {
      ++audit.false_negatives;
      return report("false_negative");
    }
    if (std::isnan(answer->time)) {
      if (request_.knows_times) report("no_time");
      return;
    }
    if (!(answer->time >= 0 && answer->time <= 1)) {
      ++audit.bad_times;
      return report("bad_time");
    }
    const double error = exact - answer->time, relative = exact > 0 ? std::abs(error) / exact : 0;
    if (error >= 0) {
      audit.early.add(error, relative);
      if (request_.exact && error > 0) report("early");
      return;
    }
    audit.late.add(-error, relative);
    report("late");
  }

  const PipelineRequest& request_;
  Step step_;
  PipelineOutcome outcome_;
  bool over_ = false;
};

}  // namespace

std::uint64_t PipelineAudit::findings() const {
  const bool ended = ending.kind != Ending::Kind::finished && ending.kind != Ending::Kind::stopped;
  return not_found + false_negatives + late.count() + bad_times + failures + bad_pairs + (ended ? 1 : 0);
}

std::uint64_t PipelineOutcome::findings() const {
  std::uint64_t sum = 0;
  for (const PipelineAudit& audit : audits) sum += audit.findings();
  return sum;
}

PipelineOutcome audit_pipeline(const PipelineRequest& request) {
  for (const fs::path& library : request.libraries) require_ccd_library(library, request.host);
  FrameInputs inputs({request.before, request.after}, request.polygons);
  for (std::size_t k = 0; k < 2; ++k) inputs.look_at(k);
  FrameSequence frames(inputs);
  frames.next();
  PipelineOutcome outcome = PipelineRun(request).run(frames.mesh(), frames.x_t0(), frames.x_t1());
  outcome.inputs = inputs.facts();
  outcome.notes = inputs.notes();
  return outcome;
}

PipelineOutcome audit_pipeline(const PipelineRequest& request, const Mesh& mesh, std::span<const Position> x_t0,
                               std::span<const Position> x_t1) {
  return PipelineRun(request).run(mesh, x_t0, x_t1);
}

}  // namespace noli::audit

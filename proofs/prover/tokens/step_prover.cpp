// SPDX-License-Identifier: Apache-2.0
#include "proofs/prover/tokens/step_prover.h"

#include <list>
#include <mutex>

#include "kernel/parallel.h"
#include "proofs/prover/windows/span_cut.h"

namespace noli {

namespace {

constexpr std::uint32_t grain_share = 128;
constexpr std::uint32_t least_grain = 64;

using Take = std::function<void(std::string_view)>;

/// One step.
template <int Dim>
class Proof {
 public:
  Proof(const ProofTree& tree, const MeshPaths& paths, const ProofClaim& claim, const WorldLines& lines,
        const VerifyOptions& options, const Take& take)
      : tree_(tree), paths_(paths), claim_(claim), lines_(lines), options_(options), take_(take), stop_(options) {}

  bool run() { return settle({Integer(0), 0}); }

 private:
  /// Tokens before each task, and those of the task.
  struct Share {
    Tokens before, own;
    bool ready = false;
  };

  bool settle(const Piece& span) {
    ProofScene<Dim> scene{lines_, tree_, claim_.excluded, claim_.strict, claim_.eta, paths_, {}, {}, span};
    const bool restless = find_chords(scene, *span.times(lines_));
    if (restless && span.half(0).times(lines_) && span.half(1).times(lines_)) {
      Tokens halve;
      halve.halve();
      halve.give(take_);
      scene.chords = {};
      return settle(span.half(0)) && settle(span.half(1));
    }
    find_boxes(scene);
    return write(scene);
  }

  /// Whether many vertices stray from their chords.
  bool find_chords(ProofScene<Dim>& scene, Span times) const {
    const std::size_t vertices = lines_.vertex_count();
    scene.chords.resize(vertices);
    for_each_in_pieces(vertices, options_.threads, [&](std::size_t v) {
      scene.chords[v] = chord_of<Dim>(WorldLine(lines_, static_cast<VertexId>(v)), times.begin, times.end);
    });
    std::size_t inside = 0;
    for (const auto& chord : scene.chords) inside += chord.inside;
    return worth_cutting(inside, vertices, [&] { return count_restless(scene.chords); });
  }

  std::size_t count_restless(const std::vector<ProofChord<Dim>>& chords) const {
    std::vector<double> size(chords.size(), std::numeric_limits<double>::infinity());
    for (std::uint32_t i = 0; i < tree_.nodes().size(); ++i) {
      if (!tree_.node(i).leaf()) continue;
      const ProofCell& cell = tree_.cell(tree_.node(i).cell);
      for (std::size_t a = 0; a < cell.corners; ++a) {
        for (std::size_t b = 0; b < a; ++b) {
          double length = 0;
          for (std::size_t k = 0; k < Dim; ++k)
            length += std::abs(chords[cell.vertices[a]].x_t0[k] - chords[cell.vertices[b]].x_t0[k]);
          for (const VertexId v : {cell.vertices[a], cell.vertices[b]}) size[v] = std::min(size[v], length);
        }
      }
    }
    std::size_t count = 0;
    for (std::size_t v = 0; v < chords.size(); ++v)
      count += *std::max_element(chords[v].radius.begin(), chords[v].radius.end()) * 12 > size[v] ? 1 : 0;
    return count;
  }

  void find_boxes(ProofScene<Dim>& scene) const {
    const auto& nodes = tree_.nodes();
    scene.boxes.resize(nodes.size());
    for_each_in_pieces(nodes.size(), options_.threads, [&](std::size_t i) {
      if (nodes[i].leaf()) scene.boxes[i] = box_of(tree_.cell(nodes[i].cell), scene.chords);
    });
    for (std::size_t i = nodes.size(); i-- > 0;) {
      if (!nodes[i].leaf()) scene.boxes[i] = joined(scene.boxes[nodes[i].left], scene.boxes[nodes[i].right]);
    }
  }

  static ProofBox<Dim> box_of(const ProofCell& cell, const std::vector<ProofChord<Dim>>& chords) {
    ProofBox<Dim> box;
    for (std::size_t i = 0; i < cell.corners; ++i) {
      const ProofChord<Dim>& c = chords[cell.vertices[i]];
      for (std::size_t k = 0; k < Dim; ++k) {
        for (std::size_t end = 0; end < 2; ++end) {
          const double x = (end == 0 ? c.x_t0 : c.x_t1)[k];
          const double low = x - c.radius[k], high = x + c.radius[k];
          box.low[end][k] = i == 0 ? low : std::min(box.low[end][k], low);
          box.high[end][k] = i == 0 ? high : std::max(box.high[end][k], high);
        }
      }
    }
    return box;
  }

  static ProofBox<Dim> joined(ProofBox<Dim> a, const ProofBox<Dim>& b) {
    for (std::size_t end = 0; end < 2; ++end) {
      for (std::size_t k = 0; k < Dim; ++k) {
        a.low[end][k] = std::min(a.low[end][k], b.low[end][k]);
        a.high[end][k] = std::max(a.high[end][k], b.high[end][k]);
      }
    }
    return a;
  }

  bool write(const ProofScene<Dim>& scene) {
    std::vector<ProofTask> tasks;
    std::list<Share> shares(1);
    ProofWalk<Dim> top(scene, stop_);
    const auto cells = tree_.node(0).count;
    bool whole = top.run({0, 0, true}, shares.back().before, std::max(cells / grain_share, least_grain), &tasks,
                         [&]() -> Tokens& { return shares.emplace_back().before; });
    std::vector<Share*> list;
    for (Share& share : shares) list.push_back(&share);
    std::mutex mutex;
    std::size_t given = 0;
    std::atomic<bool> stopped = !whole;
    parallel_for(tasks.size(), options_.threads, [&](std::size_t i) {
      if (stopped) return;
      ProofWalk<Dim> walk(scene, stop_);
      Share& share = *list[i];
      const bool finished = walk.run(tasks[i], share.own, 0, nullptr, [&]() -> Tokens& { return share.own; });
      if (!finished) stopped = true;
      const std::lock_guard lock(mutex);
      share.ready = finished;
      for (; given < tasks.size() && list[given]->ready; ++given) give(*list[given]);
    });
    if (stopped || given < tasks.size()) return false;
    give(*list[given]);
    return true;
  }

  void give(Share& share) const {
    share.before.give(take_);
    share.own.give(take_);
    share = {};
  }

  const ProofTree& tree_;
  const MeshPaths& paths_;
  const ProofClaim& claim_;
  const WorldLines& lines_;
  const VerifyOptions& options_;
  const Take& take_;
  StopSignal stop_;
};

}  // namespace

StepProver::StepProver(const Mesh& mesh, std::span<const std::uint32_t> order, std::span<const std::uint32_t> ends,
                       std::span<const std::uint32_t> labels, ProofClaim claim)
    : claim_(std::move(claim)),
      tree_(std::make_shared<ProofTree>(mesh, order, ends, labels)),
      paths_(*tree_, mesh.vertex_count, claim_.ring) {}

bool StepProver::prove(const WorldLines& lines, const VerifyOptions& options, const Take& take) const {
  TokenBlocks blocks(take);
  const Take put = [&](std::string_view bytes) { blocks(bytes); };
  const bool whole = claim_.dimension == 2 ? Proof<2>(*tree_, paths_, claim_, lines, options, put).run()
                                           : Proof<3>(*tree_, paths_, claim_, lines, options, put).run();
  blocks.flush();
  return whole;
}

bool StepProver::write(ProofFile& file, const WorldLines& lines, const VerifyOptions& options) const {
  bool whole = false;
  try {
    whole = prove(lines, options, [&file](std::string_view bytes) { file.tokens(bytes); });
  } catch (...) {
    file.discard();
    throw;
  }
  if (!whole) file.discard();
  return whole;
}

}  // namespace noli

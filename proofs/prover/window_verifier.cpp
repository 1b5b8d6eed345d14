// SPDX-License-Identifier: Apache-2.0
#include "noli/proofs/prover/window_verifier.h"

#include <algorithm>
#include <limits>
#include <mutex>

#include "noli/kernel/parallel.h"
#include "noli/proofs/prover/window_owners.h"
#include "noli/proofs/prover/window_traversal.h"

namespace noli {

namespace {

/// As in verifier.cpp.
constexpr std::uint32_t grain_share = 256;
constexpr std::uint32_t least_grain = 64;

/// Runs body(begin, end) on consecutive pieces of [0, count), in parallel.
template <class Body>
void in_pieces(std::size_t count, int threads, const Body& body) {
  constexpr std::size_t piece = 1024;
  parallel_for((count + piece - 1) / piece, threads,
               [&](std::size_t i) { body(i * piece, std::min(count, (i + 1) * piece)); });
}

/// What one task leaves behind.
struct Outcome {
  WindowTally tally;
  bool finished = false;
};

/// Positions of all vertices at T0 and T1.
struct Ends {
  std::vector<Position> x_t0, x_t1;
};

Ends ends_of(const WorldLines& lines) {
  Ends ends;
  for (std::size_t v = 0; v < lines.vertex_count(); ++v) {
    ends.x_t0.push_back(lines.positions(static_cast<VertexId>(v)).front());
    ends.x_t1.push_back(lines.positions(static_cast<VertexId>(v)).back());
  }
  return ends;
}

VerifyOptions when_to_stop(const WindowOptions& options) {
  VerifyOptions result;
  result.stop = options.stop;
  result.deadline = options.deadline;
  return result;
}

/// One verification of one window.
template <int Dim>
class Verification {
 public:
  Verification(const Mesh& mesh, const WorldLines& lines, const WindowOptions& options)
      : lines_(lines),
        options_(options),
        stop_(when_to_stop(options)),
        top_{WindowTally(options.max_reports, WindowEarliest(lines, Dim))} {
    const Ends ends = ends_of(lines);
    const Hierarchy hierarchy(mesh, ends.x_t0, ends.x_t1, Dim, options.threads);
    gather_cells(mesh, hierarchy);
    boxes_ = window_boxes(cells_, options.threads);
  }

  WindowResult run() {
    const Outcome blank = top_;
    cut_into_tasks();
    outcomes_.assign(tasks_.size(), blank);
    parallel_for(tasks_.size(), options_.threads, [this](std::size_t i) { run_task(i); });
    return add_up();
  }

 private:
  void gather_cells(const Mesh& mesh, const Hierarchy& hierarchy) {
    CellFeatures features = find_owners(mesh, options_.strict);
    const std::vector<std::uint8_t> scripted = scripted_cells(mesh, options_.scripted);
    prefer_free_owners(mesh, scripted, features);
    const auto order = hierarchy.leaf_cells();
    cells_.resize(order.size());
    in_pieces(order.size(), options_.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        cells_[i] = gather_cell(mesh, features, order[i]);
        cells_[i].scripted = scripted[order[i]] != 0;
      }
    });
  }

  WindowCell<Dim> gather_cell(const Mesh& mesh, const CellFeatures& features, std::uint32_t cell) const {
    WindowCell<Dim> c{};
    c.vertices = corners(mesh, cell);
    c.cell = cell;
    c.owned = features.owned[cell];
    c.shared = features.shared[cell];
    c.corners = static_cast<std::uint8_t>(corner_count(mesh, cell));
    c = over(c, all_corners(3), lines_, lines_.first_time(), lines_.last_time());
    return c;
  }

  WindowScene<Dim> scene() const { return {lines_, cells_, boxes_}; }

  /// Walks the top of the tree, where there is little to do, and lists what is below.
  void cut_into_tasks() {
    const WindowScene<Dim> all = scene();
    WindowTraversal<Dim> traversal(all, options_, stop_, top_.tally);
    const Group root{0, 0, static_cast<std::uint32_t>(cells_.size())};
    traversal.defer(std::max(root.count / grain_share, least_grain), tasks_);
    top_.finished = traversal.run({root, root, true});
  }

  void run_task(std::size_t i) {
    if (i > first_found_) return;
    const WindowScene<Dim> all = scene();
    Outcome& outcome = outcomes_[i];
    WindowTraversal<Dim> traversal(all, options_, stop_, outcome.tally);
    outcome.finished = traversal.run(tasks_[i]);
    if (options_.first_only && outcome.tally.found_any()) lower_first_found(i);
    if (options_.progress) tell_progress();
  }

  void lower_first_found(std::size_t i) {
    std::size_t before = first_found_;
    while (i < before && !first_found_.compare_exchange_weak(before, i)) {
    }
  }

  void tell_progress() {
    const std::lock_guard lock(mutex_);
    ++done_;
    options_.progress(static_cast<double>(done_) / static_cast<double>(tasks_.size()));
  }

  /// Tasks after the one that first_only ended at do not count: whether they ran depends on the threads.
  WindowResult add_up() {
    bool complete = top_.finished;
    for (std::size_t i = 0; i < outcomes_.size() && i <= first_found_; ++i) {
      top_.tally += outcomes_[i].tally;
      complete = complete && outcomes_[i].finished;
    }
    WindowTally& sum = top_.tally;
    return {complete,
            sum.contacts,
            sum.initial_intersections,
            sum.reports.take(),
            sum.initial_reports.take(),
            sum.earliest.first(),
            sum.stages,
            sum.obligations,
            sum.cell_pairs};
  }

  const WorldLines& lines_;
  const WindowOptions& options_;
  StopSignal stop_;
  std::vector<WindowCell<Dim>> cells_;
  std::vector<GroupBox> boxes_;
  std::vector<Obligation> tasks_;
  std::vector<Outcome> outcomes_;
  std::atomic<std::size_t> first_found_ = std::numeric_limits<std::size_t>::max();
  std::mutex mutex_;
  std::size_t done_ = 0;
  Outcome top_;  ///< of the walk over the top, then the sum of all
};

}  // namespace

WindowResult verify_window(const Mesh& mesh, const WorldLines& lines, const WindowOptions& options) {
  if (mesh.cell_count() == 0) return {};
  return options.dimension == 2 ? Verification<2>(mesh, lines, options).run()
                                : Verification<3>(mesh, lines, options).run();
}

}  // namespace noli

// SPDX-License-Identifier: Apache-2.0
#include <noli/repair.h>

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include <noli/errors.h>
#include <noli/sequence.h>
#include "certificates/cells.h"
#include "certify/groups.h"
#include "certify/not_compared.h"
#include "certify/process/hdf5_frames.h"
#include "certify/repair/changes.h"
#include "certify/repair/excluded_pairs.h"
#include "certify/repair/moving_vertices.h"
#include "certify/repair/repaired_frames.h"
#include "certify/repair/repaired_run.h"
#include "certify/repair/spread.h"
#include "certify/repair/step_contact.h"
#include "certify/repair/step_filter.h"
#include "certify/repair/verify_repaired.h"
#include "certify/result_file.h"
#include "certify/simulate/retries.h"
#include "certify/stopwatch.h"
#include "trajectory/blocks/run_checks.h"
#include "trajectory/cells.h"
#include "trajectory/formats/frame_order.h"
#include "trajectory/formats/frame_sequence.h"
#include "trajectory/formats/frames.h"
#include "trajectory/stop.h"

namespace noli {
namespace {

/// Why a repair ends before its last frame.
struct Ended {
  RepairEnd end;
};

RepairEnd end_of(const Stopped& stopped) {
  return stopped.reason() == StopReason::out_of_time ? RepairEnd::out_of_time : RepairEnd::interrupted;
}

/// Where a step is cut so that straight lines between its frames touch nothing: at multiples of 2^-finest.
constexpr int finest = 20;

template <int Dim>
class Repair {
 public:
  /// Precondition: the sequence is at its first step.
  Repair(const RepairRequest& request, FrameSource& source, FrameSequence& sequence, RepairOutcome& outcome)
      : request_(request),
        sequence_(sequence),
        outcome_(outcome),
        frames_(request, source),
        mesh_(sequence.mesh()),
        fixed_(fixed_vertices(request, mesh_.vertex_count, source.bodies())),
        stop_([this] { return stopped(); }),
        changes_(source.bodies(), fixed_),
        x_(sequence.x_t0().begin(), sequence.x_t0().end()) {
    if (request.points) add_particles(mesh_);
    if (mesh_.cell_count() == 0) {
      throw InputError(sequence.name_t0(), "",
                       "no faces, edges or points; expected something that can touch (see --points)");
    }
    if (request.ignore) {
      groups_ = read_groups(*request.ignore, mesh_.vertex_count, names_of_frames(source.bodies()));
      require_whole_cells(*request.ignore, *groups_, mesh_);
    }
    mass_ = masses_of(request, mesh_, x_);
    contact_.emplace(mesh_, x_, mass_, fixed_, exclusions(),
                     StepContact::Wanted{request.thickness, request.restitution, request.friction});
    gaps_.emplace(mesh_, vectors_of<Dim>(x_), fixed_, exclusions(), excluded_pairs_);
    filter_.emplace(mesh_, mass_, fixed_, *contact_, excluded_pairs_, *gaps_, stop_,
                    [this](double part) { tell(part); });
    verifier_.emplace(mesh_, options(false, true));
    // Parts of cells that intersect may be apart in the first frame, and yet are not compared later.
    Mesh parts = fixed_parts(mesh_, fixed_, request.only_new);
    if (parts.cell_count() > 1) fixed_verifier_.emplace(std::move(parts), options(false, false));
    if (request.spread > 0) spread_.emplace(mesh_, fixed_, request.spread);
    if (request.run) prepare_run(source.bodies());
    outcome.cells = mesh_.cell_count();
    outcome.fixed = static_cast<std::uint64_t>(std::ranges::count(fixed_, 1));
    outcome.thickness = contact_->greatest_bound();
    outcome.mean_edge = mean_edge(mesh_, x_);
  }

  /// Throws Ended, Stopped.
  void operator()() {
    bool more = true;
    const auto last = frames_.last(sequence_.mesh());
    if (last) take_over(*last);
    if (request_.only_new) leave_out_baseline();
    if (last) {
      x_ = last->positions;
      if (run_ && !run_->go_on(last->step, x_, stop_)) end_if(true);
      frames_.begin();
      for (std::size_t k = 0; k < last->step && more; ++k) more = sequence_.next();
    } else {
      require_free_start();
      if (run_) run_->claim(request_.force, request_.resume);
      frames_.begin();
      if (run_) run_->begin();
      frames_.write(0, {sequence_.mesh(), x_}, true);
      frames_.commit();
    }
    for (; more; more = sequence_.next()) {
      end_if(stopped());
      repair_step();
      frames_.commit();
      ++outcome_.steps;
      tell(0);
    }
  }

  /// Whatever is written stays.
  void finish() {
    frames_.finish(outcome_);
    if (run_) run_->finish(end_of_run(outcome_.end), stop_);
    outcome_.run_begun = run_ && run_->has_begun();
    if (request_.thickness && *request_.thickness > outcome_.thickness) {
      outcome_.notes.push_back(
          fmt::format("--thickness {} is more than half of the least height of cells; expected at most {}",
                      *request_.thickness, outcome_.thickness));
    }
    if (outcome_.frames > outcome_.copied) {
      outcome_.notes.emplace_back(
          "frames that are not copies have only vertices, faces, edges and points: no texture coordinates, materials "
          "or groups, and polygons are cut into triangles");
    }
    outcome_.changed = changes_.steps();
    outcome_.momentum_into_fixed = changes_.momentum_into_fixed();
    outcome_.by_body = changes_.by_body();
    outcome_.straight_windows = run_ ? run_->straight_windows() : 0;
    if (outcome_.straight_windows > 0) {
      outcome_.notes.push_back(
          fmt::format("--run: {} windows that this call wrote have the straight lines between the new frames, as the "
                      "repaired motion touches once its times are rounded",
                      outcome_.straight_windows));
    }
  }

 private:
  bool stopped() const {
    if (stop_asked() == StopReason::interrupted) return true;
    if (request_.stop != nullptr && request_.stop->load(std::memory_order_relaxed)) return true;
    return late();
  }
  bool late() const {
    return stop_asked() == StopReason::out_of_time ||
           (request_.deadline && std::chrono::steady_clock::now() >= *request_.deadline);
  }
  void end_if(bool stopped) const {
    if (stopped) throw Ended{late() ? RepairEnd::out_of_time : RepairEnd::interrupted};
  }

  const Exclusions* exclusions() const { return groups_ ? &groups_->exclusions : nullptr; }

  SequenceOptions options(bool at_rest, bool first_only) const {
    SequenceOptions options;
    options.dimension = Dim;
    options.at_rest = at_rest;
    options.threads = request_.threads;
    options.first_only = first_only;
    options.max_reports = 1;
    options.exclusions = exclusions();
    options.only_new = request_.only_new;
    options.stop = request_.stop;
    options.deadline = request_.deadline;
    return options;
  }

  /// `part`: of the step.
  void tell(double part) const {
    if (!request_.progress || outcome_.steps_total == 0) return;
    const double done = static_cast<double>(outcome_.steps) + part;
    request_.progress("repair", std::min(1.0, done / static_cast<double>(outcome_.steps_total)));
  }

  void prepare_run(const std::vector<FrameBody>& bodies) {
    if (request_.only_new) {
      throw UsageError("--run: cannot be combined with --only-new, as a run has no cells that may keep intersecting");
    }
    require_place_for(*request_.run);
    RepairedScene scene;
    scene.run = {{Dim, RecordMode::full, 1}, mesh_, std::vector<std::uint8_t>(mesh_.vertex_count, 0), {}};
    if (groups_) scene.run.exclusions = groups_->exclusions;
    scene.title = "Repair of " + std::filesystem::path(sequence_.name_t0()).filename().string();
    scene.pattern = request_.pattern;
    scene.steps = outcome_.steps_total;
    scene.fingerprint = frames_.fingerprint();
    scene.bodies = names_of_frames(bodies).to_json();
    WindowOptions window;
    window.dimension = Dim;
    window.threads = request_.threads;
    window.initial = false;
    window.first_only = true;
    window.exclusions = exclusions();
    window.stop = request_.stop;
    window.deadline = request_.deadline;
    run_.emplace(*request_.run, std::move(scene), window);
    if (!request_.resume) run_->require_room(request_.force);
  }

  /// A folder with a run is read as that, and not as frames; and a run that is replaced must not be what is read.
  void require_place_for(const std::filesystem::path& run) const {
    const std::filesystem::path folder = place_of(run);
    const std::string frames = place_of(parse_pattern(request_.pattern).file(0)).string();
    if (frames.starts_with(folder.string() + '/') || is_of_repaired(run, request_.pattern)) {
      throw UsageError("--run " + run.string() + ": the new frames go there; choose another folder");
    }
    for (const auto& file : files_read(request_)) {
      const std::filesystem::path there = place_of(file);
      if (there.parent_path() != folder || !is_file_of_run(there.filename())) continue;
      throw UsageError("--run " + run.string() + ": " + file.string() + " is read; choose another folder");
    }
  }

  /// Why the repair ended, as the log of a run has it.
  static const char* end_of_run(RepairEnd end) { return end == RepairEnd::out_of_time ? "time_limit" : name(end); }

  // --- What cannot be ------------------------------------------------------------------------------------------------

  /// Cells that intersect in the first frame may go on so. Precondition: x_ is that frame.
  void leave_out_baseline() {
    try {
      verifier_->baseline(x_);
      if (fixed_verifier_) fixed_verifier_->baseline(x_);
    } catch (const std::length_error& error) {
      throw InputError(sequence_.name_t0(), "", std::string("--only-new: ") + error.what());
    }
    end_if(stopped());
    const std::vector<InitialIntersection>& pairs = verifier_->baseline(x_);
    outcome_.baseline = pairs.size();
    if (pairs.empty()) return;
    const Baseline baseline(mesh_, pairs);
    excluded_pairs_ = ExcludedPairs(gaps_->features(), baseline)(stop_);
    end_if(stopped());
    NotCompared left_out;
    left_out.baseline = pairs.size();
    outcome_.notes.push_back("not compared: " + baseline_text(left_out) + " (--only-new)");
  }

  /// What an earlier call has done.
  void take_over(const RepairedFrames::Last& last) {
    outcome_.steps = outcome_.steps_before = last.step;
    for (std::size_t line = 0; line < last.changed.size(); ++line) {
      try {
        changes_.add_line(last.changed[line]);
      } catch (const std::invalid_argument&) {
        frames_.fail_changed(line);
      }
    }
  }

  void require_free_start() {
    const StepResult found = request_.only_new ? verifier_->step(x_, x_)  // which knows what to leave out
                                               : SequenceVerifier(mesh_, options(true, false)).step(x_, x_);
    end_if(!found.complete && !found.touches());
    if (!found.touches()) return;
    RepairObstacle& obstacle = outcome_.obstacle.emplace();
    if (found.first) {
      note(found, 0, obstacle);
    } else {
      obstacle.cells = true;
      const InitialIntersection& cells = found.initial_reports.front();
      obstacle.vertices = {cells.first_cell, cells.second_cell};
      const BodyNames names = names_of_frames(outcome_.bodies);
      obstacle.names = {names.cell(mesh_, cells.first_cell), names.cell(mesh_, cells.second_cell)};
    }
    throw Ended{RepairEnd::start_touches};
  }

  /// What moves as given cannot be kept apart.
  void require_room_between_fixed() {
    if (!fixed_verifier_) return;
    const StepResult found = fixed_verifier_->step(sequence_.x_t0(), y_);
    end_if(!found.complete && !found.touches());
    if (!found.touches()) return;
    note(found, number(), outcome_.obstacle.emplace());
    throw Ended{RepairEnd::blocked};
  }

  static void note(const StepResult& found, std::size_t step, RepairObstacle& obstacle) {
    obstacle.step = step;
    obstacle.time = found.first->time;
    obstacle.kind = found.first->contact.pair;
    obstacle.vertices = found.first->contact.vertices;
  }

  // --- A step --------------------------------------------------------------------------------------------------------

  std::size_t number() const { return sequence_.step() + 1; }

  void repair_step() {
    if (Dim == 2 && !request_.dimension) {
      require_one_plane(sequence_.x_t0(), sequence_.x_t1(), sequence_.name_t1());
    }
    y_.assign(sequence_.x_t1().begin(), sequence_.x_t1().end());
    if (!touches(x_, y_)) {
      if (run_) run_->add_straight(x_, y_);
      return accept(1, y_);
    }
    require_room_between_fixed();
    take_aim();
    Retries retries;
    std::optional<Retry> how = Retry{};
    while (how) {
      std::uint32_t deepest = 0;
      if (const std::optional<FilteredStep> moved = filtered(*how)) {
        deepest = moved->deepest;
        if (append(*moved)) return;
      }
      how = retries.next(deepest);
    }
    throw Ended{RepairEnd::undecided};
  }

  /// At the next given frame, or beside it as far as what is off takes its surroundings along.
  void take_aim() {
    aim_ = y_;
    if (!spread_) return;
    const std::vector<Position> along = (*spread_)(x_, sequence_.x_t0(), stop_);
    end_if(stopped());
    for (std::size_t v = 0; v < aim_.size(); ++v) {
      for (std::size_t k = 0; k < 3; ++k) aim_[v][k] += along[v][k];
    }
  }

  /// Decides the straight lines from a to b.
  bool touches(const std::vector<Position>& a, const std::vector<Position>& b) {
    const StepResult found = verifier_->step(a, b);
    end_if(!found.complete && !found.touches());
    return found.touches();
  }

  std::optional<FilteredStep> filtered(const Retry& how) {
    try {
      std::optional<FilteredStep> step = (*filter_)(x_, aim_, how);
      if (step) keep_third(step->end);
      return step;
    } catch (const integrator::ContactLimit& limit) {
      RepairObstacle& obstacle = outcome_.obstacle.emplace();
      obstacle.step = number();
      obstacle.time = limit.time;
      obstacle.kind = limit.pair.kind;
      std::copy_n(limit.pair.vertices.begin(), limit.pair.size(), obstacle.vertices.begin());
      throw Ended{RepairEnd::undecided};
    } catch (const certificates::WallFails&) {
      outcome_.notes.push_back(fmt::format("step {}: something is too close for double precision", number()));
      throw Ended{RepairEnd::undecided};
    } catch (const StepTooLong& error) {
      outcome_.notes.push_back(fmt::format("step {}: {}", number(), error.what()));
      throw Ended{RepairEnd::undecided};
    } catch (const Stopped&) {
      end_if(true);
      throw;
    }
  }

  /// In two dimensions the integrator knows no third coordinate.
  void keep_third(std::vector<Position>& x) const {
    if constexpr (Dim == 2) {
      for (std::size_t i = 0; i < x.size(); ++i) x[i][2] = y_[i][2];
    }
  }

  /// Writes the step's last frame, and before it those without which straight lines would touch. False, with nothing
  /// written, if even the finest cut touches.
  bool append(const FilteredStep& moved) {
    constexpr std::uint32_t whole = 1U << finest;
    std::vector<double> times;
    std::vector<Position> from = x_;
    for (std::uint32_t at = 0, length = whole; at < whole;) {
      const double t = std::ldexp(static_cast<double>(at + length), -finest);
      std::vector<Position> to = positions_at(moved, t);
      if (touches(from, to)) {
        length /= 2;
        if (length == 0) return false;
        continue;
      }
      at += length;
      times.push_back(t);
      from = std::move(to);
      if (at % (2 * length) == 0 && length < whole) length *= 2;
    }
    if (run_ && !run_->add(moved, x_, times)) end_if(true);
    note_change(moved, times.size() - 1);
    for (const double t : times) accept(t, positions_at(moved, t));
    return true;
  }

  std::vector<Position> positions_at(const FilteredStep& moved, double t) const {
    std::vector<Position> x = moved.at(t);
    if (t < 1) keep_third(x);
    return x;
  }

  void note_change(const FilteredStep& moved, std::size_t inserted) {
    RepairedStep step;
    step.step = number();
    step.inserted = inserted;
    step.deepest = moved.deepest;
    frames_.add_changed(changes_.add(step, moved.momentum_into_fixed, moved.end, y_));
  }

  /// The motion up to this time of the step has been decided.
  void accept(double t, std::vector<Position> x) {
    x_ = std::move(x);
    frames_.write(static_cast<double>(sequence_.step()) + t, {sequence_.mesh(), x_}, t == 1 && same_bits(x_, y_));
  }

  const RepairRequest& request_;
  FrameSequence& sequence_;
  RepairOutcome& outcome_;
  RepairedFrames frames_;
  Mesh mesh_;  ///< with the points that are compared
  std::vector<std::uint8_t> fixed_;
  integrator::Stop stop_;
  Changes changes_;
  std::vector<Position> x_, y_;  ///< where the step begins, repaired; where it is to end, as given
  std::vector<Position> aim_;    ///< where it would end without contact
  std::vector<double> mass_;
  std::optional<Groups> groups_;
  std::optional<SpreadDisplacement> spread_;
  std::optional<StepContact> contact_;
  std::vector<certificates::PairKey> excluded_pairs_;  ///< features of cells that intersect in the first frame
  std::optional<NearGaps<Dim>> gaps_;
  std::optional<StepFilter<Dim>> filter_;
  std::optional<SequenceVerifier> verifier_;        ///< of the new frames
  std::optional<SequenceVerifier> fixed_verifier_;  ///< of what moves as given
  std::optional<RepairedRun> run_;
};

/// Looks at all frames, and reads those of the first step. False if it was stopped.
bool look_at_all(const RepairRequest& request, FrameSource& source, FrameSequence& sequence, RepairOutcome& outcome) {
  try {
    const std::size_t count = source.count().value_or(0);
    for (std::size_t k = 0; k < count; ++k) {
      source.look_at(k);
      if (request.progress) request.progress("look", static_cast<double>(k + 1) / static_cast<double>(count));
      if (request.stop != nullptr && request.stop->load(std::memory_order_relaxed)) throw Ended{RepairEnd::interrupted};
      if (request.deadline && std::chrono::steady_clock::now() >= *request.deadline) {
        throw Ended{RepairEnd::out_of_time};
      }
    }
    sequence.next();
    return true;
  } catch (const Ended& ended) {
    outcome.end = ended.end;
  } catch (const Stopped& stopped) {
    outcome.end = end_of(stopped);
  }
  return false;
}

template <int Dim>
void repair(const RepairRequest& request, FrameSource& source, FrameSequence& sequence, RepairOutcome& outcome) {
  Repair<Dim> work(request, source, sequence, outcome);
  try {
    work();
  } catch (const Ended& ended) {
    outcome.end = ended.end;
  } catch (const Stopped& stopped) {  // while a frame was read
    outcome.end = end_of(stopped);
  }
  work.finish();
  if (outcome.end == RepairEnd::done) verify_repaired(request, outcome);
}

}  // namespace

const char* name(RepairEnd end) {
  switch (end) {
    case RepairEnd::done: return "done";
    case RepairEnd::start_touches: return "start_touches";
    case RepairEnd::blocked: return "blocked";
    case RepairEnd::undecided: return "undecided";
    case RepairEnd::interrupted: return "interrupted";
    case RepairEnd::out_of_time: return "out_of_time";
  }
  return "";
}

RepairOutcome run_repair(const RepairRequest& request) {
  const StopOfThread stop_of_thread(request.stop);
  const Stopwatch watch;
  RepairRequest ordered = request;
  RepairOutcome outcome;
  if (request.reading.bodies.empty()) {
    OrderedFrames frames = order_frames(request.frames, request.order);
    ordered.frames = std::move(frames.frames);
    outcome.notes = std::move(frames.notes);
  }
  const std::unique_ptr<FrameSource> source = open_all_frames(ordered.frames, ordered.reading);
  FrameSequence sequence(*source);
  outcome.steps_total = sequence.step_count().value_or(0);
  outcome.frames_given = source->count().value_or(0);
  if (!look_at_all(ordered, *source, sequence, outcome)) return outcome;
  outcome.vertices = sequence.mesh().vertex_count;
  outcome.bodies = source->bodies();
  outcome.inputs = source->facts();
  outcome.dimension = ordered.dimension.value_or(in_one_plane(sequence.x_t0(), sequence.x_t1()) ? 2 : 3);
  if (outcome.dimension == 2) {
    repair<2>(ordered, *source, sequence, outcome);
  } else {
    repair<3>(ordered, *source, sequence, outcome);
  }
  outcome.seconds = watch.seconds();
  return outcome;
}

}  // namespace noli

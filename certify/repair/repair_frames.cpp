// SPDX-License-Identifier: Apache-2.0
#include <noli/repair.h>

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include <noli/errors.h>
#include <noli/sequence.h>
#include "certify/frame_files.h"
#include "certify/groups.h"
#include "certify/proofs/proof_route.h"
#include "certify/repair/step_contact.h"
#include "certify/repair/step_filter.h"
#include "certify/simulate/retries.h"
#include "certify/stopwatch.h"
#include "trajectory/cells.h"
#include "trajectory/formats/frame_names.h"
#include "trajectory/formats/frame_order.h"
#include "trajectory/formats/frame_sequence.h"
#include "trajectory/formats/frames.h"
#include "trajectory/formats/open_frames.h"
#include "trajectory/stop.h"
#include "trajectory/write_file.h"

namespace noli {
namespace {

/// Why a repair ends before its last frame.
struct Ended {
  RepairEnd end;
};

/// Where a step is cut so that straight lines between its frames touch nothing: at multiples of 2^-finest.
constexpr int finest = 20;

bool in_one_plane(std::span<const Position> a, std::span<const Position> b) {
  return all_z_equal(a) && all_z_equal(b) && (a.empty() || a[0][2] == b[0][2]);
}

template <int Dim>
class Repair {
 public:
  Repair(const RepairRequest& request, FrameSource& source, FrameSequence& sequence, RepairOutcome& outcome)
      : request_(request),
        source_(source),
        sequence_(sequence),
        outcome_(outcome),
        files_(request.pattern, request.force),
        write_(frame_writer_of(request.pattern)),
        mesh_(sequence.mesh()),
        stop_([this] { return stopped(); }) {
    for (const auto& frame : request.frames) {
      if (!files_.may_be(frame)) continue;
      throw UsageError("-o " + request.pattern + ": " + frame.string() + " is read; choose another folder or name");
    }
    if (request.points) {
      const auto loose = unreferenced_vertices(mesh_);
      mesh_.points.insert(mesh_.points.end(), loose.begin(), loose.end());
    }
    fixed_.assign(mesh_.vertex_count, 0);
    if (request.fixed_first > mesh_.vertex_count) {
      throw UsageError(
          fmt::format("--fixed-first {}: the frames have {} vertices", request.fixed_first, mesh_.vertex_count));
    }
    std::fill_n(fixed_.begin(), request.fixed_first, std::uint8_t{1});
    if (request.ignore) groups_ = read_groups(*request.ignore, mesh_.vertex_count);
    if (groups_) require_whole_cells(*request.ignore, *groups_, mesh_);
    const auto x = sequence.x_t0();
    mass_ = masses_by_size(mesh_, x);
    contact_.emplace(mesh_, x, mass_, fixed_, exclusions(),
                     StepContact::Wanted{request.thickness, request.restitution, request.friction});
    outcome.thickness = contact_->greatest_bound();
    outcome.mean_edge = noli::mean_edge(mesh_, x);
    outcome.cells = mesh_.cell_count();
    gaps_.emplace(mesh_, vectors_of<Dim>({x.begin(), x.end()}), fixed_, exclusions());
    filter_.emplace(mesh_, mass_, fixed_, *contact_, *gaps_, stop_);
    verifier_.emplace(mesh_, options(false, true));
    const Mesh fixed_part = fixed_cells();
    if (fixed_part.cell_count() > 1) fixed_verifier_.emplace(fixed_part, options(false, false));
  }

  /// Precondition: the sequence is at its first step.
  void operator()() {
    x_.assign(sequence_.x_t0().begin(), sequence_.x_t0().end());
    require_free_start();
    write(0, x_);
    do {
      end_if(stopped());
      repair_step();
      ++outcome_.steps;
      tell();
    } while (sequence_.next());
  }

  /// Whatever is written stays.
  void finish() {
    files_.finish();
    outcome_.frames = files_.count();
    outcome_.removed = files_.removed();
    write_times();
  }

  std::vector<std::filesystem::path> written() const {
    std::vector<std::filesystem::path> all;
    for (std::uint64_t i = 0; i < files_.count(); ++i) all.push_back(files_.file(i));
    return all;
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

  /// The cells that move as given.
  Mesh fixed_cells() const {
    Mesh part;
    part.vertex_count = mesh_.vertex_count;
    const auto is_fixed = [&](VertexId v) { return fixed_[v] != 0; };
    const auto take = [&](const auto& cells, auto& into) {
      for (const auto& cell : cells) {
        if (std::ranges::all_of(cell, is_fixed)) into.push_back(cell);
      }
    };
    take(mesh_.faces, part.faces);
    take(mesh_.edges, part.edges);
    std::ranges::copy_if(mesh_.points, std::back_inserter(part.points), is_fixed);
    return part;
  }

  SequenceOptions options(bool at_rest, bool first_only) const {
    SequenceOptions options;
    options.dimension = Dim;
    options.at_rest = at_rest;
    options.threads = request_.threads;
    options.first_only = first_only;
    options.max_reports = 1;
    options.exclusions = exclusions();
    options.stop = request_.stop;
    options.deadline = request_.deadline;
    return options;
  }

  void tell() const {
    if (!request_.progress || outcome_.steps_total == 0) return;
    request_.progress("repair", static_cast<double>(outcome_.steps) / static_cast<double>(outcome_.steps_total));
  }

  void require_free_start() {
    SequenceVerifier at_rest(mesh_, options(true, false));
    const StepResult found = at_rest.step(x_, x_);
    end_if(!found.complete && !found.touches());
    if (!found.touches()) return;
    RepairObstacle& obstacle = outcome_.obstacle.emplace();
    if (found.first) {
      note(found, 0, obstacle);
    } else {
      obstacle.cells = true;
      obstacle.vertices = {found.initial_reports.front().first_cell, found.initial_reports.front().second_cell};
    }
    throw Ended{RepairEnd::start_touches};
  }

  static void note(const StepResult& found, std::size_t step, RepairObstacle& obstacle) {
    obstacle.step = step;
    obstacle.time = found.first->time;
    obstacle.kind = found.first->contact.pair;
    obstacle.vertices = found.first->contact.vertices;
  }

  std::size_t number() const { return sequence_.step() + 1; }

  void repair_step() {
    y_.assign(sequence_.x_t1().begin(), sequence_.x_t1().end());
    const StepResult straight = decide(x_, y_);
    if (!straight.touches()) return accept(1, y_);
    require_room_between_fixed();
    Retries retries;
    std::optional<Retry> how = Retry{};
    while (how) {
      std::uint32_t deepest = 0;
      if (auto moved = filtered(*how)) {
        deepest = moved->deepest;
        if (append(*moved)) return;
      }
      how = retries.next(deepest);
    }
    throw Ended{RepairEnd::undecided};
  }

  /// Decides the straight lines from a to b.
  StepResult decide(const std::vector<Position>& a, const std::vector<Position>& b) {
    StepResult found = verifier_->step(a, b);
    end_if(!found.complete && !found.touches());
    return found;
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

  std::optional<FilteredStep> filtered(const Retry& how) {
    try {
      std::optional<FilteredStep> step = (*filter_)(x_, y_, how);
      if (step) keep_third(step->end);
      return step;
    } catch (const integrator::ContactLimit& limit) {
      RepairObstacle& obstacle = outcome_.obstacle.emplace();
      obstacle.step = number();
      obstacle.time = limit.time;
      obstacle.kind = limit.pair.kind;
      std::copy_n(limit.pair.vertices.begin(), limit.pair.size(), obstacle.vertices.begin());
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
    std::vector<std::pair<double, std::vector<Position>>> frames;
    std::vector<Position> from = x_;
    for (std::uint32_t at = 0, length = whole; at < whole;) {
      const double t = std::ldexp(static_cast<double>(at + length), -finest);
      std::vector<Position> to = moved.at(t);
      if (t < 1) keep_third(to);
      const StepResult found = decide(from, to);
      if (found.touches()) {
        length /= 2;
        if (length == 0) return false;
        continue;
      }
      at += length;
      frames.emplace_back(t, to);
      from = std::move(to);
      if (at % (2 * length) == 0 && length < whole) length *= 2;
    }
    note_change(moved, frames.size() - 1);
    for (auto& [t, x] : frames) accept(t, std::move(x));
    return true;
  }

  /// The frame at a time within the step has been decided.
  void accept(double t, std::vector<Position> x) {
    x_ = std::move(x);
    write(static_cast<double>(sequence_.step()) + t, x_);
  }

  void note_change(const FilteredStep& moved, std::size_t inserted) {
    RepairedStep step;
    step.step = number();
    step.inserted = inserted;
    step.deepest = moved.deepest;
    double sum = 0;
    for (std::size_t i = 0; i < y_.size(); ++i) {
      double squared = 0;
      for (std::size_t k = 0; k < 3; ++k) squared += (moved.end[i][k] - y_[i][k]) * (moved.end[i][k] - y_[i][k]);
      if (!(squared > 0)) continue;
      ++step.moved;
      sum += squared;
      if (std::sqrt(squared) <= step.largest) continue;
      step.largest = std::sqrt(squared);
      step.vertex = static_cast<VertexId>(i);
    }
    if (step.moved > 0) step.rms = std::sqrt(sum / static_cast<double>(step.moved));
    outcome_.changed.push_back(step);
  }

  /// A frame that is as given has the bytes of the given file, if that is one of its own and of the same format.
  void write(double time, const std::vector<Position>& x) {
    const auto k = static_cast<std::size_t>(time);
    const bool given = time == static_cast<double>(k) &&
                       std::ranges::equal(x, k == sequence_.step() ? sequence_.x_t0() : sequence_.x_t1());
    given_.push_back(given);
    if (given && own_file(k)) {
      files_.add_copy(time, request_.frames[k]);
      ++outcome_.copied;
    } else {
      files_.add(time, {sequence_.mesh(), x}, write_);
    }
  }

  bool own_file(std::size_t k) const {
    return source_.count() == request_.frames.size() && is_frame_name(request_.frames[k]) &&
           request_.frames[k].extension() == files_.ending();
  }

  static std::string csv_cell(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string cell = "\"";
    for (const char c : text) cell += c == '"' ? std::string("\"\"") : std::string(1, c);
    return cell + '"';
  }

  /// Next to the frames: which file is which moment.
  void write_times() {
    std::string text = "file,time,given\n";
    for (std::uint64_t i = 0; i < files_.count(); ++i) {
      const double t = files_.times()[i];
      const bool whole = t == std::floor(t);
      text += fmt::format("{},{},{}\n", csv_cell(files_.file(i).filename().string()), t,
                          whole ? csv_cell(source_.name(static_cast<std::size_t>(t))) : "");
    }
    outcome_.times = files_.folder() / "times.csv";
    write_file(outcome_.times, text);
  }

  const RepairRequest& request_;
  FrameSource& source_;
  FrameSequence& sequence_;
  RepairOutcome& outcome_;
  FrameFiles files_;
  FrameWriter write_;
  Mesh mesh_;  ///< with the points that are compared
  integrator::Stop stop_;
  std::vector<std::uint8_t> fixed_;
  std::vector<double> mass_;
  std::optional<Groups> groups_;
  std::optional<StepContact> contact_;
  std::optional<NearGaps<Dim>> gaps_;
  std::optional<StepFilter<Dim>> filter_;
  std::optional<SequenceVerifier> verifier_;        ///< of the new frames
  std::optional<SequenceVerifier> fixed_verifier_;  ///< of what moves as given
  std::vector<Position> x_, y_;                     ///< where the step begins, repaired; where it is to end, as given
  std::vector<bool> given_;                         ///< by frame that is written
};

/// What `noli verify` says of the new frames.
void verify_all(const RepairRequest& request, std::vector<std::filesystem::path> frames, RepairOutcome& outcome) {
  VerifyRequest again;
  again.frames = std::move(frames);
  again.order = FrameOrder::given;
  again.put_in_order();
  again.reading.polygons = request.reading.polygons;
  again.dimension = outcome.dimension;
  again.threads = request.threads;
  again.points = request.points;
  again.ignore = request.ignore;
  again.proof = request.proof;
  again.check = request.check;
  again.deadline = request.deadline;
  again.stop = request.stop;
  again.progress = request.progress;
  ProofRoute route(again);
  outcome.verified = run_verify(again);
  route.check(*outcome.verified);
}

template <int Dim>
void repair(const RepairRequest& request, FrameSource& source, FrameSequence& sequence, RepairOutcome& outcome) {
  Repair<Dim> work(request, source, sequence, outcome);
  try {
    work();
  } catch (const Ended& ended) {
    outcome.end = ended.end;
  } catch (const Stopped& stopped) {  // while a frame was read
    outcome.end = stopped.reason() == StopReason::out_of_time ? RepairEnd::out_of_time : RepairEnd::interrupted;
  }
  work.finish();
  if (outcome.end != RepairEnd::done) return;
  verify_all(request, work.written(), outcome);
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

std::size_t RepairOutcome::inserted() const {
  return std::accumulate(changed.begin(), changed.end(), std::size_t{0},
                         [](std::size_t sum, const RepairedStep& step) { return sum + step.inserted; });
}

RepairOutcome run_repair(const RepairRequest& given) {
  const Stopwatch watch;
  RepairRequest request = given;
  RepairOutcome outcome;
  OrderedFrames ordered = order_frames(std::move(request.frames), request.order);
  request.frames = std::move(ordered.frames);
  outcome.notes = std::move(ordered.notes);
  const std::unique_ptr<FrameSource> source = open_frames(request.frames, request.reading);
  FrameSequence sequence(*source);
  for (std::size_t k = 0; k < source->count().value_or(0); ++k) source->look_at(k);
  sequence.next();
  outcome.steps_total = sequence.step_count().value_or(0);
  outcome.frames_given = source->count().value_or(0);
  outcome.vertices = sequence.mesh().vertex_count;
  outcome.dimension = request.dimension.value_or(in_one_plane(sequence.x_t0(), sequence.x_t1()) ? 2 : 3);
  if (outcome.dimension == 2) {
    repair<2>(request, *source, sequence, outcome);
  } else {
    repair<3>(request, *source, sequence, outcome);
  }
  outcome.seconds = watch.seconds();
  return outcome;
}

}  // namespace noli

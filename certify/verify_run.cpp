// SPDX-License-Identifier: Apache-2.0
//
// run_verify() for a run: verifies the windows of a run again, from its files alone.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include <noli/errors.h>
#include <noli/sequence.h>
#include <noli/verify.h>
#include "certify/decided_steps.h"
#include "certify/not_compared.h"
#include "certify/proofs/prove_run.h"
#include "certify/proofs/trajectory_pipe.h"
#include "certify/runs/run_folder.h"
#include "certify/runs/run_log_facts.h"
#include "certify/runs/run_series_reader.h"
#include "certify/simulate/reproduced_windows.h"
#include "certify/stopwatch.h"
#include "certify/verification.h"
#include "integrator/scene/scene.h"
#include "proofs/prover/windows/window_features.h"
#include "proofs/prover/windows/window_verifier.h"
#include "trajectory/blocks/folder_lock.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/stop.h"

namespace noli {
namespace {

RunEnding ending_of(const std::filesystem::path& run, const LogFacts& log) {
  RunEnding ending;
  if (!log.going_on && !log.last_end.empty()) ending.why = log.last_end;
  ending.going_on = log.going_on;
  ending.duration = duration_of(run);
  return ending;
}

/// The total number of windows; nothing if the duration is unknown, or needs too many windows to count.
std::optional<std::uint64_t> windows_total(const RunEnding& ending, std::uint64_t there, double window) {
  const double windows = ending.duration ? integrator::windows_up_to(*ending.duration, window) : 0;
  if (!(windows > 0 && windows < 0x1p53)) return std::nullopt;
  return integrator::windows_in_all(there, ending.time, window, static_cast<std::uint64_t>(windows));
}

class RunVerification : private Verification {
 public:
  explicit RunVerification(const VerifyWork& request)
      : Verification(request),
        run_(request.frames.at(0)),
        live_(request.live),
        log_(request.only ? LogFacts() : read_log(run_)),  // whoever joins the windows compares them with the log
        reader_(open_run(run_, log_)) {
    require_can_be_asked(request, reader_);
    request.only ? look_at_some() : look_at_run();
    const Mesh& mesh = reader_.mesh();
    outcome_.dimension = static_cast<int>(reader_.header().dimension);
    outcome_.vertices = mesh.vertex_count;
    outcome_.faces = mesh.faces.size();
    outcome_.edges = mesh.edges.size();
    outcome_.points = mesh.points.size();
    outcome_.not_compared = not_compared(mesh, reader_.scene().labels, reader_.scene().exclusions, log_.names);
    outcome_.reproduced = request.reproduce;
    outcome_.only_frames = reader_.header().record == RecordMode::frames;
    outcome_.claim = claim_of_run(request, reader_.scene());
    outcome_.claim.steps = outcome_.steps_total;
    if (request.decided) request.decided->set_claim(outcome_.claim);
  }

  VerifyOutcome operator()() {
    const Stopwatch watch;
    if (!request_.only) look_at_files();  // otherwise whoever joins the windows does
    try {
      verify_windows();
    } catch (const Stopped&) {
      outcome_.complete = false;
    }
    if (request_.follow && ended_) look_at_files();  // they have grown
    conclude();
    outcome_.seconds = watch.seconds() - outcome_.read_seconds - outcome_.reproduce_seconds;
    return std::move(outcome_);
  }

 private:
  void look_at_run() {
    const RunLook look = reader_.look();
    outcome_.steps_total = look.windows;
    look_end_ = look.end.value_or(0);
    reader_.look_for_expected();
    outcome_.ending = ending_of(run_, log_);
    if (!live_) note_lost_log();
  }

  void look_at_some() {
    outcome_.steps_total = request_.only->end - request_.only->first;
    outcome_.ending.emplace();
  }

  void verify_windows() {
    if (request_.reproduce && !request_.decided) make_again();
    if (request_.only && !skip_to_first()) return;
    while (outcome_.complete) {
      auto window = read_next();
      if (window) read_to_ = window->end;
      // A stop after the last window changes nothing.
      if (!window || stopped() || !verify(*window)) break;
      const bool last = request_.only && window->index + 1 >= request_.only->end;
      if (enough() || last) break;
      if (request_.reproduce && request_.decided) before_.emplace(std::move(*window), reader_.state());
    }
  }

  /// Of some windows alone, the first of all still says how cells are grouped, and the one before them where they
  /// begin. False if it was stopped.
  bool skip_to_first() {
    const Stopwatch watch;
    const std::uint64_t first = request_.only->first;
    if (first == 0) return true;
    auto before = next_committed();
    if (before && request_.windows != nullptr) request_.windows->push_back(before->group_hash);
    if (before && !stopped()) group_cells(*before);
    if (before && first > 1) {
      reader_.skip_to(*request_.before);
      before = next_committed();
    }
    if (before && again_) again_->continue_after(*before, reader_.state());
    outcome_.read_seconds += watch.seconds();
    return before && !stopped();
  }

  void group_cells(const RunWindow& first) {
    verifier_.emplace(reader_.mesh(), first.lines ? beginning_of(*first.lines) : again_->beginning(), options());
  }

  void look_at_files() {
    const Stopwatch watch;
    try {
      outcome_.inputs = run_facts(request_.frames[0], [this] { return stopped(); });
    } catch (const Stopped&) {
      stopped();
    }
    outcome_.read_seconds += watch.seconds();
  }

  std::optional<RunWindow> read_next() {
    const Stopwatch watch;
    auto window = request_.follow ? wait_for_next() : next_of_those_there();
    outcome_.read_seconds += watch.seconds();
    return window;
  }

  /// The next window; if the run is being written, only up to its end when it was opened.
  std::optional<RunWindow> next_of_those_there() {
    const bool enough = !request_.only && live_ && reader_.windows() >= outcome_.steps_total;
    auto window = enough ? std::nullopt : next_committed();
    ended_ = !window;
    return window;
  }

  /// Checks whether the run is still being written before it reads, so that windows written just before the end are
  /// seen.
  std::optional<RunWindow> wait_for_next() {
    constexpr auto pause = std::chrono::milliseconds(50);
    while (!stopped()) {
      live_ = is_locked(run_);
      reader_.look_again();
      if (auto window = next_committed()) return window;
      if (!live_) return next_behind_the_last();
      std::this_thread::sleep_for(pause);
    }
    return std::nullopt;
  }

  /// Retries, as windows that are not committed yet may be taken back while they are read.
  std::optional<RunWindow> next_committed() {
    constexpr auto pause = std::chrono::milliseconds(20);
    for (int more = 20;; --more) {
      const std::uint64_t before = reader_.windows();
      try {
        return reader_.next_window();
      } catch (const InputError&) {
        live_ = live_ || is_locked(run_);
        if (more == 0 || !live_ || reader_.windows() != before) throw;
      }
      std::this_thread::sleep_for(pause);
      reader_.look_again();
    }
  }

  /// The next window when no process writes to the run any more; nothing if its log has no more.
  std::optional<RunWindow> next_behind_the_last() {
    log_ = read_log(run_);
    outcome_.ending = ending_of(run_, log_);
    note_lost_log();
    reader_.expect(log_.known);
    reader_.look_again();
    auto window = next_committed();
    ended_ = !window;
    return window;
  }

  /// Of a run that is being written, the log may not have its first line yet.
  void note_lost_log() {
    const auto note = note_of_lost_log(log_);
    if (note && std::ranges::find(outcome_.notes, *note) == outcome_.notes.end()) outcome_.notes.push_back(*note);
  }

  /// Builds the model of the scene, to integrate its windows again.
  void make_again() {
    again_ =
        ReproducedWindows::of(request_.frames[0], request_.scene_folder, reader_.scene(), [this] { return stopped(); });
  }

  /// Integrates the window again and gives it its world lines. False if it was stopped. What was decided elsewhere is
  /// integrated only where a contact may be listed.
  bool reproduce(RunWindow& window, const std::optional<StepResult>& decided) {
    if (!request_.reproduce || (decided && !decided->touches() && !decided->first)) return true;
    const Stopwatch watch;
    if (!again_) make_again();
    if (before_) again_->continue_after(before_->first, before_->second);
    auto lines = again_->next(window, reader_.state());
    outcome_.reproduce_seconds += watch.seconds();
    if (lines) window.lines = std::move(lines);
    return window.lines.has_value() && !stopped();
  }

  WindowOptions options() const {
    WindowOptions options;
    options.dimension = outcome_.dimension;
    options.threads = request_.threads;
    options.initial = reader_.windows() <= 1;
    options.first_only = request_.first_only;
    options.strict = request_.strict;
    options.max_reports = reports_of_step(request_);
    options.scripted = reader_.scene().labels;
    options.exclusions = &reader_.scene().exclusions;
    options.stop = request_.stop;
    options.deadline = request_.deadline;
    return options;
  }

  /// False if it was stopped before anything was decided.
  bool verify(RunWindow& window) {
    std::optional<StepResult> result;
    if (request_.decided) result = request_.decided->result(window.index, reader_.mesh(), &window);
    if (!reproduce(window, result)) return false;
    if (outcome_.steps.empty()) outcome_.claim.from = window.begin;
    outcome_.claim.to = window.end;
    if (!result) result = decide(window);
    if (request_.decisions != nullptr) request_.decisions->push_back(*result);
    if (request_.windows != nullptr) {
      if (window.index == 0) request_.windows->push_back(window.group_hash);
      request_.windows->push_back(window.group_hash);
    }
    outcome_.complete = result->complete;
    add_window(window, *result);
    if (request_.open_proof && (result->complete || result->touches()) && goes_to_proof(*result)) {
      prove(window, *result);
    }
    return true;
  }

  StepResult decide(const RunWindow& window) {
    if (!verifier_) group_cells(window);
    WindowOptions deciding = options();
    // What was found before the first window that is decided here is not known.
    deciding.after_step = outcome_.steps.empty() ? window.index > 0 : meeting_at_end_;
    deciding.progress = [this](double share) {
      const double done = static_cast<double>(outcome_.steps.size()) + share;
      tell("verify", std::min(1.0, done / static_cast<double>(std::max<std::size_t>(outcome_.steps_total, 1))));
    };
    WindowResult result = verifier_->verify(*window.lines, deciding);
    meeting_at_end_ = result.contact_count() + result.going_on > 0;
    return step_of_window(std::move(result));
  }

  void add_window(const RunWindow& window, const StepResult& result) {
    const auto listed = [&](const FeatureContact& contact, ContactKind kind, double time) {
      return listed_in_window(contact, kind, time, *window.lines, outcome_.dimension);
    };
    std::optional<ListedContact> first;
    if (result.first) first = listed(result.first->contact, result.first->kind, result.first->time);
    add(result, first, [&](const FeatureContact& contact) {
      const FirstInWindow found = ExactlyInWindow{&*window.lines, outcome_.dimension}(contact);
      return listed(found.contact, found.kind, found.lower());
    });
  }

  void prove(RunWindow& window, const StepResult& result) {
    if (witness_sought_ && request_.trajectory_pipe != nullptr) return;  // the checker reads no further
    const Stopwatch watch;
    give_lines(window);
    if (!proof_) {
      outcome_.proof_begun = true;
      proof_ = proof_of_run(request_.open_proof(outcome_.claim), reader_.scene(), outcome_.claim);
    }
    const MotionStep step{window.index, *window.lines, 0, window.group_hash};
    if (request_.decided) {
      if (!take_proof(*proof_, step, result, reader_.mesh())) refuse_window(window);
    } else if (result.touches()) {
      refute(*proof_, step, result);
    } else {
      search_proof(*proof_, step, *verifier_, options());
    }
    witness_sought_ = doubtful();
    outcome_.proof_seconds += watch.seconds();
  }

  [[noreturn]] void refuse_window(const RunWindow& window) const {
    throw InputError(trajectory_path(run_).string(), fmt::format("window {}", window.index + 1),
                     "is not what was decided; expected the same run");
  }

  /// Streams world lines that are in no file to the checker, window by window.
  void give_lines(RunWindow& window) {
    if (request_.trajectory_pipe == nullptr) return;
    request_.trajectory_pipe->drained();
    if (!lines_) {
      RunScene scene = reader_.scene();
      scene.header.record = RecordMode::full;
      lines_.emplace(request_.trajectory_pipe->sink(), scene);
    }
    lines_->append_window({window.index, *window.lines, window.velocities, window.state, {}});
    window.group_hash = lines_->open_window_hash();
    lines_->commit();
  }

  void conclude() {
    stopped();
    outcome_.steps_total = ended_ ? reader_.windows() : std::max(outcome_.steps_total, outcome_.steps.size());
    outcome_.claim.steps = outcome_.steps_total;
    outcome_.ending->time = ended_ ? read_to_ : std::max(look_end_, read_to_);
    outcome_.ending->some_ended_early =
        integrator::some_ended_early(outcome_.steps_total, outcome_.ending->time, reader_.header().window_length);
    outcome_.ending->windows_total =
        windows_total(*outcome_.ending, outcome_.steps_total, reader_.header().window_length);
    outcome_.open_window = ended_ && !live_ && reader_.open_window().has_value();
    if (live_) say_that_it_is_written();
    // A run without committed windows proves nothing.
    if (outcome_.steps.empty()) outcome_.complete = false;
    set_verdict(ended_);
    note_distance();
    list_contacts(reader_.mesh(), log_.names);
  }

  /// Notes whether the run is being written, but not if it was killed meanwhile.
  void say_that_it_is_written() {
    outcome_.ending->being_written = is_locked(run_);
    outcome_.notes.push_back(fmt::format(
        "another process writes to the run: this is about the {} windows that were committed so far{}",
        outcome_.steps_total, request_.follow || request_.decided ? "" : "; --follow waits for the others"));
  }

  const std::filesystem::path& run_;
  bool live_;  ///< another process writes to it
  LogFacts log_;
  SeriesReader reader_;
  std::optional<WindowVerifier> verifier_;  ///< made from the first positions of the run
  std::unique_ptr<StepProofs> proof_;
  std::unique_ptr<ReproducedWindows> again_;                 ///< with --reproduce
  std::optional<std::pair<RunWindow, WindowState>> before_;  ///< with `decided`: the window before, as again_ needs it
  std::optional<RunWriter> lines_;                           ///< of the run as if it were recorded in full
  bool witness_sought_ = false;
  bool meeting_at_end_ = false;        ///< something met in the window before
  bool ended_ = false;                 ///< all windows have been read
  double look_end_ = 0, read_to_ = 0;  ///< ends of the last window by a quick look, and of the last window read [s]
};

}  // namespace

Claim claim_of_run(const VerifyRequest& request, const RunScene& scene) {
  Claim claim;
  claim.motion = "run";
  claim.dimension = static_cast<int>(scene.header.dimension);
  claim.strict = request.strict;
  claim.distance = request.min_distance;
  claim.ring = request.ring;
  set_cells_of_run(claim, scene);
  return claim;
}

void require_can_be_asked(const VerifyRequest& request, const RunReader& run) {
  const std::string name = request.frames.at(0).string();
  if (request.constant_motion || request.merge_identical || request.points || request.dimension || request.ignore ||
      request.only_new) {
    throw UsageError(
        "--static, --merge-identical, --points, --dimension, --ignore, --only-new: apply to frames only; drop them for "
        "a run");
  }
  if (run.header().record == RecordMode::frames && !request.reproduce) {
    throw InputError(
        name, "",
        "only frames were recorded (\"record\": \"frames\"); expected world lines, which are what can be verified: "
        "pass --reproduce to integrate the windows again, or put \"record\": \"full\" into the scene and run `noli "
        "simulate SCENE.json -o RUN`");
  }
  if (run.mesh().cell_count() == 0) {
    throw InputError(name, "", "the run has no cells; expected something that can touch");
  }
}

VerifyOutcome verify_run(const VerifyWork& request) { return RunVerification(request)(); }

}  // namespace noli

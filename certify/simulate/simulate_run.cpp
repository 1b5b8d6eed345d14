// SPDX-License-Identifier: Apache-2.0
#include <noli/simulate.h>

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <future>
#include <memory>
#include <new>
#include <stdexcept>
#include <system_error>

#include <noli/errors.h>
#include "certify/body_names.h"
#include "certify/contact_report.h"
#include "certify/listed_contacts.h"
#include "certify/not_compared.h"
#include "certify/proofs/prove_run.h"
#include "certify/runs/frame_times.h"
#include "certify/runs/run_folder.h"
#include "certify/runs/run_series.h"
#include "certify/runs/run_series_file.h"
#include "certify/runs/run_series_reader.h"
#include "certify/runs/series_process.h"
#include "certify/simulate/energy_watch.h"
#include "certify/simulate/exact_gap.h"
#include "certify/simulate/model_facts.h"
#include "certify/simulate/phase_clock.h"
#include "certify/simulate/retries.h"
#include "certify/simulate/run_extent.h"
#include "certify/simulate/run_space.h"
#include "certify/simulate/start_check.h"
#include "certify/simulate/window_integrator.h"
#include "certify/stopwatch.h"
#include "certify/verification.h"
#include "integrator/scene/build_model.h"
#include "integrator/scene/explain.h"
#include "integrator/scene/read_scene.h"
#include "integrator/scene/scene.h"
#include "kernel/parallel.h"
#include "proofs/prover/windows/window_verifier.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/sample.h"
#include "trajectory/stop.h"

namespace noli {

namespace {

using integrator::Phase;
using integrator::PhaseScope;
using integrator::Snapshot;

/// A window that waits for its verdict.
template <int Dim>
struct Candidate : IntegratedWindow<Dim> {
  std::future<WindowResult> verdict;
};

/// The parts of a scene that the run's files contain.
template <int Dim>
RunScene run_scene(const integrator::Scene& scene, const integrator::Model<double, Dim>& model) {
  const RecordMode record = scene.record == integrator::Record::full ? RecordMode::full : RecordMode::frames;
  return {{Dim, record, scene.window}, model.mesh, labels_of<Dim>(model), exclusions_of<Dim>(model)};
}

template <int Dim>
class CertifiedRun {
 public:
  CertifiedRun(const SimulateRequest& request, const integrator::Scene& scene)
      : request_(request),
        built_(integrator::build_model<Dim>(scene)),
        names_(names_of(built_.bodies)),
        scene_(run_scene<Dim>(scene, built_.model)),
        verifier_(built_.model.mesh, positions_of<Dim>(built_.model.x), window_options()),
        folder_(request.run),
        frame_rate_(scene.frame_rate),
        integrator_(built_.model, scene_.labels, activity_),
        watch_(kinetic_energy<Dim>(built_.model), energy_of_rounding<Dim>(built_.model), !scene.allow_unstable) {
    folder_.lock();
    outcome_.title = scene.title;
    outcome_.dimension = Dim;
    outcome_.vertices = built_.model.x.size();
    outcome_.cells = built_.model.mesh.cell_count();
    outcome_.allow_unstable = scene.allow_unstable;
    outcome_.window_length = scene.window;
    outcome_.not_compared = not_compared(scene_.mesh, scene_.labels, scene_.exclusions, names_);
    windows_asked_ = windows_of(request, scene);
    end_ = static_cast<double>(windows_asked_) * scene.window;
    require_cells();
    require_countable_frames(request, scene, outcome_.vertices, windows_asked_);
    refuse_contact_at_start();
    const integrator::Explanation explanation = integrator::explain(scene);
    const std::string space = require_space(scene, explanation);
    open(scene);
    if (request.begins) request.begins({has_short_form(scene), notes(explanation), space});
  }

  SimulateOutcome operator()() {
    const Stopwatch watch;
    PhaseClock clock(activity_);
    bool goes_on = true;
    while (goes_on && !stopped()) goes_on = with_memory([this] { return run_window(); });
    with_memory([this] { return settle() == Settled::yes; });
    // A stop after everything was done does not count.
    if (outcome_.time == end_ && stopped_from_outside()) outcome_.end = RunEnd::done;
    find_end();
    conclude(clock);
    outcome_.proved = proof_ != nullptr && outcome_.windows > 0;
    outcome_.seconds = watch.seconds();
    return std::move(outcome_);
  }

 private:
  void tell(std::string_view work, double share) const {
    if (request_.progress) request_.progress(work, share);
  }

  int stops() const { return request_.stops ? request_.stops() : 0; }

  void require_cells() const {
    if (outcome_.cells > 0) return;
    throw InputError(request_.scene.string(), "/bodies",
                     "expected a mesh with faces, edges or points; what has none of them touches nothing");
  }

  bool stopped() {
    const bool asked = request_.stop != nullptr && request_.stop->load(std::memory_order_relaxed);
    if (asked || stop_asked() == StopReason::interrupted) outcome_.end = RunEnd::interrupted;
    const bool late = request_.deadline && std::chrono::steady_clock::now() >= *request_.deadline;
    if (late || stop_asked() == StopReason::out_of_time) outcome_.end = RunEnd::out_of_time;
    return outcome_.end != RunEnd::done;
  }

  bool stopped_from_outside() const {
    return outcome_.end == RunEnd::interrupted || outcome_.end == RunEnd::out_of_time;
  }

  // --- Beginning -----------------------------------------------------------------------------------------------------

  WindowOptions window_options() const {
    WindowOptions options;
    options.dimension = Dim;
    options.threads = request_.threads;
    options.initial = false;
    options.scripted = scene_.labels;
    options.exclusions = &scene_.exclusions;
    options.stop = request_.stop;
    options.deadline = request_.deadline;
    return options;
  }

  /// A run that is resumed may have no window yet.
  void refuse_contact_at_start() const {
    const std::string found =
        contact_at_start(verifier_, built_.model.mesh, positions_of<Dim>(built_.model.x), window_options(), names_);
    if (!found.empty()) throw InputError(request_.scene.string(), "/bodies", "the scene begins in contact: " + found);
    end_if_stopped();
  }

  /// Returns a note on the bytes to come. Throws WriteError, before anything is written, when the disk is too small.
  std::string require_space(const integrator::Scene& scene, const integrator::Explanation& explanation) const {
    const RunToCome run = to_come();
    const RunBytes bytes = bytes_to_come(scene, explanation, run);
    std::optional<std::uint64_t> free = free_bytes(run.run);
    if (free && request_.force) *free += bytes_in(run.run);  // the old files are removed first
    const auto problem = space_problem(bytes, run.run, free);
    if (problem && !request_.ignore_space) throw WriteError(*problem);
    return space_note(bytes, run.run, free);
  }

  RunToCome to_come() const {
    RunToCome run;
    run.run = folder_.path();
    run.vertices = outcome_.vertices;
    run.cells = outcome_.cells;
    run.windows = windows_asked_;
    run.time = end_;
    run.prove = request_.prove;
    run.series = series_program().available();
    const bool there = std::filesystem::exists(trajectory_path(run.run));
    if (!request_.resume || !there || !folder_.has_begun()) return run;
    const RunLook look = RunReader(run.run).look();
    run.windows_there = look.windows;
    run.time_there = look.end.value_or(0);
    std::error_code error;
    run.bytes_there = std::filesystem::file_size(trajectory_path(run.run));
    const auto proof = std::filesystem::file_size(proof_path(run.run), error);
    if (!error) run.bytes_there += proof;
    return run;
  }

  /// Facts about the scene for the log, for readers of the run that do not have the scene.
  Json facts() const {
    Json json = {{"bodies", names_.to_json()}};
    if (built_.model.contact) json["contact"] = contact_json(*built_.model.contact, built_.contact);
    return json;
  }

  /// World lines are recorded, and proofs written.
  bool full() const { return scene_.header.record == RecordMode::full; }

  CommittedWindows committed() const { return {writer_->windows(), writer_->running_hash()}; }

  void open(const integrator::Scene& scene) {
    folder_.lock();  // another process may have made it since
    const bool go_on = request_.resume && folder_.has_begun();
    if (!go_on) {
      integrator_.begin();  // if it is stopped, nothing is written
      folder_.make(request_.force || request_.resume);
      writer_.emplace(folder_.path(), scene_);
      folder_.begin(scene.document, hash_of<Dim>(built_.model), facts());
      if (full() && request_.prove) {
        proof_ = proof_of_run(std::make_unique<FileSink>(proof_path(folder_.path()), FileSink::Open::create), scene_);
      }
      return;
    }
    const KnownWindows known = folder_.go_on(scene.document, hash_of<Dim>(built_.model));
    SeriesReader reader(folder_.path());
    reader.expect(known);
    if (reader.scene() != scene_) {
      throw InputError(folder_.path().string(), "", "holds a run of another scene; expected one of this scene");
    }
    Snapshot<double, Dim> last;
    double energy = 0;
    while (const auto window = reader.next_window()) {
      const SeriesRow& row = reader.row();
      last = snapshot_of<Dim>(*window, reader.state());
      retries_ = Retries(row.halvings);
      watch_.add(row);
      energy = row.energy();
      if (stopped()) throw ReadInterrupted(folder_.path().string());
    }
    if (last.time > end_) {
      throw InputError(folder_.path().string(), "",
                       fmt::format("reaches {} s, but the windows asked for end at {} s; expected a later end "
                                   "time",
                                   last.time, end_));
    }
    writer_.emplace(folder_.path(), reader);
    folder_.resumed(committed(), facts());
    const bool proved = std::filesystem::exists(proof_path(folder_.path())) || last.windows == 0;
    if (full() && request_.prove && proved) {
      try {
        proof_ = resumed_proof_of_run(folder_.path(), last.windows, scene_, verifier_, window_options());
      } catch (const NoProof& none) {
        outcome_.no_proof = none.what();  // the proof had already ended earlier
      }
    }
    outcome_.windows_before = last.windows;
    outcome_.time = last.time;
    integrator_.go_on(last, energy, {0, retries_.halvings()});
  }

  // --- Windows -------------------------------------------------------------------------------------------------------

  /// Integrates a window while the one before it is verified. False at the end of the run.
  bool run_window() {
    std::optional<Candidate<Dim>> next;
    if (integrator_.time() < end_) next = integrate();
    if (settle() == Settled::rolled_back) return true;
    if (outcome_.end != RunEnd::done || !next) return false;
    verify(std::move(*next));
    tell("simulate", outcome_.time / end_);
    return true;
  }

  /// Returns the result of `work`. If memory runs out anywhere in it, the run ends after its last committed window.
  /// Frees what takes most of the memory, so that the run can report it.
  template <class Work>
  bool with_memory(Work&& work) {
    try {
      return work();
    } catch (const std::bad_alloc&) {
      outcome_.end = RunEnd::out_of_memory;
      integrator_.end();
      if (candidate_ && !candidate_->verdict.valid()) candidate_.reset();  // it was still being written
      if (!candidate_) writer_->discard_window();
      return false;
    }
  }

  std::optional<Candidate<Dim>> integrate() {
    const Stopwatch watch;
    std::optional<IntegratedWindow<Dim>> next = integrator_.next([this] { return stopped(); });
    if (!next) return std::nullopt;
    outcome_.simulating_seconds += watch.seconds();
    return Candidate<Dim>{std::move(*next), {}};
  }

  /// Writes the window before its verdict, because its proof names the hash of what was written. It is committed only
  /// after the verdict.
  void verify(Candidate<Dim> next) {
    candidate_ = std::move(next);
    write(*candidate_);
    const auto look = [lines = candidate_->lines.get(), index = candidate_->index, options = window_options(), this] {
      const Stopwatch watch;
      WindowResult result = verifier_.verify(*lines, options);
      if (proof_ && result.complete && result.contact_count() == 0) {
        result.complete = prove(index, *lines);
      }
      outcome_.verifying_seconds += watch.seconds();
      return result;
    };
    const bool aside = (request_.threads == 0 ? hardware_threads() : request_.threads) > 1;
    try {
      candidate_->verdict = std::async(aside ? std::launch::async : std::launch::deferred, look);
    } catch (const std::system_error&) {  // no memory for another thread
      candidate_->verdict = std::async(std::launch::deferred, look);
    }
  }

  /// A window without contact counts even if no proof of it is found. The proof of the run then ends before it, and no
  /// checker accepts that as a proof of the whole run. False if it was stopped.
  bool prove(std::uint64_t index, const WorldLines& lines) {
    try {
      return proof_->prove({index, lines, 0, writer_->open_window_hash()}, verifier_, window_options());
    } catch (const NoProof& none) {
      folder_.log({{"event", "no_proof"}, {"window", index}, {"why", none.what()}});
      outcome_.no_proof = fmt::format("window {}: {}", index + 1, none.what());
      proof_.reset();
      return true;
    }
  }

  enum class Settled { yes, rolled_back };

  /// Waits for the verdict on the window that is being verified. Then commits it, goes back to its beginning, or ends
  /// the run.
  Settled settle() {
    if (!candidate_) return Settled::yes;
    Candidate<Dim> window = std::move(*candidate_);
    candidate_.reset();
    WindowResult result = verdict_of(window);
    if (!result.complete || result.contact_count() > 0) writer_->discard_window();
    if (!result.complete) {
      if (!stopped()) throw std::logic_error("a window was not verified to its end");
      return Settled::yes;
    }
    if (result.contact_count() == 0) {
      commit(window);
      return Settled::yes;
    }
    if (roll_back(window, result)) return Settled::rolled_back;
    outcome_.end = RunEnd::contact;
    if (result.first) {
      outcome_.first_names = names_.pair(result.first->contact.pair, result.first->contact.vertices, "meets");
      std::array first = {&outcome_.first.emplace(
          listed_in_window(result.first->contact, result.first->kind, result.first->lower(), *window.lines, Dim))};
      name_owners(built_.model.mesh, names_, first);
    }
    outcome_.contact = step_of_window(std::move(result));
    return Settled::yes;
  }

  /// Runs a window with a contact again: with more layers from the start, in case certificates missed one, then with
  /// all layers' steps halved from here on. False after the last try.
  bool roll_back(const Candidate<Dim>& window, const WindowResult& result) {
    if (!built_.model.contact || outcome_.end != RunEnd::done) return false;
    const std::optional<Retry> retry = retries_.next(integrator_.deepest());
    if (!retry) return false;
    ++outcome_.roll_backs;
    Json entry = {{"event", "roll_back"}, {"window", window.index}, {"try", retries_.tries()}};
    entry["least_layers"] = retry->least_layers;
    entry["step_halvings"] = retry->halvings;
    if (result.first) {
      entry["first"] = contact_json(result.first->contact);
      entry["first_time"] = result.first->lower();
    }
    folder_.log(entry);
    try {
      integrator_.go_back(window, *retry);
    } catch (const Stopped&) {
      stopped();
    }
    return true;
  }

  WindowResult verdict_of(Candidate<Dim>& window) {
    const PhaseScope proving(activity_, Phase::proof);
    return window.verdict.get();
  }

  void write(const Candidate<Dim>& window) {
    const PhaseScope writing(activity_, Phase::writing);
    const std::vector<RunFrame> frames = frames_of(window);
    writer_->append_window(
        {window.index, *window.lines, window.velocities, encode(window.row, window.anchors), frames});
  }

  void commit(const Candidate<Dim>& window) {
    const PhaseScope writing(activity_, Phase::writing);
    if (proof_) proof_->commit();
    writer_->commit();
    outcome_.events += window.row.events_in_all();
    outcome_.breakpoints += window.row.breakpoints;
    outcome_.time = window.row.time;
    watch_.add(window.row);
    folder_.log(committed(), window.row, window.deepest);
    if (retries_.committed()) ++outcome_.certificate_defects;
    if (request_.keep_going && !request_.keep_going(window.row)) outcome_.end = RunEnd::interrupted;
  }

  /// With "record": "frames", the frames within the window.
  std::vector<RunFrame> frames_of(const Candidate<Dim>& window) const {
    std::vector<RunFrame> frames;
    if (full()) return frames;
    const WorldLines& lines = *window.lines;
    for_each_frame_time(window.index, lines.first_time(), lines.last_time(), frame_rate_, [&](double t) {
      frames.push_back({t, sample(lines, t)});
      return true;
    });
    return frames;
  }

  /// Finds why the next window was not completed, unless it was stopped from outside.
  void find_end() {
    if (outcome_.end != RunEnd::done) return;
    if (const auto& limit = integrator_.limit()) {
      outcome_.end = RunEnd::too_near;
      outcome_.limit = PairTooNear{limit->pair.kind, limit->pair.vertices, limit->time};
      if (integrator_.in_first_window()) outcome_.start_gap = start_gap(limit->pair);
      outcome_.first_names = names_.pair(limit->pair.kind, limit->pair.vertices, "and");
    } else if (!integrator_.finite()) {
      outcome_.not_finite = integrator_.find_not_finite([this] { return stopped(); });
      if (outcome_.not_finite) outcome_.end = RunEnd::not_finite;
    } else if (watch_.astray()) {
      outcome_.energy_astray = watch_.astray();
      outcome_.end = RunEnd::unstable;
    }
  }

  std::optional<StartGap> start_gap(const certificates::Stencil& pair) const {
    const integrator::ContactSettings& settings = *built_.model.contact;
    const std::span<const VertexId> all(pair.vertices.data(), pair.size());
    const auto& material = settings.materials[settings.material(all.first(pair.first()), all.subspan(pair.first()))];
    const std::vector<Position> x = positions_of<Dim>(built_.model.x);
    const double gap = exact_gap(WorldLines::from_frames(x, x), Dim, pair.kind, pair.vertices).up_to;
    if (gap >= material.thickness) return std::nullopt;
    return StartGap{gap, material.thickness, layer_thickness(material, settings.schedule, settings.most_layers)};
  }

  void conclude(PhaseClock& clock) {
    outcome_.windows = writer_->windows();
    outcome_.some_ended_early = integrator::some_ended_early(outcome_.windows, outcome_.time, outcome_.window_length);
    outcome_.windows_total =
        integrator::windows_in_all(outcome_.windows, outcome_.time, outcome_.window_length, windows_asked_).value();
    outcome_.certificates = integrator_.certificates();
    outcome_.integration = watch_.integration();
    const std::exception_ptr lost = write_series();
    outcome_.phases = clock.seconds();
    log_end();
    if (lost) std::rethrow_exception(lost);
  }

  /// The first Ctrl-C still writes series.h5; a second one skips it, and `--resume` writes it. Returns an error instead
  /// of throwing it, as the run has ended in any case.
  std::exception_ptr write_series() {
    const PhaseScope writing(activity_, Phase::writing);
    const int before = stops();
    tell("series.h5", 0);
    try {
      outcome_.series = write_series_file(folder_.path(), frame_rate_, [this, before] { return stops() > before; });
    } catch (const std::exception&) {
      outcome_.series = SeriesEnd::failed;
      return std::current_exception();
    }
    return nullptr;
  }

  void log_end() {
    Json entry = {{"event", "end"}, {"end", name(outcome_.end)}};
    committed().tell(entry);
    entry["series"] = name(outcome_.series);
    if (outcome_.series == SeriesEnd::written) entry["series_sha256"] = hex(folder_.keep_series());
    if (outcome_.contact && outcome_.contact->first) {
      entry["first"] = contact_json(outcome_.contact->first->contact);
      entry["first"]["kind"] = noli::name(outcome_.contact->first->kind);
      entry["first_time"] = outcome_.contact->first->time;
    }
    if (outcome_.limit) entry["too_near"] = {{"time", outcome_.limit->time}, {"names", outcome_.first_names}};
    if (outcome_.energy_astray) entry["energy"] = energy_json(*outcome_.energy_astray);
    if (built_.model.contact) entry["roll_backs"] = outcome_.roll_backs;
    entry["timing"] = {{"verifying_seconds", outcome_.verifying_seconds},
                       {"phases", phases_json(outcome_.phases)},
                       {"certificates", certificates_json(outcome_.certificates)}};
    folder_.log(entry);
  }

  const SimulateRequest& request_;
  integrator::BuiltScene<Dim> built_;
  BodyNames names_;
  RunScene scene_;
  WindowVerifier verifier_;
  RunFolder folder_;
  double frame_rate_;
  std::uint64_t windows_asked_ = 0;  ///< the number of windows if none ends early
  double end_ = 0;                   ///< of the last one [s]
  std::optional<RunWriter> writer_;
  std::unique_ptr<StepProofs> proof_;  ///< with record full
  integrator::Activity activity_;
  WindowIntegrator<Dim> integrator_;
  EnergyWatch watch_;
  Retries retries_;  ///< of the next window to be committed
  SimulateOutcome outcome_;
  std::optional<Candidate<Dim>> candidate_;  ///< last member: the thread of its verdict uses all of the others
};

/// The outcome of a run that was stopped before its first window, while its model was built.
SimulateOutcome stopped_early(const SimulateRequest& request, const integrator::Scene& scene, StopReason reason) {
  SimulateOutcome outcome;
  outcome.end = reason == StopReason::interrupted ? RunEnd::interrupted : RunEnd::out_of_time;
  outcome.begun = false;
  outcome.title = scene.title;
  outcome.dimension = scene.dimension;
  outcome.window_length = scene.window;
  outcome.windows_total = windows_of(request, scene);
  return outcome;
}

template <int Dim>
SimulateOutcome run_in(const SimulateRequest& request, const integrator::Scene& scene) {
  std::optional<CertifiedRun<Dim>> run;
  try {
    run.emplace(request, scene);
  } catch (const Stopped& stop) {
    if (request.resume) throw;  // the existing part of the run is unknown
    return stopped_early(request, scene, stop.reason());
  }
  return (*run)();
}

}  // namespace

const char* name(RunEnd end) {
  switch (end) {
    case RunEnd::done: return "done";
    case RunEnd::contact: return "contact";
    case RunEnd::too_near: return "too_near";
    case RunEnd::not_finite: return "not_finite";
    case RunEnd::unstable: return "unstable";
    case RunEnd::interrupted: return "interrupted";
    case RunEnd::out_of_time: return "time_limit";
    case RunEnd::out_of_memory: return "out_of_memory";
  }
  return "";
}

SimulateOutcome run_simulate(const SimulateRequest& request) {
  const StopOfThread stop_of_thread(request.stop);
  const auto form = request.brief ? integrator::Form::brief : integrator::Form::full;
  const integrator::Scene scene = integrator::read_scene(request.scene, form);
  return scene.dimension == 2 ? run_in<2>(request, scene) : run_in<3>(request, scene);
}

}  // namespace noli

// SPDX-License-Identifier: Apache-2.0
//
// run_verify() for frames: reads them, decides each step between them, and proves it where that is asked.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <noli/errors.h>
#include <noli/sequence.h>
#include <noli/verify.h>
#include "certify/decided_steps.h"
#include "certify/groups.h"
#include "certify/process/hdf5_frames.h"
#include "certify/proofs/prove_frames.h"
#include "certify/proofs/trajectory_pipe.h"
#include "certify/step_parts.h"
#include "certify/stopwatch.h"
#include "certify/verification.h"
#include "proofs/prover/chain.h"
#include "trajectory/blocks/frames_file.h"
#include "trajectory/cells.h"
#include "trajectory/formats/frame_order.h"
#include "trajectory/formats/frame_sequence.h"
#include "trajectory/formats/frames.h"
#include "trajectory/merge.h"
#include "trajectory/replaced_file.h"
#include "trajectory/sample.h"
#include "trajectory/stop.h"

namespace noli {
namespace {

/// With one thread, there is no other to read.
FrameReading reading_of(const VerifyRequest& request) {
  FrameReading reading = request.reading;
  reading.ahead = request.threads != 1;
  return reading;
}

Motion motion_of(const VerifyRequest& request) { return request.constant_motion ? Motion::constant : Motion::linear; }

/// Reports a missing frame before the work begins, not an hour later. Opens nothing: that would wait for the writer of
/// a pipe, and take its only reader away from it.
void require_readable(const std::vector<std::filesystem::path>& paths) {
  for (const auto& path : paths) {
    if (path == "-") continue;
    std::error_code error;
    if (std::filesystem::is_directory(path, error) || ::access(path.c_str(), R_OK) != 0) {
      throw InputError(path.string(), "", "cannot be opened; expected a file of frames");
    }
  }
}

/// The file of --trajectory. Until all frames are in it, it has another name, so that no checker takes a part for the
/// whole.
class TrajectoryFile {
 public:
  TrajectoryFile(const std::filesystem::path& file, const Mesh& mesh)
      : file_(file, {.name = ScratchName::random}),
        writer_(std::make_unique<FileSink>(file_.path(), FileSink::Open::create), mesh) {}

  FramesWriter& writer() { return writer_; }
  /// Throws std::system_error.
  void finish() {
    writer_.finish();
    file_.take_name();
    finished_ = true;
  }
  bool finished() const { return finished_; }

 private:
  ReplacedFile file_;
  FramesWriter writer_;
  bool finished_ = false;
};

class SequenceVerification : private Verification {
 public:
  explicit SequenceVerification(const VerifyWork& request)
      : Verification(request),
        source_(open_all_frames(request.frames, reading_of(request))),
        sequence_(*source_, motion_of(request)) {
    if (!request.reading.given) require_readable(request.frames);
    if (request.merge_identical && !source_->can_begin_again()) {
      throw UsageError(
          "--merge-identical: reads frames twice; expected files or arrays, found a pipe, a generator or standard "
          "input");
    }
    outcome_.steps_total = sequence_.step_count().value_or(0);
  }

  VerifyOutcome operator()() {
    const Stopwatch watch;
    look_at_all();
    try {
      verify_steps();
    } catch (const Stopped&) {
      outcome_.complete = false;
    }
    conclude();
    outcome_.seconds = watch.seconds() - outcome_.read_seconds;
    return std::move(outcome_);
  }

 private:
  void verify_steps() {
    if (request_.merge_identical) find_classes();
    if (request_.only) skip_to_first();
    while (!stopped() && outcome_.complete) {
      if (!add_untouched_steps() || !read_next(sequence_)) {
        ended_ = outcome_.complete && !stopped();
        break;
      }
      if (sequence_.step() == 0) begin();
      if (stopped()) outcome_.complete = false;  // in the first step, the claim may not be known then
      if (!outcome_.complete) break;
      require_plane();
      write_frames();
      verify();
      if (enough() || (request_.only && sequence_.step() + 1 >= request_.only->end)) break;
    }
    write_other_frames();
  }

  /// Of some steps alone, the first frames still say what all steps are about.
  void skip_to_first() {
    if (request_.only->first == 0 || stopped() || !read_next(sequence_)) return;
    begin();
    if (stopped()) outcome_.complete = false;
    if (outcome_.complete) skip_to(request_.only->first);
  }

  void skip_to(std::size_t step) {
    const Stopwatch watch;
    sequence_.skip_to(step);
    outcome_.read_seconds += watch.seconds();
  }

  /// Adds the steps that come next, were decided elsewhere, and need no frames: no proof, no --trajectory, no contacts
  /// to list. The first step is never among them, as its frames say what all steps are about. Returns whether another
  /// step follows for which frames are to be read.
  bool add_untouched_steps() {
    const bool needs_frames = request_.open_proof || request_.trajectory || outcome_.steps.empty();
    if (!request_.decided || needs_frames || !source_->may_skip()) return !stopped();
    for (std::size_t step = outcome_.steps.size(); step < outcome_.steps_total && !stopped(); ++step) {
      StepResult result = request_.decided->result(step, verifier_->mesh(), nullptr);
      if (!result.complete || result.first || result.touches()) {
        decided_ = std::move(result);
        break;
      }
      if (result.rests) note_rest(step);
      add(result, std::nullopt, [this](const FeatureContact& contact) { return exactly(contact); });
      tell("verify", static_cast<double>(step + 1) / static_cast<double>(outcome_.steps_total));
    }
    if (stopped() || outcome_.steps.size() == outcome_.steps_total) return false;
    skip_to(outcome_.steps.size());
    return true;
  }

  /// Whatever the verdict, the file of --trajectory has all frames.
  void write_other_frames() {
    if (!request_.trajectory) return;
    while (!stopped() && read_next(sequence_)) write_frames();
    if (!trajectory_ || stopped()) return;
    trajectory_->finish();
  }

  /// Those that were read for this step.
  void append_frames(FramesWriter& writer) const {
    const bool both = sequence_.step() == 0 && !request_.constant_motion;
    if (both) writer.append(sequence_.x_t0());
    writer.append(sequence_.x_t1());
  }

  void write_frames() {
    if (!request_.trajectory) return;
    if (!trajectory_) trajectory_.emplace(*request_.trajectory, sequence_.mesh());
    append_frames(trajectory_->writer());
  }

  /// To a checker that reads them on their way. It reads those of a step when the proof comes to it.
  void give_frames() {
    TrajectoryPipe* const pipe = request_.trajectory_pipe;
    const bool wanted = !doubtful() && !outcome_.no_proof && (proof_ || sequence_.step() == 0);
    if (pipe == nullptr || !wanted) return;
    if (given_) pipe->drained();
    if (!given_) given_.emplace(pipe->sink(), sequence_.mesh());
    append_frames(*given_);
  }

  /// Reports a frame with another mesh before the first step is decided.
  void look_at_all() {
    const Stopwatch watch;
    try {
      const std::size_t count = source_->count().value_or(0);
      for (std::size_t k = 0; k < count && !stopped(); ++k) {
        if (is_read(k)) source_->look_at(k);
        tell("look", static_cast<double>(k + 1) / static_cast<double>(count));
      }
      if (request_.decided) request_.decided->set_inputs(source_->facts());
    } catch (const Stopped&) {
      stopped();
    }
    outcome_.read_seconds += watch.seconds();
  }

  bool is_read(std::size_t frame) const {
    const auto& only = request_.only;
    return !only || frame < 2 || (only->first <= frame && frame <= only->end);
  }

  /// Whether there was another step; false if the user stopped the reading.
  bool read_next(FrameSequence& sequence) {
    const Stopwatch watch;
    bool read = false;
    try {
      read = sequence.next();
    } catch (const Stopped&) {
      outcome_.complete = false;
      stopped();
    }
    outcome_.read_seconds += watch.seconds();
    return read;
  }

  /// The first pass of --merge-identical.
  void find_classes() {
    FrameSequence frames(*source_, Motion::constant);
    while (!stopped() && read_next(frames)) {
      if (!classes_) classes_.emplace(frames.mesh().vertex_count);
      classes_->refine(frames.x_t0());
    }
  }

  /// Sets up what the first step decides for all steps.
  void begin() {
    Mesh mesh = sequence_.mesh();
    const auto unreferenced = unreferenced_vertices(mesh);
    if (request_.points) {
      mesh.points.insert(mesh.points.end(), unreferenced.begin(), unreferenced.end());
    } else {
      outcome_.unreferenced_vertices = unreferenced.size();
    }
    if (classes_) {
      mesh = with_merged_vertices(mesh, *classes_);
      outcome_.merged_vertices = classes_->merged_count();
    }
    if (mesh.cell_count() == 0) {
      throw InputError(sequence_.name_t0(), "",
                       "no faces, edges or points; expected something that can touch (see --points)");
    }
    outcome_.dimension = request_.dimension.value_or(in_one_plane(sequence_.x_t0(), sequence_.x_t1()) ? 2 : 3);
    if (request_.ignore) leave_out(*request_.ignore, mesh);
    outcome_.vertices = mesh.vertex_count;
    outcome_.faces = mesh.faces.size();
    outcome_.edges = mesh.edges.size();
    outcome_.points = mesh.points.size();
    verifier_.emplace(std::move(mesh), options());
    if (request_.only_new && !find_baseline()) return;
    labels_ = labels_of_frames(verifier_->mesh(), exclusions(), outcome_.baseline);
    outcome_.claim = claim_of_frames(request_, outcome_, verifier_->mesh(), labels_);
    if (request_.decided) request_.decided->set_claim(outcome_.claim);
  }

  /// False if it was stopped: what was found is then not all.
  bool find_baseline() {
    try {
      const auto& pairs = verifier_->baseline(sequence_.x_t0());
      if (stopped()) return false;
      outcome_.baseline = pairs;
    } catch (const std::length_error& error) {
      throw InputError(sequence_.name_t0(), "", std::string("--only-new: ") + error.what());
    }
    outcome_.not_compared.baseline = outcome_.baseline.size();
    return true;
  }

  /// Reads the pairs of groups that are not compared.
  void leave_out(const std::filesystem::path& file, const Mesh& mesh) {
    groups_ = read_groups(file, mesh.vertex_count, names_of_frames(source_->bodies()));
    for (VertexId v = 0; classes_ && v < mesh.vertex_count; ++v) {
      const VertexId same = classes_->representative()[v];
      if (groups_->exclusions.groups[v] == groups_->exclusions.groups[same]) continue;
      throw InputError(file.string(), "",
                       fmt::format("vertices {} and {} are merged; expected them in one group", same, v));
    }
    require_whole_cells(file, *groups_, mesh);
    for (const auto& [a, b] : groups_->exclusions.pairs) {
      outcome_.not_compared.excluded.push_back({groups_->names[a], groups_->names[b]});
    }
  }

  void require_plane() const {
    if (request_.dimension || outcome_.dimension == 3) return;
    require_one_plane(sequence_.x_t0(), sequence_.x_t1(), sequence_.name_t1());
  }

  /// Notes two equal frames in a row, which are usually a mistake in the files.
  void note_rest(std::size_t step) {
    if (request_.constant_motion) return;
    at_rest_.push_back(fmt::format("{} and {} are equal: nothing moves in step {}", source_->name(step),
                                   source_->name(step + 1), step + 1));
  }

  const Exclusions* exclusions() const { return groups_ ? &groups_->exclusions : nullptr; }

  SequenceOptions options() {
    SequenceOptions options;
    options.dimension = outcome_.dimension;
    options.at_rest = request_.constant_motion;
    options.threads = request_.threads;
    options.first_only = request_.first_only;
    options.strict = request_.strict;
    options.max_reports = reports_of_step(request_);
    options.exclusions = exclusions();
    options.only_new = request_.only_new;
    options.first_step = request_.only ? request_.only->first : 0;
    options.stop = request_.stop;
    options.deadline = request_.deadline;
    options.progress = [this](double share) {
      const double steps = static_cast<double>(std::max<std::size_t>(outcome_.steps_total, 1));
      tell("verify", std::min(1.0, (static_cast<double>(sequence_.step()) + share) / steps));
    };
    return options;
  }

  void verify() {
    if (request_.parts != nullptr) return verify_parts();
    if (starts_chain(sequence_.step())) begin_chain();
    if (request_.open_proof && verifier_proves(request_) && request_.open_proof_at_once) begin_proof();
    give_frames();
    const StepResult result = request_.decided ? take_decided() : decide();
    if (request_.decisions != nullptr) request_.decisions->push_back(without_proof(result));
    outcome_.complete = result.complete;
    if (result.rests) note_rest(sequence_.step());
    add(result, first_of(result), [this](const FeatureContact& contact) { return exactly(contact); });
    if (request_.open_proof && (result.complete || result.touches())) prove(result);
  }

  void verify_parts() {
    outcome_.inputs = source_->facts();
    while (const auto part = request_.parts->next()) {
      const StepResult result =
          verifier_->part_of_step(sequence_.x_t0(), sequence_.x_t1(), *part, request_.parts->are_proved());
      outcome_.complete = result.complete && !stopped();
      if (!outcome_.complete) return;
      request_.parts->take(*part, result, outcome_);
    }
  }

  void begin_chain() {
    chain_proves_ = request_.open_proof && verifier_proves(request_);
    if (proof_) proof_->begin_chain();
    prover_.reset();
  }

  /// What other chains found does not count, as each may be decided by itself.
  StepResult decide() {
    StepResult result =
        writes_along() ? decide_and_write() : verifier_->step(sequence_.x_t0(), sequence_.x_t1(), chain_proves_);
    chain_proves_ = chain_proves_ && (result.proof || result.receiver_has_proof);
    return result;
  }

  /// Whether the proof of this step is written while it is found. If there turns out to be none, a checker has to begin
  /// again, so this is for the first step, and for frames that it can read again.
  bool writes_along() const {
    return proof_ && outcome_.steps.empty() && chain_proves_ && request_.trajectory_pipe == nullptr;
  }

  StepResult decide_and_write() {
    const WorldLines lines = WorldLines::from_frames(sequence_.x_t0(), sequence_.x_t1());
    const MotionStep step = step_between(lines);
    StepProofs::Writer writer(*proof_, step);
    StepResult result = verifier_->step_for(sequence_.x_t0(), sequence_.x_t1(), writer);
    result.receiver_has_proof ? writer.commit() : writer.discard();
    outcome_.proof_seconds += writer.seconds();
    return result;
  }

  StepResult take_decided() {
    auto known = std::exchange(decided_, std::nullopt);
    if (!known) known = request_.decided->result(sequence_.step(), verifier_->mesh(), nullptr);
    return request_.decided->with_positions(std::move(*known), outcome_.dimension, sequence_.x_t0(), sequence_.x_t1());
  }

  static StepResult without_proof(StepResult result) {
    result.proof.reset();
    return result;
  }

  AnyQuery query(const FeatureContact& contact) const {
    return query_of(contact, outcome_.dimension, sequence_.x_t0(), sequence_.x_t1());
  }

  ListedContact exactly(const FeatureContact& contact) const {
    const FirstInStep found = first_in_step(contact, query(contact));
    return listed(contact, found.kind, found.time);
  }

  std::optional<ListedContact> first_of(const StepResult& result) const {
    if (!result.first) return std::nullopt;
    return listed(result.first->contact, result.first->kind, result.first->time);
  }

  ListedContact listed(const FeatureContact& contact, ContactKind kind, double time) const {
    const AnyQuery moving = query(contact);
    std::array<Position, 4> x{};
    for (std::size_t i = 0; i < moving.size(); ++i) x[i] = sample_between(moving.x_t0[i], moving.x_t1[i], time);
    const std::span<const Position> corners(x.data(), moving.size());
    return {contact, 0, kind, time, meeting_point(contact.pair, outcome_.dimension, corners), {}, {}};
  }

  void prove(const StepResult& result) {
    const Stopwatch watch;
    begin_proof();
    if (witness_sought_ && request_.trajectory_pipe != nullptr) return;  // the checker reads no further
    if (!goes_to_proof(result) || result.receiver_has_proof) return;
    const WorldLines lines = WorldLines::from_frames(sequence_.x_t0(), sequence_.x_t1());
    const MotionStep step = step_between(lines);
    if (request_.decided && request_.decided->in_parts()) {
      join_parts(step, result);
    } else if (request_.decided) {
      if (!take_proof(*proof_, step, result, verifier_->mesh())) refuse_frame();
    } else if (result.touches()) {
      refute(*proof_, step, result);
    } else {
      prove_untouched(step, result);
    }
    witness_sought_ = doubtful();
    outcome_.proof_seconds += watch.seconds();
  }

  MotionStep step_between(const WorldLines& lines) const {
    const auto number = sequence_.step();
    return {number, lines, request_.constant_motion ? 0 : static_cast<double>(number)};
  }

  void join_parts(const MotionStep& step, const StepResult& result) {
    if (result.touches()) return refute(*proof_, step, result);
    if (!proof_->join(step, [this](const auto& take) { request_.decided->blocks(take); })) note_no_proof();
  }

  void begin_proof() {
    if (proof_) return;
    outcome_.proof_begun = true;
    const Mesh& mesh = verifier_->mesh();
    proof_ = proof_of_frames(request_, outcome_.claim, mesh, classes_ ? &*classes_ : nullptr, labels_);
  }

  void prove_untouched(const MotionStep& step, const StepResult& result) {
    if (!verifier_proves(request_)) {
      const WindowOptions options{verifier_->step_options(), {}, nullptr, &labels_};
      if (!prover_) prover_.emplace(verifier_->mesh(), sequence_.x_t0(), options);
      return search_proof(*proof_, step, *prover_, verifier_->step_options());
    }
    if (!result.proof) return note_no_proof();
    proof_->write(step, *result.proof);
  }

  [[noreturn]] void refuse_frame() const {
    throw InputError(sequence_.name_t1(), "",
                     fmt::format("is not what step {} was decided for; expected the same files", sequence_.step() + 1));
  }

  void conclude() {
    stopped();
    const bool counted = sequence_.step_count().has_value();
    if (!counted) count_steps();
    set_verdict(counted ? outcome_.steps.size() == outcome_.steps_total : ended_);
    outcome_.bodies = source_->bodies();
    if (verifier_) list_contacts(verifier_->mesh(), names_of_frames(outcome_.bodies));
    put_notes();
    note_distance();
    if (trajectory_ && !trajectory_->finished()) {
      outcome_.notes.push_back(request_.trajectory->string() + " was not written: not all frames were read");
    }
    outcome_.inputs = source_->take_facts();
    note_numbering();
  }

  void note_numbering() {
    if (!outcome_.touches() && !outcome_.is_too_near()) return;
    const auto is_obj = [](const FrameFacts& facts) { return extension_of(facts.file) == ".obj"; };
    if (!std::ranges::any_of(outcome_.inputs, is_obj)) return;
    outcome_.notes.emplace_back("vertices and cells count from 0 here; in OBJ files they count from 1");
  }

  /// Of a source that does not say how many frames it has.
  void count_steps() {
    outcome_.steps_total = outcome_.steps.size();
    outcome_.claim.steps = outcome_.steps_total;
    if (!request_.constant_motion) outcome_.claim.to = static_cast<double>(outcome_.steps_total);
  }

  void put_notes() {
    outcome_.notes = request_.order_notes;
    if (request_.reading.given && outcome_.unreferenced_vertices > 0) {
      outcome_.notes.push_back(fmt::format("{} of the {} vertices belong to no cell and are ignored",
                                           outcome_.unreferenced_vertices, outcome_.vertices));
    }
    append_capped(outcome_.notes, at_rest_, "steps in which nothing moves");
    for (const std::string& note : source_->notes()) outcome_.notes.push_back(note);
    const bool contact =
        outcome_.initial_reports.empty() && outcome_.first && outcome_.first->time > 0 && outcome_.first->time < 1;
    const bool near = outcome_.is_too_near() && outcome_.near->pair.time > 0 && outcome_.near->pair.time < 1;
    if (contact || near) {
      outcome_.notes.emplace_back(
          contact ? "the first contact is between two frames: straight lines are assumed there; finer frames show more"
                  : "the least distance is broken between two frames: straight lines are assumed there; finer frames "
                    "show more");
    }
  }

  std::unique_ptr<FrameSource> source_;
  FrameSequence sequence_;  ///< reads from source_
  std::optional<IdenticalVertices> classes_;
  std::optional<Groups> groups_;  ///< with --ignore
  std::optional<SequenceVerifier> verifier_;
  CellLabels labels_;  ///< of the cells of verifier_
  std::unique_ptr<StepProofs> proof_;
  std::optional<WindowVerifier> prover_;  ///< of the chain, set if verify_step cannot prove the request
  std::vector<std::string> at_rest_;      ///< notes on steps in which nothing moves
  std::optional<StepResult> decided_;     ///< of the next step, if it is known already
  bool chain_proves_ = false;             ///< all steps of the chain so far have a proof
  bool ended_ = false;                    ///< the last frame has been read
  bool witness_sought_ = false;
  std::optional<TrajectoryFile> trajectory_;  ///< --trajectory
  std::optional<FramesWriter> given_;         ///< what the checker reads on its way
};

}  // namespace

VerifyOutcome verify_frames(const VerifyWork& request) { return SequenceVerification(request)(); }

}  // namespace noli

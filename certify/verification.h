// SPDX-License-Identifier: Apache-2.0
//
// Shared by the verifications of frames and of runs: adds the findings of each step, then sets the verdict.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string_view>

#include <noli/sequence.h>
#include "certify/listed_contacts.h"
#include "certify/proofs/step_proofs.h"
#include "certify/queries/any_query.h"
#include "certify/verify_work.h"

namespace noli {

class RunReader;
struct RunScene;
struct WindowResult;

/// The features of a contact, moving from x_t0 to x_t1.
AnyQuery query_of(const FeatureContact& contact, int dimension, std::span<const Position> x_t0,
                  std::span<const Position> x_t1);

/// Kind and time of a contact that was found; `query`: its features.
FirstInStep first_in_step(const FeatureContact& contact, const AnyQuery& query);

/// The result of a window, without the exact form of its first time.
StepResult step_of_window(WindowResult window);

/// How many contacts each step is to list: one at least, of which a witness may be made.
inline std::size_t reports_of_step(const VerifyRequest& request) {
  return std::max(request.max_reports, std::size_t{1});
}

/// Throws Stopped if the request is asked to stop, or its deadline has passed.
void end_if_stopped(const VerifyRequest& request);

/// What is asked about a run, without its steps and times.
Claim claim_of_run(const VerifyRequest& request, const RunScene& scene);

/// Throws UsageError for options that a run does not have, InputError when the run lacks what they need.
void require_can_be_asked(const VerifyRequest& request, const RunReader& run);

/// run_verify() for frames, and for a run.
VerifyOutcome verify_frames(const VerifyWork& request);
VerifyOutcome verify_run(const VerifyWork& request);

class Verification {
 protected:
  explicit Verification(const VerifyWork& request) : request_(request), listed_(request.max_reports) {}

  bool stopped() { return outcome_.stop_for(request_); }
  /// Whether enough was found to stop.
  bool enough() const { return doubtful() && !request_.keep_going; }
  /// Whether in a step that was added something touches, or is or may be too near. No proof of the claim is then sought
  /// any more.
  bool doubtful() const { return outcome_.touches() || outcome_.near; }

  /// Adds the findings of the next step. `first`: its first contact.
  void add(const Findings& found, std::optional<ListedContact> first, const ContactList::Exactly& exactly);
  /// Lists contacts with their cells and bodies. Call it when all steps have been added.
  void list_contacts(const Mesh& mesh, const BodyNames& names);

  /// Whether the last step, which was decided, goes to the proof. Not after a step of which no proof was found, nor
  /// where a checker does not go on. Of some steps alone, each witness may count, and whoever joins them decides about
  /// proofs: what comes before these steps may leave one out.
  bool goes_to_proof(const Findings& found) const;
  /// Finds the proof of the last step, in which nothing touches. If something is too near, finds a witness instead, and
  /// in the first step the largest least distance that holds.
  void search_proof(StepProofs& proof, const MotionStep& step, const WindowVerifier& verifier,
                    const VerifyOptions& options);
  /// Writes a witness for a step in which something touches, if there is one.
  template <class Result>
  void refute(StepProofs& proof, const MotionStep& step, const Result& result) {
    const auto first = result.first ? std::optional(result.first->contact) : std::nullopt;
    if (proof.refute(step, first, result)) ++outcome_.witnesses;
  }
  /// Copies the proof or witness of the last step from `request.decided`. False if that is about another motion.
  bool take_proof(StepProofs& proof, const MotionStep& step, const Findings& found, const Mesh& mesh);
  void note_no_proof();
  /// Says in which steps the least distance was not looked at, if there are any. Call it when all have been added.
  void note_distance();

  void tell(std::string_view work, double share) const {
    if (request_.progress) request_.progress(work, share);
  }

  /// `all`: every step was verified.
  void set_verdict(bool all);

  const VerifyWork& request_;
  VerifyOutcome outcome_;
  ContactList listed_;
};

}  // namespace noli

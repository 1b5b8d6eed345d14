// SPDX-License-Identifier: Apache-2.0
//
// What the verifications of frames and of runs share: step by step they add what was found, in the end they conclude.
#pragma once

#include <span>
#include <string_view>

#include <noli/verify.h>
#include "certify/queries/any_query.h"
#include "proofs/prover/tokens/no_proof.h"

namespace noli {

/// The features of a contact, moving from x_t0 to x_t1.
AnyQuery query_of(const FeatureContact& contact, int dimension, std::span<const Position> x_t0,
                  std::span<const Position> x_t1);

/// Takes away what was counted in the step before: what meets where this one begins. `resting`: what is found of all
/// vertices at rest there, in x, with no reports.
void drop_met_before(Findings& found, const Findings& resting, int dimension, std::span<const Position> x);

class Verification {
 protected:
  explicit Verification(const VerifyRequest& request) : request_(request) {}

  bool stopped() { return outcome_.stop_for(request_); }
  /// Whether what was found is all that was asked for.
  bool enough() const { return outcome_.near.has_value() || (outcome_.touches() && !request_.keep_going); }

  /// Of the next step.
  void add(const Findings& found);
  /// Where there is no first contact yet. `time`: within the step, or of the run.
  void add_first(const FeatureContact& contact, ContactKind kind, double time, const Mesh& mesh);

  /// Asks for the proof of the step that was added last, in which nothing touches: prove() tells whether it was not
  /// stopped; refute(near), where something is too near, whether there is a witness; largest(), which is asked of the
  /// first step alone, the largest least distance.
  template <class Prove, class Refute, class Largest>
  void search_proof(const Prove& prove, const Refute& refute, const Largest& largest) {
    try {
      outcome_.complete = prove();
    } catch (const TooNear& near) {
      outcome_.near = ListedNear{outcome_.steps.size(), near};
      if (refute(near)) ++outcome_.witnesses;
      if (outcome_.steps.size() == 1) outcome_.largest_distance = largest();
    } catch (const NoProof&) {
      note_no_proof();
    }
  }
  void note_no_proof();

  void tell(std::string_view work, double share) const {
    if (request_.progress) request_.progress(work, share);
  }

  /// `all`: nothing is left to be looked at.
  void set_verdict(bool all);

  const VerifyRequest& request_;
  VerifyOutcome outcome_;
};

}  // namespace noli

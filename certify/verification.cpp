// SPDX-License-Identifier: Apache-2.0
#include "certify/verification.h"

#include <algorithm>

#include <noli/contact.h>

namespace noli {

AnyQuery query_of(const FeatureContact& contact, int dimension, std::span<const Position> x_t0,
                  std::span<const Position> x_t1) {
  AnyQuery query{contact.pair, dimension, {}, {}};
  for (std::size_t i = 0; i < query.size(); ++i) {
    query.x_t0[i] = x_t0[contact.vertices[i]];
    query.x_t1[i] = x_t1[contact.vertices[i]];
  }
  return query;
}

void drop_met_before(Findings& found, const Findings& resting, int dimension, std::span<const Position> x) {
  found.complete = found.complete && resting.complete;
  found.stages += resting.stages;
  for (std::size_t i = 0; i < found.contacts.size(); ++i) {
    // Counts of what is not complete are lower bounds, and so must the difference be.
    const std::uint64_t before = resting.complete ? resting.contacts[i] : found.contacts[i];
    found.contacts[i] -= std::min(found.contacts[i], before);
  }
  std::erase_if(found.reports, [&](const FeatureContact& contact) {
    return !resting.complete ||
           visit(query_of(contact, dimension, x, x), [](const auto& query) { return meet(query); });
  });
}

void Verification::add(const Findings& found) {
  outcome_.steps.push_back({found.contacts, found.initial_intersections});
  for (std::size_t i = 0; i < outcome_.contacts.size(); ++i) outcome_.contacts[i] += found.contacts[i];
  outcome_.initial_intersections += found.initial_intersections;
  outcome_.stages += found.stages;
  outcome_.obligations += found.obligations;
  outcome_.cell_pairs += found.cell_pairs;
  const std::size_t step = outcome_.steps.size();
  for (const auto& contact : found.reports) {
    if (outcome_.reports.size() < request_.max_reports) outcome_.reports.push_back({step, contact});
  }
  for (const auto& pair : found.initial_reports) {
    if (outcome_.initial_reports.size() < request_.max_reports) outcome_.initial_reports.push_back({step, pair});
  }
}

void Verification::add_first(const FeatureContact& contact, ContactKind kind, double time, const Mesh& mesh) {
  if (!outcome_.first) outcome_.first = First{contact, outcome_.steps.size(), kind, time, face_of(mesh, contact)};
}

void Verification::search_proof(StepProofs& proof, const MotionStep& step, const WindowVerifier& verifier,
                                const VerifyOptions& options) {
  try {
    outcome_.complete = proof.prove(step, verifier, options);
    if (outcome_.complete) proof.commit();
  } catch (const TooNear& near) {
    outcome_.near = ListedNear{outcome_.steps.size(), near};
    if (proof.refute(step, near)) ++outcome_.witnesses;
    if (outcome_.steps.size() == 1) outcome_.largest_distance = proof.largest(step, verifier, options);
  } catch (const NoProof&) {
    note_no_proof();
  }
}

void Verification::note_no_proof() {
  outcome_.no_proof = true;
  outcome_.complete = !request_.needs_proof();
}

void Verification::set_verdict(bool all) {
  outcome_.complete = outcome_.complete && (all || enough());
  const Verdict untouched = outcome_.complete ? Verdict::no_contact : Verdict::undecided;
  const Verdict near = outcome_.witnesses > 0 ? Verdict::too_near : Verdict::undecided;
  outcome_.verdict = outcome_.touches() ? Verdict::contact : outcome_.near ? near : untouched;
}

}  // namespace noli

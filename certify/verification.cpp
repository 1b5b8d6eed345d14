// SPDX-License-Identifier: Apache-2.0
#include "certify/verification.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>
#include <vector>

#include <noli/errors.h>
#include <noli/time_of_impact.h>
#include "certify/decided_steps.h"
#include "proofs/prover/windows/window_verifier.h"

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

FirstInStep first_in_step(const FeatureContact& contact, const AnyQuery& query) {
  const auto found = visit(query, [](const auto& typed) { return first_contact(typed); });
  if (!found) throw std::logic_error("two parts of the kernel disagree on a contact");
  return {contact, found->kind, found->time.lower()};
}

StepResult step_of_window(WindowResult window) {
  StepResult step{std::move(static_cast<Findings&>(window)), {}, nullptr};
  if (window.first) step.first = FirstInStep{window.first->contact, window.first->kind, window.first->lower()};
  return step;
}

void end_if_stopped(const VerifyRequest& request) {
  VerifyOutcome outcome;
  if (!outcome.stop_for(request)) return;
  throw Stopped(outcome.interrupted ? StopReason::interrupted : StopReason::out_of_time, "");
}

void Verification::add(const Findings& found, std::optional<ListedContact> first, const ContactList::Exactly& exactly) {
  const std::size_t step = outcome_.steps.size() + 1;
  if (first) first->step = step;
  if (!outcome_.first) outcome_.first = first;
  listed_.add(step, first, found.reports, exactly, [this] { return stopped(); });
  outcome_.steps.push_back({found.contacts, found.initial_intersections, found.going_on > 0,
                            first ? std::make_shared<ListedContact>(std::move(*first)) : nullptr});
  for (std::size_t i = 0; i < outcome_.contacts.size(); ++i) outcome_.contacts[i] += found.contacts[i];
  outcome_.initial_intersections += found.initial_intersections;
  outcome_.stages += found.stages;
  outcome_.obligations += found.obligations;
  outcome_.cell_pairs += found.cell_pairs;
  for (const auto& pair : found.initial_reports) {
    if (outcome_.initial_reports.size() < request_.max_reports) outcome_.initial_reports.push_back({step, pair});
  }
}

void Verification::list_contacts(const Mesh& mesh, const BodyNames& names) {
  outcome_.reports = listed_.take();
  std::vector<ListedContact*> all;
  for (ListedContact& listed : outcome_.reports) all.push_back(&listed);
  for (StepCounts& step : outcome_.steps) {
    if (step.first) all.push_back(&*step.first);
  }
  if (outcome_.first) all.push_back(&*outcome_.first);
  name_owners(mesh, names, all);
  const auto name = [&](auto& listed) {
    listed.names = {names.cell(mesh, listed.pair.first_cell), names.cell(mesh, listed.pair.second_cell)};
  };
  for (ListedInitial& listed : outcome_.initial_reports) name(listed);
  if (outcome_.near) name(*outcome_.near);
}

bool Verification::goes_to_proof(const Findings& found) const {
  if (found.touches()) return request_.only || (!outcome_.no_proof && !outcome_.near);
  return !outcome_.no_proof && !outcome_.near && !outcome_.touches();
}

void Verification::search_proof(StepProofs& proof, const MotionStep& step, const WindowVerifier& verifier,
                                const VerifyOptions& options) {
  try {
    outcome_.complete = proof.prove(step, verifier, options);
    if (outcome_.complete) proof.commit();
  } catch (const TooNear& near) {
    const bool witnessed = proof.refute(step, near);
    outcome_.witnesses += witnessed ? 1 : 0;
    outcome_.near = ListedNear{outcome_.steps.size(), near, witnessed};
    if (outcome_.steps.size() == 1) outcome_.largest_distance = proof.largest(step, verifier, options);
  } catch (const NoProof&) {
    note_no_proof();
  }
}

bool Verification::take_proof(StepProofs& proof, const MotionStep& step, const Findings& found, const Mesh& mesh) {
  DecidedSteps& decided = *request_.decided;
  bool written = false;
  try {
    written = proof.copy(step, [&](const auto& take) { decided.blocks(take); });
  } catch (const std::invalid_argument&) {
    return false;
  }
  const auto near = found.touches() ? std::nullopt : decided.near(mesh);
  if (found.touches() || near) outcome_.witnesses += written ? 1 : 0;
  if (near) {
    outcome_.near = near;
    outcome_.near->step = outcome_.steps.size();
    if (outcome_.steps.size() == 1) outcome_.largest_distance = decided.largest_distance();
  } else if (!found.touches() && !written) {
    note_no_proof();
  }
  return true;
}

void Verification::note_no_proof() {
  outcome_.no_proof = true;
  outcome_.complete = request_.only || !request_.needs_proof();  // with `only`, whoever joins the steps decides
}

void Verification::note_distance() {
  const auto last = outcome_.last_for_distance();
  if (request_.min_distance <= 0 || !last || *last == outcome_.steps.size()) return;
  const char* const what = outcome_.is_too_near() ? "is too near" : outcome_.near ? "may be too near" : "touches";
  outcome_.notes.push_back(fmt::format("{} {} is the last that was checked for the least distance: something {} in it",
                                       request_.step_word(), *last, what));
}

void Verification::set_verdict(bool all) {
  outcome_.complete = outcome_.complete && (all || enough());
  const Verdict untouched = outcome_.complete ? Verdict::no_contact : Verdict::undecided;
  const Verdict near = outcome_.is_too_near() ? Verdict::too_near : Verdict::undecided;
  outcome_.verdict = outcome_.touches() ? Verdict::contact : outcome_.near ? near : untouched;
}

}  // namespace noli

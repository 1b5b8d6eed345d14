// SPDX-License-Identifier: Apache-2.0
#include <noli/verify.h>

#include <algorithm>
#include <utility>

#include <noli/errors.h>
#include "certify/verification.h"
#include "trajectory/blocks/run_file.h"
#include "trajectory/formats/stored_frames.h"
#include "trajectory/stop.h"

namespace noli {

std::uint64_t VerifyOutcome::frame_count() const { return noli::frame_count(inputs); }

std::string VerifyOutcome::frame_name(std::size_t k) const { return noli::frame_name(inputs, k); }

void VerifyRequest::put_in_order() {
  OrderedFrames in_order = order_frames(std::move(frames), order);
  frames = std::move(in_order.frames);
  ordered = std::move(in_order.how);
  order_notes = std::move(in_order.notes);
}

std::optional<std::size_t> VerifyOutcome::last_for_distance() const {
  const auto touching = std::ranges::find_if(steps, [](const StepCounts& step) { return step.touches(); });
  const auto contact = static_cast<std::size_t>(touching - steps.begin()) + 1;
  if (near) return std::min(near->step, contact);
  return touching == steps.end() ? std::nullopt : std::optional(contact);
}

bool VerifyOutcome::stop_for(const VerifyRequest& request) {
  interrupted |= request.stop != nullptr && request.stop->load(std::memory_order_relaxed);
  interrupted |= stop_asked() == StopReason::interrupted;
  out_of_time |= stop_asked() == StopReason::out_of_time;
  out_of_time |= request.deadline && std::chrono::steady_clock::now() >= *request.deadline;
  return interrupted || out_of_time;
}

void VerifyWork::prepare_to_reproduce() {
  if (reproduce && !run) {
    throw UsageError("--reproduce: is for a run of `noli simulate`; expected its folder, found frames");
  }
  lines_in_no_file = reproduce && RunReader(frames[0]).header().record == RecordMode::frames;
  if (lines_in_no_file && follow) {
    throw UsageError(
        "--follow: the run recorded only frames, so its windows are integrated again only when it is complete; "
        "expected a run with \"record\": \"full\", or no --follow");
  }
  if (lines_in_no_file && proof) {
    throw UsageError(
        "--proof: needs world lines in a file, but the run recorded only frames; expected a run with \"record\": "
        "\"full\", or no --proof");
  }
}

VerifyOutcome run_verify(const VerifyWork& work) {
  const StopOfThread stop_of_thread(work.stop);
  return work.run ? verify_run(work) : verify_frames(work);
}

VerifyOutcome run_verify(const VerifyRequest& request) {
  VerifyWork work(request);
  work.prepare_to_reproduce();
  return run_verify(work);
}

}  // namespace noli

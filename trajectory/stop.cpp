// SPDX-License-Identifier: Apache-2.0
#include "trajectory/stop.h"

#include <noli/errors.h>

namespace noli {
namespace {

std::string words(StopReason reason, const std::string& place) {
  const char* const why = reason == StopReason::interrupted ? "interrupted" : "the time limit has passed";
  return place.empty() ? why : on_one_line(place + ": " + why);
}

}  // namespace

Stopped::Stopped(StopReason reason, const std::string& place)
    : std::runtime_error(words(reason, place)), reason_(reason) {}

void stop_detail::throw_stopped() { throw Stopped(*stop_asked(), ""); }

}  // namespace noli

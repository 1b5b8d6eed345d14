// SPDX-License-Identifier: Apache-2.0
#include "certify/simulate/phase_clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <numeric>

namespace noli {

using integrator::Phase;

PhaseClock::PhaseClock(const integrator::Activity& activity)
    : activity_(activity), last_(std::chrono::steady_clock::now()), thread_([this] { watch(); }) {}

PhaseClock::~PhaseClock() {
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

PhaseSeconds PhaseClock::seconds() {
  const std::lock_guard lock(mutex_);
  look();
  return seconds_;
}

void PhaseClock::watch() {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, std::chrono::milliseconds(1), [this] { return done_; })) look();
}

void PhaseClock::look() {
  const Time now = std::chrono::steady_clock::now();
  seconds_[static_cast<std::size_t>(activity_.now())] += std::chrono::duration<double>(now - last_).count();
  last_ = now;
}

Json phases_json(const PhaseSeconds& seconds) {
  Json json = Json::object();
  for (std::size_t i = 0; i < seconds.size(); ++i) json[std::string(name(static_cast<Phase>(i)))] = seconds[i];
  return json;
}

std::string phases_text(const PhaseSeconds& seconds) {
  const double all = std::accumulate(seconds.begin(), seconds.end(), 0.0);
  std::vector<std::size_t> order(seconds.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return seconds[a] > seconds[b]; });
  std::string text;
  for (const std::size_t i : order) {
    if (!(seconds[i] > 1e-3 * all)) continue;
    text += fmt::format("{}{} {:.2f} s ({:.0f} %)", text.empty() ? "" : ", ", name(static_cast<Phase>(i)), seconds[i],
                        100 * seconds[i] / all);
  }
  return text.empty() ? "none" : text;
}

}  // namespace noli

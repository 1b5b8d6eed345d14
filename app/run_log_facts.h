// SPDX-License-Identifier: Apache-2.0
//
// What the log of a run says, for those who want to know how it went. Nothing of a run is computed from it.
//
// What this does not do: lines that it does not know, or that are damaged, are counted and passed over.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "noli/app/body_names.h"
#include "noli/app/json.h"
#include "noli/app/phase_clock.h"
#include "noli/certificates/counts.h"
#include "noli/integrator/contact_settings.h"

namespace noli::app {

struct LogFacts {
  BodyNames names;
  bool has_contact = false;
  integrator::LayerSchedule layers;
  std::uint32_t most_layers = 0;
  std::vector<double> thicknesses;  ///< eta(1) of each material [m]
  std::uint64_t parts = 0;          ///< begun
  std::uint64_t parts_ended = 0;    ///< with a line of their own
  std::uint64_t windows = 0;        ///< that it tells of, each once
  std::uint64_t windows_told = 0;   ///< up to the last one that any line tells of
  std::uint64_t bad_lines = 0;
  std::uint32_t deepest = 0;     ///< layer that was active in any of these windows
  std::vector<Json> roll_backs;  ///< lines of the log, with windows counted from 1
  std::string last_end;          ///< of the last part that ended: "done", "interrupted", ...
  Json last_end_line;            ///< of the same, whole
  bool going_on = false;         ///< the last part has no line of its end: it goes on still, or was killed
  PhaseSeconds phases{};
  double verifying_seconds = 0;
  certificates::CertificateCounts certificates;

  /// How the run ended, as far as is known: nothing when its last part goes on still, or was killed.
  std::string end() const { return going_on ? "" : last_end; }
};

/// Throws std::system_error when the log cannot be read; one that is not there has no lines.
LogFacts read_log(const std::filesystem::path& run);

/// A window is logged after it has been committed. Throws InputError if the log tells of more windows than are there.
void require_all_windows(const std::filesystem::path& run, const LogFacts& log, std::uint64_t windows);

}  // namespace noli::app

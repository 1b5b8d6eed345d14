// SPDX-License-Identifier: Apache-2.0
//
// Facts from the log of a run, for reports; and checks that the other files of the run agree with it. Nothing of a run
// is computed from it. Unknown lines are counted and skipped.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <noli/run.h>
#include "certify/body_names.h"
#include "certify/contact_report.h"
#include "certify/json.h"
#include "certify/runs/run_series_reader.h"
#include "certify/simulate/phase_clock.h"
#include "integrator/contact_settings.h"
#include "trajectory/blocks/run_file.h"

namespace noli {

struct LogFacts {
  BodyNames names;
  bool has_contact = false;
  integrator::LayerSchedule layers;
  std::uint32_t most_layers = 0;
  std::vector<double> thicknesses;      ///< eta(1) of each material [m]
  std::vector<MeetingBodies> meetings;  ///< of each material; empty if there is only one, or they are not logged
  std::uint64_t parts = 0;              ///< begun
  std::uint64_t parts_ended = 0;        ///< with a line of their own
  std::uint64_t windows = 0;            ///< logged windows, each once
  KnownWindows known;                   ///< from the last line about windows
  std::uint64_t bad_lines = 0;          ///< whole lines of an unknown kind
  std::uint32_t deepest = 0;            ///< the deepest layer that was active in any of these windows
  std::vector<Json> roll_backs;         ///< lines of the log, with windows counted from 1
  std::string last_end;                 ///< of the last part that ended: "done", "interrupted", ...
  Json last_end_line;                   ///< its whole line
  bool going_on = false;                ///< the last part has no line for its end: it is running, or was killed
  std::optional<Sha256Digest> manifest, series;  ///< of manifest.json; of series.h5, if the last part wrote it
  PhaseSeconds phases{};
  double verifying_seconds = 0;
  CertificateCounts certificates;
  std::set<std::string> not_logged;  ///< members of certificates_json() that some part lacks: unknown, not 0

  /// How the run ended; empty if its last part is still running, or was killed.
  std::string end() const { return going_on ? "" : last_end; }
};

/// A missing log has no lines. Throws InputError when a line is damaged, or when manifest.json or scene.json exist but
/// are not those with which the run began.
LogFacts read_log(const std::filesystem::path& run);

/// Opens a run. Read its log before, as windows are logged after they are committed. The reader also throws InputError
/// when logged windows are missing or have another hash.
SeriesReader open_run(const std::filesystem::path& run, const LogFacts& log);
/// The same for callers that do not need its log.
SeriesReader open_run(const std::filesystem::path& run);

/// A note on a run that has lost its log: windows missing at the end would not be noticed.
std::optional<std::string> note_of_lost_log(const LogFacts& log);

/// Throws InputError when series.h5 exists, but its hash is not the one in the log.
void require_series(const std::filesystem::path& run, const LogFacts& log);

}  // namespace noli

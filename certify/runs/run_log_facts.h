// SPDX-License-Identifier: Apache-2.0
//
// What the log of a run says, for those who want to know how it went; and that the other files of the run agree with
// it. Nothing of a run is computed from it.
//
// What this does not do: lines that it does not know are counted and passed over.
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
  std::vector<MeetingBodies> meetings;  ///< of each material; none where there is but one, or it is not logged
  std::uint64_t parts = 0;              ///< begun
  std::uint64_t parts_ended = 0;        ///< with a line of their own
  std::uint64_t windows = 0;            ///< that it tells of, each once
  KnownWindows known;                   ///< what the last line that tells of them says
  std::uint64_t bad_lines = 0;          ///< that are whole, but say nothing that is known
  std::uint32_t deepest = 0;            ///< layer that was active in any of these windows
  std::vector<Json> roll_backs;         ///< lines of the log, with windows counted from 1
  std::string last_end;                 ///< of the last part that ended: "done", "interrupted", ...
  Json last_end_line;                   ///< of the same, whole
  bool going_on = false;                ///< the last part has no line of its end: it goes on still, or was killed
  std::optional<Sha256Digest> manifest, series;  ///< of manifest.json; of series.h5, if the last part wrote it
  PhaseSeconds phases{};
  double verifying_seconds = 0;
  CertificateCounts certificates;
  std::set<std::string> not_logged;  ///< members of certificates_json() that a part does not tell: not known, not 0

  /// How the run ended, as far as is known: nothing when its last part goes on still, or was killed.
  std::string end() const { return going_on ? "" : last_end; }
};

/// A log that is not there has no lines. Throws InputError when one is damaged, or when manifest.json or scene.json are
/// there, but are not those that the run began with.
LogFacts read_log(const std::filesystem::path& run);

/// Opens a run whose log has been read: before, as windows are logged after they have been committed. The reader throws
/// InputError, too, when windows that the log tells of are missing or have another hash.
SeriesReader open_run(const std::filesystem::path& run, const LogFacts& log);
/// The same for those who want nothing else of its log.
SeriesReader open_run(const std::filesystem::path& run);

/// What to know of a run that has lost its log: nothing tells of windows that are missing at the end.
std::optional<std::string> note_of_lost_log(const LogFacts& log);

/// Throws InputError when series.h5 is there, but not as the log tells that it was written.
void require_series(const std::filesystem::path& run, const LogFacts& log);

}  // namespace noli

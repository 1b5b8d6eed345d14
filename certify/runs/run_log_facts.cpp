// SPDX-License-Identifier: Apache-2.0
#include "certify/runs/run_log_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include <noli/errors.h>
#include "certify/contact_report.h"
#include "certify/runs/run_folder.h"
#include "trajectory/blocks/run_log.h"
#include "trajectory/blocks/run_manifest.h"
#include "trajectory/formats/frame_look.h"

namespace noli {
namespace {

/// A member, or null.
const Json& member(const Json& json, const char* key) {
  static const Json nothing;
  return json.contains(key) ? json[key] : nothing;
}

/// A member that is a number, otherwise 0.
template <class T>
T number(const Json& json, const char* key) {
  const Json& found = member(json, key);
  return found.is_number() ? found.get<T>() : T{};
}

std::optional<Sha256Digest> digest(const Json& json, const char* key) {
  const Json& text = member(json, key);
  return text.is_string() ? digest_of_hex(text.get_ref<const std::string&>()) : std::nullopt;
}

class Reader {
 public:
  void take(const Json& entry) {
    const Json& event = member(entry, "event");
    if (!event.is_string()) {
      ++facts_.bad_lines;
      return;
    }
    const auto is = [&](const char* name) { return event.get_ref<const std::string&>() == name; };
    if (is("begin")) begin(entry);
    if (is("begin") || is("resume")) {
      ++facts_.parts;
      facts_.going_on = true;
      facts_.series.reset();
    }
    if (is("resume")) tell(entry, "windows", 0);
    if (is("window")) window(entry);
    if (is("roll_back")) roll_back(entry);
    if (is("end")) end(entry);
  }

  LogFacts finish() { return std::move(facts_); }

 private:
  void begin(const Json& entry) {
    facts_.names = BodyNames::from_json(member(entry, "bodies"));
    facts_.manifest = digest(entry, "manifest_sha256");
    const Json& contact = member(entry, "contact");
    if (!contact.is_object()) return;
    facts_.has_contact = true;
    facts_.most_layers = number<std::uint32_t>(contact, "most_layers");
    const Json& quarters = member(contact, "layers");
    if (quarters.is_array() && quarters.size() == 3 &&
        std::all_of(quarters.begin(), quarters.end(), [](const Json& q) { return q.is_number_integer(); })) {
      facts_.layers = {quarters[0], quarters[1], quarters[2]};
    }
    for (const Json& material : member(contact, "materials")) {
      facts_.thicknesses.push_back(number<double>(material, "thickness"));
      facts_.meetings.push_back(meetings(material));
    }
  }

  /// The pairs of bodies of a material; nothing if they are malformed or there are no such bodies.
  MeetingBodies meetings(const Json& material) const {
    MeetingBodies result;
    const Json& pairs = member(material, "pairs");
    if (!pairs.is_array()) return result;
    const auto is_body = [&](const Json& n) { return n.is_number_unsigned() && n < facts_.names.bodies().size(); };
    for (const Json& pair : pairs) {
      if (result.pairs.size() == MeetingBodies::most) break;
      if (!pair.is_array() || pair.size() != 2 || !std::ranges::all_of(pair, is_body)) return {};
      result.pairs.push_back({pair[0].get<std::uint64_t>(), pair[1].get<std::uint64_t>()});
    }
    result.more = number<std::uint64_t>(material, "more_pairs");
    return result;
  }

  /// The last line counts: a resumed part may have found fewer windows than the previous part logged, and makes the
  /// others again.
  void tell(const Json& entry, const char* windows, std::uint64_t more) {
    constexpr std::uint64_t most = std::uint64_t{1} << 53;
    if (!member(entry, windows).is_number_unsigned()) return;
    const auto count = number<std::uint64_t>(entry, windows);
    if (count <= most) facts_.known = {count + more, digest(entry, "running"), false};
  }

  void window(const Json& entry) {
    tell(entry, "window", 1);
    const Json& timing = member(entry, "timing");
    if (!member(timing, "deepest").is_number()) return;  // otherwise it is not known
    const auto window = number<std::uint64_t>(entry, "window");
    if (window >= next_) {
      ++facts_.windows;
      next_ = window + 1;
    }
    facts_.deepest = std::max(facts_.deepest, number<std::uint32_t>(timing, "deepest"));
  }

  void roll_back(Json entry) {
    if (member(entry, "window").is_number_unsigned()) entry["window"] = entry["window"].get<std::uint64_t>() + 1;
    facts_.roll_backs.push_back(std::move(entry));
  }

  void end(const Json& entry) {
    ++facts_.parts_ended;
    tell(entry, "windows", 0);
    facts_.going_on = false;
    facts_.series = digest(entry, "series_sha256");
    const Json& why = member(entry, "end");
    facts_.last_end = why.is_string() ? why.get<std::string>() : "";
    facts_.last_end_line = entry;
    const Json& timing = member(entry, "timing");
    facts_.verifying_seconds += number<double>(timing, "verifying_seconds");
    for (std::size_t i = 0; i < phase_count; ++i) {
      const std::string phase(name(static_cast<integrator::Phase>(i)));
      facts_.phases[i] += number<double>(member(timing, "phases"), phase.c_str());
    }
    if (facts_.has_contact) certificates(member(timing, "certificates"));
  }

  void certificates(const Json& counts) {
    const Json all = certificates_json({});
    for (const auto& told : all.items()) {
      if (!member(counts, told.key().c_str()).is_number()) facts_.not_logged.insert(told.key());
    }
    CertificateCounts more;
    more.slices = number<std::uint64_t>(counts, "slices");
    more.tubes = number<std::uint64_t>(counts, "tubes");
    more.plans = number<std::uint64_t>(counts, "plans");
    more.penned = number<std::uint64_t>(counts, "penned");
    more.repairs = number<std::uint64_t>(counts, "repairs");
    more.events = number<std::uint64_t>(counts, "events");
    more.activations = number<std::uint64_t>(counts, "activations");
    more.deactivations = number<std::uint64_t>(counts, "deactivations");
    more.most_near = number<std::uint64_t>(counts, "most_near");
    more.deepest = number<std::uint32_t>(counts, "deepest");
    facts_.certificates += more;
  }

  LogFacts facts_;
  std::uint64_t next_ = 0;  ///< the next window; one may be logged twice, by a part that was killed and by the next
                            ///< part
};

/// Checks the manifest and the scene if they exist: a run can do without its scene, and without a log there is nothing
/// to compare with.
void require_manifest(const std::filesystem::path& run, const LogFacts& log) {
  const std::filesystem::path path = run / "manifest.json";
  if (!std::filesystem::exists(path)) return;
  const Sha256Digest found = manifest_hash(run);
  if (log.manifest && found != *log.manifest) {
    throw InputError(
        path.string(), "",
        fmt::format("is damaged: it has SHA-256 {}; expected {}, which the log has", hex(found), hex(*log.manifest)));
  }
  if (std::filesystem::exists(run / "scene.json")) read_scene(run, read_manifest(run));
}

}  // namespace

LogFacts read_log(const std::filesystem::path& run) {
  Reader reader;
  read_log_lines(run, [&reader](const Json& entry) { reader.take(entry); });
  LogFacts facts = reader.finish();
  require_manifest(run, facts);
  return facts;
}

SeriesReader open_run(const std::filesystem::path& run, const LogFacts& log) {
  SeriesReader reader(run);
  reader.expect(log.known);
  const double length = reader.header().window_length;
  const std::optional<double> window = window_of(run);
  if (window && *window != length) {
    throw InputError(trajectory_path(run).string(), "",
                     fmt::format("has windows of {} s; expected {} s, as its scene says", length, *window));
  }
  return reader;
}

SeriesReader open_run(const std::filesystem::path& run) { return open_run(run, read_log(run)); }

std::optional<std::string> note_of_lost_log(const LogFacts& log) {
  if (log.parts > 0) return std::nullopt;
  return "the run has no log.jsonl: windows that are missing at its end would not be noticed";
}

void require_series(const std::filesystem::path& run, const LogFacts& log) {
  const std::filesystem::path path = run / "series.h5";
  if (!log.series || !std::filesystem::exists(path)) return;
  const Sha256Digest found = file_facts(path).sha256;
  if (found == *log.series) return;
  throw InputError(path.string(), "",
                   fmt::format("is damaged: it has SHA-256 {}; expected {}, which the log has (`noli simulate ... "
                               "--resume` writes it again)",
                               hex(found), hex(*log.series)));
}

}  // namespace noli

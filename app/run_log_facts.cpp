// SPDX-License-Identifier: Apache-2.0
#include "noli/app/run_log_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <string>
#include <system_error>

#include "noli/trajectory/error.h"

namespace noli::app {
namespace {

/// A member that is a number, or else 0.
template <class T>
T number(const Json& json, const char* key) {
  const auto found = json.is_object() ? json.find(key) : json.end();
  return json.is_object() && found != json.end() && found->is_number() ? found->template get<T>() : T{};
}

const Json& member(const Json& json, const char* key) {
  static const Json nothing;
  const auto found = json.is_object() ? json.find(key) : json.end();
  return json.is_object() && found != json.end() ? *found : nothing;
}

class Reader {
 public:
  void take(const std::string& line) {
    const Json entry = Json::parse(line, nullptr, false);
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
    }
    if (is("window")) window(entry);
    if (is("roll_back")) roll_back(entry);
    if (is("end")) end(entry);
  }

  LogFacts finish() { return std::move(facts_); }

 private:
  void begin(const Json& entry) {
    facts_.names = BodyNames::from_json(member(entry, "bodies"));
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
    }
  }

  /// Lines may be damaged; what one of them tells of was there.
  void tell(std::uint64_t windows) {
    constexpr std::uint64_t most = std::uint64_t{1} << 53;
    if (windows <= most) facts_.windows_told = std::max(facts_.windows_told, windows);
  }

  void window(const Json& entry) {
    if (member(entry, "window").is_number_unsigned()) tell(number<std::uint64_t>(entry, "window") + 1);
    const Json& timing = member(entry, "timing");
    if (!member(timing, "deepest").is_number()) return;  // what it does not say is not known
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
    if (member(entry, "windows").is_number_unsigned()) tell(number<std::uint64_t>(entry, "windows"));
    facts_.going_on = false;
    const Json& why = member(entry, "end");
    facts_.last_end = why.is_string() ? why.get<std::string>() : "";
    facts_.last_end_line = entry;
    const Json& timing = member(entry, "timing");
    facts_.verifying_seconds += number<double>(timing, "verifying_seconds");
    for (std::size_t i = 0; i < integrator::phases; ++i) {
      const std::string phase(name(static_cast<integrator::Phase>(i)));
      facts_.phases[i] += number<double>(member(timing, "phases"), phase.c_str());
    }
    const Json& counts = member(timing, "certificates");
    certificates::CertificateCounts more;
    more.slices = number<std::uint64_t>(counts, "slices");
    more.tubes = number<std::uint64_t>(counts, "tubes");
    more.plans = number<std::uint64_t>(counts, "plans");
    more.repairs = number<std::uint64_t>(counts, "repairs");
    more.activations = number<std::uint64_t>(counts, "activations");
    more.deactivations = number<std::uint64_t>(counts, "deactivations");
    more.most_near = number<std::uint64_t>(counts, "most_near");
    more.deepest = number<std::uint32_t>(counts, "deepest");
    facts_.certificates += more;
  }

  LogFacts facts_;
  std::uint64_t next_ = 0;  ///< window; one may be logged twice, by a part that was killed and by the next
};

}  // namespace

LogFacts read_log(const std::filesystem::path& run) {
  const std::filesystem::path path = run / "log.jsonl";
  Reader reader;
  if (!std::filesystem::exists(path)) return reader.finish();
  std::ifstream in(path, std::ios::binary);
  for (std::string line; std::getline(in, line);) {
    if (!in.eof()) reader.take(line);  // a last line without an end was cut off
  }
  if (in.bad() || !in.eof()) throw std::system_error(errno, std::generic_category(), path.string());
  return reader.finish();
}

void require_all_windows(const std::filesystem::path& run, const LogFacts& log, std::uint64_t windows) {
  if (log.windows_told <= windows) return;
  throw InputError((run / "trajectory.blocks").string(), "",
                   fmt::format("windows are missing: it has {}, the log tells of {}", windows, log.windows_told));
}

}  // namespace noli::app

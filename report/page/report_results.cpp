// SPDX-License-Identifier: Apache-2.0
#include "report/page/report_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <noli/errors.h>
#include "certify/listed_contacts.h"
#include "integrator/scene/json_text.h"
#include "report/page/report_statement.h"
#include "report/page/report_verdict.h"
#include "trajectory/text.h"

namespace noli::report {
namespace {

constexpr std::size_t most_listed = 1000, most_inputs = 200;
constexpr std::uint64_t most_digits = 1'000'000'000'000'000;  ///< from here a page writes exponents

std::string pairs(std::uint64_t count) { return fmt::format("{} {}", count, count == 1 ? "pair" : "pairs"); }

/// What is said of a run that ended before its scene does.
std::string end_text(const Json& run) {
  const Json &end = run.at("end"), &duration = run.at("duration");
  const std::string of = duration.is_number() ? fmt::format(" of {} s", duration.get<double>()) : "";
  const std::string why = end.is_string() ? spoken(end.get<std::string>()) : "its log does not say why";
  return fmt::format("The run ends at {} s{}: {}.", run.at("time").get<double>(), of, why);
}

/// A result of `noli verify` that is about to be shown.
class Verified {
 public:
  Verified(const Json& result, const std::filesystem::path& path, ReportPage& report)
      : result_(result), path_(path), report_(report) {
    const Json& scene = report.page["scene"];
    if (!scene.is_null()) scene_ = &scene;
  }

  void put() {
    looked_at_ = count(result_.at("steps"), "steps");
    steps_ = count(result_.at("steps_total"), "steps_total");
    require_steps();
    if (scene_) require_mesh();
    report_.page["contacts"] = contacts();
    take_verdict();
    if (!scene_) take_end_of_run();
    report_.page["contacts"]["settled"] = settled();
    for (const std::string& line : lines()) report_.page["verdict"]["lines"].push_back(line);
    for (const std::string& line : caveats()) add_caveat(line, report_);
    report_.page["statement"] = statement_in_words(result_.at("statement"));
    put_weakenings();
    put_inputs();
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw InputError(path_.string(), "", what); }

  /// A whole number that is one in a browser too.
  std::uint64_t count(const Json& value, const std::string& what) const {
    if (value.is_number_unsigned() && value.get<std::uint64_t>() < most_digits) return value.get<std::uint64_t>();
    refuse(fmt::format("is not a result of noli verify: {} is {}; expected a whole number from 0", what, value.dump()));
  }

  void require_steps() const {
    const VerifiedSteps of = verified_steps(result_, path_);
    const std::uint64_t steps = of.run || of.at_rest ? of.count : of.count - 1;
    if (steps_ != steps) refuse(fmt::format("makes statements about {} steps, but has {}", steps, steps_));
    if (looked_at_ > steps_) refuse(fmt::format("looked at {} of {} steps", looked_at_, steps_));
  }

  void take_verdict() {
    const auto word = result_.at("verdict").get<std::string>();
    const auto touching = contacts_ + report_.page["contacts"]["initial"].get<std::uint64_t>();
    if (touching > 0 && word != "contact") refuse(fmt::format("says {}, but counts {} contacts", word, touching));
    take_word(word, report_);
  }

  void require_count(const char* what, std::uint64_t shown) const {
    const std::uint64_t said = count(result_.at(what), what);
    if (said == shown) return;
    refuse(fmt::format("is about another mesh: it has {} {}, but what is shown has {}", said, what, shown));
  }

  /// Merging takes cells away, and --points makes some.
  void require_mesh() const {
    if (looked_at_ == 0) return;  // then the mesh was not read
    const Json &statement = result_.at("statement"), &cells = scene_->at("cells");
    const bool merged = count(statement.at("merged_vertices"), "merged_vertices") > 0;
    require_count("vertices", scene_->at("vertices").get<std::uint64_t>());
    if (merged) return;
    require_count("faces", cells.at("faces").get<std::uint64_t>());
    require_count("edges", cells.at("edges").get<std::uint64_t>());
    if (!statement.at("points").get<bool>()) require_count("points", cells.at("points").get<std::uint64_t>());
    const auto dimension = count(statement.at("dimension"), "dimension");
    const auto shown = scene_->at("dimension").get<std::uint64_t>();
    if (!statement.contains("windows") || dimension == shown) return;  // of frames it is an option
    refuse(fmt::format("is about {} dimensions, but the run has {}", dimension, shown));
  }

  void require_feature(const Json& feature) const {
    const bool of_three = feature.is_array() && !feature.empty() && feature.size() <= 3;
    if (!of_three) refuse("names a feature that does not have 1 to 3 vertices");
    for (const Json& v : feature) {
      const std::uint64_t number = count(v, "a vertex");
      if (!scene_ || number < scene_->at("vertices").get<std::uint64_t>()) continue;
      refuse(fmt::format("names vertex {}, but the mesh that is shown has {}", number,
                         scene_->at("vertices").get<std::uint64_t>()));
    }
  }

  Json listed(const Json& contact) const {
    const Json& features = contact.at("features");
    if (!features.is_array() || features.size() != 2) refuse("lists a contact that is not of two features");
    for (const Json& feature : features) require_feature(feature);
    const std::uint64_t step = count(contact.at("step"), "step");
    if (step == 0 || step > steps_) refuse(fmt::format("lists a contact in step {} of {}", step, steps_));
    Json shown = {{"step", step}, {"pair", contact.at("pair").get<std::string>()}, {"features", features}};
    add_details(contact, shown);
    return shown;
  }

  /// Results of older versions lack some or all of these.
  static void add_details(const Json& contact, Json& shown) {
    const auto has = [&](const char* key) { return contact.contains(key) && !contact.at(key).is_null(); };
    if (has("time")) shown["time"] = contact.at("time").get<double>();
    if (has("kind")) shown["kind"] = contact.at("kind").get<std::string>();
    if (has("cells")) shown["cells"] = contact.at("cells").get<std::array<std::vector<std::uint64_t>, 2>>();
    if (has("bodies")) shown["bodies"] = contact.at("bodies").get<std::array<std::string, 2>>();
    if (has("point")) add_point(contact.at("point"), shown);
  }

  /// Unless it is beyond the range of doubles.
  static void add_point(const Json& point, Json& shown) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (point.at(k).is_null()) return;
    }
    shown["point"] = point.get<std::array<double, 3>>();
  }

  /// How many contacts each step has, and each frame at rest pairs of cells that intersect; nothing where the result
  /// does not say.
  Json per_step() const {
    const bool at_rest = result_.at("statement").at("static").get<bool>();
    Json totals = Json::array();
    for (const Json& step : result_.value("per_step", Json::array())) {
      std::uint64_t total = 0;
      for (const auto& [kind, number] : step.at("contacts").items()) total += count(number, kind);
      if (at_rest) total += count(step.at("initial_intersections"), "initial_intersections");
      totals.push_back(total);
    }
    return totals;
  }

  /// Steps in which contacts go on that were counted in the step before.
  Json going_on() const {
    Json steps = Json::array();
    std::uint64_t step = 0;
    for (const Json& counts : result_.value("per_step", Json::array())) {
      ++step;
      if (counts.value("goes_on", false)) steps.push_back(step);
    }
    return steps;
  }

  /// Which contacts the page lists: of each step as many as there is room for, its first ones.
  std::vector<std::size_t> spread(const Json& all) const {
    std::map<std::uint64_t, std::vector<std::size_t>> of_step;
    for (std::size_t i = 0; i < all.size(); ++i) of_step[count(all.at(i).at("step"), "step")].push_back(i);
    std::vector<std::size_t> counts, chosen;
    for (const auto& [step, contacts] : of_step) counts.push_back(contacts.size());
    const std::vector<std::size_t> shares = fair_shares(counts, most_listed);
    std::size_t next = 0;
    for (const auto& [step, contacts] : of_step) {
      chosen.insert(chosen.end(), contacts.begin(), contacts.begin() + static_cast<std::ptrdiff_t>(shares[next++]));
    }
    return chosen;
  }

  /// Pairs of cells that intersect before anything moves. After merging, their numbers are not those of the mesh.
  Json intersections() const {
    Json list = Json::array();
    if (count(result_.at("statement").at("merged_vertices"), "merged_vertices") > 0) return list;
    const Json reports = result_.value("initial_reports", Json::object()).value("intersections", Json::array());
    for (std::size_t i = 0; i < reports.size() && i < most_listed; ++i) {
      const std::uint64_t step = count(reports.at(i).at("step"), "step");
      list.push_back({{"step", step}, {"cells", reports.at(i).at("cells").get<std::array<std::uint64_t, 2>>()}});
    }
    return list;
  }

  Json contacts() {
    for (const auto& [kind, number] : result_.at("contacts").items()) contacts_ += count(number, kind);
    const Json& all = result_.at("reports").at("contacts");
    if (all.size() > contacts_) refuse(fmt::format("lists {} contacts, but counts {}", all.size(), contacts_));
    Json list = Json::array();
    for (const std::size_t i : spread(all)) list.push_back(listed(all.at(i)));
    const Json& first = result_.at("first");
    return {{"counts", result_.at("contacts")},
            {"total", contacts_},
            {"initial", count(result_.at("initial_intersections"), "initial_intersections")},
            {"per_step", per_step()},
            {"goes_on", going_on()},
            {"first", first.is_null() ? Json() : listed(first)},
            {"listed", list},
            {"intersections", intersections()}};
  }

  /// A run that is not shown itself: its end stays all the same.
  void take_end_of_run() {
    const Json run = result_.value("run", Json());
    if (!run.is_object()) return;
    const Json& end = run.at("end");
    take_word(word_of_end(end.is_string() ? end.get<std::string>() : "", false), report_);
    end_ = end_text(run);
  }

  /// What makes the claim weaker than the one that `noli check` asks by default.
  void put_weakenings() const {
    const Json claim = result_.value("claim", Json());
    if (!claim.is_object() || claim.value("weaker", Json::array()).empty()) return;
    report_.page["statement"].push_back({"weaker than the default claim", value_in_words(claim.at("weaker")), true});
  }

  /// What was looked at, and by whom, below the statement.
  void put_inputs() const {
    Json& rows = report_.page["statement"];
    if (const Json noli = result_.value("noli", Json()); noli.is_object()) {
      rows.push_back(
          {"decided by",
           fmt::format("noli {} ({})", noli.at("version").get<std::string>(), noli.at("commit").get<std::string>()),
           false});
    }
    if (const Json checker = result_.value("checker", Json()); checker.is_object()) {
      rows.push_back({"checked by",
                      fmt::format("{} {} ({})", checker.at("name").get<std::string>(),
                                  checker.at("version").get<std::string>(), checker.at("commit").get<std::string>()),
                      false});
    }
    const Json inputs = result_.value("inputs", Json::array());
    for (std::size_t i = 0; i < inputs.size() && i < most_inputs; ++i) {
      rows.push_back({fmt::format("input {}", i + 1), input_in_words(inputs.at(i)), false});
    }
    if (inputs.size() > most_inputs)
      rows.push_back({"more inputs", fmt::format("{}", inputs.size() - most_inputs), false});
  }

  static std::string input_in_words(const Json& input) {
    std::string words = page_name(input.at("file").get<std::string>());
    for (const auto& [key, unit] : {std::pair("bytes", " bytes"), {"vertices", " vertices"}, {"cells", " cells"}}) {
      if (const Json number = input.value(key, Json()); number.is_number()) words += ", " + number.dump() + unit;
    }
    if (const Json numbers = input.value("numbers", Json()); numbers.is_string()) {
      words += ", " + numbers.get<std::string>();
    }
    if (const Json& hash = input.at("sha256"); hash.is_string()) words += ", SHA-256 " + hash.get<std::string>();
    return words;
  }

  std::vector<std::string> lines() const {
    const auto word = result_.at("verdict").get<std::string>();
    const bool run = result_.at("statement").contains("windows");
    std::vector<std::string> lines = {fmt::format("noli verify says {} ({}): {} of {} {} checked, {} of features meet.",
                                                  spoken(word), page_name(path_), looked_at_, steps_,
                                                  run ? "windows" : "steps", pairs(contacts_))};
    if (const auto initial = report_.page["contacts"]["initial"].get<std::uint64_t>(); initial > 0) {
      lines.push_back(pairs(initial) + " of cells intersect before anything moves.");
    }
    if (!end_.empty()) lines.push_back(end_);
    add_first(lines);
    add_near(lines);
    add_proof(lines);
    if (scene_) lines.push_back(same_motion());
    return lines;
  }

  bool first_only() const { return result_.at("statement").at("first_only").get<bool>(); }

  /// Whether no contact can be earlier than the first.
  bool settled() const { return result_.at("complete").get<bool>() && !first_only(); }

  void add_first(std::vector<std::string>& lines) const {
    const Json& first = result_.at("first");
    if (first.is_null()) return;
    lines.push_back(fmt::format("The first {}is a {}, in step {} at time {}.", settled() ? "" : "that was found ",
                                first.at("kind").get<std::string>(), count(first.at("step"), "step"),
                                digits17(first.at("time").get<double>())));
  }

  /// What is never folded, because it limits what the verdict says.
  std::vector<std::string> caveats() const {
    std::vector<std::string> lines;
    if (!result_.at("complete").get<bool>()) lines.emplace_back("Not everything asked for was decided.");
    if (settled() || result_.at("first").is_null()) return lines;
    lines.push_back(
        fmt::format("This covers only what was settled so far{}: there may be more contacts, and earlier ones.",
                    first_only() ? " (first contact only)" : ""));
    return lines;
  }

  void add_near(std::vector<std::string>& lines) const {
    const Json near = result_.value("near", Json());
    if (near.is_null()) return;
    const bool witnessed = near.value("witnessed", true);
    lines.push_back(fmt::format("Cells {} and {} {} not more than the least distance apart, in step {}.",
                                count(near.at("cells").at(0), "a cell"), count(near.at("cells").at(1), "a cell"),
                                witnessed ? "are" : "may be", count(near.at("step"), "step")));
  }

  void add_proof(std::vector<std::string>& lines) const {
    const Json proof = result_.value("proof", Json::object());
    if (const Json said = proof.value("checked", Json()); said.is_string()) {
      lines.push_back(fmt::format("The proof checker said: {}.", said.get<std::string>()));
    }
    if (const Json why = proof.value("not_checked", Json()); why.is_string()) {
      lines.push_back(fmt::format("The proof checker was not asked: {}.", why.get<std::string>()));
    }
  }

  /// What is shown has been compared with it (report_inputs.h).
  std::string same_motion() const {
    const bool run = result_.at("statement").contains("windows");
    return fmt::format("{} is about {}: the SHA-256 of each file is the same.", page_name(path_),
                       run ? "this run" : "these frames");
  }

  const Json& result_;
  const std::filesystem::path& path_;
  ReportPage& report_;
  const Json* scene_ = nullptr;  ///< that is shown
  std::uint64_t looked_at_ = 0, steps_ = 0, contacts_ = 0;
  std::string end_;
};

/// A page reads doubles: the digits of a seed would be lost.
void keep_digits(Json& value) {
  if (value.is_structured()) {
    for (Json& item : value) keep_digits(item);
  } else if (value.is_number_unsigned()
                 ? value.get<std::uint64_t>() >= most_digits
                 : value.is_number_integer() && value.get<std::int64_t>() <= -std::int64_t{most_digits}) {
    value = value.dump();
  }
}

}  // namespace

Json read_result(const std::filesystem::path& path) {
  Json result = integrator::parse_json(read_whole_file(path), path.string());
  if (!result.is_object()) throw InputError(path.string(), "", "expected an object, a result of noli");
  keep_digits(result);
  return result;
}

bool is_of_verify(const Json& result) { return result.contains("statement") && result.contains("reports"); }

bool is_of_repair(const Json& result) { return result.value("schema", Json()) == "noli-repair"; }

VerifiedSteps verified_steps(const Json& result, const std::filesystem::path& path) {
  return as_written(path, [&] {
    const Json& statement = result.at("statement");
    const bool run = statement.contains("windows");
    return VerifiedSteps{run, statement.at(run ? "windows" : "frames").get<std::uint64_t>(),
                         statement.at("static").get<bool>(), statement.at("dimension") == 2};
  });
}

void put_verdict(const Json& result, const std::filesystem::path& path, ReportPage& report) {
  as_written(path, [&] { Verified(result, path, report).put(); });
}

std::string page_name(const std::filesystem::path& path) {
  const std::filesystem::path normal = std::filesystem::absolute(path).lexically_normal();
  return on_one_line((normal.has_filename() ? normal : normal.parent_path()).filename().string());
}

}  // namespace noli::report

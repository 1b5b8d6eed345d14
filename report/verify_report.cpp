// SPDX-License-Identifier: Apache-2.0
#include "report/verify_report.h"

#include <fmt/format.h>

#include <utility>

#include <noli/errors.h>
#include <noli/version.h>
#include "certify/contact_report.h"
#include "certify/not_compared.h"
#include "certify/process/run_program.h"
#include "certify/process/this_program.h"
#include "certify/proofs/claim.h"
#include "kernel/parallel.h"
#include "report/input_report.h"

namespace noli::report {
namespace {

const char* motion(const VerifyRequest& request) {
  if (request.reproduce) {
    return "every vertex moves linearly between its own breakpoints, from each window to the next; the windows were "
           "integrated again from the run's own scene, and the hashes of their world lines were those of the run";
  }
  if (request.run) return "every vertex moves linearly between its own breakpoints, from each window to the next";
  return request.constant_motion ? "each frame by itself, at rest"
                                 : "every vertex moves linearly from each frame to the next";
}

std::string claim(const VerifyRequest& request) {
  const std::string who = fmt::format("no two features of two different cells{} that share no vertex",
                                      request.strict ? ", or of one," : "");
  if (request.min_distance == 0) return who + " meet at any time of a step";
  const std::string which =
      request.ring > 1 ? fmt::format(" (except features fewer than {} mesh edges apart)", request.ring) : "";
  return fmt::format("{} meet at any time of a step, or come within {} of each other{}", who,
                     digits17(request.min_distance), which);
}

Json excluded_json(const VerifyRequest& request, const VerifyOutcome& outcome) {
  Json list = Json::array();
  if (outcome.not_compared.any_held) list.push_back(held_text(outcome.not_compared));
  for (const auto& pair : outcome.not_compared.excluded) {
    list.push_back(fmt::format("two cells of {}, which {}", pair_text(pair),
                               request.run ? "the run's scene excludes" : "--ignore leaves out"));
  }
  return list;
}

Json statement_json(const VerifyRequest& request, const VerifyOutcome& outcome) {
  Json json = {
      {"claim", claim(request)},
      {request.run ? "windows" : "frames", request.run ? outcome.steps_total : request.frames.size()},
      {"motion", motion(request)},
      {"time", request.run ? "seconds; each window, both ends included" : "[0, 1] in each step, both ends included"},
      {"numbers", "the doubles that the files give, taken exactly; real arithmetic on them, no tolerance"},
      {"dimension", outcome.dimension},
      {"cells",
       "faces, and the loose edges and points that the files list; their features are their vertices, edges and "
       "themselves"},
      {"contact", "closed simplices have a point in common; degenerate ones are what their hull is; touching counts"},
      {"neighbours",
       "features that share a vertex are not compared; vertices are identified by index and never merged unless asked"},
      {"initial_intersections", "pairs of cells whose vertex-disjoint parts meet at the first time of all"},
      {"excluded", excluded_json(request, outcome)},
      {"min_distance", request.min_distance},
      {"min_distance_from_ring", request.ring},
      {"strict", request.strict},
      {"points", request.points},
      {"static", request.constant_motion},
      {"keep_going", request.keep_going},
      {"first_only", request.first_only},
      {"merge_identical", request.merge_identical},
      {"merged_vertices", outcome.merged_vertices},
      {"unreferenced_vertices_left_out", outcome.unreferenced_vertices},
  };
  if (!request.run) {
    json["order"] = request.ordered;
    json["polygons"] = polygons_text(request.polygons);
  }
  json["notes"] = outcome.notes;
  return json;
}

Json first_json(const VerifyOutcome& outcome) {
  if (!outcome.first) return nullptr;
  Json json = contact_json(outcome.first->contact);
  if (outcome.first->face) json["face"] = *outcome.first->face;
  json["kind"] = name(outcome.first->kind);
  json["step"] = outcome.first->step;
  json["time"] = outcome.first->time;
  return json;
}

Json reports_json(const VerifyOutcome& outcome) {
  Json list = Json::array();
  for (const auto& [step, contact] : outcome.reports) {
    list.push_back(contact_json(contact));
    list.back()["step"] = step;
  }
  return {{"listed", outcome.reports.size()},
          {"left_out", outcome.contact_count() - outcome.reports.size()},
          {"contacts", list}};
}

Json initial_reports_json(const VerifyOutcome& outcome) {
  Json list = Json::array();
  for (const auto& [step, pair] : outcome.initial_reports) {
    list.push_back({{"cells", {pair.first_cell, pair.second_cell}}, {"step", step}});
  }
  const auto listed = outcome.initial_reports.size();
  return {{"listed", listed}, {"left_out", outcome.initial_intersections - listed}, {"intersections", list}};
}

Json steps_json(const VerifyOutcome& outcome) {
  Json json = Json::array();
  for (const StepCounts& step : outcome.steps) {
    Json counts;
    counts["contacts"] = counts_json(step.contacts);
    counts["initial_intersections"] = step.initial_intersections;
    json.push_back(std::move(counts));
  }
  return json;
}

Json work_json(const VerifyOutcome& outcome) {
  Json json = stages_json(outcome.stages);
  json["obligations"] = outcome.obligations;
  json["cell_pairs"] = outcome.cell_pairs;
  return json;
}

Json near_json(const VerifyOutcome& outcome) {
  if (!outcome.near) return nullptr;
  const TooNear& pair = outcome.near->pair;
  return {{"cells", {pair.first_cell, pair.second_cell}}, {"step", outcome.near->step}, {"part_of_step", pair.time}};
}

Json proof_json(const VerifyRequest& request, const VerifyOutcome& outcome) {
  return {{"file", request.proof ? Json(request.proof->string()) : Json(nullptr)},
          {"witnesses", outcome.witnesses},
          {"checked", or_null(outcome.checked)},
          {"not_checked", or_null(outcome.not_checked)}};
}

/// The claim, and what weakens it.
Json asked_json(const Claim& claim) {
  if (claim.cells.empty()) return nullptr;
  Json json = claim_json(claim);
  json["weaker"] = weakenings(claim);
  return json;
}

Json run_json(const RunEnding& ending) {
  return {{"end", or_null(ending.why)},
          {"time", ending.time},
          {"windows_total", or_null(ending.windows_total)},
          {"duration", or_null(ending.duration)}};
}

/// Why a run has not come to the end of its scene.
std::string why_ended(const RunEnding& ending) {
  if (ending.being_written) return "it is being written";
  if (ending.going_on) return "it may still be going on, or was killed";
  if (!ending.why) return "its log does not say why";
  if (*ending.why == "done") return "no more was asked for";
  if (*ending.why == "too_near") return "too near";
  if (*ending.why == "not_finite") return "numbers ran out";
  if (*ending.why == "unstable") return "no more was asked for; its energy goes astray";
  if (*ending.why == "time_limit") return "time limit";
  return on_one_line(*ending.why);
}

int threads_used(const VerifyRequest& request) { return request.threads > 0 ? request.threads : hardware_threads(); }

const char* why_incomplete(const VerifyOutcome& outcome) {
  if (outcome.no_proof) return "no proof was found";
  if (outcome.near) return "something is about as near as the least distance, but no witness was found";
  if (outcome.interrupted) return "interrupted";
  if (outcome.steps_total == 0) return "no window was committed";
  return outcome.out_of_time ? "time limit" : "first contact only";
}

/// What stands behind the verdict, in the last line.
class Place {
 public:
  Place(const VerifyRequest& request, const VerifyOutcome& outcome) : request_(request), outcome_(outcome) {}

  std::string operator()() const {
    switch (outcome_.verdict) {
      case Verdict::proved: return fmt::format("{}: {} ({})", looked_at(), untouched(), by_checker());
      case Verdict::no_contact: return fmt::format("{}: {} (decided exactly, not checked)", looked_at(), untouched());
      case Verdict::contact: return contact();
      case Verdict::too_near: return near();
      case Verdict::undecided:
        return fmt::format("{} of {} {} begun: nothing found so far ({})", outcome_.steps.size(), outcome_.steps_total,
                           steps_word(outcome_.steps_total), why_incomplete(outcome_));
    }
    return "";
  }

 private:
  const char* steps_word(std::size_t count) const {
    if (request_.run) return count == 1 ? "window" : "windows";
    if (request_.constant_motion) return count == 1 ? "frame at rest" : "frames at rest";
    return count == 1 ? "step" : "steps";
  }

  std::string looked_at() const {
    std::string steps = fmt::format("{} {}", outcome_.steps_total, steps_word(outcome_.steps_total));
    if (request_.constant_motion) return steps;
    if (!request_.run) return fmt::format("{} frames, {}", request_.frames.size(), steps);
    const RunEnding& ending = *outcome_.ending;
    if (ending.whole() || !ending.duration) return fmt::format("{}, {} s", steps, digits4(ending.time));
    const std::string of = ending.windows_total
                               ? fmt::format("{} of {}{} windows", outcome_.steps_total,
                                             ending.some_ended_early ? "at least " : "", *ending.windows_total)
                               : steps;
    return fmt::format("{}, {} of {} s", of, digits4(ending.time), *ending.duration);
  }

  std::string untouched() const {
    std::string text = nothing_touches_in_short(outcome_.not_compared);
    if (request_.min_distance > 0) {
      const std::string which =
          request_.ring > 1 ? fmt::format("what is {} mesh edges or more away", request_.ring) : "all";
      text += fmt::format(", and {} is more than {} apart", which, digits17(request_.min_distance));
    }
    for (const std::string& phrase : weakenings(outcome_.claim)) text += "; " + phrase;
    return text;
  }

  std::string by_checker() const {
    return outcome_.checker ? fmt::format("accepted by {} {}", outcome_.checker->name, outcome_.checker->version)
                            : "accepted by the checker";
  }

  /// "step 3 (c.ply → d.ply)", "frame 3 (c.ply)", "window 3".
  std::string step(std::size_t number) const {
    if (request_.run) return fmt::format("window {}", number);
    const auto name = [&](std::size_t frame) { return on_one_line(request_.frames[frame].filename().string()); };
    if (request_.constant_motion) return fmt::format("frame {} ({})", number, name(number - 1));
    return fmt::format("step {} ({} → {})", number, name(number - 1), name(number));
  }

  std::string contact() const {
    if (outcome_.first) {
      const First& first = *outcome_.first;
      return fmt::format("{}  t = {}{}  {}{}", step(first.step), digits4(first.time), request_.run ? " s" : "",
                         pair_in_short(first.contact, first.face), rests_on());
    }
    if (outcome_.initial_reports.empty()) return "from the beginning" + rests_on();
    const auto& [number, pair] = outcome_.initial_reports.front();
    return fmt::format("{}  from its beginning  cell {} × cell {}{}", step(number), pair.first_cell, pair.second_cell,
                       rests_on());
  }

  /// What the checker's witness rests on that is not asked by default: "; z does not count".
  std::string rests_on() const {
    const std::size_t at = outcome_.checked ? outcome_.checked->find("; ") : std::string::npos;
    return at == std::string::npos ? "" : outcome_.checked->substr(at);
  }

  std::string near() const {
    const TooNear& pair = outcome_.near->pair;
    const std::string ring = request_.ring > 1 ? fmt::format(", {} mesh edges or more away", request_.ring) : "";
    return fmt::format("{}  t = {} of it  cell {} × cell {}  not more than {} apart{}", step(outcome_.near->step),
                       digits4(pair.time), pair.first_cell, pair.second_cell, digits17(request_.min_distance), ring);
  }

  const VerifyRequest& request_;
  const VerifyOutcome& outcome_;
};

class Words {
 public:
  Words(const VerifyRequest& request, const VerifyOutcome& outcome, Answer& answer)
      : request_(request), outcome_(outcome), answer_(answer) {}

  void operator()() {
    contacts();
    initial_intersections();
    remarks();
    proof();
    check_again();
    looked_at();
    answer_.text += notes_text(outcome_.notes);
    statement();
    work();
    answer_.place = Place(request_, outcome_)();
    answer_.next = next();
  }

 private:
  template <class... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    answer_.text += fmt::format(format, std::forward<Args>(args)...) + '\n';
  }
  template <class... Args>
  void detail(fmt::format_string<Args...> format, Args&&... args) {
    answer_.details += fmt::format(format, std::forward<Args>(args)...) + '\n';
  }

  void contacts() {
    if (!outcome_.first) return;
    const First& first = *outcome_.first;
    line("First: {}, {}, in step {} at time {}.", contact_text(first.contact), name(first.kind), first.step,
         digits17(first.time));
    line("Contacts ({} pairs of features, in {} of {} step(s) looked at):", outcome_.contact_count(), touching_steps(),
         outcome_.steps.size());
    for (const auto& [step, contact] : outcome_.reports) line("  step {}: {}", step, contact_text(contact));
    const auto left_out = outcome_.contact_count() - outcome_.reports.size();
    if (left_out > 0) line("  ... and {} more (--max-reports)", left_out);
  }

  std::size_t touching_steps() const {
    std::size_t count = 0;
    for (const StepCounts& step : outcome_.steps) {
      count += step.contacts != ContactCounts{} || step.initial_intersections > 0;
    }
    return count;
  }

  void initial_intersections() {
    if (outcome_.initial_intersections == 0) return;
    line("{} pair(s) of cells intersect already at the {}:", outcome_.initial_intersections,
         request_.constant_motion ? "time of their frame" : "first time");
    for (const auto& [step, pair] : outcome_.initial_reports) {
      line("  step {}: cells {} and {}", step, pair.first_cell, pair.second_cell);
    }
    const auto left_out = outcome_.initial_intersections - outcome_.initial_reports.size();
    if (left_out > 0) line("  ... and {} more (--max-reports)", left_out);
  }

  void remarks() {
    if (outcome_.largest_distance) {
      line("The first frame allows {}, and not {}{}.", digits17(outcome_.largest_distance->allowed),
           digits17(outcome_.largest_distance->limit),
           request_.ring == 1 ? " (neighbours by the mesh are near; see --min-distance-from-ring)" : "");
    }
    if (outcome_.claim.empty) {
      line("The claim is empty: fewer than two cells are compared, so nothing could touch (see --points, --ignore).");
    }
    ending();
    if (outcome_.open_window) line("The run ends in a window that was never committed; it is left out.");
    if (outcome_.verdict == Verdict::contact && !outcome_.complete) {
      line("Only a part was settled ({}): there may be more contacts, and earlier ones.", why_incomplete(outcome_));
    }
  }

  /// What was verified, by whom; each file with --verbose.
  void looked_at() {
    if (outcome_.claim.cells.empty())
      return line("Nothing was read. noli {} ({}).", version_number(), version_commit());
    std::uint64_t bytes = 0;
    for (const FrameFacts& facts : outcome_.inputs) bytes += facts.bytes;
    const std::string numbers = outcome_.inputs.empty() ? "" : outcome_.inputs.front().numbers;
    line("Looked at: {}, {} bytes{}; {} vertices, {} cells. noli {} ({}).", files(), bytes,
         numbers.empty() ? "" : ", " + numbers, outcome_.vertices, outcome_.faces + outcome_.edges + outcome_.points,
         version_number(), version_commit());
    if (outcome_.checker) {
      detail("Checked by {} {} ({}).", outcome_.checker->name, outcome_.checker->version, outcome_.checker->commit);
    }
    for (const FrameFacts& facts : outcome_.inputs) {
      if (!facts.looked_at) continue;
      detail("  {}: {} bytes, {}SHA-256 {}", on_one_line(facts.file), facts.bytes,
             facts.numbers.empty() ? "" : facts.numbers + ", ", hex(facts.sha256));
    }
  }

  std::string files() const {
    std::string first = on_one_line(request_.frames.front().string());
    if (request_.frames.size() == 1) return first;
    return fmt::format("{} frames, {} to {}", request_.frames.size(), first,
                       on_one_line(request_.frames.back().string()));
  }

  void ending() {
    if (!outcome_.ending || outcome_.ending->whole()) return;
    const RunEnding& ending = *outcome_.ending;
    const std::string of = ending.duration ? fmt::format(" of {} s", *ending.duration) : "";
    line("The run ends at {} s{} ({}).", ending.time, of, why_ended(ending));
  }

  void proof() {
    const bool touches = outcome_.verdict == Verdict::contact;
    if (!request_.proof) {
      if (outcome_.checked) detail("The checker says of the proof: {}.", *outcome_.checked);
      if (outcome_.not_checked) line("The proof was not checked: {}.", *outcome_.not_checked);
      if (touches && request_.open_proof && outcome_.witnesses == 0 && outcome_.complete)
        line("No witness was found of which a checker could be convinced.");
      return;
    }
    const std::string file = on_one_line(request_.proof->string());
    if (outcome_.checked) line("The checker says of {}: {}.", file, *outcome_.checked);
    if (outcome_.not_checked) line("{} was not checked: {}.", file, *outcome_.not_checked);
    if (touches && outcome_.witnesses == 0 && outcome_.proof_begun)
      line("No witness was found for {}: it proves nothing.", file);
    if (outcome_.verdict == Verdict::no_contact && !request_.check) line("The proof in {} was not checked.", file);
    if (!outcome_.proof_begun) line("No proof was written to {}.", file);
    if (outcome_.verdict == Verdict::undecided && outcome_.proof_begun)
      line("{} is not complete, and proves nothing.", file);
  }

  /// A proof that `noli check` takes only if it is asked for what it claims.
  void check_again() {
    if (!request_.proof || !outcome_.checked) return;
    constexpr std::size_t most_named = 8;
    std::vector<std::string> words = {"noli", "check", request_.proof->string()};
    for (const auto& frame : request_.frames) {
      if (request_.frames.size() <= most_named) words.push_back(frame.string());
    }
    if (request_.frames.size() > most_named) words.emplace_back("FRAMES...");
    if (request_.order == FrameOrder::given) words.insert(words.end(), {"--order", "given"});
    const std::size_t plain = words.size();
    for (const std::string& field : fields_beyond_default(outcome_.claim)) {
      words.insert(words.end(), {"--require", field});
    }
    if (words.size() > plain) line("To check it again, ask for what it claims: {}", shell_words(words));
  }

  /// What a user does now.
  std::string next() const {
    switch (outcome_.verdict) {
      case Verdict::contact:
        if (!request_.keep_going && outcome_.steps.size() < outcome_.steps_total) {
          return "--keep-going counts the contacts of all steps.";
        }
        return "write the result with --json OUT.json; noli report OUT.json and the same inputs shows where.";
      case Verdict::undecided: return outcome_.out_of_time ? "give it more time (--time-limit)." : "";
      case Verdict::too_near:
      case Verdict::no_contact:
      case Verdict::proved: return "";
    }
    return "";
  }

  void statement() {
    detail("Statement:");
    const Json statement = statement_json(request_, outcome_);  // items() only refers to it
    for (const auto& [key, value] : statement.items()) {
      detail("  {}: {}", key, value.is_string() ? value.get<std::string>() : value.dump());
    }
  }

  void work() {
    detail("Mesh: {} vertices, {} faces, {} loose edges, {} loose points.", outcome_.vertices, outcome_.faces,
           outcome_.edges, outcome_.points);
    answer_.details += "Stages:";
    const Json stages = work_json(outcome_);
    for (const auto& [key, value] : stages.items()) answer_.details += fmt::format(" {} {}", key, value.dump());
    detail("");
    detail("Time: {:.3f} s, and {:.3f} s of reading; {} thread(s); {:.0f} MB.", outcome_.seconds, outcome_.read_seconds,
           threads_used(request_), static_cast<double>(peak_memory_bytes()) / 1e6);
    if (!request_.open_proof) return;
    detail("Of it, {:.3f} s of making the proof; then {:.3f} s of waiting for the checker.", outcome_.proof_seconds,
           outcome_.check_seconds);
  }

  const VerifyRequest& request_;
  const VerifyOutcome& outcome_;
  Answer& answer_;
};

/// For machines.
void add_pairs(const VerifyOutcome& outcome, Answer& answer) {
  for (const FeaturePair pair : all_feature_pairs) {
    answer.add({fmt::format("contacts.{}", name(pair)), outcome.contacts[static_cast<std::size_t>(pair)]});
  }
  answer.add({"initial_intersections", outcome.initial_intersections});
  answer.add({"first_time", outcome.first ? digits17(outcome.first->time) : "none"});
  answer.add({"steps", outcome.steps.size()});
  answer.add({"steps_total", outcome.steps_total});
  answer.add({"faces", outcome.faces});
  answer.add({"complete", outcome.complete});
}

}  // namespace

Json verify_json(const VerifyRequest& request, const VerifyOutcome& outcome) {
  Json json = {{"verdict", name(outcome.verdict)}, {"complete", outcome.complete}};
  json["statement"] = statement_json(request, outcome);
  json["inputs"] = inputs_json(outcome.inputs);
  json["notes"] = outcome.notes;
  json["contacts"] = counts_json(outcome.contacts);
  json["initial_intersections"] = outcome.initial_intersections;
  json["first_time"] = outcome.first ? Json(outcome.first->time) : Json(nullptr);
  json["first"] = first_json(outcome);
  json["reports"] = reports_json(outcome);
  json["initial_reports"] = initial_reports_json(outcome);
  if (outcome.ending) {
    json["run"] = run_json(*outcome.ending);
    json["reproduced"] = outcome.reproduced;
  }
  json["steps"] = outcome.steps.size();
  json["steps_total"] = outcome.steps_total;
  json["per_step"] = steps_json(outcome);
  json["vertices"] = outcome.vertices;
  json["faces"] = outcome.faces;
  json["edges"] = outcome.edges;
  json["points"] = outcome.points;
  json["stages"] = work_json(outcome);
  json["near"] = near_json(outcome);
  json["first_frame"] = nullptr;
  if (outcome.largest_distance) {
    json["first_frame"] = {{"allowed", outcome.largest_distance->allowed}, {"not", outcome.largest_distance->limit}};
  }
  if (request.open_proof) json["proof"] = proof_json(request, outcome);
  json["claim"] = asked_json(outcome.claim);
  json["checker"] = outcome.checker ? checker_json(*outcome.checker) : Json();
  json["timing"] = {{"seconds", outcome.seconds},
                    {"read_seconds", outcome.read_seconds},
                    {"reproduce_seconds", outcome.reproduce_seconds},
                    {"proof_seconds", outcome.proof_seconds},
                    {"check_seconds", outcome.check_seconds},
                    {"threads", threads_used(request)},
                    {"peak_memory_bytes", peak_memory_bytes()}};
  return json;
}

Answer verify_answer(const VerifyRequest& request, const VerifyOutcome& outcome) {
  Answer answer(name(outcome.verdict));
  add_pairs(outcome, answer);
  Words(request, outcome, answer)();
  return answer;
}

}  // namespace noli::report

// SPDX-License-Identifier: Apache-2.0
#include "report/verify_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <noli/errors.h>
#include <noli/version.h>
#include "certify/contact_report.h"
#include "certify/not_compared.h"
#include "certify/process/run_program.h"
#include "certify/process/this_program.h"
#include "certify/proofs/claim.h"
#include "certify/proofs/prove_run.h"
#include "report/input_report.h"
#include "report/verify_place.h"
#include "report/verify_report.h"
#include "report/verify_statement.h"

namespace noli::report {
namespace {

/// Rows that leave room for the verdict on a screen of 24 lines.
constexpr std::size_t most_rows = 5, most_intersections = 3;

/// Whether a run ends as its scene asks for.
bool ended_well(const RunEnding& ending) {
  return ending.whole() && !ending.going_on && ending.why.value_or("done") == "done";
}

/// Why a run has not come to the end that was asked for.
std::string why_ended(const RunEnding& ending) {
  if (ending.being_written) return "it is being written";
  if (ending.going_on) return "it may still be going on, or was killed";
  if (!ending.why) return "its log does not say why";
  if (*ending.why == "done") return "no more was requested";
  if (*ending.why == "too_near") return "too near";
  if (*ending.why == "not_finite") return "not finite";
  if (*ending.why == "unstable") return "no more was requested; its energy drifts";
  if (*ending.why == "time_limit") return "time limit";
  if (*ending.why == "blocked") return "fixed vertices meet in the next step";
  if (*ending.why == "undecided") return "no way was found to repair the next step";
  return on_one_line(*ending.why);
}

class VerifyText {
 public:
  VerifyText(const VerifyRequest& request, const VerifyOutcome& outcome, TextOptions wanted, Answer& answer)
      : request_(request), outcome_(outcome), wanted_(std::move(wanted)), answer_(answer) {}

  void operator()() {
    baseline();
    contacts();
    initial_intersections();
    remarks();
    proof();
    check_again();
    looked_at();
    answer_.text += notes_text(outcome_.notes);
    if (wanted_.details) {
      statement();
      work();
    }
    answer_.place = place_of(request_, outcome_);
    answer_.next = next();
  }

 private:
  template <class... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    answer_.text += fmt::format(format, std::forward<Args>(args)...) + '\n';
  }
  template <class... Args>
  void detail(fmt::format_string<Args...> format, Args&&... args) {
    if (wanted_.details) answer_.details += fmt::format(format, std::forward<Args>(args)...) + '\n';
  }

  /// The first `most` rows of a list are text, the others are details.
  void listed(std::size_t i, std::size_t most, const std::string& row) {
    if (i < most)
      answer_.text += row;
    else if (wanted_.details)
      answer_.details += row;
  }

  void baseline() {
    if (!request_.only_new || outcome_.claim.cells.empty()) return;
    line("Not compared: {}{}", baseline_text(outcome_.not_compared), outcome_.baseline.empty() ? "." : ":");
    const auto& pairs = outcome_.baseline;
    const std::size_t said = wanted_.details ? pairs.size() : std::min(most_intersections, pairs.size());
    for (std::size_t i = 0; i < said; ++i) {
      listed(i, most_intersections, fmt::format("  cells {} and {}\n", pairs[i].first_cell, pairs[i].second_cell));
    }
    if (pairs.size() > most_intersections) line("  ... and {} more (-v)", pairs.size() - most_intersections);
  }

  void contacts() {
    if (outcome_.contact_count() == 0) return;
    line("Contacts: {} of features, in {} of {} {} looked at:", plural(outcome_.contact_count(), "pair"),
         touching_steps(), outcome_.steps.size(), steps_word(request_, outcome_.steps.size()));
    table();
    for (const ListedContact& listed : outcome_.reports) {
      detail("  {} {}  t = {}  {}  {}", request_.step_word(), listed.step, digits17(listed.time), name(listed.kind),
             who_and_where(listed, outcome_.dimension));
    }
    const auto left_out = outcome_.contact_count() - outcome_.reports.size();
    if (left_out > 0) detail("  ... and {} more (--max-reports)", left_out);
  }

  /// A row for each step that has contacts.
  void table() {
    std::size_t frames_width = 0;
    std::vector<std::size_t> rows;
    for (std::size_t k = 0; k < outcome_.steps.size(); ++k) {
      if (outcome_.steps[k].contact_count() == 0) continue;
      frames_width = std::max(frames_width, columns(step_frames(request_, outcome_, k + 1)));
      rows.push_back(k);
    }
    for (std::size_t i = 0; i < rows.size(); ++i) listed(i, most_rows, row(rows[i], frames_width));
    if (rows.size() > most_rows) line("  ... and {} more (-v)", rows.size() - most_rows);
  }

  std::string row(std::size_t k, std::size_t frames_width) const {
    const StepCounts& step = outcome_.steps[k];
    const std::string frames = step_frames(request_, outcome_, k + 1);
    const std::string gap = frames.empty() ? "" : "  " + frames + std::string(frames_width - columns(frames), ' ');
    return fmt::format("  {} {:>4}{}  {:>7}  {}\n", request_.step_word(), k + 1, gap, step.contact_count(),
                       how_it_begins(step));
  }

  /// Precondition: the step has contacts.
  std::string how_it_begins(const StepCounts& step) const {
    return fmt::format("t = {}{}  {}, {}{}", digits4(step.first->time), request_.run ? " s" : "",
                       pair_in_short(*step.first), name(step.first->kind),
                       step.goes_on ? ", in addition to contacts that go on" : "");
  }

  /// How wide UTF-8 is on a terminal, for names without wide letters.
  static std::size_t columns(const std::string& text) {
    return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
  }

  std::size_t touching_steps() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(outcome_.steps, [](const StepCounts& step) { return step.contact_count() > 0; }));
  }

  void initial_intersections() {
    if (outcome_.initial_intersections == 0) return;
    line("{} of cells {} {}:", plural(outcome_.initial_intersections, "pair"),
         outcome_.initial_intersections == 1 ? "intersects" : "intersect",
         request_.constant_motion ? "in its frame" : "before anything moves");
    const std::size_t shown = std::min(most_intersections, outcome_.initial_reports.size());
    for (std::size_t i = 0; i < outcome_.initial_reports.size(); ++i) {
      const ListedInitial& pair = outcome_.initial_reports[i];
      listed(i, shown,
             fmt::format("  {} {}: {} and {}\n", request_.step_word(), pair.step, pair.names[0], pair.names[1]));
    }
    const auto left_out = outcome_.initial_intersections - shown;
    if (left_out > 0) line("  ... and {} more (-v, --max-reports)", left_out);
  }

  void remarks() {
    if (outcome_.largest_distance) {
      line("The first frame allows {} at most, not {}{}.", digits17(outcome_.largest_distance->allowed),
           digits17(outcome_.largest_distance->limit),
           request_.ring == 1 ? " (neighbours in the mesh are near; see --min-distance-from-ring)" : "");
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
    const std::string file = on_one_line(request_.frames.front().string());
    const std::uint64_t count = outcome_.frame_count();
    if (request_.run || count < 2) return file;
    if (request_.frames.size() == 1) return fmt::format("{} frames in {}", count, file);
    return fmt::format("{} frames, {} to {}", count, on_one_line(outcome_.frame_name(0)),
                       on_one_line(outcome_.frame_name(static_cast<std::size_t>(count - 1))));
  }

  void ending() {
    if (!outcome_.ending || ended_well(*outcome_.ending)) return;
    const RunEnding& ending = *outcome_.ending;
    const std::string of = ending.duration && !ending.whole() ? fmt::format(" of {} s", *ending.duration) : "";
    line("The run ends at {} s{} ({}).", ending.time, of, why_ended(ending));
  }

  void proof() {
    const bool touches = outcome_.verdict == Verdict::contact;
    if (!request_.proof) {
      if (outcome_.checked) detail("The checker says of the proof: {}.", *outcome_.checked);
      if (outcome_.not_checked) line("The proof was not checked: {}.", *outcome_.not_checked);
      if (touches && request_.open_proof && outcome_.witnesses == 0 && outcome_.complete)
        line("No witness was found that would convince a checker.");
      return;
    }
    const std::string file = on_one_line(request_.proof->string());
    if (outcome_.checked) line("The checker says of {}: {}.", file, *outcome_.checked);
    if (outcome_.not_checked) line("{} was not checked: {}.", file, *outcome_.not_checked);
    if (touches && outcome_.witnesses == 0 && outcome_.proof_begun)
      line("No witness was found for {}: it proves nothing.", file);
    if (outcome_.verdict == Verdict::no_contact && !request_.check) line("The proof in {} was not checked.", file);
    if (!outcome_.proof_begun) line("No proof was written to {}.", file);
    const bool whole = outcome_.check_seconds > 0;  // only a whole proof is checked
    if (outcome_.verdict == Verdict::undecided && outcome_.proof_begun && !whole)
      line("{} is not complete, and proves nothing.", file);
  }

  /// A proof that `noli check` takes only if it is asked for what it claims.
  void check_again() {
    if (!request_.proof || !outcome_.checked || request_.reading.given) return;
    constexpr std::size_t most_named = 8, most_of_a_command = 1000;
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
    if (words.size() == plain) return;
    std::string command = shell_words(words);
    if (command.size() > most_of_a_command) {
      words.resize(plain);
      command = shell_words(words) + " --claim CLAIM.json, which --claim-out CLAIM.json writes";
    }
    line("To check it again, ask for what it claims: {}", command);
  }

  /// What a user does now.
  std::string next() const {
    switch (outcome_.verdict) {
      case Verdict::contact: return after_contact();
      case Verdict::undecided: return after_stop();
      case Verdict::too_near: return after_too_near();
      case Verdict::no_contact: return after_no_contact();
      case Verdict::proved: return after_proof();
    }
    return "";
  }

  /// World lines in no file have no proof that can be kept.
  static constexpr const char* record_in_full =
      "record the run in full (\"record\": \"full\" in its scene) for a proof that anybody can check.";

  std::string after_no_contact() const {
    if (outcome_.only_frames && (request_.check || request_.min_distance > 0)) return record_in_full;
    if (request_.check) return "";
    return outcome_.only_frames ? "without --no-check, and without shards, the proof is checked."
                                : "drop --no-check to have the proof checked.";
  }

  std::string after_proof() const {
    if (request_.proof) return "";
    if (outcome_.only_frames) return record_in_full;
    std::error_code error;
    if (request_.run && std::filesystem::exists(proof_path(request_.frames[0]), error)) {
      return shell_words({"noli", "check", request_.frames[0].string()}) + " checks the proof that is in the run.";
    }
    return "--proof OUT.noli keeps the proof, which anybody can check.";
  }

  std::string after_contact() const {
    const bool more = !request_.keep_going && outcome_.steps.size() < outcome_.steps_total;
    std::string others = more ? "; --keep-going counts the contacts of all steps" : "";
    const bool first = outcome_.initial_intersections > 0 && !request_.run && !request_.constant_motion;
    if (first) others = "; --only-new leaves out what intersects from the beginning";
    if (request_.only_new) others = "; --ignore GROUPS.json lets whole bodies pass each other";
    const std::string result = wanted_.result.empty() ? "result.json" : shell_words({wanted_.result});
    return fmt::format("{}noli export {} -o first.png is a picture of it{}.",
                       wanted_.result.empty() ? "--json result.json keeps the result, and " : "", result, others);
  }

  std::string after_stop() const {
    if (outcome_.out_of_time) return "give it more time (--time-limit).";
    if (outcome_.interrupted) return "run it again; nothing of an interrupted verification is kept.";
    if (outcome_.near || outcome_.no_proof) return "ask for a smaller distance (--min-distance).";
    return "";
  }

  std::string after_too_near() const {
    if (outcome_.largest_distance) {
      return fmt::format("ask for at most {} (--min-distance){}.", digits17(outcome_.largest_distance->allowed),
                         request_.ring == 1 ? ", or leave out neighbours (--min-distance-from-ring)" : "");
    }
    return "ask for a smaller distance (--min-distance).";
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
    detail("Time: {:.3f} s, plus {:.3f} s reading; {} thread(s); {:.0f} MB.", outcome_.seconds, outcome_.read_seconds,
           threads_used(request_), static_cast<double>(peak_memory_bytes()) / 1e6);
    if (!request_.open_proof) return;
    detail("Of this, {:.3f} s making the proof; then {:.3f} s waiting for the checker.", outcome_.proof_seconds,
           outcome_.check_seconds);
  }

  const VerifyRequest& request_;
  const VerifyOutcome& outcome_;
  TextOptions wanted_;
  Answer& answer_;
};

}  // namespace

void put_text(const VerifyRequest& request, const VerifyOutcome& outcome, TextOptions wanted, Answer& answer) {
  VerifyText(request, outcome, std::move(wanted), answer)();
}

}  // namespace noli::report

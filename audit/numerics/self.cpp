// SPDX-License-Identifier: Apache-2.0
#include "audit/numerics/self.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include <noli/errors.h>
#include "audit/numerics/stability_point.h"
#include "audit/numerics/stability_rows.h"
#include "certify/process/run_program.h"
#include "certify/process/scratch_folder.h"
#include "certify/stopwatch.h"
#include "trajectory/text.h"
#include "trajectory/write_file.h"

namespace noli::audit {
namespace {

namespace fs = std::filesystem;
using std::chrono::nanoseconds;

/// `noli fuzz NAME`, and in its JSON document the key for the number of cases tried and the verdict if all was well.
struct Fuzzer {
  const char *name, *tried, *well;
};

/// All fuzzers. Add a new one here.
constexpr Fuzzer fuzzers[] = {{"queries", "queries", "no_difference"},
                              {"trajectories", "trajectories", "no_finding"},
                              {"proofs", "mutants", "no_finding"},
                              {"scenes", "scenes", "no_finding"}};

/// Rows of the sweeps whose first, ordinary value makes a good example: frames apart and in contact, scenes in the
/// plane and in space, with and without contact.
constexpr const char* examples[] = {"frames-offset",   "frames-offset-contact", "steps",
                                    "stiffness-ratio", "speed-contact",         "thickness-plane-contact"};

/// The programs that check proofs, and the option of `noli check` that selects each.
struct CheckerProgram {
  const char *name, *option;
};
constexpr CheckerProgram checkers[] = {{"noli_check", ""}, {"noli_check_verified", "--verified"}};

/// How long a program may run beyond its time limit.
constexpr std::chrono::minutes grace{10};

struct Stopped {};

std::string told(const ProgramEnd& run) {
  const std::string words =
      run.out.starts_with("verdict") || run.err.empty() ? first_line(run.out) : first_complaint(run.err);
  return run.brief() + ": " + (words.empty() ? "no output" : on_one_line(words));
}

std::string milliseconds(nanoseconds time) {
  return fmt::format("{}ms", std::chrono::duration_cast<std::chrono::milliseconds>(time).count());
}

/// Files of a folder with this extension, sorted; empty if the folder does not exist.
std::vector<fs::path> files_of(const fs::path& folder, const std::string& extension) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().extension() == extension) files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The folder in which fuzzers create theirs; removed at the end if it is new and still empty.
class FindingsFolder {
 public:
  explicit FindingsFolder(const fs::path& path) : path_(path), made_(fs::create_directories(path)) {}
  ~FindingsFolder() {
    std::error_code not_empty;
    if (made_) fs::remove(path_, not_empty);
  }
  FindingsFolder(const FindingsFolder&) = delete;
  FindingsFolder& operator=(const FindingsFolder&) = delete;

 private:
  const fs::path& path_;
  bool made_;
};

class SelfAudit {
 public:
  explicit SelfAudit(const SelfOptions& options) : options_(options) {}

  SelfReport run() {
    try {
      if (wanted("rounding")) part("rounding", "self-test", [this](SelfPart& p) { rounding(p); });
      if (wanted("labels")) part("labels", "queries", [this](SelfPart& p) { labels(p); });
      if (wanted("fuzz")) {
        for (const Fuzzer& fuzzer : fuzzers) part("fuzz", fuzzer.name, [&](SelfPart& p) { fuzz(fuzzer, p); });
      }
      if (wanted("proofs")) proofs();
    } catch (const Stopped&) {
      report_.complete = false;
    }
    return std::move(report_);
  }

 private:
  template <class Do>
  void part(const std::string& group, const std::string& name, const Do& make) {
    if (options_.begun) options_.begun(group + " " + name);
    SelfPart result;
    result.group = group;
    result.name = name;
    const Stopwatch watch;
    make(result);
    result.seconds = watch.seconds();
    report_.parts.push_back(std::move(result));
  }

  bool wanted(const std::string& group) const {
    return options_.only.empty() || std::ranges::count(options_.only, group) > 0;
  }

  ProgramEnd noli(std::vector<std::string> words, nanoseconds limit = nanoseconds(0)) const {
    words.insert(words.begin(), options_.program.string());
    ProgramEnd run = run_program(std::move(words), {limit + grace, stop_by(options_.stop), 2 * time_to_end});
    if (run.kind == ProgramEnd::Kind::stopped) throw Stopped();
    return run;
  }

  static void hold(SelfPart& p) { p.state = PartState::held; }
  static void fail(SelfPart& p, const std::string& words) {
    p.state = PartState::failed;
    p.words = words;
  }
  static void skip(SelfPart& p, const std::string& words) {
    p.state = PartState::skipped;
    p.words = words;
  }

  /// The document of a program that exited with 0 and this verdict. Otherwise the part fails.
  static Json document(const ProgramEnd& run, const char* verdict, SelfPart& p) {
    Json json = Json::parse(run.out, nullptr, false);
    if (run.exited_with(0) && json.is_object() && json.value("verdict", "") == verdict) return json;
    fail(p, json.is_object() ? fmt::format("{}, verdict {}", run.brief(), json.value("verdict", "none")) : told(run));
    return nullptr;
  }

  /// Copies a count from the document. If it is missing or zero, nothing was tested and the part fails.
  static bool figure(const Json& json, const char* key, SelfPart& p) {
    const auto found = json.find(key);
    const std::uint64_t number = found != json.end() && found->is_number_unsigned() ? found->get<std::uint64_t>() : 0;
    if (number == 0) {
      fail(p, fmt::format("it reports success, but no {}", key));
      return false;
    }
    p.figures[key] = number;
    return true;
  }

  void rounding(SelfPart& p) const {
    const ProgramEnd run = noli({"--version"});
    const bool passed = run.out.find("\nrounding self-test passed\n") != std::string::npos;
    if (run.exited_with(0) && passed) return hold(p);
    if (!run.exited_with(0)) return fail(p, told(run));
    const std::size_t at = run.out.find("rounding");
    fail(p, at == std::string::npos ? "--version does not mention it" : on_one_line(first_line(run.out.substr(at))));
  }

  void labels(SelfPart& p) const {
    if (!options_.data) return skip(p, "NOLI_DATA is not set");
    const std::vector<fs::path> files = files_of(*options_.data / "queries", ".csv");
    if (files.empty()) return skip(p, "there are no queries/*.csv in " + on_one_line(options_.data->string()));
    std::vector<std::string> words = {"ccd"};
    for (const fs::path& file : files) words.push_back(file.string());
    words.insert(words.end(), {"--json", "-"});
    const Json json = document(noli(words), "agreement", p);
    if (!json.is_object()) return;
    p.figures["files"] = files.size();
    if (figure(json, "queries", p) && figure(json, "labelled", p)) hold(p);
  }

  void fuzz(const Fuzzer& fuzzer, SelfPart& p) const {
    p.by_clock = true;
    const FindingsFolder folder(options_.out);
    const fs::path out = options_.out / fuzzer.name;
    const ProgramEnd run =
        noli({"fuzz", fuzzer.name, "--for", milliseconds(options_.fuzz_time), "--seed", std::to_string(options_.seed),
              "--threads", std::to_string(options_.threads), "--out", out.string(), "--json", "-"},
             options_.fuzz_time);
    const Json json = document(run, fuzzer.well, p);
    if (json.is_object() && figure(json, fuzzer.tried, p)) hold(p);
    if (p.state == PartState::failed && run.exited_with(1))
      p.words += "; what it found is in " + on_one_line(out.string());
  }

  // --- proofs --------------------------------------------------------------------------------------------------------

  void proofs() {
    for (const CheckerProgram& checker : checkers) look_for(checker);
    for (const StabilityRow& row : stability_rows()) {
      if (std::ranges::count(examples, row.name) == 0) continue;
      part("proofs", row.name, [&](SelfPart& p) { example(row, p); });
    }
    shipped_scenes();
  }

  /// The plain checker is part of `noli`; the verified one is built only where Coq is installed.
  void look_for(const CheckerProgram& checker) {
    const bool there = ::access((options_.program.parent_path() / checker.name).c_str(), X_OK) == 0;
    if (there) return present_.push_back(checker);
    part("proofs", checker.name, [&](SelfPart& p) {
      const std::string words = std::string(checker.name) + " not found next to noli";
      if (*checker.option == '\0') return fail(p, words);
      skip(p, words + ": it is built where there is Coq");
    });
  }

  /// The part holds if each checker exits with `code`: 0 accepted, 1 refuted.
  void check(const std::vector<std::string>& files, int code, std::uint64_t steps, SelfPart& p) const {
    for (const CheckerProgram& checker : present_) {
      std::vector<std::string> words = {"check", "--porcelain"};
      words.insert(words.end(), files.begin(), files.end());
      if (*checker.option != '\0') words.emplace_back(checker.option);
      const ProgramEnd run = noli(words);
      const char* const expected = code == 0 ? "verdict=accepted" : "verdict=refuted";
      if (run.exited_with(code) && first_line(run.out).starts_with(expected)) continue;
      return fail(p, fmt::format("{}: {}", checker.name, told(run)));
    }
    p.figures["steps"] = steps;
    p.figures["checkers"] = present_.size();
    if (present_.empty()) return fail(p, "no checker is installed");
    hold(p);
  }

  void example(const StabilityRow& row, SelfPart& p) const {
    const ScratchFolder scratch;
    const StabilityCase what = row.make(row.values.front());
    if (const auto* scene = std::get_if<SceneCase>(&what)) {
      write_file(scratch.path() / "scene.json", scene->scene);
      return run_scene(scratch.path(), {}, {0}, p);
    }
    const FramesCase& two = std::get<FramesCase>(what);
    std::vector<std::string> frames;
    for (std::size_t i = 0; i < 2; ++i) {
      frames.push_back((scratch.path() / fmt::format("{}.ply", i)).string());
      write_file(frames.back(), two.frames[i]);
    }
    const std::string proof = (scratch.path() / "proof.noli").string();
    const ProgramEnd run = noli({"verify", "--porcelain", frames[0], frames[1], "--proof", proof});
    const char* const expected = two.touch ? "verdict=contact " : "verdict=proved ";
    if (!run.exited_with(two.touch ? 1 : 0) || !run.out.starts_with(expected)) return fail(p, told(run));
    check({proof, frames[0], frames[1]}, two.touch ? 1 : 0, 1, p);
  }

  /// Runs scene.json of the folder and checks the committed windows; `codes`: the exit codes allowed.
  void run_scene(const fs::path& folder, const std::vector<std::string>& more, const std::vector<int>& codes,
                 SelfPart& p) const {
    const std::string run_folder = (folder / "run").string();
    std::vector<std::string> words = {
        "simulate", (folder / "scene.json").string(), "-o", run_folder, "--json", "-", "--ignore-space"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramEnd run = noli(words);
    const Json json = Json::parse(run.out, nullptr, false);
    const bool ends = run.kind == ProgramEnd::Kind::exited && std::ranges::count(codes, run.code) > 0;
    if (!ends || !json.is_object()) return fail(p, told(run));
    const auto windows = json.value("windows", std::uint64_t{0});
    if (windows == 0) {
      if (run.exited_with(2)) return skip(p, "no window was done within --scene-time");
      return fail(p, "no window was committed: " + told(run));
    }
    check({run_folder}, 0, windows, p);
  }

  void shipped_scenes() {
    const std::vector<fs::path> files = files_of(options_.scenes, ".json");
    if (files.empty()) {
      part("proofs", "scenes", [&](SelfPart& p) {
        skip(p, "there are no scenes in " + on_one_line(options_.scenes.string()) + " (--scenes)");
      });
    }
    for (const fs::path& file : files) {
      part("proofs", "scenes/" + file.filename().string(), [&](SelfPart& p) { shipped_scene(file, p); });
    }
  }

  /// Runs the scene in its short form and records it in full, because frames have no proofs.
  void shipped_scene(const fs::path& file, SelfPart& p) const {
    p.by_clock = true;
    Json scene = Json::parse(bytes_of(file), nullptr, false);
    if (!scene.is_object()) return fail(p, "is not JSON");
    scene["record"] = "full";
    const ScratchFolder scratch;
    write_file(scratch.path() / "scene.json", scene.dump());
    for (const auto& entry : fs::directory_iterator(file.parent_path())) {  // meshes it may refer to
      if (entry.is_directory()) {
        fs::create_directory_symlink(fs::absolute(entry.path()), scratch.path() / entry.path().filename());
      }
    }
    // A scene may be meant to end in contact, and the time may be too short to finish it.
    run_scene(
        scratch.path(),
        {"--short", "--time-limit", milliseconds(options_.scene_time), "--threads", std::to_string(options_.threads)},
        {0, 1, 2}, p);
  }

  const SelfOptions& options_;
  SelfReport report_;
  std::vector<CheckerProgram> present_;
};

}  // namespace

std::size_t SelfReport::count(PartState state) const {
  return static_cast<std::size_t>(std::ranges::count(parts, state, &SelfPart::state));
}

bool SelfReport::holds(bool require_all) const {
  const bool all = complete && (!require_all || count(PartState::skipped) == 0);
  return all && !refuted() && count(PartState::held) > 0;
}

SelfReport audit_self(const SelfOptions& options) { return SelfAudit(options).run(); }

}  // namespace noli::audit

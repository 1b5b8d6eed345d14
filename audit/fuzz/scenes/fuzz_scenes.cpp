// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/scenes/fuzz_scenes.h"

#include <fmt/format.h>

#include <cctype>
#include <chrono>
#include <utility>

#include <noli/errors.h>
#include "audit/fuzz/save_finding.h"
#include "certify/process/scratch_folder.h"
#include "certify/process/this_program.h"
#include "integrator/scene/json_text.h"
#include "trajectory/blocks/sha256.h"
#include "trajectory/text.h"
#include "trajectory/write_file.h"

namespace noli::audit {

namespace {

namespace fs = std::filesystem;

constexpr const char *scene_file = "scene.json", *wrong_place_file = "wrong_place";  // of a corpus

/// The word behind a key in what --porcelain prints: "verdict=no_contact end=done windows=5".
std::string word_behind(const std::string& line, const std::string& key) {
  const std::size_t at = line.find(key + '=');
  if (at == std::string::npos) return "";
  const std::size_t begin = at + key.size() + 1;
  return line.substr(begin, line.find(' ', begin) - begin);
}

/// Whether a message names a place of the scene, or one in it: "/bodies/1" is named by "/bodies/1/mesh", and not by
/// "/bodies/10".
bool names_place(const std::string& message, const std::string& place) {
  for (std::size_t at = 0; (at = message.find(place, at)) != std::string::npos; ++at) {
    const std::size_t end = at + place.size();
    if (end == message.size() || !(std::isalnum(static_cast<unsigned char>(message[end])) || message[end] == '_'))
      return true;
  }
  return false;
}

bool agree(const std::string& verdict, int code) {
  if (code == 0) return verdict == "no_contact";
  if (code == 1)
    return verdict == "contact" || verdict == "too_near" || verdict == "not_finite" || verdict == "unstable";
  return code == 2 && verdict == "undecided";
}

class SceneJudge {
 public:
  SceneJudge(const GeneratedScene& scene, const RunNoli& noli)
      : scene_(scene), noli_(noli), text_(scene.scene.dump(1) + '\n') {}

  SceneJudgement judge() {
    write_file(file(), text_);
    const ProgramEnd end = simulate("run", {});
    if (judgement_.stopped || judgement_.difference) return judgement_;
    judgement_.end = fmt::format("exit {}", end.code);
    if (end.code != 3) judgement_.end += " " + word_behind(first_line(end.out), "end");
    if (scene_.wrong_place) {
      require_refusal(end);
    } else if (end.code == 3) {
      const std::size_t at = end.err.find("scene.json: ");
      if (at == std::string::npos) {
        found("message: does not name the file: " + first_complaint(end.err));
        return judgement_;
      }
      judgement_.end = "refused " + end.err.substr(at, end.err.find(':', at + 12) - at).substr(12);
    } else {
      look_at_run(end);
    }
    return judgement_;
  }

 private:
  std::string file() const { return folder_ / "scene.json"; }

  void found(const std::string& what) {
    if (!judgement_.difference) judgement_.difference = on_one_line(what);
  }

  ProgramEnd run(const std::vector<std::string>& arguments) {
    ProgramEnd end = noli_(arguments);
    judgement_.stopped |= end.kind == ProgramEnd::Kind::stopped;
    const bool documented = end.kind == ProgramEnd::Kind::exited && end.code >= 0 && end.code <= 3;
    if (!documented && !judgement_.stopped) {
      found(fmt::format("failure: noli {}: {}: {}", arguments[0], end.words(), first_complaint(end.err)));
    }
    return end;
  }

  ProgramEnd simulate(const char* name, const std::vector<std::string>& more) {
    std::vector<std::string> words = {"simulate", file(),         "-o", folder_ / name,   "--threads",
                                      "1",        "--time-limit", "4s", "--ignore-space", "--porcelain"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }

  void require_refusal(const ProgramEnd& end) {
    if (end.code != 3) return found(fmt::format("accepted: {} is wrong, but {}", *scene_.wrong_place, end.words()));
    if (!names_place(end.err, *scene_.wrong_place)) {
      found(fmt::format("message: does not name {}: {}", *scene_.wrong_place, first_complaint(end.err)));
    }
  }

  void look_at_run(const ProgramEnd& end) {
    const std::string line = first_line(end.out), verdict = word_behind(line, "verdict");
    if (!agree(verdict, end.code)) return found(fmt::format("verdict: {} with {}", verdict, end.words()));
    if (word_behind(line, "windows") == "0") return;
    verify();
    if (end.code != 2 && !judgement_.difference && !judgement_.stopped) resume(end);
  }

  void verify() {
    std::vector<std::string> words = {"verify", folder_ / "run", "--threads", "1"};
    if (scene_.scene.value("record", "full") == "frames") words.emplace_back("--reproduce");
    const ProgramEnd end = run(words);
    if (judgement_.stopped || judgement_.difference) return;
    judgement_.verified = true;
    if (end.code != 0)
      found(fmt::format("verify: {}: {}{}", end.words(), first_line(end.out), first_complaint(end.err)));
    if (!fs::exists(folder_ / "run" / "proof.blocks") || judgement_.difference) return;
    const ProgramEnd check = run({"check", folder_ / "run"});
    if (!judgement_.stopped && check.code != 0) {
      found(fmt::format("check: {}: {}{}", check.words(), first_line(check.out), first_complaint(check.err)));
    }
  }

  /// Interrupted at a time that the scene's text decides, so that it is the same when it is asked again.
  void resume(const ProgramEnd& whole) {
    const Sha256Digest hash = sha256(text_);
    const double until = scene_.scene.value("duration", 1.0) * (hash[0] + 1) / 257.0;
    simulate("again", {"--until", fmt::format("{:.17g}", until)});
    const ProgramEnd end = simulate("again", {"--resume"});
    if (judgement_.stopped || judgement_.difference) return;
    judgement_.resumed = true;
    if (end.code == 2) return;  // out of time, on a machine that was busy just then
    if (end.code != whole.code)
      return found(fmt::format("resume: {}, without an interruption {}", end.words(), whole.words()));
    for (const char* const name : {"trajectory.blocks", "proof.blocks"}) {
      const fs::path a = folder_ / "run" / name, b = folder_ / "again" / name;
      if (fs::exists(a) != fs::exists(b)) return found(fmt::format("resume: one of the two runs has no {}", name));
      if (fs::exists(a) && read_whole_file(a) != read_whole_file(b)) {
        return found(fmt::format("resume: different bytes in {} after an interruption at {:.17g} s", name, until));
      }
    }
  }

  const GeneratedScene& scene_;
  const RunNoli& noli_;
  const ScratchFolder scratch_{ScratchFolder::Place::memory};
  const fs::path folder_ = scratch_.path();
  std::string text_;
  SceneJudgement judgement_;
};

/// A scene that is said to be wrong somewhere is kept as it is: without some part it may be right, or wrong elsewhere.
bool can_shrink(const GeneratedScene& scene) { return !scene.wrong_place; }

struct JudgedScene {
  GeneratedScene made;
  std::string generator;
  SceneJudgement judgement;
};

class SceneFuzzing : public Fuzzing<SceneFuzzing, SceneFuzzOptions, SceneFuzzReport, JudgedScene> {
 public:
  static constexpr std::uint64_t items_per_block = 4;
  using Fuzzing::Fuzzing;

  std::optional<JudgedScene> make(std::uint64_t block, std::size_t index, Random& random) const {
    const auto all = scene_generators();
    const SceneGenerator& by = all[turn_of(block, index, all.size())];
    JudgedScene one{by.make(random), std::string(by.name), {}};
    one.judgement = judge(one.made);
    if (one.judgement.stopped) return std::nullopt;
    return one;
  }

  bool take_saved(const std::string& name) {
    const fs::path folder = corpus_->folder(name), wrong = folder / wrong_place_file;
    JudgedScene one{{read_saved_scene(folder / scene_file), {}}, "corpus/" + name, {}};
    if (fs::exists(wrong)) one.made.wrong_place = first_line(read_whole_file(wrong));
    one.judgement = judge(one.made);
    if (one.judgement.difference) found(one, 0);
    return true;
  }

  void take(const JudgedScene& one, std::size_t index) {
    ++report_.ends[one.generator][one.judgement.end.empty() ? "failed" : one.judgement.end];
    report_.verified += one.judgement.verified ? 1 : 0;
    report_.resumed += one.judgement.resumed ? 1 : 0;
    if (one.judgement.difference) return found(one, index);
    // The simulations of a generator that end in the same way have one shape.
    add_if_new(one.generator + ": " + without_numbers(one.judgement.end), [&](const fs::path& folder) {
      write_file(folder / scene_file, one.made.scene.dump(2) + '\n');
      if (one.made.wrong_place) write_file(folder / wrong_place_file, *one.made.wrong_place + '\n');
    });
  }

  std::uint64_t items() const {
    std::uint64_t sum = 0;
    for (const auto& [generator, ends] : report_.ends) {
      for (const auto& [end, count] : ends) sum += count;
    }
    return sum;
  }

 private:
  SceneJudgement judge(const GeneratedScene& scene) const { return judge_scene(scene, options_.noli); }

  void found(const JudgedScene& one, std::size_t index) {
    if (!is_kept() || ++alike_[*one.judgement.difference] > options_.max_alike) return;
    SceneFinding finding{{one.generator, block_, index, *one.judgement.difference, {}},
                         one.made.scene,
                         one.made.scene,
                         one.made.wrong_place};
    const std::string kind(kind_of(finding.difference));
    const auto now = [&](const SceneJson& scene) { return judge({scene, one.made.wrong_place}).difference; };
    const auto fails = [&](const SceneJson& scene) { return is_of_kind(now(scene), kind); };
    if (can_shrink(one.made)) finding.shrunk = minimise(finding.scene, fails, options_.shrink_budget);
    finding.difference = now(finding.shrunk).value_or(finding.difference);
    keep(std::move(finding), [this](SceneFinding& kept) { save(kept); });
  }

  void save(SceneFinding& finding) const {
    const bool known = finding.generator.starts_with("corpus/");
    const fs::path folder = known ? unused(options_.out / finding.generator)
                                  : folder_for(finding.block, finding.index, "-" + finding.generator);
    finding.place = folder / scene_file;
    std::vector<std::string> command = {"noli", "fuzz", "scenes", "--replay", finding.place};
    if (finding.wrong_place) command.insert(command.end(), {"--wrong-place", *finding.wrong_place});
    save_whole(folder, finding.difference, command,
               [&](const fs::path& to) { write_file(to / scene_file, finding.shrunk.dump(2) + '\n'); });
  }

  std::map<std::string, std::size_t> alike_;  ///< by difference
};

}  // namespace

RunNoli noli_as_subject(const std::atomic<bool>& stop) {
  require_startable(beside_this_program("noli_check").string());
  return [noli = this_program_file().string(), &stop](const std::vector<std::string>& arguments) {
    std::vector<std::string> words = {noli};
    words.insert(words.end(), arguments.begin(), arguments.end());
    ProgramLimits limits;
    limits.stop = stop_by(&stop);
    limits.time = std::chrono::seconds(120);
    return run_program(std::move(words), limits);
  };
}

SceneJson read_saved_scene(const fs::path& file) {
  return integrator::parse_json(read_whole_file(file), file.string());
}

SceneJudgement judge_scene(const GeneratedScene& scene, const RunNoli& noli) { return SceneJudge(scene, noli).judge(); }

ReplayedScene replay_scene(GeneratedScene scene, bool smaller, const RunNoli& noli) {
  const auto judge = [&](const SceneJson& candidate) { return judge_scene({candidate, scene.wrong_place}, noli); };
  SceneJudgement judgement = judge(scene.scene);
  if (judgement.difference && smaller) {
    const std::string kind(kind_of(*judgement.difference));
    scene.scene = minimise(
        scene.scene, [&](const SceneJson& candidate) { return is_of_kind(judge(candidate).difference, kind); }, 1000);
    if (SceneJudgement last = judge(scene.scene); last.difference) judgement = std::move(last);
  }
  return {std::move(scene.scene), std::move(judgement)};
}

SceneFuzzReport fuzz_scenes(const SceneFuzzOptions& options) { return SceneFuzzing(options).run(); }

}  // namespace noli::audit

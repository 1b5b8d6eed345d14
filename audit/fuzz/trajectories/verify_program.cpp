// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/trajectories/verify_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "certify/json.h"
#include "certify/process/run_program.h"
#include "certify/process/scratch_folder.h"
#include "certify/process/this_program.h"
#include "certify/proofs/checker.h"
#include "trajectory/text.h"

namespace noli::audit {
namespace {

namespace fs = std::filesystem;

/// Well before the limit behind which a program hangs: then it says so by itself.
constexpr const char* time_to_decide = "40s";

std::string failure_of(const std::string& program, const ProgramEnd& end) {
  if (end.kind == ProgramEnd::Kind::stopped) return "stopped";
  const std::string& said = end.err.empty() ? end.out : end.err;
  return fmt::format("{}: {} {}", program, end.words(), first_line(said));
}

Feature feature_of(const Json& vertices) {
  Feature feature = vertices.get<Feature>();
  std::ranges::sort(feature);
  feature.erase(std::unique(feature.begin(), feature.end()), feature.end());
  return feature;
}

/// None, one or several.
char how_many(const Json& number) {
  const auto count = number.get<std::uint64_t>();
  return count == 0 ? '0' : count == 1 ? '1' : '+';
}

/// What it went through: verdict, first contact, which kinds of contact there are, which stages decided.
std::string shape_of(const Json& said) {
  const Json& first = said["first"];
  std::string shape = said["verdict"].get<std::string>();
  if (!first.is_null())
    shape += fmt::format(" {} {}", first["pair"].get<std::string>(), first["kind"].get<std::string>());
  shape += fmt::format(" {}D step {} initial {} contacts ", said["statement"]["dimension"].get<int>(),
                       how_many(said["steps"]), how_many(said["initial_intersections"]));
  for (const auto& [pair, count] : said["contacts"].items()) shape += how_many(count);
  shape += " stages ";
  for (const auto& [stage, count] : said["stages"].items()) shape += how_many(count) == '0' ? '0' : '+';
  return shape;
}

void read_answer(const Json& said, MotionAnswer& answer) {
  answer.contact = said["verdict"] == "contact";
  answer.step = said["steps"].get<std::size_t>() - 1;
  answer.initial = said["initial_intersections"].get<std::uint64_t>() > 0;
  answer.has_proof = !answer.contact || said["proof"]["witnesses"].get<int>() > 0;
  const Json& first = said["first"];
  if (first.is_null()) return;
  answer.first = {{feature_of(first["features"][0]), feature_of(first["features"][1])},
                  first["kind"].get<std::string>(),
                  first["step"].get<std::size_t>() - 1,
                  first["time"].get<double>()};
}

}  // namespace

VerifyProgram::VerifyProgram(std::uint64_t verified_every, const std::atomic<bool>& stop)
    : limits_{.stop = stop_by(&stop)},
      noli_(this_program_file()),
      plain_(beside_this_program("noli_check")),
      verified_(beside_this_program("noli_check_verified")),
      has_verified_(has_checker(Checker::verified)),
      verified_every_(verified_every) {
  require_startable(plain_.string());
}

MotionAnswer VerifyProgram::operator()(const FrameMotion& motion) {
  const std::uint64_t number = number_++;
  const ScratchFolder work_folder(ScratchFolder::Place::memory);
  const std::string proof = work_folder.path() / "proof.noli";
  std::vector<std::string> files;
  for (const fs::path& file : write_frames(motion, work_folder.path())) files.push_back(file.string());
  std::vector<std::string> words = {noli_.string(), "verify", "--threads", "1", "--no-check",
                                    "--proof",      proof,    "--json",    "-", "--time-limit",
                                    time_to_decide};
  std::vector<std::string> asked = {"--require", "empty"};  // one cell alone may be a motion too
  if (motion.at_rest()) {
    words.emplace_back("--static");
    asked.insert(asked.end(), {"--require", "motion=rest"});
  }
  words.insert(words.end(), files.begin(), files.end());
  const ProgramEnd end = run_program(words, limits_);
  MotionAnswer answer;
  answer.undecided = end.exited_with(2);
  if (answer.undecided) return answer;
  if (!end.exited_with(0) && !end.exited_with(1)) {
    answer.failure = failure_of("noli verify", end);
    return answer;
  }
  try {
    const Json said = Json::parse(end.out);
    if (said["verdict"] != (end.code == 0 ? "no_contact" : "contact")) {
      answer.failure = fmt::format("noli verify: {}, but its verdict is {}", end.words(), said["verdict"].dump());
      return answer;
    }
    read_answer(said, answer);
    answer.shape = shape_of(said);
  } catch (const Json::exception& error) {
    answer.failure = fmt::format("noli verify: its JSON is not as required: {}", error.what());
    return answer;
  }
  if (!answer.has_proof) return answer;
  files.insert(files.begin(), proof);
  files.insert(files.begin(), asked.begin(), asked.end());
  answer.plain = check(plain_, files, answer);
  if (has_verified_ && number % verified_every_ == 0) answer.verified = check(verified_, files, answer);
  return answer;
}

CheckerWord VerifyProgram::check(const fs::path& program, const std::vector<std::string>& files,
                                 MotionAnswer& answer) const {
  std::vector<std::string> words = {program.string()};
  words.insert(words.end(), files.begin(), files.end());
  const ProgramEnd end = run_program(words, limits_);
  if (end.exited_with(0)) return CheckerWord::accepted;
  if (end.exited_with(1)) return CheckerWord::refuted;
  if (end.exited_with(3)) return CheckerWord::rejected;
  if (answer.failure.empty()) answer.failure = failure_of(program.filename().string(), end);
  return CheckerWord::not_asked;
}

}  // namespace noli::audit

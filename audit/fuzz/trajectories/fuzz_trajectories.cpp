// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/trajectories/fuzz_trajectories.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <new>
#include <set>
#include <system_error>
#include <utility>

#include "audit/fuzz/trajectories/motion_generators.h"
#include "trajectory/text.h"

namespace noli::audit {

namespace {

namespace fs = std::filesystem;

/// A motion that was judged.
struct Judged {
  FrameMotion motion;
  bool contact = false;
  MotionAnswer answer;
  std::optional<std::string> difference;
};

Judged judge(GeneratedMotion made, const TrajectoryOptions& options) {
  Judged judged;
  judged.motion = std::move(made.motion);
  try {
    const MotionTruth truth = truth_of(judged.motion, options.limits.stop);
    judged.contact = truth.contact;
    if (truth.stopped) {
      judged.answer.failure = "stopped";
      return judged;
    }
    judged.answer = options.decide(judged.motion);
    judged.difference = difference(judged.motion, truth, judged.answer);
    if (const auto broken = broken_promise(judged.motion, made.planted, truth)) judged.difference = broken;
    if (std::string fault = text_fault(judged.motion); !fault.empty()) judged.difference = "files: " + fault;
  } catch (const std::system_error&) {
    throw;  // the machine's fault, or a program is not there
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    judged.difference = fmt::format("threw: {}", error.what());
  }
  return judged;
}

class TrajectoryFuzzing : public Fuzzing<TrajectoryFuzzing, TrajectoryOptions, TrajectoryReport, Judged> {
 public:
  static constexpr std::uint64_t items_per_block = motions_per_block;

  explicit TrajectoryFuzzing(const TrajectoryOptions& options)
      : Fuzzing(options), generators_(motion_generators(options.families)) {
    for (const MotionGenerator& generator : generators_)
      report_.generators.push_back({std::string(generator.name), 0, 0, 0});
  }

  std::optional<Judged> make(std::uint64_t block, std::size_t index, Random& random) const {
    return judge(generators_[turn_of(block, index, generators_.size())].make(random), options_);
  }

  bool take_saved(const std::string& name) {
    const Judged judged = judge({read_frames(corpus_->folder(name)), {}}, options_);
    if (judged.answer.failure == "stopped") return false;
    is_new(judged.answer);
    if (judged.difference) found(judged, name, 0, 0);
    return true;
  }

  void take(const Judged& judged, std::size_t index) {
    if (judged.answer.failure == "stopped") return;  // by the user
    TrajectoryTally& tally = report_.generators[turn_of(block_, index, generators_.size())];
    ++(judged.contact ? tally.contact : tally.apart);
    tally.undecided += judged.answer.undecided ? 1 : 0;
    if (judged.answer.contact && !judged.answer.has_proof) ++tally.without_witness;
    if (judged.answer.plain != CheckerWord::not_asked) ++report_.checked_plain;
    if (judged.answer.verified != CheckerWord::not_asked) ++report_.checked_verified;
    const bool added = is_new(judged.answer);
    if (judged.difference) return found(judged, tally.name, block_, index);
    if (added) add_to_corpus(judged.answer.shape, [&](const fs::path& folder) { write_frames(judged.motion, folder); });
  }

  std::uint64_t items() const {
    std::uint64_t sum = 0;
    for (const TrajectoryTally& tally : report_.generators) sum += tally.apart + tally.contact;
    return sum;
  }

 private:
  /// Whether no earlier answer had this shape.
  bool is_new(const MotionAnswer& answer) {
    const bool added = !answer.undecided && shapes_.insert(answer.shape).second;
    report_.shapes = shapes_.size();
    return added;
  }

  void found(const Judged& judged, const std::string& generator, std::uint64_t block, std::size_t index) {
    if (!is_kept()) return;
    TrajectoryFinding finding{{generator, block, index, *judged.difference, {}}, judged.motion, judged.motion};
    shrink(finding);
    keep(std::move(finding), [this](TrajectoryFinding& kept) {
      kept.place = folder_for(kept.block, kept.index, "-" + kept.generator);
      save_motion(kept.shrunk, kept.difference, options_.replay_command, kept.place);
    });
  }

  /// What was planted holds for the motion as it was made: that cannot be shrunk.
  void shrink(TrajectoryFinding& finding) const {
    const std::string kind(kind_of(finding.difference));
    const auto now = [&](const FrameMotion& motion) -> std::optional<std::string> {
      try {
        return difference(motion, options_.decide, options_.limits.stop);
      } catch (const std::exception& error) {
        return fmt::format("threw: {}", error.what());
      }
    };
    const auto fails = [&](const FrameMotion& motion) { return is_of_kind(now(motion), kind); };
    if (!fails(finding.motion)) return;
    finding.shrunk = minimise(finding.motion, fails, options_.shrink_budget);
    finding.difference = now(finding.shrunk).value_or(finding.difference);
  }

  std::vector<MotionGenerator> generators_;
  std::set<std::string> shapes_;
};

}  // namespace

TrajectoryReport fuzz_trajectories(const TrajectoryOptions& options) { return TrajectoryFuzzing(options).run(); }

}  // namespace noli::audit

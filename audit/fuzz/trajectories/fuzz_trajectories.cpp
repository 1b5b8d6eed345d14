// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/trajectories/fuzz_trajectories.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <new>
#include <set>
#include <system_error>
#include <utility>

#include "audit/fuzz/finding_name.h"
#include "audit/fuzz/kind_of_difference.h"
#include "audit/fuzz/shape_corpus.h"
#include "audit/fuzz/trajectories/motion_generators.h"
#include "audit/fuzz/trajectories/save_motion.h"
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

class TrajectoryFuzzing {
 public:
  explicit TrajectoryFuzzing(const TrajectoryOptions& options)
      : options_(options), generators_(motion_generators(options.families)) {
    for (const MotionGenerator& generator : generators_)
      report_.generators.push_back({std::string(generator.name), 0, 0, 0});
    if (options.corpus) corpus_.emplace(*options.corpus);
  }

  TrajectoryReport run() {
    if (corpus_) run_corpus();
    report_.extent = fuzz_blocks(
        options_.limits, motions_per_block,
        [this](std::uint64_t block, std::uint64_t count) { return make_block(block, count); },
        [this](std::vector<Judged> block) { take_block(std::move(block)); });
    report_.extent.items = 0;  // an interruption leaves blocks that are not whole
    for (const TrajectoryTally& tally : report_.generators) report_.extent.items += tally.apart + tally.contact;
    report_.shapes = shapes_.size();
    report_.corpus_size = corpus_ ? corpus_->names().size() : 0;
    return std::move(report_);
  }

 private:
  /// Each motion of a block is of another generator.
  const MotionGenerator& generator(std::uint64_t block, std::size_t index) const {
    return generators_[(block * motions_per_block + index) % generators_.size()];
  }

  std::vector<Judged> make_block(std::uint64_t block, std::uint64_t count) const {
    Random random(options_.limits.seed, block);
    std::vector<Judged> judged;
    for (std::size_t index = 0; index < count; ++index) {
      const MotionGenerator& by = generator(block, index);
      judged.push_back(judge(by.make(random), options_));
      if (options_.limits.stop && options_.limits.stop->load()) break;
    }
    return judged;
  }

  void run_corpus() {
    for (const std::string& name : corpus_->names()) {
      if (options_.limits.stop && options_.limits.stop->load()) return;
      Judged judged = judge({read_frames(corpus_->folder(name)), {}}, options_);
      if (judged.answer.failure == "stopped") return;
      if (!judged.answer.undecided) shapes_.insert(judged.answer.shape);
      if (judged.difference) keep(std::move(judged), name, 0, 0);
    }
  }

  void take_block(std::vector<Judged> block) {
    for (std::size_t index = 0; index < block.size(); ++index) take(std::move(block[index]), index);
    ++block_;
  }

  void take(Judged judged, std::size_t index) {
    if (judged.answer.failure == "stopped") return;  // by the user
    TrajectoryTally& tally = report_.generators[(block_ * motions_per_block + index) % generators_.size()];
    ++(judged.contact ? tally.contact : tally.apart);
    tally.undecided += judged.answer.undecided ? 1 : 0;
    if (judged.answer.contact && !judged.answer.has_proof) ++tally.without_witness;
    if (judged.answer.plain != CheckerWord::not_asked) ++report_.checked_plain;
    if (judged.answer.verified != CheckerWord::not_asked) ++report_.checked_verified;
    const bool is_new = !judged.answer.undecided && shapes_.insert(judged.answer.shape).second;
    if (is_new && corpus_ && !judged.difference) {
      report_.not_saved.attempt([&] {
        corpus_->add(judged.answer.shape, [&](const fs::path& folder) { write_frames(judged.motion, folder); });
      });
    }
    if (judged.difference) keep(std::move(judged), tally.name, block_, index);
  }

  void keep(Judged judged, const std::string& generator, std::uint64_t block, std::size_t index) {
    ++report_.findings_total;
    if (report_.findings.size() >= options_.max_findings) return;
    TrajectoryFinding finding{generator, block, index, *judged.difference, judged.motion, judged.motion, {}};
    shrink(finding);
    if (!options_.out.empty() && !report_.not_saved.attempt([&] { save(finding); })) finding.folder.clear();
    report_.findings.push_back(std::move(finding));
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

  void save(TrajectoryFinding& finding) const {
    finding.folder = unused(options_.out / fmt::format("seed{}-block{}-index{}-{}", options_.limits.seed, finding.block,
                                                       finding.index, finding.generator));
    save_motion(finding.shrunk, finding.difference, options_.replay_command, finding.folder);
  }

  const TrajectoryOptions& options_;
  std::vector<MotionGenerator> generators_;
  std::optional<ShapeCorpus> corpus_;
  std::set<std::string> shapes_;
  std::uint64_t block_ = 0;
  TrajectoryReport report_;
};

}  // namespace

TrajectoryReport fuzz_trajectories(const TrajectoryOptions& options) { return TrajectoryFuzzing(options).run(); }

}  // namespace noli::audit

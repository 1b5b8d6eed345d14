// SPDX-License-Identifier: Apache-2.0
#include "audit/fuzz/trajectories/fuzz_library_motions.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "audit/fuzz/fuzzing_library.h"
#include "audit/fuzz/save_finding.h"
#include "audit/fuzz/trajectories/fuzz_trajectories.h"
#include "audit/fuzz/trajectories/motion_generators.h"
#include "kernel/parallel.h"

namespace noli::audit {

namespace {

namespace fs = std::filesystem;

/// A motion that the library was asked.
struct AskedMotion {
  FrameMotion motion;
  LibraryMotionAnswer answer;
};

/// What one block came to.
struct AskedBlock {
  std::vector<AskedMotion> motions;
  std::uint64_t not_asked = 0;
  bool stopped = false;  ///< within a motion, which is not among these
};

bool is_costly(const LibraryMotionAnswer& answer) {
  return answer.found && (answer.found->fault == MotionFault::hang || answer.found->fault == MotionFault::memory);
}

class LibraryMotionFuzzing
    : public FuzzingLibrary<LibraryMotionFuzzing, LibraryMotionOptions, LibraryMotionReport, AskedMotion> {
 public:
  static constexpr std::uint64_t items_per_block = motions_per_block;

  explicit LibraryMotionFuzzing(const LibraryMotionOptions& options)
      : FuzzingLibrary(options), generators_(motion_generators(options.families)) {
    for (const MotionGenerator& generator : generators_) {
      report_.generators.push_back({std::string(generator.name), 0, 0, {}});
    }
  }

  std::uint64_t items() const {
    std::uint64_t sum = 0;
    for (const LibraryMotionTally& tally : report_.generators) sum += tally.motions;
    return sum;
  }

  AskedBlock make_block(std::uint64_t block, std::uint64_t count) const {
    Random random(options_.limits.seed, block);
    AskedBlock result;
    std::uint64_t costly = 0;
    for (std::size_t index = 0; index < count; ++index) {
      GeneratedMotion made = generators_[turn_of(block, index, generators_.size())].make(random);
      if (costly >= asked_.host.most_hangs) {
        ++result.not_asked;
        continue;
      }
      const MotionQuestion question{report_.knows_times, block == 0};
      AskedMotion asked{std::move(made.motion), {}};
      asked.answer = ask_motion(asked_, asked.motion, made.planted, question);
      result.stopped = asked.answer.stopped;
      if (result.stopped) break;
      costly += is_costly(asked.answer) ? 1 : 0;
      result.motions.push_back(std::move(asked));
    }
    return result;
  }

  bool take_saved(const std::string& name) {
    AskedMotion asked{read_frames(corpus_->folder(name)), {}};
    asked.answer = ask_motion(asked_, asked.motion, {}, {report_.knows_times, false});
    if (asked.answer.stopped) return false;
    take(std::move(asked), "corpus/" + name, 0, nullptr);
    return true;
  }

  void take_block(AskedBlock block) {
    for (std::size_t index = 0; index < block.motions.size(); ++index) {
      LibraryMotionTally& tally = report_.generators[turn_of(block_, index, generators_.size())];
      take(std::move(block.motions[index]), tally.name, index, &tally);
    }
    report_.not_asked += block.not_asked;
    report_.nothing_answered = report_.candidates == 0 && (report_.nothing_answered || block.stopped);
  }

  void shrink_findings() {
    std::vector<LibraryMotionFinding>& findings = report_.findings;
    parallel_for(findings.size(), options_.limits.threads, [&](std::size_t i) {
      LibraryMotionFinding& finding = findings[i];
      if (stopped()) return;
      ShrunkMotion shrunk = shrink_for_library(options_.asked, finding.motion, finding.found, report_.knows_times,
                                               options_.shrink_budget);
      finding.shrunk = std::move(shrunk.motion);
      finding.found = std::move(shrunk.found);
    });
    for (LibraryMotionFinding& finding : findings) save(finding);
  }

 private:
  void take(AskedMotion asked, const std::string& generator, std::size_t index, LibraryMotionTally* tally) {
    const LibraryMotionAnswer& answer = asked.answer;
    report_.contacts += answer.contacts;
    report_.candidates += answer.candidates;
    report_.false_positives += answer.false_positives;
    if (tally != nullptr) ++tally->motions, tally->contacts += answer.contacts;
    if (tally != nullptr && !answer.found) {
      add_if_new("library" + answer.shape, [&](const fs::path& folder) { write_frames(asked.motion, folder); });
    } else if (corpus_) {
      corpus_->reached("library" + answer.shape);
    }
    if (!answer.found) return;
    const auto fault = static_cast<std::size_t>(answer.found->fault);
    ++report_.faults[fault];
    if (tally != nullptr) ++tally->faults[fault];
    report_.through += answer.found->through ? 1 : 0;
    keep_first({*answer.found, generator, block_, index, asked.motion, asked.motion, 1, {}});
  }

  /// The first of its like, saved as it is: it is shrunk later, and should not be lost until then.
  void keep_first(LibraryMotionFinding finding) {
    const bool room = is_kept();
    const auto alike = std::ranges::find_if(report_.findings, [&](const LibraryMotionFinding& other) {
      return other.found.is_like(finding.found) && other.generator == finding.generator;
    });
    if (alike != report_.findings.end()) {
      ++alike->alike;
      return;
    }
    if (!room) return;
    if (!options_.out.empty()) finding.folder = unused(options_.out / folder_name(finding));
    save(finding);
    report_.findings.push_back(std::move(finding));
  }

  std::string folder_name(const LibraryMotionFinding& finding) const {
    std::string fault(name(finding.found.fault)), generator = finding.generator;
    std::ranges::replace(fault, '_', '-');
    std::ranges::replace(generator, '/', '-');
    return fmt::format("{}-seed{}-block{}-index{}-{}", fault, options_.limits.seed, finding.block, finding.index,
                       generator);
  }

  /// As it is now. Where there is no room for that, what was saved before stays.
  void save(LibraryMotionFinding& finding) {
    const auto write = [&] {
      save_motion(finding.shrunk, finding.found.words, options_.replay_command, finding.folder);
    };
    if (finding.folder.empty() || report_.not_saved.attempt(write) || fs::exists(finding.folder)) return;
    finding.folder.clear();
  }

  std::vector<MotionGenerator> generators_;
};

}  // namespace

LibraryMotionReport fuzz_library_motions(const LibraryMotionOptions& options) {
  return LibraryMotionFuzzing(options).run();
}

ShrunkMotion shrink_for_library(const LibraryUnderTest& library, const FrameMotion& motion,
                                const MotionFaultFound& found, bool knows_times, std::size_t budget) {
  constexpr std::size_t most_costly = 100;  // of those that hang or take all memory
  const LibraryUnderTest asked = asked_while_shrinking(library, found.fault == MotionFault::hang);
  const MotionQuestion question{knows_times, found.fault == MotionFault::leak};
  std::size_t costly = 0;
  const auto fails = [&](const FrameMotion& candidate) {
    if (costly >= most_costly || library.host.stopped()) return false;
    const LibraryMotionAnswer answer = ask_motion(asked, candidate, {}, question);
    costly += is_costly(answer) ? 1 : 0;
    return !answer.stopped && answer.found && answer.found->is_like(found);
  };
  const FrameMotion shrunk = minimise(motion, fails, budget);
  if (shrunk.mesh == motion.mesh && shrunk.frames == motion.frames) return {motion, found};
  const LibraryMotionAnswer again = ask_motion(library, shrunk, {}, question);
  if (!again.found || !again.found->is_like(found)) return {motion, found};  // another answer than before
  return {shrunk, *again.found};
}

}  // namespace noli::audit

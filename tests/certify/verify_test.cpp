// SPDX-License-Identifier: Apache-2.0
//
// Verifies files of frames through the public interface: outcome, proof, progress, stops.
#include <noli/verify.h>

#include <sys/stat.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include <noli/errors.h>
#include "certify/proofs/checker.h"
#include "certify/shards/shards.h"
#include "tests/support/temporary_folder.h"
#include "trajectory/blocks/block_sink.h"
#include "trajectory/stop.h"

namespace noli {
namespace {

class VerifyInProcess : public testing::Test {
 protected:
  /// A triangle in the plane z = 0, and another one whose lowest corner is at (x, 0.25, z).
  std::string frame(const std::string& name, double x, double z) const {
    const auto corner = [&](double y, double up) {
      return "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z + up) + "\n";
    };
    return folder.write(name, "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + corner(0.25, 0) + corner(0.75, 1) + corner(0.25, 1) +
                                  "f 1 2 3\nf 4 5 6\n");
  }

  VerifyRequest falling(double x) const {
    VerifyRequest request;
    request.frames = {frame("0.obj", x, 1), frame("1.obj", x, 0.5), frame("2.obj", x, -1)};
    return request;
  }

  test::TemporaryFolder folder;
};

TEST_F(VerifyInProcess, NothingTouches) {
  const VerifyOutcome outcome = run_verify(falling(1.5));
  EXPECT_EQ(outcome.verdict, Verdict::no_contact);
  EXPECT_TRUE(outcome.complete);
  EXPECT_EQ(outcome.steps.size(), 2U);
  EXPECT_EQ(outcome.claim.steps, 2U);
}

TEST_F(VerifyInProcess, SomethingTouches) {
  const VerifyOutcome outcome = run_verify(falling(0.25));
  EXPECT_EQ(outcome.verdict, Verdict::contact);
  ASSERT_TRUE(outcome.first);
  EXPECT_EQ(outcome.first->step, 2U);
  EXPECT_EQ(outcome.first->kind, ContactKind::crossing);
}

/// Frames of steps without contacts are gone when the shards are joined: none of them is read.
TEST_F(VerifyInProcess, JoinsShardsFromTheFramesWithContactsAlone) {
  VerifyWork request;
  for (int k = 0; k < 12; ++k) {
    request.frames.emplace_back(frame(std::to_string(k) + ".obj", k == 6 ? 0.25 : 1.5, k < 6 ? 1 : -1));
  }
  request.keep_going = true;
  request.check = false;
  const std::filesystem::path shards = folder.path() / "shards";
  EXPECT_EQ(verify_shard(request, {.folder = shards}).first_touch, 6U);
  VerifyWork whole = request_of_shards(shards);
  whole.progress = [&](std::string_view work, double /*share*/) {
    if (work != "verify") return;
    for (const int k : {2, 3, 4, 8, 9, 10, 11}) std::filesystem::remove(request.frames[k]);
  };
  const VerifyOutcome joined = run_verify(whole);
  EXPECT_EQ(joined.verdict, Verdict::contact);
  EXPECT_EQ(joined.steps.size(), 11U);
  ASSERT_TRUE(joined.first);
  EXPECT_EQ(joined.first->step, 6U);
  EXPECT_FALSE(std::filesystem::exists(request.frames[11]));
}

TEST_F(VerifyInProcess, WritesItsProofWhereItIsTold) {
  VerifyRequest request = falling(1.5);
  const std::filesystem::path proof = folder / "proof.noli";
  request.open_proof = [&](const Claim& claim) {
    EXPECT_EQ(claim.motion, "linear");
    return std::make_unique<FileSink>(proof, FileSink::Open::create);
  };
  EXPECT_EQ(run_verify(request).verdict, Verdict::no_contact);
  EXPECT_GT(std::filesystem::file_size(proof), 100U);
}

/// Keeps the bytes of a proof, and counts what is asked of it.
struct Asked {
  std::string bytes;
  int opened = 0;
  std::uint64_t dropped = 0;  ///< bytes that were taken back

  std::unique_ptr<Sink> open() {
    class Kept : public Sink {
     public:
      explicit Kept(Asked& asked) : asked_(asked) {}
      void write(std::string_view piece) override { asked_.bytes += piece; }
      void sync() override {}
      void truncate(std::uint64_t size) override {
        asked_.dropped += asked_.bytes.size() - size;
        asked_.bytes.resize(size);
      }

     private:
      Asked& asked_;
    };
    ++opened;
    return std::make_unique<Kept>(*this);
  }
};

TEST_F(VerifyInProcess, WritesTheSameProofAtOnce) {
  for (const double x : {1.5, 0.25}) {
    std::array<Asked, 2> asked;
    for (const bool at_once : {false, true}) {
      VerifyRequest request = falling(x);
      request.keep_going = true;
      if (x < 1) std::swap(request.frames[1], request.frames[2]);  // so the first step touches
      request.open_proof = [&](const Claim&) { return asked[at_once ? 1 : 0].open(); };
      request.open_proof_at_once = at_once;
      const VerifyOutcome outcome = run_verify(request);
      EXPECT_EQ(outcome.touches(), x < 1);
      EXPECT_EQ(outcome.witnesses, x < 1 ? 2U : 0U);
    }
    EXPECT_EQ(asked[0].opened, 1);
    EXPECT_EQ(asked[1].opened, 1);
    EXPECT_EQ(asked[0].dropped, 0U);
    EXPECT_TRUE(asked[0].bytes == asked[1].bytes) << asked[0].bytes.size() << ", " << asked[1].bytes.size();
  }
}

/// 4,000 triangles side by side, and behind them two that meet.
TEST_F(VerifyInProcess, TakesBackWhatItWroteBeforeTheContact) {
  const auto frame = [&](const std::string& name, double height) {
    std::string vertices, faces;
    auto add = [&, v = 1](double x, double z) mutable {
      for (const auto& [dx, y] : {std::pair{0.0, 0.0}, {0.5, 0.0}, {0.0, 0.5}}) {
        vertices += fmt::format("v {} {} {}\n", x + dx, y, z);
      }
      faces += fmt::format("f {} {} {}\n", v, v + 1, v + 2);
      v += 3;
    };
    for (int i = 0; i < 4000; ++i) add(i, 0);
    add(4000, 0);
    add(4000, height);
    return folder.write(name, vertices + faces);
  };
  VerifyRequest request;
  request.frames = {frame("a.obj", 1), frame("b.obj", -1)};
  request.threads = 1;
  std::array<Asked, 2> asked;
  for (const bool at_once : {false, true}) {
    request.open_proof = [&](const Claim&) { return asked[at_once ? 1 : 0].open(); };
    request.open_proof_at_once = at_once;
    const VerifyOutcome outcome = run_verify(request);
    EXPECT_EQ(outcome.verdict, Verdict::contact);
    EXPECT_EQ(outcome.witnesses, 1U);
  }
  EXPECT_EQ(asked[0].dropped, 0U);
  EXPECT_GT(asked[1].dropped, 10'000U);
  EXPECT_EQ(asked[1].opened, 1);
  EXPECT_TRUE(asked[0].bytes == asked[1].bytes);
}

TEST_F(VerifyInProcess, TellsItsProgress) {
  VerifyRequest request = falling(1.5);
  std::set<std::string> works;
  double last = 0;
  request.progress = [&](std::string_view work, double share) {
    works.insert(std::string(work));
    last = share;
  };
  run_verify(request);
  EXPECT_EQ(works, (std::set<std::string>{"look", "verify"}));
  EXPECT_EQ(last, 1);
}

TEST_F(VerifyInProcess, AStopLeavesItUndecided) {
  VerifyRequest request = falling(1.5);
  const std::atomic<bool> stop = true;
  request.stop = &stop;
  const VerifyOutcome outcome = run_verify(request);
  EXPECT_EQ(outcome.verdict, Verdict::undecided);
  EXPECT_FALSE(outcome.complete);
  EXPECT_TRUE(outcome.interrupted);
}

/// A checker that received only part of the proof gives no verdict.
TEST_F(VerifyInProcess, AProofThatAStopHasCutIsNotJudged) {
  const VerifyRequest request = falling(1.5);
  std::atomic<bool> stop = false;
  CheckRequest asked{.trajectory = request.frames, .stop = &stop, .programs = NOLI_PROGRAMS};
  CheckerProcess whole(asked);
  whole.write("no proof");
  EXPECT_EQ(whole.finish()->code, 3);
  CheckerProcess cut(asked);
  stop = true;
  cut.write("no proof");
  stop = false;
  EXPECT_FALSE(cut.finish().has_value());
}

/// What is taken back after the first group makes another checker begin; anything else does not.
TEST_F(VerifyInProcess, ACheckerBeginsAgain) {
  const VerifyRequest request = falling(1.5);
  std::optional<CheckerProcess> checker;
  int started = 0;
  CheckerSink sink([&]() -> CheckerProcess& {
    ++started;
    return checker.emplace(CheckRequest{.trajectory = request.frames, .programs = NOLI_PROGRAMS});
  });
  sink.write("first ");
  sink.sync();
  sink.write("group");
  sink.sync();
  sink.write(" and more");
  sink.truncate(12);
  sink.write(" than that");
  EXPECT_EQ(started, 1);
  sink.truncate(11);
  EXPECT_EQ(started, 1) << "nobody may need another one";
  sink.write(" and other");
  EXPECT_EQ(started, 2);
  EXPECT_EQ(checker->finish()->code, 3);
}

/// A checker that reads nothing holds nobody up: threads that write to it hear what the thread that started it hears.
TEST_F(VerifyInProcess, AThreadThatWritesToACheckerHearsStops) {
  const auto program = folder.write("noli_check", "#!/bin/sh\nexec sleep 60\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  const std::string proof(1 << 20, ' ');
  const auto write = [&](const CheckRequest& asked, const std::function<void()>& meanwhile) {
    CheckerProcess checker(asked);
    auto writer = std::async(std::launch::async, [&] { checker.write(proof); });
    meanwhile();
    writer.get();
    EXPECT_FALSE(checker.finish().has_value());
  };
  const auto begin = std::chrono::steady_clock::now();
  std::atomic<bool> stop = false;
  CheckRequest asked{.stop = &stop, .programs = program.parent_path()};
  write(asked, [&] { stop = true; });
  asked.stop = nullptr;
  asked.deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(50);
  write(asked, [] {});
  asked.deadline.reset();
  std::atomic<bool> stop_here = false;
  const StopOfThread of_thread(stop_here);
  write(asked, [&] { stop_here = true; });
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
}

/// Whoever writes to a checker hears that the machine failed it, as whoever waits for it does.
TEST_F(VerifyInProcess, ACheckerThatTheMachineFailedWhileItReadIsAHelpersError) {
  const std::string proof(1 << 20, ' ');
  for (const char* const end : {"kill -KILL $$", "echo 'out of memory'; exit 4"}) {
    const auto program = folder.write("noli_check", std::string("#!/bin/sh\n") + end + "\n");
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    CheckerProcess checker(CheckRequest{.programs = program.parent_path()});
    EXPECT_THROW(checker.write(proof), HelperError) << end;
  }
}

TEST_F(VerifyInProcess, ACheckerThatReadsNoMoreAndStaysIsEndedByAStop) {
  const auto program = folder.write("noli_check", "#!/bin/sh\nexec 0<&-\nexec sleep 60\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(50);
  CheckerProcess checker(CheckRequest{.deadline = deadline, .programs = program.parent_path()});
  checker.write(std::string(1 << 20, ' '));
  EXPECT_FALSE(checker.finish().has_value());
}

TEST_F(VerifyInProcess, TwoAtOnceHaveStopsOfTheirOwn) {
  const VerifyRequest goes_on = falling(1.5);
  VerifyRequest stopped = goes_on;
  const std::atomic<bool> stop = true;
  stopped.stop = &stop;
  auto other = std::async(std::launch::async, [&] { return run_verify(goes_on).verdict; });
  EXPECT_EQ(run_verify(stopped).verdict, Verdict::undecided);
  EXPECT_EQ(other.get(), Verdict::no_contact);
}

TEST_F(VerifyInProcess, AStopOfItsOwnEndsItsWaitForAPipe) {
  VerifyRequest request = falling(1.5);
  std::filesystem::remove(request.frames[0]);
  ASSERT_EQ(::mkfifo(request.frames[0].c_str(), 0600), 0);
  std::atomic<bool> stop = false;
  request.stop = &stop;
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stop = true;
  });
  const VerifyOutcome outcome = run_verify(request);
  later.join();
  EXPECT_EQ(outcome.verdict, Verdict::undecided);
  EXPECT_TRUE(outcome.interrupted);
}

TEST_F(VerifyInProcess, BadInputIsAnException) {
  VerifyRequest request = falling(1.5);
  request.frames.push_back(folder.write("3.obj", "v 0 0\n"));
  EXPECT_THROW(run_verify(request), InputError);
}

}  // namespace
}  // namespace noli

// SPDX-License-Identifier: Apache-2.0
//
// The proof of a step that is passed on while the step is decided.
#include "proofs/prover/early_tokens.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#include "proofs/prover/verifier.h"
#include "scenes.h"

namespace noli::testing {
namespace {

/// Keeps what it gets.
class Taken : public ProofReceiver {
 public:
  void tree(std::span<const std::uint32_t> leaf_cells) override { order.assign(leaf_cells.begin(), leaf_cells.end()); }
  void tokens(std::string_view piece) override {
    EXPECT_FALSE(busy_.exchange(true)) << "two threads at once";
    bytes += piece;
    if (stop != nullptr) *stop = true;
    busy_ = false;
  }

  std::vector<std::uint32_t> order;
  std::string bytes;
  std::atomic<bool>* stop = nullptr;  ///< raised by the first tokens

 private:
  std::atomic<bool> busy_ = false;
};

/// A disk that is full from the first byte on.
class Full : public ProofReceiver {
  void tree(std::span<const std::uint32_t> /*leaf_cells*/) override {}
  void tokens(std::string_view /*bytes*/) override { throw std::runtime_error("full"); }
};

/// 14,400 faces, with a pair of loose edges behind them that no direction separates for long; they meet or not.
Step sheets_and_edges(bool meet) {
  Step step = two_sheets(7, 60, 0);
  const double hair = meet ? 0 : 0x1p-5;
  const VertexId v = step.vertex({999, 0, 0});
  step.vertex({1001, 0, 0});
  step.vertex({1000, -1, hair}, {1000, -hair, -1});
  step.vertex({1000, 1, hair}, {1000, -hair, 1});
  step.mesh.edges = {{v, v + 1}, {v + 2, v + 3}};
  return step;
}

VerifyResult proved(const Step& step, int threads, ProofReceiver* receiver) {
  VerifyOptions options;
  options.threads = threads;
  options.prove = true;
  options.receiver = receiver;
  return verify_step(step.mesh, step.x_t0, step.x_t1, options);
}

TEST(EarlyTokens, AreThoseOfTheWholeProof) {
  std::vector<Step> steps = {sheets_and_edges(false), two_sheets(7, 3, 0)};
  steps.emplace_back().face({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  for (const Step& step : steps) {
    const VerifyResult whole = proved(step, 1, nullptr);
    ASSERT_TRUE(whole.proof);
    std::string bytes;
    whole.proof->tokens.give([&](std::string_view piece) { bytes += piece; });
    for (const int threads : {1, 2, 5}) {
      Taken taken;
      const VerifyResult result = proved(step, threads, &taken);
      ASSERT_TRUE(result.complete && result.receiver_has_proof);
      EXPECT_FALSE(result.proof);
      EXPECT_EQ(taken.order, whole.proof->leaf_cells);
      EXPECT_TRUE(taken.bytes == bytes) << taken.bytes.size() << " of " << bytes.size() << " bytes";
      EXPECT_EQ(result.obligations, whole.obligations);
    }
  }
}

TEST(EarlyTokens, CountForNothingIfSomethingTouchesLater) {
  const Step step = sheets_and_edges(true);
  for (const int threads : {1, 2}) {
    Taken taken;
    const VerifyResult result = proved(step, threads, &taken);
    EXPECT_TRUE(result.complete);
    EXPECT_EQ(result.contact_count(), 1u);
    EXPECT_FALSE(result.proof || result.receiver_has_proof);
    EXPECT_FALSE(taken.bytes.empty()) << "the edges are behind most of the faces";
  }
}

TEST(EarlyTokens, EndWithTheErrorOfTheReceiver) {
  for (const int threads : {1, 3}) {
    Full full;
    EXPECT_THROW(proved(sheets_and_edges(false), threads, &full), std::runtime_error);
  }
}

/// The first tokens raise the stop, so they came before the end.
TEST(EarlyTokens, EndWithAStop) {
  const Step step = sheets_and_edges(false);
  Taken all;
  ASSERT_TRUE(proved(step, 1, &all).receiver_has_proof);
  std::atomic<bool> stop = false;
  VerifyOptions options;
  options.threads = 1;
  options.prove = true;
  options.stop = &stop;
  Taken taken;
  taken.stop = &stop;
  options.receiver = &taken;
  const VerifyResult result = verify_step(step.mesh, step.x_t0, step.x_t1, options);
  EXPECT_FALSE(result.complete || result.proof || result.receiver_has_proof);
  EXPECT_LT(taken.bytes.size(), all.bytes.size() / 2);
  EXPECT_TRUE(all.bytes.starts_with(taken.bytes));
}

}  // namespace
}  // namespace noli::testing

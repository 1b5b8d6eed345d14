// SPDX-License-Identifier: Apache-2.0
//
// Inspects proofs through the public interface: what they say of themselves, damage, progress, stops.
#include <noli/proof.h>
#include <noli/verify.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include <noli/errors.h>
#include "tests/support/temporary_folder.h"

namespace noli {
namespace {

class InspectedProof : public testing::Test {
 protected:
  /// Two triangles in parallel planes, this far apart.
  std::string frame(const std::string& name, const std::string& z) const {
    return folder
        .write(name, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 " + z + "\nv 1 0 " + z + "\nv 0 1 " + z + "\nf 1 2 3\nf 4 5 6\n")
        .string();
  }

  /// Two steps. The triangles meet in the second one if `last` is negative.
  VerifyRequest request(const std::string& last) const {
    VerifyRequest request;
    request.frames = {frame("0.obj", "2"), frame("1.obj", "1"), frame("2.obj", last)};
    std::filesystem::remove(proof);
    request.open_proof = proof_to_file(proof);
    return request;
  }

  test::TemporaryFolder folder;
  const std::filesystem::path proof = folder / "proof.noli";
};

TEST_F(InspectedProof, SaysWhatItIsAbout) {
  VerifyRequest asked = request("0.5");
  asked.strict = true;
  asked.min_distance = 0.25;
  const VerifyOutcome outcome = run_verify(asked);
  ASSERT_EQ(outcome.verdict, Verdict::no_contact);
  ASSERT_TRUE(is_proof(proof));
  const ProofInfo info = inspect_proof(proof);
  EXPECT_EQ(info.motion, outcome.claim.motion);
  EXPECT_EQ(info.dimension, 3);
  EXPECT_TRUE(info.strict);
  EXPECT_FALSE(info.points);
  EXPECT_EQ(info.distance, 0.25);
  EXPECT_EQ(info.ring, outcome.claim.ring);
  EXPECT_EQ(info.merged, 0U);
  EXPECT_EQ(info.excluded, outcome.claim.excluded.size());
  EXPECT_EQ(info.steps, 2U);
  EXPECT_EQ(info.contacts, 0U);
  EXPECT_EQ(info.from, outcome.claim.from);
  EXPECT_EQ(info.to, outcome.claim.to);
  EXPECT_GT(info.token_bytes, 0U);
  EXPECT_EQ(info.bytes, std::filesystem::file_size(proof));
  EXPECT_FALSE(info.open_group);
}

TEST_F(InspectedProof, CountsWitnessesOfContact) {
  ASSERT_EQ(run_verify(request("-1")).verdict, Verdict::contact);
  const ProofInfo info = inspect_proof(proof);
  EXPECT_EQ(info.steps, 2U);
  EXPECT_EQ(info.contacts, 1U);
}

TEST_F(InspectedProof, EndsWhereItsWriterWasStopped) {
  ASSERT_EQ(run_verify(request("0.5")).verdict, Verdict::no_contact);
  std::filesystem::resize_file(proof, std::filesystem::file_size(proof) - 1);
  const ProofInfo info = inspect_proof(proof);
  EXPECT_TRUE(info.open_group);
  EXPECT_LT(info.steps, 2U);
  std::filesystem::resize_file(proof, 16);
  EXPECT_TRUE(is_proof(proof));
  EXPECT_THROW(inspect_proof(proof), InputError);
}

TEST_F(InspectedProof, AnotherFileIsAnInputError) {
  const std::string mesh = frame("0.obj", "1");
  EXPECT_FALSE(is_proof(mesh));
  EXPECT_FALSE(is_proof(folder / "none"));
  EXPECT_THROW(inspect_proof(mesh), InputError);
  EXPECT_THROW(inspect_proof(folder / "none"), InputError);
}

TEST_F(InspectedProof, TellsItsProgress) {
  run_verify(request("0.5"));
  std::vector<double> shares;
  inspect_proof(proof, nullptr, [&](double share) { shares.push_back(share); });
  ASSERT_GE(shares.size(), 2U);
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_EQ(shares.back(), 1);
}

TEST_F(InspectedProof, AStopOfItsOwnEndsIt) {
  run_verify(request("0.5"));
  std::atomic<bool> stop = false;
  EXPECT_THROW(inspect_proof(proof, &stop, [&](double) { stop = true; }), Stopped);
  stop = false;
  EXPECT_EQ(inspect_proof(proof, &stop).steps, 2U);
}

}  // namespace
}  // namespace noli

// SPDX-License-Identifier: Apache-2.0
// Certifies two frames in files, writes the proof, and has the separate checker judge it.
//   check_proof FOLDER-OF-NOLI_CHECK BEFORE AFTER PROOF
#include <cstdio>
#include <exception>

#include <noli/proof.h>
#include <noli/verify.h>

int main(int argc, char** argv) try {
  if (argc != 5) return 3;
  noli::VerifyRequest request;
  request.frames = {argv[2], argv[3]};
  request.open_proof = noli::proof_to_file(argv[4]);
  const noli::VerifyOutcome outcome = noli::run_verify(request);
  const noli::CheckerVerdict verdict = noli::check_proof(
      {.proof = argv[4], .trajectory = request.frames, .asked = noli::fields_of(outcome.claim), .programs = argv[1]});
  std::printf("%s", verdict.words.substr(0, verdict.words.find('\n') + 1).c_str());
  return verdict.code;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 3;
}

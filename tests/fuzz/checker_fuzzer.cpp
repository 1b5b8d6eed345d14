// SPDX-License-Identifier: Apache-2.0
//
// Fuzzes the proof checker: any bytes give a verdict. It never accepts a proof that touching frames stay apart, nor a
// witness of contact for frames that stay apart.
//
// Input, by its first byte:
//   P       a proof file, about edges that pass each other
//   C, c    two bytes for the length of a tree, the tree and tokens, about edges that touch; c: with a distance and a
//           ring
//   W, w    a witness, about edges that pass each other; w: with a distance
//   L, O    a frame, PLY or OBJ
#include <sys/mman.h>

#include "tests/checker/proof_writer.h"

namespace {

using namespace noli::checker::test;
/// Aborts, which the fuzzer reports as a finding.
void require(bool condition) {
  if (!condition) std::abort();
}

/// A file in memory that has a path.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes) : file_(memfd_create("input", 0)) {
    require(file_ >= 0 && write(file_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()));
  }
  ~MemoryFile() { close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::string name() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

/// Writes the frames to a folder that exists once per process; returns their paths.
std::vector<std::string> frames(const Proof& proof, const std::string& prefix) {
  static const Folder folder;
  std::vector<std::string> paths;
  for (std::size_t i = 0; i < proof.frames.size(); ++i)
    paths.push_back(folder.write(prefix + std::to_string(i) + ".obj", obj(proof.frames[i], proof.cells)));
  return paths;
}
Proof crossing() {
  Proof proof = two_edges();
  for (auto& x : proof.frames[1]) x[0] = -x[0];
  return proof;
}
Verdict ask(const std::string& proof, bool touching) {
  static const auto passing_frames = frames(two_edges(), "p"), touching_frames = frames(crossing(), "t");
  const MemoryFile file(proof);
  return verdict(file.name(), touching ? touching_frames : passing_frames);
}

void fuzz(char mode, const std::string& rest) {
  if (mode == 'P') ask(rest, false);
  if (mode == 'L' || mode == 'O') {
    try {
      noli::checker::Reader text(rest, "input");
      mode == 'L' ? noli::checker::PlyReader(text).read() : noli::checker::read_obj(text);
    } catch (const noli::checker::Rejected&) {
    }
  }
  Proof proof = mode == 'C' || mode == 'c' ? crossing() : two_edges();
  if (mode == 'c') proof.claim.ring = 3;
  if (mode == 'c' || mode == 'w') proof.claim.eta = 1;
  if ((mode == 'C' || mode == 'c') && rest.size() > 2) {
    const std::size_t length = static_cast<unsigned char>(rest[0]) + 256u * static_cast<unsigned char>(rest[1]);
    proof.tree = rest.substr(2, length);
    proof.tokens = {rest.substr(2 + proof.tree.size())};
    if (!proof.tree.empty()) require(ask(block_file("PROF", proof.groups()), true).code != 0);
  }
  if ((mode == 'W' || mode == 'w') && !rest.empty()) {
    proof.tokens.clear();
    proof.witness = {rest};
    require(ask(block_file("PROF", proof.groups()), false).code != 1);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 0) fuzz(static_cast<char>(data[0]), {reinterpret_cast<const char*>(data) + 1, size - 1});
  return 0;
}

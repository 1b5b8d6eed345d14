// SPDX-License-Identifier: Apache-2.0
//
// Checkers side by side: each looks at a part of the steps of one proof (proofs/FORMAT.md, section 6, "Parts").
//
// Parts are cut so that each has about as many bytes of tokens, as these take most of a checker's time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "certify/proofs/checker.h"

namespace noli {

/// The first steps, counted from 1, of so many parts of a proof, or of as many as it has steps. Nothing if it cannot be
/// parted: it is in no regular file, it is not a file of whole blocks, or it has a witness, which refutes all of it.
std::vector<std::uint64_t> parts_of_proof(const std::filesystem::path& proof, std::size_t parts);

/// How many steps a proof in a file has; 0 if it cannot be parted.
std::uint64_t steps_of_proof(const std::filesystem::path& proof);

/// The steps of a part, as checkers are asked for them: "17..32", or "33.." for the last one.
std::string steps_of_part(const std::vector<std::uint64_t>& firsts, std::size_t part);

/// Why not: what is said of such a proof, after its name.
inline constexpr const char* proof_cannot_be_cut =
    "cannot be cut into parts, as it has a witness, is damaged, or is not a regular file";

/// If one word is about steps, and is steps=A..B or steps=A..: takes it out of those that are asked, and returns its
/// value.
std::optional<std::string> take_part(std::vector<std::string>& asked);

/// Asks for the steps A..B or A.. instead of N, which is returned: 0 if the words do not say steps=N. To the end means
/// as far as N at least: throws InputError if the proof has fewer.
std::uint64_t ask_for_part(const std::string& steps, const std::filesystem::path& proof,
                           std::vector<std::string>& asked);

/// N of the one word steps=N; 0 if no word is about steps; nothing if they ask for something else, or twice.
std::optional<std::uint64_t> asked_steps(const std::vector<std::string>& asked);

/// The first steps, from 1, of the parts that so many checkers take. Nothing if one should look at all steps: the proof
/// or its trajectory cannot be read by several, the proof has a witness or is small, or a part of it is asked for.
/// Precondition: request.proof.
std::vector<std::uint64_t> parts_of_check(const CheckRequest& request, int checkers);

/// What checkers, `threads` at once, say of the parts from `begin` on and before `end`; nothing of one that is not
/// accepted, or whose checker failed. After such a part the others are not checked to their end, unless request.stop is
/// in use.
std::vector<std::string> words_of_parts(const CheckRequest& request, const std::vector<std::uint64_t>& firsts,
                                        std::size_t begin, std::size_t end, int threads);

/// What one checker would say of all steps, from what checkers said of the parts, in order. Nothing if not all of them
/// accept parts of one proof that follow each other from step 1, or if there are fewer than `least_steps`.
/// Precondition: the last part was asked for with an open end, so that it comes to the end of the trajectory.
std::optional<std::string> joined_words(const std::vector<std::string>& words, std::uint64_t least_steps);

/// Has request.checkers look at a part of the steps each, at the same time. Returns what one checker would say if all
/// of them accept. Otherwise returns nothing, and one checker should look at all steps.
/// Precondition: request.proof.
std::optional<CheckerVerdict> accepted_in_parts(const CheckRequest& request);

}  // namespace noli

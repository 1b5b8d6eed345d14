// SPDX-License-Identifier: Apache-2.0
//
// The fields of a claim that a checker is asked for, as words: "motion=rest", "strict" (proofs/FORMAT.md, section 6).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace noli {

/// "motion" of "motion=rest".
std::string field_of(const std::string& word);

/// Whether one of the words is about this field.
bool asks(const std::vector<std::string>& words, const std::string& field);

/// Asks also for the fields of a file CLAIM.json that the words do not name. Throws InputError.
void ask_for_claim(const std::filesystem::path& claim, std::vector<std::string>& words);

/// Asks for all windows that the log of a run tells of, where some are missing. What cannot be read is the checker's to
/// say. Remarks about the log are added to `notes`. Throws InputError when the log is damaged, or has another hash of
/// what is there.
void ask_for_all_windows(const std::filesystem::path& run, std::vector<std::string>& words,
                         std::vector<std::string>& notes);

}  // namespace noli

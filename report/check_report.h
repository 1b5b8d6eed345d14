// SPDX-License-Identifier: Apache-2.0
//
// The words of `noli check`: its JSON, and its answer for people and machines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <noli/proof.h>
#include "certify/json.h"
#include "report/answer.h"

namespace noli::report {

/// Why a checker may accept no proof of a run in its present state.
enum class RunState { complete, only_frames, open_window, being_written };

/// What a checker said of a proof, and what it was asked.
struct Checked {
  CheckerVersion checker;
  std::filesystem::path proof;
  std::vector<std::string> asked;  ///< as CheckRequest::asked
  CheckerVerdict verdict;
  std::vector<std::string> notes;
  std::uint64_t least_steps = 0;  ///< of a part: how many steps the whole has to have, by a claim or the log of a run
  std::size_t joined = 0;         ///< from so many answers about parts; 0: the checker looked at all that was asked
  RunState run = RunState::complete;  ///< of the run that was checked; not looked for if the proof was accepted
};

/// Schema check.
Json check_json(const Checked& checked);

Answer check_answer(const Checked& checked);

}  // namespace noli::report

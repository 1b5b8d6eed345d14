// SPDX-License-Identifier: Apache-2.0
//
// What is in a file or a run: the JSON of `noli info`, and its answer for people and machines.
#pragma once

#include <filesystem>

#include "certify/json.h"
#include "report/answer.h"

namespace noli::report {

/// One of the "files" of schema info: frames, queries (CSV), a proof, or the folder of a run. Reads all of it; of a
/// file with many frames, the first frame. Throws InputError, HelperError, Stopped, std::system_error.
Json file_info_json(const std::filesystem::path& path);

/// `json`: schema info.
Answer info_answer(const Json& json);

}  // namespace noli::report

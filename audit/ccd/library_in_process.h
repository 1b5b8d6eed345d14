// SPDX-License-Identifier: Apache-2.0
//
// Asks somebody else's library of continuous collision detection in this very process, each query once: for a debugger,
// or a sanitizer, which are to see the library's call. Nothing protects this process from the library.
#pragma once

#include <filesystem>
#include <vector>

#include "audit/ccd/ccd_library.h"

namespace noli::audit {

/// The answers, without times of computation. Throws InputError: the library cannot be loaded, or lacks the functions.
LibraryAnswers ask_in_process(const std::filesystem::path& library, int kind, const std::vector<AskedQuery>& queries,
                              double tolerance);

}  // namespace noli::audit

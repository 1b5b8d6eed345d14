// SPDX-License-Identifier: Apache-2.0
//
// The request whose steps are decided in shards, as the file request.json of their folder.
#pragma once

#include <filesystem>
#include <string>

#include "certify/json.h"
#include "certify/verify_work.h"

namespace noli {

/// Whether proofs of its steps are made.
bool are_proved(const VerifyWork& request);

/// Everything that the findings depend on, with the version of Noli. Throws InputError when the file of --ignore cannot
/// be read.
Json request_json(const VerifyWork& request);

/// The request, without threads, limits and outputs. Throws Json::exception and std::logic_error for what
/// request_json() does not write.
VerifyWork request_of_json(const Json& json);

}  // namespace noli

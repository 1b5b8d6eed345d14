// SPDX-License-Identifier: Apache-2.0
//
// The request whose steps are decided in shards, as the file request.json of their folder.
#pragma once

#include <filesystem>
#include <string>

#include <noli/verify.h>
#include "certify/json.h"

namespace noli {

/// Whether proofs of its steps are made.
bool are_proved(const VerifyRequest& request);

/// Everything that the findings depend on, with the version of Noli. Throws InputError when the file of --ignore cannot
/// be read.
Json request_json(const VerifyRequest& request);

/// The request, without threads, limits and outputs. Throws Json::exception and std::logic_error for what
/// request_json() does not write.
VerifyRequest request_of_json(const Json& json);

}  // namespace noli

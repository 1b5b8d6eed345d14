// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "trajectory/formats/frame_look.h"

namespace noli {

/// The files of a run that `noli verify` reads and that do not change once it has ended: trajectory.blocks and, where
/// it is there, manifest.json, each with the SHA-256 of its bytes. Throws InputError; ReadInterrupted when `stop` says
/// true.
std::vector<FrameFacts> run_facts(const std::filesystem::path& run, const std::function<bool()>& stop);

}  // namespace noli

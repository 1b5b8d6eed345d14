// SPDX-License-Identifier: Apache-2.0
//
// Frames of a run as files of one pattern, whatever is written of each.
#pragma once

#include <filesystem>
#include <functional>

#include <noli/export.h>
#include <noli/mesh.h>

namespace noli {

using FrameWriter = std::function<void(const Frame& frame, const std::filesystem::path& path)>;

/// As run_export() does it, with files of any ending and without a series for ParaView.
ExportOutcome export_frames(const ExportRequest& request, const FrameWriter& write);

}  // namespace noli

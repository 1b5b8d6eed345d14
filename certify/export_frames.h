// SPDX-License-Identifier: Apache-2.0
//
// Exports the frames of a run as files of one pattern, with any writer.
#pragma once

#include <noli/export.h>
#include "certify/frame_files.h"

namespace noli {

/// Like run_export(), but with files of any extension and without a series for ParaView.
ExportOutcome export_frames(const ExportRequest& request, const FrameWriter& write);

}  // namespace noli

// SPDX-License-Identifier: Apache-2.0
//
// Frames that are named together: what stands for many files becomes the files.
//
//   DIR            the frames in a folder, which are all of one format; not for the folder of a run
//   shirt_*.obj    the files that match: * is any text, ? any letter, [a-c] one of those
//   f/%04d.ply     the files with a number there; %d takes numbers without leading zeros
//   cloth.pvd      the files of a series of ParaView
//   @frames.txt    the lines of a file; paths are relative to its folder, and # begins a comment
//
// All except those of a series and a list are sorted by the numbers in their names (noli/frames.h,
// FrameOrder::natural). If there is a file of a name with *, ?, [ or %, the name means that file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <noli/frames.h>

namespace noli {

/// The files, in the order in which they are named. Names of files, and of folders without frames, stay. Throws
/// InputError: nothing matches, a folder has frames of several formats, a list cannot be read or names nothing.
std::vector<std::filesystem::path> named_frames(std::vector<std::filesystem::path> given);

/// Orders the frames of each body. Notes on that are added to `notes`, with the body's name. Throws as order_frames().
void order_bodies(std::vector<BodyFrames>& bodies, FrameOrder order, std::vector<std::string>& notes);

/// All files of all bodies.
std::vector<std::filesystem::path> files_of(const std::vector<BodyFrames>& bodies);

/// Throws InputError if a single file or folder is named that does not exist. Otherwise the first complaint would be
/// that one frame has no motion.
void require_there(const std::vector<std::filesystem::path>& frames);

/// The files that are read to find out which frames are named: lists, without their @, and series.
std::vector<std::filesystem::path> files_named(const std::vector<std::filesystem::path>& given);

}  // namespace noli

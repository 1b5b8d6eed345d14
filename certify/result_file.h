// SPDX-License-Identifier: Apache-2.0
//
// Files and folders of results: whether they can be written, asked before the work begins; and how they are.
#pragma once

#include <filesystem>
#include <string>

namespace noli {

/// Writes the file under another name first and then renames it: it is complete or absent, and has the owner and
/// permissions of the one that it replaces. A file that may be written but not replaced (in a folder without write
/// permission, say), a device or a pipe is written in place. Throws WriteError.
void write_result(const std::string& path, const std::string& text);

/// Writes all of it to an open file. False, with errno, when that fails.
bool write_all(int descriptor, const std::string& text);

/// Throws UsageError, naming `option`, when the file cannot be written: one that is there, or a new one in its folder.
/// Leaves nothing behind.
void require_writable_file(const std::filesystem::path& file, const std::string& option);

/// Throws UsageError, naming `option`, when files cannot be made in this folder or, where there is none yet, in the one
/// that it would be in. Leaves nothing behind.
void require_writable_folder(const std::string& folder, const std::string& option);

/// Throws UsageError, naming `option`, when this is no program that can be started.
void require_program(const std::filesystem::path& program, const std::string& option);

/// Makes a folder, and those that it is in, unless it is there. Throws UsageError, naming `option`, when it cannot be
/// made, or no files in it.
void make_writable_folder(const std::filesystem::path& folder, const std::string& option);

}  // namespace noli

// SPDX-License-Identifier: Apache-2.0
//
// Writes files and folders of results, and checks before the work begins that they can be written.
#pragma once

#include <filesystem>
#include <string>

namespace noli {

/// Writes the file under another name first and then renames it: it is complete or absent, and has the owner and
/// permissions of the file that it replaces. A file that may be written but not replaced (for example in a folder
/// without write permission), a device or a pipe is written in place. Throws WriteError.
void write_result(const std::string& path, const std::string& text);

/// Where a path leads, with all symbolic links followed, also when there is no file at the end.
std::filesystem::path place_of(std::filesystem::path path);

/// Whether a path leads to a regular file or to nothing. Anything else, such as a device or a pipe, is never replaced.
bool is_regular_or_nothing(const std::filesystem::path& path);

/// Throws UsageError, naming `option`, when the file cannot be written, whether it exists or not. Leaves nothing
/// behind.
void require_writable_file(const std::filesystem::path& file, const std::string& option);

/// Throws UsageError, naming `option`, when files cannot be created in this folder or, if it does not exist, in its
/// parent. Leaves nothing behind.
void require_writable_folder(const std::string& folder, const std::string& option);

/// Throws UsageError, naming `option`, when this is not a program that can be started.
void require_program(const std::filesystem::path& program, const std::string& option);

/// Creates a folder and its parents, unless it exists. Throws UsageError, naming `option`, when it or files in it
/// cannot be created.
void make_writable_folder(const std::filesystem::path& folder, const std::string& option);

}  // namespace noli

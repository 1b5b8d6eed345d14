// SPDX-License-Identifier: Apache-2.0
//
// Finds the types that headers define, and types that two headers define under one name.
//
// Notation
//   type   a class, struct, union, enum or alias at namespace scope
//   name   with all its namespaces: "noli::certificates::Features"
//
// Forward declarations, specialisations, members of classes and what functions define are ignored. The preprocessor
// does not run, so a type counts even where an #if leaves it out.
//
// Programs that are never linked together have no exemption: checker, oracle, plug-ins and benchmarks have namespaces
// of their own.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace noli::repository {

/// The names of all types that a header defines.
std::set<std::string> defined_types(std::string_view header);

/// One line for each type that two or more headers below `root` define, except those of tests: "NAME: FILE, FILE".
std::vector<std::string> types_defined_twice(const std::filesystem::path& root);

}  // namespace noli::repository

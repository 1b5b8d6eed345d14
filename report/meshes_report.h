// SPDX-License-Identifier: Apache-2.0
//
// The words of `noli verify --static` for files with different meshes: a line for each, and one verdict for all.
#pragma once

#include <string>
#include <vector>

#include <noli/verify.h>
#include "certify/json.h"
#include "report/answer.h"

namespace noli::report {

/// What was found of one file.
struct MeshVerdict {
  std::string file;
  Verdict verdict = Verdict::undecided;
  Answer answer;                   ///< of noli verify for this file alone
  std::vector<std::string> notes;  ///< a line each
  bool empty = false;              ///< nothing in it can be compared
  Json json;                       ///< its result; null if nobody wants it
};

/// The worst of all: contact, too near, undecided, not checked, proved. Precondition: there is one at least.
Verdict verdict_of(const std::vector<MeshVerdict>& meshes);

/// Schema verify-meshes.
Json meshes_json(const std::vector<MeshVerdict>& meshes);

/// `details`: also what --verbose shows of each.
Answer meshes_answer(const std::vector<MeshVerdict>& meshes, bool details);

}  // namespace noli::report

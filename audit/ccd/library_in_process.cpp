// SPDX-License-Identifier: Apache-2.0
#include "audit/ccd/library_in_process.h"

#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <limits>

#include <noli/errors.h>
#include "audit/ccd/host/library.h"
#include "trajectory/text.h"

namespace noli::audit {

LibraryAnswers ask_in_process(const std::filesystem::path& library, int kind, const std::vector<AskedQuery>& queries,
                              double tolerance) {
  HostStatus status;
  const Library loaded = load(status, library.c_str(), false);
  require_loaded(library, status, {});
  LibraryAnswers result;
  result.endings.resize(queries.size());
  result.description = status.description.data();
  for (AskedQuery query : queries) {  // a copy, which the library may write to
    GivenAnswer answer{};
    answer.time = std::numeric_limits<double>::quiet_NaN();
    try {
      answer.code = loaded.ask(kind, query.x_t0.data(), query.x_t1.data(), tolerance, &answer.time);
    } catch (const std::exception& error) {
      throw InputError(
          library.string(), "",
          fmt::format("threw an exception: {}; `catch throw` in gdb stops where", on_one_line(error.what())));
    }
    answer.state = AnswerState::answered;
    result.answers.push_back(answer);
  }
  return result;
}

}  // namespace noli::audit

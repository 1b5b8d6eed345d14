// SPDX-License-Identifier: Apache-2.0
#include "certify/runs/run_inputs.h"

#include <system_error>

#include "trajectory/blocks/run_file.h"

namespace noli {

std::vector<FrameFacts> run_facts(const std::filesystem::path& run, const std::function<bool()>& stop) {
  std::vector<FrameFacts> facts = {file_facts(trajectory_path(run), stop)};
  const std::filesystem::path manifest = run / "manifest.json";
  std::error_code error;
  if (std::filesystem::exists(manifest, error)) facts.push_back(file_facts(manifest, stop));
  return facts;
}

}  // namespace noli

// SPDX-License-Identifier: Apache-2.0
#include "check_frame.h"
#include "trajectory/formats/vtk/vtu.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return noli::fuzz::check_reader(data, size, [](auto bytes, auto name) { return noli::parse_vtk(bytes, name); });
}

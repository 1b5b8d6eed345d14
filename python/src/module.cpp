// SPDX-License-Identifier: Apache-2.0
#include <pybind11/pybind11.h>
#include <pybind11/stl/filesystem.h>

#include <noli/version.h>
#include "certify/process/this_program.h"
#include "python/src/background.h"
#include "python/src/bindings.h"

PYBIND11_MODULE(_core, core) {
  using namespace noli::python;
  core.attr("version") = noli::version_number();
  core.attr("commit") = noli::version_commit();
  core.def("keep_programs_in", &noli::keep_programs_in);
  core.def("end_all_work", &end_all_work);
  core.def("forget_all_work", &forget_all_work);
  bind_errors(core);
  bind_verify(core);
  bind_check(core);
  bind_queries(core);
  bind_steps(core);
  bind_simulate(core);
  bind_run(core);
  bind_repair(core);
  bind_fuzz(core);
}

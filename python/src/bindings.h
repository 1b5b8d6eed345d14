// SPDX-License-Identifier: Apache-2.0
//
// The parts of the module noli._core. What people call is in python/noli, which checks arguments and has the manual;
// what is here takes them as they come out of there.
//
// Threads: work is done without the interpreter's lock (background.h), so other threads of Python go on meanwhile.
#pragma once

#include <pybind11/pybind11.h>

namespace noli::python {

/// Exceptions of Noli become those of the module noli._errors, of Python's own kinds where there is one.
void bind_errors(pybind11::module_& core);
/// verify(): frames in files or arrays, and runs; class Outcome.
void bind_verify(pybind11::module_& core);
/// check(): the checkers of proofs.
void bind_check(pybind11::module_& core);
/// contacts(): arrays of queries.
void bind_queries(pybind11::module_& core);
/// One step of a mesh, or one moment: class Steps.
void bind_steps(pybind11::module_& core);
/// class Simulation.
void bind_simulate(pybind11::module_& core);
/// Existing runs.
void bind_run(pybind11::module_& core);
/// repair().
void bind_repair(pybind11::module_& core);
/// Adversarial queries, if the audits are part of this build.
void bind_fuzz(pybind11::module_& core);

}  // namespace noli::python

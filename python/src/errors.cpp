// SPDX-License-Identifier: Apache-2.0
#include <pybind11/pybind11.h>

#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <noli/errors.h>
#include "python/src/bindings.h"

namespace noli::python {
namespace {

namespace py = pybind11;

void raise(const char* name, const char* what) {
  const py::object type = py::module_::import("noli._errors").attr(name);
  PyErr_SetString(type.ptr(), what);
}

/// OSError(errno, text), of which Python makes PermissionError and others.
void raise_system(const std::system_error& error) {
  const py::tuple arguments = py::make_tuple(error.code().value(), error.what());
  PyErr_SetObject(PyExc_OSError, arguments.ptr());
}

/// What the command calls --force and --resume.
std::string in_python(std::string text) {
  for (const auto& [option, argument] : {std::pair("--force", "force=True"), std::pair("--resume", "resume=True")}) {
    const std::string_view name = option;
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at)) {
      text.replace(at, name.size(), argument);
    }
  }
  return text;
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(std::move(thrown));
  } catch (const InputError& error) {
    raise("InputError", in_python(error.what()).c_str());
  } catch (const UsageError& error) {
    raise("UsageError", in_python(error.what()).c_str());
  } catch (const Stopped& error) {
    raise("Stopped", error.what());
  } catch (const WriteError& error) {
    raise("WriteError", error.what());
  } catch (const HelperError& error) {
    raise("NoliError", error.what());
  } catch (const std::system_error& error) {
    raise_system(error);
  }
}

}  // namespace

void bind_errors(py::module_& /*core*/) { py::register_local_exception_translator(&translate); }

}  // namespace noli::python

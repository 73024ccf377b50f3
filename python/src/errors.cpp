// SPDX-License-Identifier: GPL-3.0-or-later
#include "errors.h"

#include <cassert>
#include <string>

namespace argil::python {
namespace {

// Borrowed from the module, which is never taken out of the interpreter.
PyObject* g_error = nullptr;
PyObject* g_bad_input = nullptr;
PyObject* g_device = nullptr;
PyObject* g_memory = nullptr;
PyObject* g_disk = nullptr;
PyObject* g_internal = nullptr;

PyObject* add_class(py::module_& module, const char* name, PyObject* also, const char* about) {
  const std::string full = std::string("argil.") + name;
  py::tuple bases = also == nullptr ? py::make_tuple(py::handle(g_error))
                                    : py::make_tuple(py::handle(g_error), py::handle(also));
  PyObject* made = PyErr_NewExceptionWithDoc(full.c_str(), about, bases.ptr(), nullptr);
  if (made == nullptr) throw py::error_already_set();
  module.add_object(name, made);
  return made;
}

PyObject* class_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::bad_input:
      return g_bad_input;
    case ErrorKind::device:
      return g_device;
    case ErrorKind::memory:
      return g_memory;
    case ErrorKind::disk:
      return g_disk;
    case ErrorKind::interrupted:
      return PyExc_KeyboardInterrupt;
    case ErrorKind::internal:
      break;
  }
  return g_internal;
}

}  // namespace

void add_errors(py::module_& module) {
  g_error = PyErr_NewExceptionWithDoc("argil.Error", "What Argil could not do, in one sentence.",
                                      PyExc_Exception, nullptr);
  if (g_error == nullptr) throw py::error_already_set();
  module.add_object("Error", g_error);
  g_bad_input = add_class(module, "BadInput", PyExc_ValueError,
                          "A file, number or option that cannot be used; nothing was changed.");
  g_device = add_class(module, "DeviceError", nullptr, "Hardware that is absent or faulty.");
  g_memory = add_class(module, "OutOfMemory", PyExc_MemoryError, "Would not fit, or did not.");
  g_disk = add_class(module, "DiskError", PyExc_OSError,
                     "A file could not be read or written; the one before is whole.");
  g_internal = add_class(module, "InternalError", nullptr, "A bug of Argil: please report it.");
}

void raise(const Error& error) {
  assert(g_error != nullptr);
  PyErr_SetString(class_of(error.kind), error.message.c_str());
  throw py::error_already_set();
}

void raise_bad_input(const std::string& message) { raise({ErrorKind::bad_input, message}); }

}  // namespace argil::python

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

namespace argil::python {

namespace py = pybind11;

void add_bridge(py::module_& module);

}  // namespace argil::python

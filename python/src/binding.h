// SPDX-License-Identifier: GPL-3.0-or-later
// pybind11 with all conversions that are used. A source without one of them would convert the same
// types otherwise than those with it, and the linker keeps one of the two.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace argil::python {

namespace py = pybind11;

}  // namespace argil::python

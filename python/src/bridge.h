// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "binding.h"

namespace argil::python {

void add_bridge(py::module_& module);

}  // namespace argil::python

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "binding.h"

namespace argil::python {

void add_pictures(py::module_& module);

}  // namespace argil::python

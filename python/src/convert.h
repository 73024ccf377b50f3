// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "argil/core/vec3.h"

#include "binding.h"

namespace argil::python {

/// What `--json` of the command line prints, as Python has it: dict, list, str, int, float, bool,
/// None.
py::object from_json(const nlohmann::ordered_json& json);

/// Three numbers of any sequence; throws BadInput that calls it `name`.
Vec3 vec3_of(const char* name, py::handle numbers);
/// A number; throws BadInput that calls it `name`.
double number_of(const std::string& name, py::handle value);
py::tuple tuple_of(const Vec3& v);

}  // namespace argil::python

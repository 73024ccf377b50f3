// SPDX-License-Identifier: GPL-3.0-or-later
#include "convert.h"

#include <array>
#include <cstdint>
#include <string>

#include "errors.h"

namespace argil::python {

py::object from_json(const nlohmann::ordered_json& json) {
  using Type = nlohmann::json::value_t;
  switch (json.type()) {
    case Type::object: {
      py::dict dict;
      for (const auto& [key, value] : json.items()) dict[py::str(key)] = from_json(value);
      return dict;
    }
    case Type::array: {
      py::list list;
      for (const auto& value : json) list.append(from_json(value));
      return list;
    }
    case Type::string:
      return py::str(json.get_ref<const std::string&>());
    case Type::boolean:
      return py::bool_(json.get<bool>());
    case Type::number_integer:
      return py::int_(json.get<std::int64_t>());
    case Type::number_unsigned:
      return py::int_(json.get<std::uint64_t>());
    case Type::number_float:
      return py::float_(json.get<double>());
    case Type::null:
    case Type::binary:
    case Type::discarded:
      break;
  }
  return py::none();
}

Vec3 vec3_of(const char* name, py::handle numbers) {
  try {
    const auto values = numbers.cast<std::array<double, 3>>();
    return {values[0], values[1], values[2]};
  } catch (const py::cast_error&) {
    raise_bad_input(std::string(name) + " is " + py::repr(numbers).cast<std::string>() +
                    "; give three numbers");
  }
}

double number_of(const std::string& name, py::handle value) {
  try {
    return value.cast<double>();
  } catch (const py::cast_error&) {
    raise_bad_input(name + " is " + py::repr(value).cast<std::string>() + "; give a number");
  }
}

py::tuple tuple_of(const Vec3& v) { return py::make_tuple(v.x, v.y, v.z); }

}  // namespace argil::python

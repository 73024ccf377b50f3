// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/scene/scene_parameters.h"

#include <algorithm>
#include <cassert>
#include <sstream>

namespace argil::haptics {
namespace {

Error unknown(std::string_view name, std::span<const SceneParameter> parameters) {
  std::string text = "the scene has no '" + std::string(name) + "'";
  if (parameters.empty()) return {ErrorKind::bad_input, text + ", nor anything else to set"};
  const char* before = "; what can be set is ";
  for (const SceneParameter& parameter : parameters) {
    text.append(before).append(parameter.name);
    before = ", ";
  }
  return {ErrorKind::bad_input, text};
}

Error out_of_range(const SceneParameter& parameter, double value) {
  const std::string unit = *parameter.unit != '\0' ? std::string(" ") + parameter.unit : "";
  std::ostringstream text;
  text << parameter.name << " is " << value << unit << "; must be from " << parameter.low << " to "
       << parameter.high << unit;
  return {ErrorKind::bad_input, text.str()};
}

}  // namespace

SceneValues::SceneValues(std::span<const SceneParameter> parameters) : parameters_(parameters) {
  for (const SceneParameter& parameter : parameters) {
    assert(parameter.low <= parameter.usual && parameter.usual <= parameter.high);
    values_.push_back(parameter.usual);
  }
}

Result<void> SceneValues::set(std::string_view name, double value) {
  const auto found = std::ranges::find(parameters_, name, &SceneParameter::name);
  if (found == parameters_.end()) return unknown(name, parameters_);
  // NaN is out of range, too.
  if (!(value >= found->low && value <= found->high)) return out_of_range(*found, value);
  values_[static_cast<std::size_t>(found - parameters_.begin())] = value;
  return {};
}

Result<void> SceneValues::set_all(const std::map<std::string, double>& values) {
  for (const auto& [name, value] : values) {
    if (auto good = set(name, value); !good) return good;
  }
  return {};
}

double SceneValues::operator[](std::string_view name) const noexcept {
  const auto found = std::ranges::find(parameters_, name, &SceneParameter::name);
  assert(found != parameters_.end());
  return values_[static_cast<std::size_t>(found - parameters_.begin())];
}

}  // namespace argil::haptics

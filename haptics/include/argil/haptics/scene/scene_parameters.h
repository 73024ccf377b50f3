// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "argil/core/result.h"

namespace argil::haptics {

/// A number of a scene that may be chosen.
struct SceneParameter {
  /// As the Falcon report writes it, where it does. Options and recordings use it, so it never
  /// changes.
  const char* name;
  const char* unit;  ///< "" for none
  double usual;
  double low;  ///< the least and the most that are allowed
  double high;
  const char* about;  ///< a few words
  /// Where it stands in the Falcon report; "" for what is not of that.
  const char* equation = "";
};

/// What a scene's parameters are, all of them usual at first. For one thread.
class SceneValues {
 public:
  /// `parameters` must outlive this.
  explicit SceneValues(std::span<const SceneParameter> parameters = {});

  /// Errors  bad_input naming the parameter, its value and its range, or what there is instead.
  Result<void> set(std::string_view name, double value);

  /// Of a parameter that the scene has.
  double operator[](std::string_view name) const noexcept;

  /// Sets all of them, or says what is wrong with the first that cannot be.
  Result<void> set_all(const std::map<std::string, double>& values);

  std::span<const SceneParameter> parameters() const noexcept { return parameters_; }

 private:
  std::span<const SceneParameter> parameters_;
  std::vector<double> values_;
};

}  // namespace argil::haptics

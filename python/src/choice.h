// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "errors.h"

namespace argil::python {

/// A word and what it stands for.
template <class Choice>
using Words = std::vector<std::pair<std::string, Choice>>;

/// What `value` stands for; throws BadInput that names all words there are.
template <class Choice>
Choice choice_of(const char* name, const std::string& value,
                 const Words<std::type_identity_t<Choice>>& known) {
  std::string all;
  for (const auto& [word, choice] : known) {
    if (value == word) return choice;
    all += (all.empty() ? "" : ", ") + word;
  }
  raise_bad_input(std::string(name) + " is '" + value + "'; must be one of " + all);
}

/// `value`, or BadInput where it is not from `least` to `most`; NaN is not.
inline double in_range(const std::string& name, double value, double least, double most) {
  if (value >= least && value <= most) return value;
  raise_bad_input(name + " is " + std::to_string(value) + "; must be from " +
                  std::to_string(least) + " to " + std::to_string(most));
}

}  // namespace argil::python

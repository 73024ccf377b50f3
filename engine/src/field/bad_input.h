// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sstream>
#include <string>
#include <utility>

#include "argil/core/result.h"

namespace argil {

/// `message` names the thing, its value and the remedy.
inline Error bad_input(std::string message) { return {ErrorKind::bad_input, std::move(message)}; }

/// A number as messages show it: six significant digits.
inline std::string number_text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

}  // namespace argil

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "keys/key_map.h"

namespace argil::viewer {

/// What the window remembers of the search.
struct SearchChoice {
  static constexpr std::size_t kMostRecent = 8;
  bool is_open = false;
  std::string text;    ///< ASCII, as it is typed
  std::size_t at = 0;  ///< of what is found
  /// A letter that is told no later than that is of the key which opened it, and is not typed.
  double skips_until_s = -1.0;
  std::vector<KeyAim> recent;  ///< what was done through it, newest first
};

}  // namespace argil::viewer

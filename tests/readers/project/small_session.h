// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <random>
#include <string>
#include <vector>

#include "argil/engine/clay.h"

#include "support/effort.h"
#include "support/stroke_maker.h"

namespace argil::io {

/// What sessions of the tests sculpt: a ball, by strokes that its number tells.
inline Clay small_clay() { return Clay::ball(6.0, {test::effort(0.5, 0.4), 0.1}).value(); }

inline Stroke small_stroke(unsigned n) {
  std::mt19937 random(n);
  return random_dab(random, 6.0);
}

inline std::string lines_of(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

}  // namespace argil::io

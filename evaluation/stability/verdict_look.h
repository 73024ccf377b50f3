// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "argil/haptics/analysis/hold_judgement.h"

namespace argil::evaluation {

/// How the maps of stability show a verdict: gnuplot's style of a box, and its name in the key.
struct VerdictLook {
  haptics::Verdict verdict;
  const char* style;
  const char* title;
};
inline constexpr std::array kVerdictLooks{
    VerdictLook{haptics::Verdict::quiet, "fs solid noborder lc rgb '#9ad0ae'", "quiet"},
    VerdictLook{haptics::Verdict::buzz, "fs solid noborder lc rgb '#f6c667'", "buzz"},
    VerdictLook{haptics::Verdict::limit_cycle, "fs solid noborder lc rgb '#d9694a'",
                "limit cycle"}};

}  // namespace argil::evaluation

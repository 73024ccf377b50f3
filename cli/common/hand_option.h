// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>

#include "argil/haptics/simulation/hand_model.h"

#include "common/options.h"

namespace argil::cli {

/// The hands that --hand names, in the order of their names, from the least to the most damped.
inline constexpr std::array kHands{haptics::Hand::push, haptics::Hand::light, haptics::Hand::arm,
                                   haptics::Hand::firm};

/// --hand; `hand` becomes an index into kHands.
inline CLI::Option* add_hand(CLI::App& app, std::size_t& hand, const std::string& help) {
  return add_choice(app, "--hand", hand, {"push", "light", "arm", "firm"}, help);
}

}  // namespace argil::cli

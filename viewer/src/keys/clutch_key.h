// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace argil::viewer {

/// While it is held the hand of a device moves without the tool, as to come back from the end of
/// its reach.
inline constexpr int kClutchKey = 'V';

}  // namespace argil::viewer

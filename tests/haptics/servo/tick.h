// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace argil::haptics {

inline constexpr double kTickS = 1e-3;  ///< of the usual servo

}  // namespace argil::haptics

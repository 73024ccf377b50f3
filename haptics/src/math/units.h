// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace argil::haptics {

/// Lengths are in mm, stiffness and damping per metre.
inline constexpr double kMmPerM = 1000.0;
/// Times are in s, but for those that go over a wire.
inline constexpr double kNsPerS = 1e9;

}  // namespace argil::haptics

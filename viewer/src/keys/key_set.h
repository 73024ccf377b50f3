// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace argil::viewer {

/// The keys that are built in: Argil's own, and for who comes from another program.
enum class KeySet { argil, blender, zbrush };
inline constexpr std::size_t kKeySetCount = 3;
/// In files, and as panels have them.
inline constexpr std::array<std::string_view, kKeySetCount> kKeySetNames{"argil", "blender",
                                                                         "zbrush"};
inline constexpr std::array<const char*, kKeySetCount> kKeySetTitles{"Argil", "Blender", "ZBrush"};

}  // namespace argil::viewer

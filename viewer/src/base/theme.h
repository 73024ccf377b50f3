// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace argil::viewer {

/// How panels and what is behind the clay are coloured.
enum class Theme { dark, light };
inline constexpr std::array<std::string_view, 2> kThemeNames{"dark", "light"};  // in settings.txt

/// Red, green, blue and opacity, 0 to 1, encoded as sRGB.
struct Paint {
  float r = 0.0F;
  float g = 0.0F;
  float b = 0.0F;
  float a = 1.0F;
};

/// All colours of a theme. Whatever is read is told from what it stands on by a contrast of 4.5 at
/// least (ThemeTest.EveryTextIsToldFromWhatItStandsOn), whatever is seen through that.
struct ThemeColors {
  // What texts stand on.
  Paint window;      ///< panels and status line
  Paint popup;       ///< menus, lists, tooltips, numbers over the picture
  Paint title;       ///< of the panel that is worked in
  Paint title_idle;  ///< of the others
  Paint frame;       ///< of fields, sliders and boxes to tick
  Paint frame_hovered;
  Paint frame_active;
  Paint button;
  Paint button_hovered;
  Paint button_active;
  Paint header;  ///< what is chosen in a list
  Paint header_hovered;
  Paint header_active;
  Paint grab;  ///< of sliders, below their numbers, and what is done of a bar
  Paint grab_active;

  // Texts. What is said beside, and what cannot be done now, is weaker; both are read.
  Paint text;
  Paint weak_text;
  Paint heading;
  Paint done;
  Paint warning;
  Paint error;
  Paint told;  ///< of a device: what it does

  // What is no text.
  Paint mark;  ///< ticks and plots
  Paint mark_active;
  Paint line;  ///< between parts of a panel
  // Pictures of tools: the air around the clay, the clay, its edge, and where it was.
  Paint air;
  Paint clay;
  Paint masked;
  Paint edge;
  Paint before;
  Paint hand;
  // Lines over the picture, as lassos: of a mask, of a trim, of a stroke to come.
  Paint mask_line;
  Paint trim_line;
  Paint guide;
  // Behind the clay, at the lower and the upper edge of the picture.
  Paint ground_low;
  Paint ground_high;
};
const ThemeColors& colors_of(Theme theme) noexcept;

/// The luminance of an opaque colour, 0 (black) to 1 (white).
///
/// Source  Web Content Accessibility Guidelines 2.1, "relative luminance".
double luminance_of(const Paint& opaque) noexcept;

/// A colour as it is seen over an opaque one.
Paint seen_over(const Paint& color, const Paint& below) noexcept;

/// How well two opaque colours are told apart: 1 (not at all) to 21; 4.5 is enough for text.
///
/// Source  Web Content Accessibility Guidelines 2.1, "contrast ratio" and success criterion 1.4.3.
double contrast_of(const Paint& one, const Paint& other) noexcept;

}  // namespace argil::viewer

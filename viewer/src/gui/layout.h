// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <imgui.h>

namespace argil::viewer {

/// Pixels of the screen in one of those that sizes here are given in: of a screen whose letters are
/// kLetterPixels high. Every size of a panel is a multiple of it, or comes from the letters.
float unit();

/// How many times larger letters are than kLetterPixels: as the screen asks for (`content_scale`),
/// times what the user chose, but no larger than that a window of this size has room for all
/// panels.
double scale_of_panels(double content_scale, int percent, int width, int height);

/// As many letters of a text as fit into so many pixels, from its beginning or to its end, with
/// dots for the others.
std::string fitted(std::string text, float width);
std::string fitted_end(std::string text, float width);

/// The colour of what stops the force, or tells that it is stopped.
inline const ImVec4 kStopColor{0.75F, 0.10F, 0.08F, 1.0F};
/// That of what gives it again, and of the text on either, whatever the theme.
inline const ImVec4 kGiveColor{0.20F, 0.47F, 0.20F, 1.0F};
inline const ImVec4 kOnStopColor{1.0F, 1.0F, 1.0F, 1.0F};

// All below in units.

/// Where panels begin that open beside the tools.
inline constexpr float kBesideTools = 162.0F;

/// Where panels that are opened begin, each at a position of its own: from the tools to the brush.
inline constexpr float kDevicePanelLeft = kBesideTools;
inline constexpr float kPiecesPanelLeft = kBesideTools + 56.0F;      // of tools in three columns
inline constexpr float kPrintPanelLeft = kPiecesPanelLeft + 278.0F;  // beside either
inline constexpr float kHistoryPanelLeft = kDevicePanelLeft + 596.0F;

/// Puts the next panel below the menu when it is first opened, farther left where the screen ends.
void put_beside(float left, float width);

/// Makes the next panel this wide and no higher than the screen: what does not fit scrolls.
void keep_on_screen(float width);

}  // namespace argil::viewer

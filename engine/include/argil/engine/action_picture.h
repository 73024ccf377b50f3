// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace argil {

/// The surface of a piece of clay in section: a height over x from -1 to 1, in the same unit; 0 is
/// the ground. All parts add up, then what lies inside the tool, |x| < kHalfWidth, is clamped.
/// The window shows heights from -0.56 to 0.84. The default is flat ground.
struct PictureProfile {
  /// Of the tool; beside it the profile is shown as it adds up.
  static constexpr float kHalfWidth = 0.66F;

  float wave = 0.0F;  ///< amplitude of ripples over the whole width

  // A rounded bump: its height, negative for a hollow, and where it stands.
  float bump = 0.0F;
  float middle = 0.0F;
  // How far it reaches to either side of that; above 0. Unequal ones make it lean.
  float left = 1.0F;
  float right = 1.0F;

  // A pointed one in the middle: its height, negative for a valley, and its reach, above 0.
  float tip = 0.0F;
  float tip_reach = 1.0F;

  float ball = 0.0F;   ///< 1: half a ball of radius 0.5 stands out; -1: it is cut in
  float print = 0.0F;  ///< height of a stamp's print, a raised field with two grooves

  // Between which heights the clay is inside the tool; floor <= ceiling.
  float floor = -1.0F;
  float ceiling = 1.0F;
};

/// The tool itself, or how it moves.
enum class HandMark {
  none,
  circle,    ///< a ball
  across,    ///< an arrow along the surface
  press,     ///< two arrows down
  blade,     ///< a blade on the surface
  pour,      ///< one arrow down
  together,  ///< two arrows to the middle
  drag,      ///< an arrow away and up
  turn,      ///< arrows in a circle
  rise,      ///< an arrow up
  handle     ///< a stamp
};

/// What a tool does, shown on a piece of clay that shows its effect best: the clay after it,
/// filled, and a dashed line where `before` was, as far as that differs.
struct ActionPicture {
  PictureProfile before{};
  PictureProfile after{};
  HandMark hand = HandMark::none;
  bool is_masked = false;  ///< the middle is dark
};

}  // namespace argil

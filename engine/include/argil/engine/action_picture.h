// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace argil {

/// The surface of a piece of clay in section: a height over x from -1 to 1, in the same unit; 0 is
/// the ground. All parts add up, then what lies inside the tool, |x| < kHalfWidth, is clamped.
struct PictureProfile {
  static constexpr float kHalfWidth = 0.66F;

  float wave = 0.0F;  ///< amplitude of ripples over the whole width

  float bump = 0.0F;    ///< height of a rounded bump
  float middle = 0.0F;  ///< where it stands
  float left = 1.0F;    ///< how far it reaches to either side
  float right = 1.0F;

  float tip = 0.0F;  ///< height of a pointed one in the middle
  float tip_reach = 1.0F;

  float ball = 0.0F;   ///< 1: half a ball of radius 0.5 stands out; -1: it is cut in
  float print = 0.0F;  ///< height of a stamp's print

  float floor = -1.0F;  ///< inside the tool
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

/// What a tool does, shown on a piece of clay that shows its effect best.
struct ActionPicture {
  PictureProfile before{};
  PictureProfile after{};
  HandMark hand = HandMark::none;
  bool is_masked = false;  ///< the middle is dark
};

}  // namespace argil

// SPDX-License-Identifier: GPL-3.0-or-later
#include "gui/tool_picture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "gui/gui.h"

namespace argil::viewer {
namespace {

// A picture's frame: x from -1 to 1, heights in the same unit, 0 where the clay's surface was.
constexpr float kGround = 0.60F;  // of the picture's height, from its top
constexpr float kTall = 0.7F;     // of its width

ImU32 paint_of(const Paint& paint) { return ImGui::GetColorU32(imgui_color(paint)); }

float bump(float x, float radius) {
  const float fraction = 1.0F - (x / radius) * (x / radius);
  return fraction > 0.0F ? fraction * fraction : 0.0F;
}
float tip(float x, float radius) {
  const float fraction = std::max(0.0F, 1.0F - std::abs(x) / radius);
  return fraction * fraction;
}
float ball(float x) { return std::sqrt(std::max(0.0F, 0.25F - x * x)); }

/// A raised field with two grooves.
float print(float x) {
  if (std::abs(x) > 0.52F) return 0.0F;
  return std::abs(std::abs(x) - 0.26F) < 0.13F ? 0.476F : 1.0F;
}

float height_of(const PictureProfile& profile, float x) {
  const float beside = x - profile.middle;
  float height = profile.wave * std::sin(9.0F * x + 0.6F);
  height += profile.bump * bump(beside, beside < 0.0F ? profile.left : profile.right);
  height += profile.tip * tip(x, profile.tip_reach);
  height += profile.ball * ball(x) + profile.print * print(x);
  if (std::abs(x) >= PictureProfile::kHalfWidth) return height;
  return std::clamp(height, profile.floor, profile.ceiling);
}

/// Draws in the picture's frame.
class Painter {
 public:
  Painter(ImDrawList& list, ImVec2 corner, float width)
      : list_(list), corner_(corner), width_(width), line_(std::max(1.0F, width / 30.0F)) {}

  void clay(const PictureProfile& profile, bool is_masked) {
    const auto height = [&](float x) { return height_of(profile, x); };
    // Without smoothed edges, or the seams between the strips would show.
    const ImDrawListFlags flags = list_.Flags;
    list_.Flags &= ~ImDrawListFlags_AntiAliasedFill;
    for (int n = 0; n < kStrips; ++n) {
      const float x0 = x_of(n);
      const float x1 = x_of(n + 1);
      const bool is_dark = is_masked && std::abs(0.5F * (x0 + x1)) < 0.45F;
      list_.AddQuadFilled(at(x0, height(x0)), at(x1, height(x1)), bottom(x1), bottom(x0),
                          paint_of(is_dark ? colors_.masked : colors_.clay));
    }
    list_.Flags = flags;
    std::array<ImVec2, kStrips + 1> points;
    for (int n = 0; n <= kStrips; ++n) {
      points[static_cast<std::size_t>(n)] = at(x_of(n), height(x_of(n)));
    }
    list_.AddPolyline(points.data(), kStrips + 1, paint_of(colors_.edge), 0, line_);
  }

  /// Dashed, where it differs.
  void before(const ActionPicture& picture) {
    for (int n = 0; n < kStrips; n += 4) {
      const float x0 = x_of(n);
      const float x1 = x_of(n + 2);
      const float before = height_of(picture.before, x0);
      if (std::abs(before - height_of(picture.after, x0)) < 0.04F) continue;
      list_.AddLine(at(x0, before), at(x1, height_of(picture.before, x1)), paint_of(colors_.before),
                    line_);
    }
  }

  void circle(float x, float y, float radius) {
    list_.AddCircle(at(x, y), 0.5F * radius * width_, paint_of(colors_.hand), 0, line_);
  }

  void rectangle(float x0, float y0, float x1, float y1) {
    list_.AddRect(at(x0, y1), at(x1, y0), paint_of(colors_.hand), 0.0F, 0, line_);
  }

  void arrow(float x0, float y0, float x1, float y1) {
    const ImVec2 from = at(x0, y0);
    const ImVec2 to = at(x1, y1);
    list_.AddLine(from, to, paint_of(colors_.hand), line_);
    head(to, std::atan2(to.y - from.y, to.x - from.x));
  }

  /// Part of a circle with an arrow's head; angles clockwise from the right.
  void arc(float x, float y, float radius, float from, float to) {
    const float r = 0.5F * radius * width_;
    list_.PathArcTo(at(x, y), r, from, to, 16);
    list_.PathStroke(paint_of(colors_.hand), 0, line_);
    const ImVec2 middle = at(x, y);
    const ImVec2 end{middle.x + r * std::cos(to), middle.y + r * std::sin(to)};
    head(end, to + 1.5708F);
  }

 private:
  static constexpr int kStrips = 44;
  static float x_of(int n) { return -1.0F + 2.0F * static_cast<float>(n) / kStrips; }

  ImVec2 at(float x, float y) const {
    return {corner_.x + 0.5F * width_ * (1.0F + x),
            corner_.y + width_ * (kTall * kGround - 0.5F * y)};
  }
  ImVec2 bottom(float x) const { return {at(x, 0.0F).x, corner_.y + kTall * width_}; }

  void head(ImVec2 to, float angle) {
    const float size = 4.0F * line_;
    const auto corner = [&](float turn) {
      return ImVec2{to.x - size * std::cos(angle + turn), to.y - size * std::sin(angle + turn)};
    };
    list_.AddTriangleFilled(to, corner(0.5F), corner(-0.5F), paint_of(colors_.hand));
  }

  const ThemeColors& colors_ = shown_colors();
  ImDrawList& list_;
  ImVec2 corner_;
  float width_;
  float line_;
};

/// The tool itself, or how it moves.
void draw_hand(HandMark hand, Painter& painter) {
  switch (hand) {
    case HandMark::none:
      break;
    case HandMark::circle:
      painter.circle(0.0F, 0.0F, 0.5F);
      break;
    case HandMark::across:
      painter.arrow(-0.6F, 0.45F, 0.6F, 0.45F);
      break;
    case HandMark::press:
      painter.arrow(-0.3F, 0.62F, -0.3F, 0.12F);
      painter.arrow(0.3F, 0.62F, 0.3F, 0.12F);
      break;
    case HandMark::blade:
      painter.rectangle(-0.1F, 0.06F, 0.1F, 0.6F);
      break;
    case HandMark::pour:
      painter.arrow(0.0F, 0.7F, 0.0F, 0.24F);
      break;
    case HandMark::together:
      painter.arrow(-0.85F, 0.3F, -0.42F, 0.3F);
      painter.arrow(0.85F, 0.3F, 0.42F, 0.3F);
      break;
    case HandMark::drag:
      painter.arrow(-0.25F, 0.3F, 0.15F, 0.8F);
      break;
    case HandMark::turn:
      painter.arc(0.0F, 0.3F, 0.42F, 3.5F, 5.6F);
      painter.arc(0.0F, 0.3F, 0.42F, 0.36F, 2.46F);
      break;
    case HandMark::rise:
      painter.arrow(0.0F, 0.52F, 0.0F, 0.86F);
      break;
    case HandMark::handle:
      painter.rectangle(-0.52F, 0.52F, 0.52F, 0.66F);
      painter.rectangle(-0.12F, 0.66F, 0.12F, 0.86F);
      break;
  }
}

}  // namespace

void draw_tool_picture(const ActionPicture& picture, ImDrawList& list, ImVec2 corner, float width) {
  assert(width > 0.0F);
  list.AddRectFilled(corner, {corner.x + width, corner.y + kTall * width},
                     paint_of(shown_colors().air), 0.06F * width);
  Painter painter(list, corner, width);
  painter.clay(picture.after, picture.is_masked);
  painter.before(picture);
  draw_hand(picture.hand, painter);
}

}  // namespace argil::viewer

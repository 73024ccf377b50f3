// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace argil::viewer {
namespace {

// A picture's frame: x from -1 to 1, heights in the same unit, 0 where the clay's surface was.
constexpr float kGround = 0.60F;  // of the picture's height, from its top
constexpr float kTall = 0.7F;     // of its width

constexpr ImU32 kAir = IM_COL32(24, 24, 27, 255);
constexpr ImU32 kClay = IM_COL32(150, 88, 58, 255);
constexpr ImU32 kHeld = IM_COL32(52, 40, 40, 255);
constexpr ImU32 kEdge = IM_COL32(236, 168, 124, 255);
constexpr ImU32 kBefore = IM_COL32(200, 200, 205, 150);
constexpr ImU32 kHand = IM_COL32(150, 205, 245, 255);

float bump(float x, float radius) {
  const float share = 1.0F - (x / radius) * (x / radius);
  return share > 0.0F ? share * share : 0.0F;
}
float tip(float x, float radius) {
  const float share = std::max(0.0F, 1.0F - std::abs(x) / radius);
  return share * share;
}
float mound(float x) { return 0.38F * bump(x, 0.9F); }
float flat(float) { return 0.0F; }
float wave(float x) { return 0.20F * std::sin(9.0F * x + 0.6F); }
float ball(float x) { return std::sqrt(std::max(0.0F, 0.25F - x * x)); }
float under(float x, float worked) { return std::abs(x) < 0.66F ? worked : wave(x); }

/// The surface before and after.
struct Section {
  float (*before)(float);
  float (*after)(float);
};

Section section_of(const ActionInfo& tool) {
  if (tool.is_stamp) {
    return {flat, [](float x) {
              if (std::abs(x) > 0.52F) return 0.0F;
              return std::abs(std::abs(x) - 0.26F) < 0.13F ? 0.20F : 0.42F;
            }};
  }
  switch (tool.action) {
    case Action::add:
      return {flat, [](float x) { return ball(x); }};
    case Action::carve:
      return {flat, [](float x) { return -ball(x); }};
    case Action::smooth:
      return {wave, [](float x) { return 0.2F * wave(x); }};
    case Action::flatten:
      return {wave, [](float x) { return under(x, 0.0F); }};
    case Action::scrape:
      return {wave, [](float x) { return under(x, std::min(wave(x), 0.0F)); }};
    case Action::fill:
      return {wave, [](float x) { return under(x, std::max(wave(x), 0.0F)); }};
    case Action::crease:
      return {flat, [](float x) { return 0.12F * bump(x, 0.9F) - 0.58F * tip(x, 0.42F); }};
    case Action::pinch:
      return {[](float x) { return 0.26F * bump(x, 0.95F); },
              [](float x) { return 0.62F * tip(x, 0.62F); }};
    case Action::grab:
      return {[](float x) { return 0.22F * bump(x + 0.25F, 0.6F); },
              [](float x) { return 0.62F * bump(x - 0.08F, x < 0.08F ? 0.95F : 0.45F); }};
    case Action::mask:
      return {mound, mound};
    case Action::twist:
      return {flat, flat};
    default:
      return {flat, [](float x) { return 0.5F * bump(x, 0.8F); }};
  }
}

class Painter {
 public:
  Painter(ImDrawList& list, ImVec2 corner, float width)
      : list_(list), corner_(corner), width_(width), line_(std::max(1.0F, width / 30.0F)) {}

  void clay(float (*height)(float), bool is_held) {
    // Without a smooth rim, or the seams between the strips would show.
    const ImDrawListFlags flags = list_.Flags;
    list_.Flags &= ~ImDrawListFlags_AntiAliasedFill;
    for (int n = 0; n < kStrips; ++n) {
      const float x0 = place(n);
      const float x1 = place(n + 1);
      const bool is_dark = is_held && std::abs(0.5F * (x0 + x1)) < 0.45F;
      list_.AddQuadFilled(at(x0, height(x0)), at(x1, height(x1)), bottom(x1), bottom(x0),
                          is_dark ? kHeld : kClay);
    }
    list_.Flags = flags;
    std::array<ImVec2, kStrips + 1> points;
    for (int n = 0; n <= kStrips; ++n) {
      points[static_cast<std::size_t>(n)] = at(place(n), height(place(n)));
    }
    list_.AddPolyline(points.data(), kStrips + 1, kEdge, 0, line_);
  }

  /// Dashed, where it differs.
  void before(const Section& section) {
    for (int n = 0; n < kStrips; n += 4) {
      const float x0 = place(n);
      const float x1 = place(n + 2);
      if (std::abs(section.before(x0) - section.after(x0)) < 0.04F) continue;
      list_.AddLine(at(x0, section.before(x0)), at(x1, section.before(x1)), kBefore, line_);
    }
  }

  void circle(float x, float y, float radius) {
    list_.AddCircle(at(x, y), 0.5F * radius * width_, kHand, 0, line_);
  }

  void rectangle(float x0, float y0, float x1, float y1) {
    list_.AddRect(at(x0, y1), at(x1, y0), kHand, 0.0F, 0, line_);
  }

  void arrow(float x0, float y0, float x1, float y1) {
    const ImVec2 from = at(x0, y0);
    const ImVec2 to = at(x1, y1);
    list_.AddLine(from, to, kHand, line_);
    head(to, std::atan2(to.y - from.y, to.x - from.x));
  }

  /// Part of a circle with an arrow's head; angles clockwise from the right.
  void arc(float x, float y, float radius, float from, float to) {
    const float r = 0.5F * radius * width_;
    list_.PathArcTo(at(x, y), r, from, to, 16);
    list_.PathStroke(kHand, 0, line_);
    const ImVec2 middle = at(x, y);
    const ImVec2 end{middle.x + r * std::cos(to), middle.y + r * std::sin(to)};
    head(end, to + 1.5708F);
  }

 private:
  static constexpr int kStrips = 44;
  static float place(int n) { return -1.0F + 2.0F * static_cast<float>(n) / kStrips; }

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
    list_.AddTriangleFilled(to, corner(0.5F), corner(-0.5F), kHand);
  }

  ImDrawList& list_;
  ImVec2 corner_;
  float width_;
  float line_;
};

void draw_hand(const ActionInfo& tool, Painter& painter) {
  if (tool.is_stamp) {
    painter.rectangle(-0.52F, 0.52F, 0.52F, 0.66F);
    painter.rectangle(-0.12F, 0.66F, 0.12F, 0.86F);
    return;
  }
  switch (tool.action) {
    case Action::add:
    case Action::carve:
      painter.circle(0.0F, 0.0F, 0.5F);
      break;
    case Action::smooth:
      painter.arrow(-0.6F, 0.45F, 0.6F, 0.45F);
      break;
    case Action::flatten:
      painter.arrow(-0.3F, 0.62F, -0.3F, 0.12F);
      painter.arrow(0.3F, 0.62F, 0.3F, 0.12F);
      break;
    case Action::scrape:
      painter.rectangle(-0.1F, 0.06F, 0.1F, 0.6F);
      break;
    case Action::fill:
      painter.arrow(0.0F, 0.7F, 0.0F, 0.24F);
      break;
    case Action::pinch:
      painter.arrow(-0.85F, 0.3F, -0.42F, 0.3F);
      painter.arrow(0.85F, 0.3F, 0.42F, 0.3F);
      break;
    case Action::grab:
      painter.arrow(-0.25F, 0.3F, 0.15F, 0.8F);
      break;
    case Action::twist:
      painter.arc(0.0F, 0.3F, 0.42F, 3.5F, 5.6F);
      painter.arc(0.0F, 0.3F, 0.42F, 0.36F, 2.46F);
      break;
    case Action::inflate:
      painter.arrow(0.0F, 0.52F, 0.0F, 0.86F);
      break;
    default:
      break;
  }
}

}  // namespace

void draw_tool_picture(const ActionInfo& tool, ImDrawList& list, ImVec2 corner, float width) {
  list.AddRectFilled(corner, {corner.x + width, corner.y + kTall * width}, kAir, 0.06F * width);
  const Section section = section_of(tool);
  Painter painter(list, corner, width);
  painter.clay(section.after, tool.action == Action::mask);
  painter.before(section);
  draw_hand(tool, painter);
}

}  // namespace argil::viewer

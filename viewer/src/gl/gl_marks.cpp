// SPDX-License-Identifier: GPL-3.0-or-later
#include "gl/gl_marks.h"

#include <algorithm>
#include <array>
#include <utility>

#include "gl/gl_clay_shaders.h"
#include "gl/gl_mark_shaders.h"
#include "gl/gl_mark_shapes.h"
#include "gl/gl_state.h"

namespace argil::viewer {
namespace {

constexpr double kRingHalfPixels = 1.1;
constexpr double kHaloHalfPixels = 2.4;
constexpr double kHaloAlpha = 0.35;
/// How much is seen of what lies behind clay.
constexpr double kHiddenRing = 0.34;
constexpr double kHiddenPlane = 0.15;
constexpr double kHandleHalfPixels = 1.6;
constexpr double kHandleHaloPixels = 2.9;
constexpr double kHandleFill = 0.45;
constexpr double kPlaneAlpha = 0.16;
constexpr double kPatchAlpha = 0.30;
constexpr double kFaint = 0.5;  // a frame without a fill, of its colour
/// Of a parallel lens: how much nearer marks are seen, as a fraction of what is between its planes.
constexpr double kNearerFraction = 0.003;

/// The uniforms that lines and solids share.
void set_eye(const GlProgram& program, const EyeView& eye) {
  program.use();
  program.set("view", eye.lens.view());
  program.set("projection", eye.lens.projection());
  program.set("is_parallel", eye.lens.is_parallel ? 1 : 0);
  program.set("nearer_mm", kNearerFraction * (eye.lens.far_mm - eye.lens.near_mm));
  program.set("half_size", 0.5 * eye.part.width, 0.5 * eye.part.height);
}

/// Whether a ring's outer side is turned to the eye: what tells the far side of the clay for a
/// patch, which is drawn without a depth test.
bool faces(const Lens& lens, const RingMark& ring) {
  const Vec3 to_eye = lens.is_parallel ? lens.back : lens.eye_mm - ring.center_mm;
  return dot(ring.normal, to_eye) > 0.0;
}

/// Sorts triangles so that the nearer ones are drawn over the others.
void sort_from_afar(std::vector<SolidVertex>& solids, const Lens& lens) {
  using Corners = std::array<SolidVertex, 3>;
  std::vector<std::pair<double, Corners>> sorted;
  for (std::size_t n = 0; n + 2 < solids.size(); n += 3) {
    const Corners corners{solids[n], solids[n + 1], solids[n + 2]};
    double nearness = 0.0;
    for (const SolidVertex& corner : corners) {
      const auto& p = corner.position;
      nearness += dot(lens.back, {static_cast<double>(p[0]), static_cast<double>(p[1]),
                                  static_cast<double>(p[2])});
    }
    sorted.emplace_back(nearness, corners);
  }
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  solids.clear();
  for (const auto& [nearness, corners] : sorted)
    solids.insert(solids.end(), corners.begin(), corners.end());
}

int count_of(const auto& vertices) { return static_cast<int>(vertices.size()); }

void send(const GlStream& stream, const auto& vertices) {
  stream.send(vertices.data(), static_cast<long>(vertices.size() * sizeof(vertices[0])));
}

}  // namespace

Result<GlMarks> GlMarks::make(ObjectCount& count) {
  GlMarks made;
  auto lines = GlProgram::make(count, {"lines", kColorFunctions, kLineVertex, kLineFragment});
  if (!lines) return lines.error();
  made.lines_ = std::move(lines).value();
  auto solids = GlProgram::make(count, {"solids", kColorFunctions, kSolidVertex, kSolidFragment});
  if (!solids) return solids.error();
  made.solids_ = std::move(solids).value();
  auto pins = GlProgram::make(count, {"pins", kColorFunctions, kPinVertex, kPinFragment});
  if (!pins) return pins.error();
  made.pins_ = std::move(pins).value();
  made.line_stream_ = GlStream(count, {3, 3, 3, 4, 1});
  made.solid_stream_ = GlStream(count, {3, 3, 4});
  made.pin_stream_ = GlStream(count, {3, 2, 3});
  return made;
}

void GlMarks::draw(const Picture& picture, const EyeView& eye, const GlTargets& targets) const {
  blend_over();
  glEnable(GL_DEPTH_TEST);
  // Marks are tested against the clay and leave its depth as it is.
  glDepthMask(GL_FALSE);
  if (!picture.planes.empty()) draw_planes(picture, eye);
  if (!picture.rings.empty() || !picture.lines.empty()) draw_rings(picture, eye);
  if (!picture.arrows.empty()) draw_arrows(picture, eye);
  if (!picture.handles.empty()) draw_handles(picture, eye);
  glDisable(GL_DEPTH_TEST);
  if (!picture.pins.empty()) draw_pins(picture, eye, targets);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LEQUAL);
  glDisable(GL_BLEND);
}

void GlMarks::draw_planes(const Picture& picture, const EyeView& eye) const {
  // A tinted square with a frame, which shows faintly through the clay.
  std::vector<SolidVertex> fills;
  std::vector<LineVertex> edges;
  for (const PlaneMark& plane : picture.planes) {
    if (plane.is_filled) add_fill(fills, plane_corners(plane), plane.color, kPlaneAlpha);
    add_loop(edges, plane_corners(plane), plane.is_filled ? plane.color : kFaint * plane.color);
  }
  glDepthFunc(GL_LEQUAL);
  if (!fills.empty()) {
    set_eye(solids_, eye);
    solid_stream_.draw<SolidVertex>(GL_TRIANGLES, fills);
  }
  set_eye(lines_, eye);
  lines_.set("half_width", kRingHalfPixels);
  send(line_stream_, edges);
  lines_.set("tint", 1.0, 1.0, 1.0, 0.8);
  line_stream_.draw_sent(GL_TRIANGLES, count_of(edges));
  glDepthFunc(GL_GREATER);
  lines_.set("tint", 1.0, 1.0, 1.0, kHiddenPlane);
  line_stream_.draw_sent(GL_TRIANGLES, count_of(edges));
}

void GlMarks::draw_rings(const Picture& picture, const EyeView& eye) const {
  std::vector<SolidVertex> patches;
  std::vector<LineVertex> edges;
  for (const LineMark& line : picture.lines) add_line(edges, line.points_mm, line.color);
  for (const RingMark& ring : picture.rings) {
    if (ring.is_filled) {
      const double alpha = faces(eye.lens, ring) ? kPatchAlpha : kHiddenRing * kPatchAlpha;
      add_fill(patches, ring_points(ring), ring.color, alpha);
    }
    add_loop(edges, ring_points(ring), ring.color);
  }
  if (!patches.empty()) {
    // A patch lies on the surface and would be half inside it.
    glDisable(GL_DEPTH_TEST);
    set_eye(solids_, eye);
    solid_stream_.draw<SolidVertex>(GL_TRIANGLES, patches);
    glEnable(GL_DEPTH_TEST);
  }
  set_eye(lines_, eye);
  send(line_stream_, edges);
  const auto draw_edges = [&](double half_width, double light, double alpha) {
    lines_.set("half_width", half_width);
    lines_.set("tint", light, light, light, alpha);
    line_stream_.draw_sent(GL_TRIANGLES, count_of(edges));
  };
  // First what lies behind clay, faintly; over it the dark halo and the ring itself.
  glDepthFunc(GL_GREATER);
  draw_edges(kRingHalfPixels, 1.0, kHiddenRing);
  glDepthFunc(GL_LEQUAL);
  draw_edges(kHaloHalfPixels, 0.0, kHaloAlpha);
  draw_edges(kRingHalfPixels, 1.0, 1.0);
}

void GlMarks::draw_arrows(const Picture& picture, const EyeView& eye) const {
  std::vector<SolidVertex> solids;
  for (const ArrowMark& arrow : picture.arrows)
    add_arrow(solids, arrow, pixel_mm_at(eye, 0.5 * (arrow.from_mm + arrow.to_mm)));
  // Always seen, and hiding each other only: the depth is the clay's.
  sort_from_afar(solids, eye.lens);
  glDisable(GL_DEPTH_TEST);
  set_eye(solids_, eye);
  solid_stream_.draw<SolidVertex>(GL_TRIANGLES, solids);
}

void GlMarks::draw_handles(const Picture& picture, const EyeView& eye) const {
  std::vector<SolidVertex> fills;
  std::vector<LineVertex> edges;
  for (const HandleMark& handle : picture.handles) {
    if (handle.is_filled) {
      add_fill(fills, handle.points_mm, handle.color, kHandleFill);
      add_loop(edges, handle.points_mm, handle.color);
    } else {
      add_line(edges, handle.points_mm, handle.color);
    }
  }
  glDisable(GL_DEPTH_TEST);
  if (!fills.empty()) {
    set_eye(solids_, eye);
    solid_stream_.draw<SolidVertex>(GL_TRIANGLES, fills);
  }
  set_eye(lines_, eye);
  send(line_stream_, edges);
  lines_.set("half_width", kHandleHaloPixels);
  lines_.set("tint", 0.0, 0.0, 0.0, kHaloAlpha);
  line_stream_.draw_sent(GL_TRIANGLES, count_of(edges));
  lines_.set("half_width", kHandleHalfPixels);
  lines_.set("tint", 1.0, 1.0, 1.0, 1.0);
  line_stream_.draw_sent(GL_TRIANGLES, count_of(edges));
}

void GlMarks::draw_pins(const Picture& picture, const EyeView& eye,
                        const GlTargets& targets) const {
  // Without a depth test: the shader reads the clay's depth and shows what lies behind it fainter.
  std::vector<PinVertex> pins;
  for (const PinMark& pin : picture.pins) add_pin(pins, pin);
  pins_.use();
  pins_.set("view_projection", view_projection(eye.lens));
  pins_.set("half_size", 0.5 * eye.part.width, 0.5 * eye.part.height);
  pins_.set("part", eye.part.x, eye.part.y, eye.part.width, eye.part.height);
  pins_.set("depth", 0);
  bind_texture(0, targets.kept_depth());
  pin_stream_.draw<PinVertex>(GL_TRIANGLES, pins);
  bind_texture(0, 0);
}

}  // namespace argil::viewer

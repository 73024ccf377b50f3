// SPDX-License-Identifier: GPL-3.0-or-later
#include "gl/gl_clay.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "gl/gl_clay_shaders.h"
#include "gl/gl_state.h"
#include "picture/piece_frame.h"

namespace argil::viewer {
namespace {

/// Told apart by colour-blind eyes: M. Okabe and K. Ito's palette, in linear light, in an order in
/// which neighbours differ most. Levels beyond start over.
constexpr std::array<Vec3, 7> kLevelColors{{{0.008, 0.162, 0.445},    // blue
                                            {0.791, 0.347, 0.008},    // orange
                                            {0.008, 0.342, 0.171},    // green
                                            {0.604, 0.191, 0.386},    // purple
                                            {0.093, 0.456, 0.815},    // sky
                                            {0.665, 0.112, 0.006},    // vermilion
                                            {0.871, 0.776, 0.054}}};  // yellow

/// Of a piece without a colour, by shading; curvature and level have colours of their own.
constexpr std::array<Vec3, 4> kBaseColors{
    {{0.52, 0.225, 0.128}, {0.60, 0.585, 0.56}, {1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}}};

constexpr const char* kShadingNames[] = {"matcap", "plain", "curvature", "level"};
constexpr const char* kShades[] = {kMatcapShade, kPlainShade, kCurvatureShade, kLevelShade};

/// A plane through a point, inside along the normal.
BoundPlane plane_at(const Vec3& point, const Vec3& normal) { return {normal, -dot(normal, point)}; }

/// The uniforms that every shading and the wires share.
void set_lens(const GlProgram& program, const EyeView& eye, const ClipPlane& cut) {
  program.set("view", eye.lens.view());
  program.set("view_projection", view_projection(eye.lens));
  assert(eye.part.width > 0 && eye.part.height > 0);
  // Without a cut a plane that has everything on its positive side.
  const BoundPlane plane = cut.value_or(BoundPlane{{}, 1.0});
  program.set("cut", plane.normal.x, plane.normal.y, plane.normal.z, plane.offset);
  const double slopes = eye.lens.is_parallel ? 0.0 : 1.0;
  const double x = 2.0 * eye.lens.tan_x / eye.part.width * slopes;
  const double y = 2.0 * eye.lens.tan_y / eye.part.height * slopes;
  program.set("ray", x, y, (eye.lens.shift_x - eye.lens.tan_x) * slopes - x * eye.part.x,
              (eye.lens.shift_y - eye.lens.tan_y) * slopes - y * eye.part.y);
}

}  // namespace

Matrix view_projection(const Lens& lens) noexcept {
  // Shaders multiply positions by one matrix: half the work for each vertex.
  const Matrix view = lens.view();
  const Matrix projection = lens.projection();
  Matrix product{};
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 4; ++row) {
      double sum = 0.0;
      for (std::size_t k = 0; k < 4; ++k)
        sum += static_cast<double>(projection[4 * k + row]) *
               static_cast<double>(view[4 * column + k]);
      product[4 * column + row] = static_cast<float>(sum);
    }
  }
  return product;
}

double pixel_mm_at(const EyeView& eye, const Vec3& place_mm) noexcept {
  assert(eye.part.height > 0);
  const double away = eye.lens.is_parallel ? 1.0 : dot(eye.lens.eye_mm - place_mm, eye.lens.back);
  return 2.0 * eye.lens.tan_y * std::abs(away) / eye.part.height;
}

std::vector<BoundPlane> bounds_of(const EyeView& eye, const PixelRect& area, const ClipPlane& cut) {
  const Lens& lens = eye.lens;
  const PixelRect& part = eye.part;
  const Vec3& at = lens.eye_mm;
  std::vector<BoundPlane> planes{plane_at(at - lens.near_mm * lens.back, -lens.back),
                                 plane_at(at - lens.far_mm * lens.back, lens.back)};
  // A side goes through the eye, or stands parallel to the view: on `inward` of a column or row, so
  // many pixels from the part's beginning. Normals need no unit length here.
  const auto add = [&](const Vec3& axis, double tangent, double pixel, int pixels, double inward) {
    const double shift = &axis == &lens.right ? lens.shift_x : lens.shift_y;
    const double slope = (2.0 * pixel / pixels - 1.0) * tangent + shift;
    planes.push_back(lens.is_parallel ? plane_at(at + slope * axis, inward * axis)
                                      : plane_at(at, inward * (axis + slope * lens.back)));
  };
  assert(part.width > 0 && part.height > 0);
  add(lens.right, lens.tan_x, area.x - part.x, part.width, 1.0);
  add(lens.right, lens.tan_x, area.x - part.x + area.width, part.width, -1.0);
  add(lens.up, lens.tan_y, area.y - part.y, part.height, 1.0);
  add(lens.up, lens.tan_y, area.y - part.y + area.height, part.height, -1.0);
  if (cut) planes.push_back(*cut);
  return planes;
}

PixelRect area_of(const EyeView& eye, const Box3& box_mm) {
  const Lens& lens = eye.lens;
  constexpr double kBeyond = 1e6;  // pixels: far outside of any picture
  double left = kBeyond;
  double right = -kBeyond;
  double bottom = kBeyond;
  double top = -kBeyond;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vec3 p{(corner & 1U) != 0 ? box_mm.max.x : box_mm.min.x,
                 (corner & 2U) != 0 ? box_mm.max.y : box_mm.min.y,
                 (corner & 4U) != 0 ? box_mm.max.z : box_mm.min.z};
    const Vec3 to = p - lens.eye_mm;
    const double away = -dot(to, lens.back);
    if (away < lens.near_mm && !lens.is_parallel) return eye.part;
    const double over = lens.is_parallel ? 1.0 : away;
    const double across = dot(to, lens.right) / over - lens.shift_x;
    const double upward = dot(to, lens.up) / over - lens.shift_y;
    const double x = 0.5 * eye.part.width * (1.0 + across / lens.tan_x);
    const double y = 0.5 * eye.part.height * (1.0 + upward / lens.tan_y);
    left = std::min(left, x);
    right = std::max(right, x);
    bottom = std::min(bottom, y);
    top = std::max(top, y);
  }
  constexpr double kMargin = 2.0;
  const auto within = [](double pixel, int pixels) {
    return static_cast<int>(std::clamp(pixel, 0.0, static_cast<double>(pixels)));
  };
  const int x = within(std::floor(left - kMargin), eye.part.width);
  const int y = within(std::floor(bottom - kMargin), eye.part.height);
  return {eye.part.x + x, eye.part.y + y, within(std::ceil(right + kMargin), eye.part.width) - x,
          within(std::ceil(top + kMargin), eye.part.height) - y};
}

PieceView view_of_piece(const ShownPiece& piece, const GlBlocks* blocks, const EyeView& eye,
                        const ClipPlane& cut) {
  const Lens own = shrunk(unplaced(piece.placement, eye.lens), piece.scale);
  PieceView view{piece.piece, blocks, {own, eye.part}, cut, piece.color};
  if (!cut) return view;
  view.cut->normal = turned_back(piece.placement, cut->normal);
  view.cut->offset += dot(cut->normal, piece.placement.position_mm);
  view.cut->offset /= piece.scale;
  return view;
}

Result<GlClay> GlClay::make(ObjectCount& count) {
  GlClay made;
  for (std::size_t i = 0; i < made.shadings_.size(); ++i) {
    const std::string fragment = std::string(kClayFragmentHead) + kShades[i] + kClayFragmentMain;
    auto program =
        GlProgram::make(count, {kShadingNames[i], kColorFunctions, kClayVertex, fragment.c_str()});
    if (!program) return program.error();
    made.shadings_[i] = std::move(program).value();
  }
  auto wires = GlProgram::make(count, {"wires", kColorFunctions, kClayVertex, kWireFragment});
  if (!wires) return wires.error();
  made.wires_ = std::move(wires).value();
  return made;
}

void GlClay::draw(std::span<const PieceView> pieces, const Picture& picture, bool is_behind) const {
  if (pieces.empty()) return;
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(is_behind ? GL_LESS : GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  if (pieces.front().cut) {
    // A cut shows the inside, whose triangles look away.
    glEnable(GL_CLIP_DISTANCE0);
    glDisable(GL_CULL_FACE);
  } else {
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
  }
  const auto number = static_cast<std::size_t>(picture.shading);
  assert(number < shadings_.size());
  const GlProgram& shading = shadings_[number];
  shading.use();
  for (const PieceView& piece : pieces) {
    set_lens(shading, piece.eye, piece.cut);
    shading.set("base_color", piece.color.value_or(kBaseColors[number]));
    piece.blocks->draw([&shading](int level) {
      assert(level >= 0);
      shading.set("level_color",
                  kLevelColors[static_cast<std::size_t>(level) % kLevelColors.size()]);
    });
  }
  glDepthFunc(GL_LEQUAL);
  if (picture.has_wires) draw_wires(pieces);
  glDisable(GL_CLIP_DISTANCE0);
  glDisable(GL_CULL_FACE);
}

void GlClay::draw_wires(std::span<const PieceView> pieces) const {
  wires_.use();
  wires_.set("wire", 0.004, 0.004, 0.006, 0.55);
  blend_over();
  // Drawn a little before the faces they bound; the depth stays that of the faces.
  glDepthMask(GL_FALSE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  glEnable(GL_POLYGON_OFFSET_LINE);
  glPolygonOffset(-1.0F, -4.0F);
  for (const PieceView& piece : pieces) {
    set_lens(wires_, piece.eye, piece.cut);
    piece.blocks->draw([](int) {});
  }
  glDisable(GL_POLYGON_OFFSET_LINE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

}  // namespace argil::viewer

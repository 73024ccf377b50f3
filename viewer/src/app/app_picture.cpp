// SPDX-License-Identifier: GPL-3.0-or-later
// What the window shows beside the clay: rings, planes, slice, drains, force and path.
#include <algorithm>

#include "app/app.h"
#include "base/theme.h"
#include "commands/command.h"
#include "gestures/measure_marks.h"
#include "gestures/piece_gestures.h"
#include "picture/piece_frame.h"
#include "picture/stereo.h"

namespace argil::viewer {
namespace {

const Vec3 kRingColor{1.0, 0.62, 0.35};
const Vec3 kDrainColor{0.25, 0.6, 1.0};

Vec3 place_of(const Paint& opaque) {
  return {static_cast<double>(opaque.r), static_cast<double>(opaque.g),
          static_cast<double>(opaque.b)};
}

}  // namespace

Picture App::picture() const {
  Picture picture;
  const ShowState& show = ui_.show;
  Box3 content = shown_bounds(ui_);
  const auto gizmo = shown_gizmo(ui_, ui_.camera);
  if (gizmo) {
    content.include(bounds_of(*gizmo).min);
    content.include(bounds_of(*gizmo).max);
  }
  const std::vector<WindowPart> parts = parts_of(ui_.camera, show.is_stereo);
  picture.lens = parts.front().camera.lens(content);
  if (parts.size() > 1) picture.right_lens = parts.back().camera.lens(content);
  add_pieces(picture);
  add_references(picture);
  if (gizmo) add_gizmo(*gizmo, picture.lens, ui_.pieces.handle, picture);
  const ThemeColors& colors = colors_of(ui_.settings.theme);
  picture.ground = {place_of(colors.ground_low), place_of(colors.ground_high)};
  picture.shading = show.shading;
  picture.has_wires = show.has_wires;
  picture.has_occlusion = show.has_occlusion;
  picture.is_moving = is_moving();
  add_rings(picture);
  add_force(picture);
  add_path(picture);
  add_measure_lines(ui_, picture);
  const Placement at = shown_placement(ui_);
  for (const Drain& drain : ui_.operation.drains) {
    const Vec3 point = placed(at, drain.point_mm);
    const Vec3 inward = turned(at, normalized(drain.direction));
    picture.rings.push_back({point, -1.0 * inward, drain.radius_mm, kDrainColor, true});
    picture.arrows.push_back({point - 6.0 * drain.radius_mm * inward, point, kDrainColor});
  }
  if (show.has_planes) add_planes(picture);
  add_cut(picture);
  if (show.has_slice) {
    picture.slice = slice_;
    if (ui_.chord) picture.lines.push_back({{ui_.chord->from_mm, ui_.chord->to_mm}, kRingColor});
  }
  const auto judged = show.has_pins ? judged_placement(ui_) : std::nullopt;
  if (judged) {
    for (const mesh::MeshProblem& problem : ui_.report->verdict.problems) {
      picture.pins.push_back({placed(*judged, problem.at_mm), {1.0, 0.1, 0.1}});
    }
  }
  return picture;
}

/// All that are visible, each where it stands.
void App::add_pieces(Picture& picture) const {
  picture.pieces.clear();
  if (!ui_.clay.pieces) return;
  const PieceList& list = *ui_.clay.pieces;
  for (std::size_t n = 0; n < list.pieces.size(); ++n) {
    const PieceLook& look = list.pieces[n].look;
    if (!look.is_visible) continue;
    ShownPiece shown{list.pieces[n].key, look.placement};
    shown.is_active = n == list.active;
    if (shown.is_active) {
      shown.placement = shown_placement(ui_);
      shown.scale = shown_factor(ui_);
    }
    if (look.color) shown.color = linear_of(*look.color);
    picture.pieces.push_back(shown);
  }
}

void App::add_rings(Picture& picture) const {
  if (ui_.measures.tool || drag_form_of(ui_) != DragForm::brush) return;  // no size to show
  std::optional<SurfaceHit> hit = gestures_.tool_hit();
  double radius = gestures_.tool_radius_mm();
  if (!hit) {
    const auto answer = document_.answer();
    if (!answer || !answer->pick || !(ui_.is_pointer_over_clay_view || ui_.brush_drag)) return;
    hit = SurfaceHit{answer->pick->point_mm, answer->pick->normal};
    radius = radius_on(ui_.brush, ui_.camera.pixel_mm_at(hit->point_mm));
  }
  // Symmetry is about the planes and axes of the piece itself.
  const Placement at = shown_placement(ui_);
  const SurfaceHit own{unplaced(at, hit->point_mm), turned_back(at, hit->normal)};
  for (const SurfaceHit& image : images_of(own, ui_.brush)) {
    picture.rings.push_back(
        {placed(at, image.point_mm), turned(at, image.normal), radius, kRingColor, false});
  }
  // A smaller ring shows the strength.
  picture.rings.push_back(
      {hit->point_mm, hit->normal, radius * ui_.brush.strength, 0.5 * kRingColor, false});
}

/// The planes of symmetry, through the origin, as large as the clay.
void App::add_planes(Picture& picture) const {
  const Box3& box = ui_.clay.bounds_mm;
  const double half = 0.6 * std::max({box.size().x, box.size().y, box.size().z});
  const Mirror& mirror = ui_.brush.mirror;
  const Placement at = shown_placement(ui_);
  const auto add = [&](bool is_on, const Vec3& normal, const Vec3& color) {
    if (!is_on) return;
    const Vec3 middle = box.center() - dot(box.center(), normal) * normal;
    // Filled it would veil half of the piece.
    picture.planes.push_back({placed(at, middle), turned(at, normal), half, color, false});
  };
  add(mirror.x, {1.0, 0.0, 0.0}, {0.9, 0.3, 0.3});
  add(mirror.y, {0.0, 1.0, 0.0}, {0.3, 0.8, 0.3});
  add(mirror.z, {0.0, 0.0, 1.0}, {0.3, 0.5, 0.95});
}

/// The plane along which the dialog would cut.
void App::add_cut(Picture& picture) const {
  if (open_dialog(ui_) != Dialog::operations) return;
  const Box3& box = ui_.clay.bounds_mm;
  PlaneMark plane;
  plane.normal = {};
  const auto axis = static_cast<std::size_t>(ui_.operation.cut_axis);
  plane.normal[axis] = 1.0;
  plane.point_mm = box.center();
  plane.point_mm[axis] = ui_.operation.cut_at_mm;
  const Placement at = shown_placement(ui_);
  plane.normal = turned(at, plane.normal);
  plane.point_mm = placed(at, plane.point_mm);
  plane.half_side_mm = 0.6 * std::max({box.size().x, box.size().y, box.size().z});
  plane.color = kRingColor;
  picture.planes.push_back(plane);
}

/// Asks for the slice that is to be shown: a square across one axis, a little larger than the clay.
void App::cut_slice() {
  if (!ui_.show.has_slice || !ui_.clay.has_clay) {
    document_.cut({});
    slice_.reset();
    return;
  }
  if (gestures_.is_stroke_open()) return;
  const Box3& box = ui_.clay.all_bounds_mm;
  const auto axis = static_cast<std::size_t>(ui_.show.slice_axis);
  const std::size_t across = axis == 0 ? 1 : 0;
  const std::size_t down = axis == 2 ? 1 : 2;
  const double half = 0.55 * std::max(box.size()[across], box.size()[down]);
  SlicePlane plane;
  plane.corner_mm = box.center();
  plane.corner_mm[axis] += 0.5 * ui_.show.slice_position * box.size()[axis];
  plane.corner_mm[across] -= half;
  plane.corner_mm[down] += half;
  plane.along_mm[across] = 2.0 * half;
  plane.down_mm[down] = -2.0 * half;
  plane.columns = plane.rows = 384;
  document_.cut(plane);
}

/// How thick the material of the slice is under the pointer.
std::optional<Chord> App::chord() const {
  if (!ui_.show.has_slice || !slice_ || !ui_.is_pointer_over_clay_view) return std::nullopt;
  return shortest_chord(*slice_,
                        part_at(ui_.camera, ui_.show.is_stereo, ui_.pointer).ray_at(ui_.pointer));
}

/// What the slice leaves of the clay, as the renderer cuts it: the half behind it.
std::optional<SeenHalf> App::seen_half() const {
  if (!ui_.show.has_slice || !slice_) return std::nullopt;
  const Lens lens = ui_.camera.lens({});
  const Vec3 normal = normalized(cross(slice_->along_mm, slice_->down_mm));
  const Vec3 to_eye = lens.is_parallel ? lens.back : lens.eye_mm - slice_->corner_mm;
  const Vec3 kept = dot(normal, to_eye) > 0.0 ? -1.0 * normal : normal;
  return SeenHalf{kept, dot(kept, slice_->corner_mm)};
}

/// An arrow of 3 N is 8 % of the distance to the target long.
double App::arrow_mm_per_n() const { return 0.08 * ui_.camera.distance_mm() / 3.0; }

/// The force on the tool, and where it is felt.
void App::add_force(Picture& picture) const {
  const auto& seen = shown_force_;
  if (!seen) return;
  const double force = length(seen->force_n);
  RingMark tool{seen->tool_mm, ui_.camera.lens({}).back, seen->radius_mm, {0.4, 0.8, 1.0}, false};
  picture.rings.push_back(tool);
  if (force < 0.02) return;  // N: noise, whose direction says nothing
  const Vec3 direction = seen->force_n / force;
  const double mm_per_n = arrow_mm_per_n();
  picture.arrows.push_back({seen->tool_mm, seen->tool_mm + force * mm_per_n * direction});
  tool.center_mm -= seen->radius_mm * direction;
  tool.normal = direction;
  tool.radius_mm *= 0.7;
  tool.color = {1.0, 0.8, 0.1};
  tool.is_filled = true;
  picture.rings.push_back(tool);
}

/// The path that guides the hand, or the one that is being drawn.
void App::add_path(Picture& picture) const {
  const std::vector<Vec3>& drawn = ui_.drawn_path_mm;
  std::vector<Vec3> path = drawn.empty() ? ui_.haptics.guidance.path_mm : drawn;
  for (Vec3& point : path) point = placed(shown_placement(ui_), point);
  if (path.size() > 1) picture.lines.push_back({path});
  if (path.size() == 1) picture.pins.push_back({path.front(), LineMark().color});
}

}  // namespace argil::viewer

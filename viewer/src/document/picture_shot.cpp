// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/picture_shot.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <new>

#include "document/coarse_view.h"
#include "picture/piece_frame.h"
#include "settings/thumbnail.h"

namespace argil::viewer {
namespace {

/// Of all pieces together: up to 100 000 triangles, of which a picture shows a few a pixel.
constexpr std::int64_t kMostShotLeaves = 2000;

/// False where there is no memory for it.
bool add_piece_to_shot(const Clay& clay, const PieceLook& look, std::int64_t most_leaves,
                       PictureShot& shot) {
  DisplaySurface surface;
  if (!surface.update(clay, coarse_view(clay, most_leaves))) return false;
  for (const BlockId& id : surface.blocks()) {
    const DisplayBlock block = surface.block(id);
    const auto first = static_cast<std::uint32_t>(shot.mesh.positions.size());
    for (const DisplayVertex& vertex : block.vertices) {
      const auto& p = vertex.position_mm;
      const auto& n = vertex.normal;
      const auto wide = [](float x) { return static_cast<double>(x); };
      shot.mesh.positions.push_back(
          placed(look.placement, Vec3{wide(p[0]), wide(p[1]), wide(p[2])}));
      shot.mesh.normals.push_back(turned(look.placement, {wide(n[0]), wide(n[1]), wide(n[2])}));
    }
    for (const Triangle& t : block.triangles) {
      shot.mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
  }
  shot.colors.resize(shot.mesh.triangles.size(), look.color ? linear_of(*look.color) : kClayColor);
  return true;
}

void aim_shot(const std::optional<DisplayView>& view, PictureShot& shot) {
  const Box3 box = bounds(shot.mesh);
  shot.toward = {0.35, -1.0, 0.45};  // as the window's camera at its start
  if (view) {
    const Vec3 to_eye = view->eye_mm - box.center();
    if (length(to_eye) > 1e-3 * length(box.size())) shot.toward = to_eye;
  }
  shot.up = {0.0, 0.0, 1.0};
  const Vec3 toward = normalized(shot.toward);
  // Straight from above or below, where z is no direction in the picture.
  if (length(cross(toward, shot.up)) < 1e-2) shot.up = {0.0, 1.0, 0.0};
}

std::optional<PictureShot> shot_of(const Sculpture& sculpture,
                                   const std::optional<DisplayView>& view) {
  std::int64_t visible = 0;
  bool has_colors = false;
  for (std::size_t n = 0; n < sculpture.piece_count(); ++n) {
    if (!sculpture.look(n).is_visible) continue;
    ++visible;
    has_colors = has_colors || sculpture.look(n).color.has_value();
  }
  if (visible == 0) return std::nullopt;
  const std::int64_t most_leaves = std::max<std::int64_t>(kMostShotLeaves / visible, 1);
  PictureShot shot;
  for (std::size_t n = 0; n < sculpture.piece_count(); ++n) {
    const PieceLook& look = sculpture.look(n);
    if (!look.is_visible) continue;
    if (!add_piece_to_shot(sculpture.clay(n), look, most_leaves, shot)) return std::nullopt;
  }
  if (shot.mesh.triangles.empty()) return std::nullopt;
  if (!has_colors) shot.colors.clear();
  aim_shot(view, shot);
  return shot;
}

}  // namespace

std::optional<PictureShot> shoot(const Sculpture& sculpture,
                                 const std::optional<DisplayView>& view) {
  try {
    return shot_of(sculpture, view);
  } catch (const std::bad_alloc&) {
    return std::nullopt;  // a picture is the last thing that memory is wanted for
  }
}

Result<Image> draw(const PictureShot& shot, const Progress& progress) {
  assert(!shot.mesh.triangles.empty());
  RenderOptions options;
  options.width = kThumbnailWidth;
  options.height = kThumbnailHeight;
  options.toward = shot.toward;
  options.up = shot.up;
  options.colors = shot.colors;
  return render(shot.mesh, options, progress);
}

}  // namespace argil::viewer

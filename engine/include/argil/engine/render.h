// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"

namespace argil {

/// 8-bit sRGB, rows from the top, no padding: rgb[3 * (row * width + column)].
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Colours are linear light: red, green and blue, 1 = white. The picture is sRGB.
inline constexpr Vec3 kClayColor{0.50, 0.245, 0.150};

/// What is shown of a mesh, and how. The camera stands where the whole object fills the frame, or
/// the part of it that `frame_mm` names.
struct RenderOptions {
  int width = 1280;  ///< pixels, 16 to 16384
  int height = 960;  ///< pixels, 16 to 16384
  int samples = 4;   ///< supersampling per axis, 1 to 8: 4 means 16 rays a pixel
  /// From the object's centre toward the camera, any length but zero; not along `up`.
  Vec3 toward{0.35, -1.0, 0.45};
  /// What is up in the picture; any length but zero.
  Vec3 up{0.0, 0.0, 1.0};
  double field_of_view_rad = 0.5;  ///< vertical; 0.05 to 2

  /// How much darker than clay the surface is at a point in mm: 0 not, 1 most; none: nowhere. Shows
  /// a mask (Clay::mask_at). Called from several threads at once and must not throw.
  std::function<double(const Vec3& point_mm)> darkness = {};

  /// The colour of each triangle, in the mesh's order; none: all are clay.
  std::vector<Vec3> colors = {};

  /// What fills the frame, in mm: a box with finite corners that is not empty. None: the whole
  /// mesh. All of the mesh is drawn as far as it is in the picture, and throws its shadows.
  std::optional<Box3> frame_mm = {};
};

/// A picture without a GPU or display: rays traced with Embree, soft key light, ambient occlusion,
/// a ground shadow, the whole object in frame.
///
/// Shapes       any triangles with finite positions below 1e15, of any size, not all in one point.
///              Normals of the mesh smooth it; without them each triangle is flat.
/// Errors       bad_input for an empty mesh or options out of range, named; memory for a picture
///              too large; interrupted: `progress` is asked every 10 ms. No picture then.
/// Determinism  same bits for any number of threads (Render.GivesTheSameBitsForAnyThreadCount).
/// Threads      any thread; spreads over TBB. `progress` is called on the one that called this.
/// Cost         `samples` squared rays for a pixel at an edge, one for any other, and a few more
///              for its light.
Result<Image> render(const TriangleMesh& mesh_mm, const RenderOptions& options,
                     const Progress& progress = {});

}  // namespace argil

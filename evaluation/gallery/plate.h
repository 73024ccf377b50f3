// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "argil/core/vec3.h"
#include "argil/engine/stroke.h"

namespace argil::evaluation {

// What the gallery shows: a plate for each action, that is one piece of work on one body, done in
// clays of three voxel sizes and in Blender. All in mm.

inline constexpr double kGalleryBall = 20.0;
inline constexpr double kGalleryTool = 5.0;
/// Of the level that the tool is written at, in each of the three clays: ten to the tool's radius.
/// Blender's mesh has as large faces.
inline constexpr double kGalleryVoxel = 0.5;
/// The tool is written at the level of its number in the clay whose finest voxel is so much finer.
inline constexpr int kGalleryLevels = 3;
inline constexpr double finest_voxel(int level) noexcept {
  return kGalleryVoxel / static_cast<double>(1 << level);
}

/// A ball; the same with a welt along a great circle; the same with bumps all over.
enum class Body { ball, welt, bumpy };
inline constexpr int kBodies = 3;
const char* body_name(Body body);
/// The signed distance, negative inside; nearly so beside welt and bumps, whose slope is up to 0.6.
double body_distance(Body body, const Vec3& p) noexcept;

/// Where the work is done: `out` of the ball there, east to the right in the picture, north up.
/// They lie askew to the lattice.
struct WorkPlace {
  Vec3 out;
  Vec3 east;
  Vec3 north;
};
const WorkPlace& work_place();
/// A point of the ball so far from the middle of the work along great circles, `up_mm` above it.
Vec3 place_on_ball(double east_mm, double north_mm, double up_mm = 0.0);

/// What Blender does in place of a stroke of ours.
struct BlenderBrush {
  std::string name;                                    ///< of the brush
  nlohmann::json settings = nlohmann::json::object();  ///< of it, by Blender's names
  double strength = 1.0;                               ///< where no displacement is asked for
  std::vector<Vec3> path = {};                         ///< where its dabs fall; empty: as ours
};

/// One stroke, ours and Blender's.
struct PlateStroke {
  Stroke stroke;  ///< its samples are its dabs' places
  BlenderBrush brush = {};
};

/// What is measured besides how far the surface went out and in, and the change in volume.
enum class Figures {
  rim,      ///< of a ball that is added or cut out
  profile,  ///< of crease and ridge
  flat,     ///< how far the middle is from a plane
  bumps,    ///< what is left of them
  moved,    ///< ripples and facets
  held,     ///< likewise, and how far what was masked went
};

struct Plate {
  Action action = Action::add;
  Body body = Body::ball;
  std::vector<PlateStroke> strokes = {};
  Figures figures = Figures::moved;
  /// Blender's strength is sought at which its surface moves as far as ours.
  bool is_matched = true;
  /// What Blender does instead of a stroke: UNION or DIFFERENCE with the tool's ball.
  std::string boolean = {};
  /// Why Blender's column is empty; "" where it is not.
  std::string no_counterpart = {};
  Vec3 toward = {};          ///< the viewer
  double frame_mm = 9.0;     ///< edge of the cube that the picture shows,
  double frame_up_mm = 0.0;  ///< its middle so far above the ball
};

/// A plate for every action, in the order of their numbers.
std::vector<Plate> all_plates();

/// "add, tool of 5 mm, strength 1; h = 0.5 mm"
std::string plate_text(const Plate& plate);

}  // namespace argil::evaluation

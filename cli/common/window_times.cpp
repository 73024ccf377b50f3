// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/window_times.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>

#include "argil/engine/window.h"
#include "argil/haptics/force/lattice_force.h"

#include "common/machine.h"

namespace argil::cli {
namespace {

using haptics::ForceTool;

/// A direction along the surface; any where none is near.
Vec3 along_surface(const Clay& clay, const Vec3& at, double step_mm) {
  Vec3 slope;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3 step;
    step[axis] = step_mm;
    slope[axis] = clay.distance_at(at + step) - clay.distance_at(at - step);
  }
  if (length(slope) == 0.0) return {1.0, 0.0, 0.0};
  const Vec3 normal = normalized(slope);
  const Vec3 aside = std::abs(normal.x) < 0.7 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  return normalized(cross(normal, aside));
}

/// What carves the shape that is felt, at its pose.
Stroke dab_of(const ForceTool& felt) {
  Stroke dab;
  dab.tool.action = Action::carve;
  dab.tool.radii_mm = felt.radii_mm;
  const Vec3& r = felt.radii_mm;
  switch (felt.shape) {
    case haptics::ToolShape::ellipsoid:
      dab.tool.shape = r.x == r.y && r.y == r.z ? Shape::ball : Shape::ellipsoid;
      break;
    case haptics::ToolShape::box:
      dab.tool.shape = Shape::box;
      break;
    case haptics::ToolShape::capsule:
      dab.tool.shape = Shape::capsule;
      break;
  }
  dab.samples = {{0.0, felt.position_mm, felt.orientation, 1.0}};
  return dab;
}

/// Publishes, and adds what that took.
Result<void> publish(WindowPublisher& publisher, const Clay& clay, const WindowRequest& request,
                     std::vector<double>& ms) {
  const double before = thread_cpu_us();
  auto done = publisher.publish(clay, request);
  ms.push_back(1e-3 * (thread_cpu_us() - before));
  return done;
}

/// To and fro about the tool's place: 1, 2, 1, 0, -1, -2, -1, 0 and so on, in moves.
int place_of(int move) {
  constexpr int kPlaces[] = {0, 1, 2, 1, 0, -1, -2, -1};
  return kPlaces[move % 8];
}

}  // namespace

void WindowTimes::append(const WindowTimes& other) {
  const auto join = [](std::vector<double>& to, const std::vector<double>& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  join(fresh, other.fresh);
  join(moved, other.moved);
  join(after_dab, other.after_dab);
}

WindowRequest servo_window(const ForceTool& tool, const haptics::ForceMaterial& material,
                           double spacing_mm, double margin_mm) {
  assert(spacing_mm > 0.0 && margin_mm >= 0.0);
  haptics::Lattice lattice;
  lattice.voxel_mm = spacing_mm;
  const double reach = haptics::window_reach_mm(tool, lattice, margin_mm);
  return {tool.position_mm, spacing_mm, std::min(reach, kMostWindowReachVoxels * spacing_mm),
          haptics::window_depth_mm(tool, material, lattice)};
}

Result<WindowTimes> time_windows(Clay& clay, const ForceTool& tool, const WindowRequest& request,
                                 int count) {
  assert(count >= 0 && !clay.is_stroke_open());
  constexpr double kMoveNodes = 4.0;
  const auto channel = std::make_unique<WindowChannel>();
  WindowTimes times;
  for (int n = 0; n < count; ++n) {
    WindowPublisher fresh(*channel);
    if (auto done = publish(fresh, clay, request, times.fresh); !done) return done.error();
  }
  WindowPublisher publisher(*channel);
  if (auto done = publisher.publish(clay, request); !done) return done.error();
  const Vec3 move = kMoveNodes * request.voxel_mm *
                    along_surface(clay, tool.position_mm, clay.options().voxel_mm);
  for (int n = 1; n <= count; ++n) {
    WindowRequest aside = request;
    aside.center_mm += place_of(n) * move;
    if (auto done = publish(publisher, clay, aside, times.moved); !done) return done.error();
  }
  const Stroke dab = dab_of(tool);
  for (int n = 0; n < count; ++n) {
    if (auto done = publisher.publish(clay, request); !done) return done.error();
    const auto worked = clay.apply(dab);
    if (!worked && worked.error().kind == ErrorKind::bad_input) return times;  // no tool for clay
    if (!worked) return worked.error();
    const auto done = publish(publisher, clay, request, times.after_dab);
    clay.undo();
    if (!done) return done.error();
  }
  return times;
}

}  // namespace argil::cli

// SPDX-License-Identifier: GPL-3.0-or-later
// One tool in one scene: its poses, the reference at each, and every method's answer and time.
#include "force/station.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "common/machine.h"

namespace argil::evaluation {

using haptics::ForceLaw;
using haptics::ForceMaterial;
using haptics::ForceTool;

namespace {

constexpr std::array kDepths{0.05, 0.1, 0.25, 0.5, 1.0, 2.0};  // of the radius
/// Nodes of the reference along each diameter of the tool. How much half as many again would change
/// it is part of the result.
constexpr int kReferenceAcross = 48;
constexpr int kQuickAcross = 32;

/// Calls several times and appends the thread CPU time of each, the clock's own taken away. The
/// first call warms the cache, as a loop that runs all the time has it; it counts only where one
/// call outlasts that, and is then the only one. Returns what the first call did.
template <class Call>
auto time_calls(const Call& call, std::vector<double>& cpu_us) {
  // Far more than filling the caches takes.
  constexpr double kSlowUs = 100.0;
  constexpr int kCalls = 15;
  double clock_us = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const double before = cli::thread_cpu_us();
    clock_us = std::min(clock_us, cli::thread_cpu_us() - before);
  }
  const auto passed = [&](double before) {
    return std::max(cli::thread_cpu_us() - before - clock_us, 0.0);
  };
  const double start = cli::thread_cpu_us();
  const auto result = call();
  const double first = passed(start);
  if (first > kSlowUs) {
    cpu_us.insert(cpu_us.end(), kCalls, first);  // weighs as much as others where rows are pooled
    return result;
  }
  for (int i = 0; i < kCalls; ++i) {
    const double before = cli::thread_cpu_us();
    call();
    cpu_us.push_back(passed(before));
  }
  return result;
}

/// In degrees; 180 when one is zero.
double angle_between(const Vec3& a, const Vec3& b) {
  const double scale = length(a) * length(b);
  if (scale == 0.0) return 180.0;
  // Not acos, which has no digits left near 0 degrees.
  return std::atan2(length(cross(a, b)), dot(a, b)) * 180.0 / std::numbers::pi;
}

void compare(const Answer& answer, const Wrench& truth, double push_n, double floor_n,
             double radius_mm, Tally& tally) {
  assert(floor_n > 0.0 && radius_mm > 0.0);
  // Where the force vanishes a relative error would say nothing.
  const double scale = std::max(length(truth.force_n), floor_n);
  const double error_n = length(answer.wrench.force_n - truth.force_n);
  tally.error.push_back(error_n / scale);
  tally.opposed.push_back(push_n / scale);
  tally.torque.push_back(length(answer.wrench.torque_nmm - truth.torque_nmm) / (scale * radius_mm));
  if (length(truth.force_n) > floor_n) {
    tally.direction_deg.push_back(angle_between(answer.wrench.force_n, truth.force_n));
  }
  if (answer.error_n) tally.bound_held.push_back(error_n <= *answer.error_n ? 1.0 : 0.0);
  tally.samples = std::max(tally.samples, static_cast<double>(answer.samples));
}

}  // namespace

const Wrench& truth_for(const Method& method, const Reference& reference, std::size_t exponent) {
  return method.law == ForceLaw::energy ? reference.energy[exponent] : reference.blanch[exponent];
}

ForceStation::ForceStation(const Scene& scene, const SceneRecipe& recipe, ToolKind tool,
                           int radius_voxels, bool quick, unsigned long seed)
    : scene_(scene),
      recipe_(recipe),
      tool_(tool),
      radius_voxels_(radius_voxels),
      radius_mm_(radius_voxels * kVoxelMm),
      quick_(quick),
      random_(seed),
      methods_(all_methods()) {
  for (const Method& method : methods_) {
    for (std::size_t e = 0; e < kExponents.size(); ++e) {
      queries_.emplace_back(method, shape(), material(e));
    }
  }
}

ForceTool ForceStation::shape() const {
  constexpr double kSlender = 0.25;
  ForceTool tool;
  const double side = tool_ == ToolKind::ball ? radius_mm_ : kSlender * radius_mm_;
  tool.radii_mm = {side, side, radius_mm_};
  return tool;
}

ForceMaterial ForceStation::material(std::size_t exponent) const {
  ForceMaterial material;
  material.exponent = kExponents[exponent];
  return material;
}

std::vector<ForceRow> ForceStation::empty_rows() const {
  std::vector<ForceRow> rows;
  for (const Method& method : methods_) {
    for (const double exponent : kExponents) {
      ForceRow row;
      row.scene = recipe_.name;
      row.group = recipe_.group == Group::smooth ? "smooth" : "sharp";
      row.tool = tool_ == ToolKind::ball ? "ball" : "ellipsoid";
      row.radius_voxels = radius_voxels_;
      row.radius_mm = radius_mm_;
      row.method = method.name;
      row.series = method.series;
      row.law = method.law == ForceLaw::energy ? "energy" : "blanch";
      row.exponent = exponent;
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::string ForceStation::time_key(const Method& method, std::size_t exponent) const {
  return std::to_string(static_cast<int>(tool_)) + " " + std::to_string(radius_voxels_) + " " +
         method.name + " " + std::to_string(exponent);
}

/// A random pose whose tool dips so deep below the surface, in largest radii.
ForceTool ForceStation::pose_at(double depth, Vec3& normal) {
  ForceTool tool = shape();
  const SurfacePoint surface = scene_.point_for(random_, radius_mm_);
  assert(std::abs(length(surface.normal) - 1.0) < 1e-6);
  tool.orientation = random_.orientation();
  normal = surface.normal;
  const Vec3 local = rotate(conjugate(tool.orientation), normal);
  // Half the width of the ellipsoid along the normal: so far its centre stands off when
  // it just touches.
  const double extent =
      std::hypot(tool.radii_mm.x * local.x, tool.radii_mm.y * local.y, tool.radii_mm.z * local.z);
  tool.position_mm = surface.point_mm + (extent - depth * radius_mm_) * normal;
  return tool;
}

int ForceStation::poses_per_depth() const { return quick_ || tool_ == ToolKind::ellipsoid ? 1 : 2; }

int ForceStation::reference_across() const {
  if (quick_) return kQuickAcross;
  return recipe_.has_detail ? std::max(kReferenceAcross, radius_voxels_) : kReferenceAcross;
}

/// How much the reference still moves with finer nodes.
void ForceStation::check_reference(const ForceTool& pose, const Reference& reference) {
  const int finer = reference_across() * 3 / 2;
  const Reference check =
      reference_force(scene_.distance, scene_.probe_mm, pose, material(0), finer);
  const double floor_n = kFloorFraction * material(0).surface_force_n;
  for (std::size_t e = 0; e < kExponents.size(); ++e) {
    const auto change = [floor_n](const Wrench& before, const Wrench& now) {
      return length(before.force_n - now.force_n) / std::max(length(now.force_n), floor_n);
    };
    reference_change_ = {
        std::max(reference_change_.energy, change(reference.energy[e], check.energy[e])),
        std::max(reference_change_.blanch, change(reference.blanch[e], check.blanch[e]))};
  }
}

void ForceStation::time_finest_lattice(FinestTimes& times) {
  Vec3 normal;
  const ForceTool pose = pose_at(kDepths[3], normal);
  const FieldWindow window = finest_window(scene_.distance, pose, 0.0);
  for (std::size_t m = 0; m < methods_.size(); ++m) {
    if (!reads_finest_lattice(methods_[m])) continue;
    for (std::size_t e = 0; e < kExponents.size(); ++e) {
      const Query& query = queries_[m * kExponents.size() + e];
      time_calls([&] { return query.ask(window.view, pose); }, times[time_key(methods_[m], e)]);
    }
  }
}

Result<std::vector<ForceRow>> ForceStation::measure(const FinestTimes& finest_times) {
  std::vector<ForceRow> rows = empty_rows();
  for (const double depth : kDepths) {
    for (int i = 0; i < poses_per_depth(); ++i) {
      const bool is_first = i == 0;
      if (auto done = measure_pose(depth, is_first, rows); !done) return done.error();
    }
  }
  if (auto done = measure_ripple(rows); !done) return done.error();
  if (auto done = time_windows(rows); !done) return done.error();
  for (std::size_t m = 0; m < methods_.size(); ++m) {
    for (std::size_t e = 0; e < kExponents.size(); ++e) {
      const auto known = finest_times.find(time_key(methods_[m], e));
      if (known != finest_times.end()) rows[m * kExponents.size() + e].tally.cpu_us = known->second;
    }
  }
  std::erase_if(rows, [](const ForceRow& row) {
    return row.tally.error.empty() && row.tally.cpu_us.empty();
  });
  return rows;
}

/// What the windows take that the methods read, half a radius deep, with a radius' margin. Only of
/// balls of three sizes: a window takes a thousand times as long as a query.
Result<void> ForceStation::time_windows(std::vector<ForceRow>& rows) {
  constexpr int kWindows = 3;
  const bool is_timed = std::ranges::find(kWindowRadii, radius_voxels_) != kWindowRadii.end();
  if (!is_timed || tool_ != ToolKind::ball) return {};
  Vec3 normal;
  const ForceTool pose = pose_at(kDepths[3], normal);
  std::map<std::pair<double, double>, cli::WindowTimes> known;  // by spacing and reach
  for (std::size_t m = 0; m < methods_.size(); ++m) {
    if (!is_servable(methods_[m], pose)) continue;
    const double spacing = spacing_mm(methods_[m], pose);
    WindowRequest request = cli::servo_window(pose, material(0), spacing, radius_mm_);
    if (methods_[m].quadrature == Quadrature::point) {
      request.reach_mm = std::min(request.reach_mm, radius_mm_ + kPointBorder * spacing);
    }
    const std::pair key{request.voxel_mm, request.reach_mm};
    auto times = known.find(key);
    if (times == known.end()) {
      auto timed = cli::time_windows(*scene_.clay, pose, request, kWindows);
      if (!timed) return timed.error();
      times = known.emplace(key, std::move(timed).value()).first;
    }
    for (std::size_t e = 0; e < kExponents.size(); ++e) {
      rows[m * kExponents.size() + e].tally.windows = times->second;
    }
  }
  return {};
}

/// What the method answers, timed on the clay's window; on the finest lattice it is timed apart.
Answer ForceStation::timed_answer(const Query& query, const Method& method,
                                  const FieldWindowView* window, const ForceTool& pose,
                                  Tally& tally) const {
  if (method.quadrature == Quadrature::stencil) return query.ask(scene_.distance, pose);
  if (method.quadrature == Quadrature::fine) return query.ask(*window, pose);
  return time_calls([&] { return query.ask(*window, pose); }, tally.cpu_us);
}

/// What was just measured of the servo, when that took the centre, and of the sum there: the rows
/// of lod stand before those of servo.
void ForceStation::note_centre(const Answer& answer, std::size_t row,
                               std::vector<ForceRow>& rows) const {
  if (answer.samples != 1) return;
  const ForceRow& sum = rows[row - kExponents.size()];
  assert(sum.method == "lod" && sum.exponent == rows[row].exponent);
  Tally& tally = rows[row].tally;
  tally.centre_error.push_back(tally.error.back());
  tally.centre_lod_error.push_back(sum.tally.error.back());
  tally.centre_us.push_back(tally.cpu_us.back());
}

/// One pose: the methods against the reference, and timed.
Result<void> ForceStation::measure_pose(double depth, bool is_first, std::vector<ForceRow>& rows) {
  Vec3 normal;
  const ForceTool pose = pose_at(depth, normal);
  const ForceMaterial usual = material(0);
  const Reference reference =
      reference_force(scene_.distance, scene_.probe_mm, pose, usual, reference_across());
  if (is_first && depth == kDepths[2] && radius_voxels_ <= 16) {
    check_reference(pose, reference);
  }
  Windows windows(scene_, pose, usual, 0.0);
  const bool with_dense = is_first && !quick_ && (depth == kDepths.front() || depth == kDepths[3]);
  const double floor_n = kFloorFraction * usual.surface_force_n;
  for (std::size_t m = 0; m < methods_.size(); ++m) {
    const Method& method = methods_[m];
    if (!is_measured(method, pose) || (is_dense(method) && !with_dense)) continue;
    auto window = windows.of(method);
    if (!window) return window.error();
    for (std::size_t e = 0; e < kExponents.size(); ++e) {
      const std::size_t row = m * kExponents.size() + e;
      Tally& tally = rows[row].tally;
      const Answer answer = timed_answer(queries_[row], method, window.value(), pose, tally);
      compare(answer, truth_for(method, reference, e), reference.push_n[e], floor_n, radius_mm_,
              tally);
      if (depth == kDepths.front()) tally.shallow_error.push_back(tally.error.back());
      if (method.quadrature == Quadrature::chosen) note_centre(answer, row, rows);
    }
  }
  return {};
}

}  // namespace argil::evaluation

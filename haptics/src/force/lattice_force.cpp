// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/force/lattice_force.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "force/lattice_sums.h"
#include "force/law_table.h"
#include "force/tool_kernel.h"
#include "force/window_field.h"
#include "math/mat3.h"

namespace argil::haptics {
namespace {

/// Nodes across the tool's smallest diameter.
constexpr double kAcross = 8.0;
/// Most nodes from the middle of the support to its farthest point: leaves a margin for motion in a
/// window of kWindowCapacity.
constexpr double kMostReach = 27.0;

/// Filtered laws reach this many voxels beyond the skin.
constexpr double kFilterVoxels = 2.0;

/// The parts of `error_n`, chosen so that 99 % of the errors lie below, on exact fields
/// (LatticeForceError.*) and on the chart's clay: what the two halves of the lattice differ by; a
/// distance that bends within a voxel, as so many voxels of depth; the fraction of a voxel that the
/// window's distance is off by, which turns the force as well; what is left.
constexpr double kHalvesWeight = 2.0;
constexpr double kBendVoxels = 0.015;
constexpr double kTurnWeight = 0.8;
constexpr double kLeftWeight = 0.007;

double smallest(const Vec3& v) noexcept { return std::min({v.x, v.y, v.z}); }
double largest(const Vec3& v) noexcept { return std::max({v.x, v.y, v.z}); }

/// From the middle of the support to its farthest point.
double circumscribed_mm(const ForceTool& tool) noexcept {
  const Vec3 reach = ToolKernel(tool).reach_mm();
  return tool.shape == ToolShape::box ? length(reach) : largest(reach);
}

bool is_ball(const ForceTool& tool) noexcept {
  const Vec3& r = tool.radii_mm;
  return tool.shape == ToolShape::ellipsoid && r.x == r.y && r.y == r.z;
}

SumShape sum_shape(const ForceTool& tool) noexcept {
  if (tool.shape == ToolShape::box) return SumShape::box;
  if (tool.shape == ToolShape::capsule) return SumShape::capsule;
  return is_ball(tool) ? SumShape::ball : SumShape::ellipsoid;
}

void sum_with(Simd simd, const LatticeJob& job, LatticeSums& sums) noexcept {
#if defined(__x86_64__)
  if (simd == Simd::avx512) return avx512::sum_lattice(job, sums);
  if (simd == Simd::avx2) return avx2::sum_lattice(job, sums);
#endif
  assert(simd == Simd::baseline);
  baseline::sum_lattice(job, sums);
}

/// Fills the range of nodes under the support; false when the window does not hold all of it.
/// `border` nodes at each face serve as neighbours only.
bool set_range(const FieldWindowView& window, const Vec3& center, const Vec3& reach, int border,
               LatticeJob& job) noexcept {
  assert(border >= 0);
  bool whole = true;
  for (std::size_t a = 0; a < 3; ++a) {
    const double first = border;
    const double last = window.nodes[a] - 1 - border;
    const double low = std::ceil(center[a] - reach[a]);
    const double high = std::floor(center[a] + reach[a]);
    whole = whole && low >= first && high <= last;  // false for NaN
    const bool meets = low <= last && high >= first;
    job.low[a] = meets ? static_cast<int>(std::max(low, first)) : 0;
    job.high[a] = meets ? static_cast<int>(std::min(high, last)) : -1;
    assert(job.high[a] < window.nodes[a]);
  }
  return whole;
}

constexpr Vec3 as_vec3(const double (&v)[3]) noexcept { return {v[0], v[1], v[2]}; }

/// From the tool's frame to the world's.
Vec3 turned(const std::array<Vec3, 3>& axes, const Vec3& v) noexcept {
  return v.x * axes[0] + v.y * axes[1] + v.z * axes[2];
}

}  // namespace

Lattice choose_lattice(const ForceTool& tool) noexcept {
  assert(smallest(tool.radii_mm) > 0.0);
  const double volume = ToolKernel(tool).support_mm3();
  Lattice lattice;
  lattice.voxel_mm =
      std::max({2.0 * smallest(tool.radii_mm) / kAcross, std::cbrt(volume / kMostSamples),
                circumscribed_mm(tool) / kMostReach});
  lattice.samples = volume / (lattice.voxel_mm * lattice.voxel_mm * lattice.voxel_mm);
  lattice.across = 2.0 * smallest(tool.radii_mm) / lattice.voxel_mm;
  return lattice;
}

double resting_margin_mm(const ForceTool& tool) noexcept {
  return std::clamp(2.0 * largest(tool.radii_mm), 1.0, 4.0);
}

double window_reach_mm(const ForceTool& tool, const Lattice& lattice, double margin_mm) noexcept {
  constexpr double kBorder = 1.0;  // the neighbours that blanch takes differences of
  assert(lattice.voxel_mm > 0.0 && margin_mm >= 0.0);
  return circumscribed_mm(tool) + margin_mm + kBorder * lattice.voxel_mm;
}

double window_depth_mm(const ForceTool& tool, const ForceMaterial& material,
                       const Lattice& lattice) noexcept {
  assert(lattice.voxel_mm > 0.0 && material.skin_mm > 0.0);
  return circumscribed_mm(tool) + 2.0 * largest(tool.radii_mm) + material.skin_mm +
         kFilterVoxels * lattice.voxel_mm;
}

LatticeForce::LatticeForce(const ForceTool& tool, const ForceMaterial& material, ForceLaw law,
                           double voxel_mm, Simd simd) noexcept
    : shape_(tool), material_(material), law_(law), simd_(simd), voxel_mm_(voxel_mm) {
  assert(voxel_mm > 0.0 && has_simd(simd));
  static_assert(kSegments == kLawSegments);
  const ToolKernel kernel(tool);
  reach_mm_ = kernel.reach_mm();
  segment_mm_ = kernel.segment_mm();
  const double voxel_mm3 = voxel_mm * voxel_mm * voxel_mm;
  weight_sum_ = kernel.integral_mm3() / voxel_mm3;
  assert(weight_sum_ > 0.0);
  constexpr double kRounding = 1.001;
  is_bounded_ = kernel.support_mm3() <= kRounding * kMostSamples * voxel_mm3;
  const ContactLaw contact(material);
  const LawTable table = law == ForceLaw::energy ? filtered_potential(contact, voxel_mm)
                                                 : filtered_pressure(contact, voxel_mm);
  table_low_mm_ = table.low_mm;
  table_per_mm_ = table.per_mm;
  table_ = table.coefficient;
}

/// The query in units of one voxel.
void LatticeForce::fill_job(const FieldWindowView& window, const Vec3& center,
                            const std::array<Vec3, 3>& axes, double offset,
                            LatticeJob& job) const noexcept {
  job.shape = sum_shape(shape_);
  job.blanch = law_ == ForceLaw::blanch;
  job.values = window.distance_mm.data();
  job.count = static_cast<std::ptrdiff_t>(window.distance_mm.size());
  for (std::size_t a = 0; a < 3; ++a) {
    job.nodes[a] = window.nodes[a];
    job.center[a] = center[a];
    job.reach[a] = reach_mm_[a] / voxel_mm_;
    for (std::size_t b = 0; b < 3; ++b) job.axes[a][b] = axes[a][b];
  }
  job.segment = segment_mm_ / voxel_mm_;
  job.law = table_[0].data();
  job.law_low = static_cast<float>(table_low_mm_);
  job.law_per_mm = static_cast<float>(table_per_mm_);
  job.skin_inverse = static_cast<float>(1.0 / material_.skin_mm);
  job.voxel_inverse = static_cast<float>(1.0 / voxel_mm_);
  job.law_offset = static_cast<float>(offset);
}

/// The contact's part of the result from the sums, which are in voxels. A slope is 1 / voxel there;
/// its moment has no unit.
void LatticeForce::apply_contact(const LatticeSums& sums, const std::array<Vec3, 3>& axes,
                                 double offset, double distance_error_mm,
                                 ForceResult& result) const noexcept {
  const Vec3 even = as_vec3(sums.force_even);
  const Vec3 odd = as_vec3(sums.force_odd);
  result.samples = static_cast<int>(sums.samples);
  double stiffness_n_per_mm = sums.law_rate / weight_sum_ * table_per_mm_;
  double halves_n = length(even - odd) / weight_sum_;
  if (law_ == ForceLaw::energy) {
    result.contact_n = turned(axes, even + odd) / (weight_sum_ * voxel_mm_);
    result.contact_nmm = turned(axes, as_vec3(sums.torque)) / weight_sum_;
    result.energy_nmm = sums.law / weight_sum_ + offset;
    stiffness_n_per_mm *= table_per_mm_;
    halves_n /= voxel_mm_;
  } else {
    result.contact_n = turned(axes, even + odd) / weight_sum_;
    result.contact_nmm = (voxel_mm_ / weight_sum_) * turned(axes, as_vec3(sums.torque));
  }
  result.stiffness_n_per_mm = std::abs(stiffness_n_per_mm);
  const double felt_n = length(result.contact_n);
  result.error_n = kHalvesWeight * halves_n +
                   (kBendVoxels * voxel_mm_ + distance_error_mm) * result.stiffness_n_per_mm +
                   (kTurnWeight * distance_error_mm / voxel_mm_ + kLeftWeight) * felt_n;
}

/// Eq. 1 summed, its moments in the tool's frame and in voxels.
void LatticeForce::apply_drag(const LatticeSums& sums, const std::array<Vec3, 3>& axes,
                              const ForceTool& pose, ForceResult& result) const noexcept {
  const double scale = -material_.viscosity_s_per_mm * material_.viscosity_force_n / weight_sum_;
  const Vec3& v = pose.velocity_mm_per_s;
  const Vec3& omega = pose.angular_velocity_rad_per_s;
  const Vec3 first = voxel_mm_ * turned(axes, as_vec3(sums.drag_first));
  const double* s = sums.drag_second;
  const Mat3 second{{Vec3{s[0], s[5], s[4]}, Vec3{s[5], s[1], s[3]}, Vec3{s[4], s[3], s[2]}}};
  const Vec3 spin{dot(axes[0], omega), dot(axes[1], omega), dot(axes[2], omega)};
  const Vec3 swept = (s[0] + s[1] + s[2]) * spin - second * spin;  // sum of u q x (omega x q)
  result.viscosity_n = scale * (sums.drag * v + cross(omega, first));
  result.viscosity_nmm = scale * (cross(first, v) + voxel_mm_ * voxel_mm_ * turned(axes, swept));
}

ForceResult LatticeForce::evaluate(const FieldWindowView& window,
                                   const ForceTool& pose) const noexcept {
  ForceResult result;
  result.outside_window = true;
  if (window.voxel_mm != voxel_mm_ || !is_bounded_) return result;
  assert(is_consistent(window));
  const std::array<Vec3, 3> axes = axes_of(is_ball(shape_) ? Quat{} : pose.orientation);
  const Vec3 center = (pose.position_mm - window.origin_mm) / voxel_mm_;
  const Vec3 reach = ToolKernel(shape_).extent_mm(axes) / voxel_mm_;
  LatticeJob job;
  result.outside_window = !set_range(window, center, reach, law_ == ForceLaw::blanch ? 1 : 0, job);
  if (job.high[0] < job.low[0] || job.high[1] < job.low[1] || job.high[2] < job.low[2]) {
    return result;
  }
  // The energy law only feels differences: taking the value at the centre from all keeps the sums
  // small. Not where the sum is cut off: there it would not cancel.
  double offset = 0.0;
  if (law_ == ForceLaw::energy && !result.outside_window) {
    const LawTable table{table_low_mm_, table_per_mm_, table_};
    offset = table.at(distance_at(window, pose.position_mm));
  }
  fill_job(window, center, axes, offset, job);
  LatticeSums sums;
  sum_with(simd_, job, sums);
  apply_contact(sums, axes, offset, window.distance_error_mm, result);
  apply_drag(sums, axes, pose, result);
  return result;
}

}  // namespace argil::haptics

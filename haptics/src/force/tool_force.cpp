// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/force/tool_force.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "force/force_law.h"
#include "force/tool_kernel.h"
#include "force/window_field.h"
#include "math/mat3.h"

namespace argil::haptics {
namespace {

// Notation: c the tool's centre, r = x - c in the world's frame, q the same in the tool's frame, w
// the kernel and G its gradient there, both divided by W, the sum of the kernel over the nodes, so
// that it sums to 1 however the nodes lie.

/// Below this many nodes the lattice does not resolve the kernel; the point force stands in.
constexpr int kFewestSamples = 32;
/// As above, for kernels with many nodes but thinner than a voxel: see energy_contact.
constexpr double kLeastDeterminant = 0.25;
/// |grad phi| below which a direction means nothing: a plateau or the crest of a medial axis.
constexpr double kLeastGradient = 1e-3;

struct KernelNode {
  int i = 0;
  int j = 0;
  int k = 0;
  double phi_mm = 0.0;
  Vec3 r;
  Vec3 q;
  KernelValue kernel;
};

/// The kernel laid over the window's lattice.
class KernelNodes {
 public:
  KernelNodes(const FieldWindowView& window, const ForceTool& tool) noexcept;

  bool outside_window() const noexcept { return outside_window_; }

  /// Calls visit(KernelNode) for every node under the kernel in memory order.
  template <class Visit>
  void for_each(const Visit& visit) const noexcept;

 private:
  void set_range(std::size_t axis, double reach) noexcept;

  const FieldWindowView& window_;
  ToolKernel kernel_;
  Vec3 first_;                     ///< r of the window's node (0, 0, 0)
  std::array<Vec3, 3> tool_axes_;  ///< the tool's axes in the world's frame
  std::array<int, 3> low_{};
  std::array<int, 3> high_{};  ///< inclusive; below low_ when the kernel misses the window
  bool outside_window_ = false;
};

KernelNodes::KernelNodes(const FieldWindowView& window, const ForceTool& tool) noexcept
    : window_(window),
      kernel_(tool),
      first_(window.origin_mm - tool.position_mm),
      tool_axes_(axes_of(tool.orientation)) {
  assert(window.voxel_mm > 0.0 && is_consistent(window));
  const Vec3 extent = kernel_.extent_mm(tool_axes_);
  for (std::size_t axis = 0; axis < 3; ++axis) set_range(axis, extent[axis]);
}

/// The nodes along one axis that may lie under the kernel, cut to the window.
void KernelNodes::set_range(std::size_t axis, double reach) noexcept {
  assert(!(reach < 0.0));
  const double last = window_.nodes[axis] - 1;
  const double low = (-reach - first_[axis]) / window_.voxel_mm;
  const double high = (reach - first_[axis]) / window_.voxel_mm;
  if (!(low >= 0.0 && high <= last)) outside_window_ = true;  // also for NaN
  if (!(low <= last && high >= 0.0)) {
    low_[axis] = 0;
    high_[axis] = -1;
    return;
  }
  low_[axis] = static_cast<int>(std::ceil(std::max(low, 0.0)));
  high_[axis] = static_cast<int>(std::floor(std::min(high, last)));
}

template <class Visit>
void KernelNodes::for_each(const Visit& visit) const noexcept {
  KernelNode node;
  for (node.i = low_[0]; node.i <= high_[0]; ++node.i) {
    for (node.j = low_[1]; node.j <= high_[1]; ++node.j) {
      for (node.k = low_[2]; node.k <= high_[2]; ++node.k) {
        const Vec3 step{static_cast<double>(node.i), static_cast<double>(node.j),
                        static_cast<double>(node.k)};
        node.r = first_ + window_.voxel_mm * step;
        node.q = {dot(tool_axes_[0], node.r), dot(tool_axes_[1], node.r),
                  dot(tool_axes_[2], node.r)};
        if (!kernel_.at(node.q, node.kernel)) continue;
        node.phi_mm = static_cast<double>(window_.at(node.i, node.j, node.k));
        visit(node);
      }
    }
  }
}

/// The moments of eq. 1 over the kernel, kernel not yet divided by W.
struct DragSums {
  double zeroth = 0.0;
  Vec3 first;
  Mat3 second;

  void add(double weight, const Vec3& r) noexcept {
    zeroth += weight;
    first += weight * r;
    second.add_outer(weight, r, r);
  }
};

/// -alpha f_v0 times the sum of u (v + omega x r) and of its moment about the centre.
void apply_drag(const DragSums& sums, double weight_sum, const ForceTool& tool,
                const ForceMaterial& material, ForceResult& result) noexcept {
  assert(weight_sum > 0.0 && sums.zeroth >= 0.0);
  const double scale = -material.viscosity_s_per_mm * material.viscosity_force_n / weight_sum;
  const Vec3& v = tool.velocity_mm_per_s;
  const Vec3& omega = tool.angular_velocity_rad_per_s;
  const double trace = sums.second.row[0].x + sums.second.row[1].y + sums.second.row[2].z;
  result.viscosity_n = scale * (sums.zeroth * v + cross(omega, sums.first));
  result.viscosity_nmm =
      scale * (cross(sums.first, v) + trace * omega - sums.second * omega);  // r x (omega x r)
}

/// What the energy law needs of all nodes; names say the weight, then what is summed.
struct EnergySums {
  double kernel = 0.0;  ///< W
  Vec3 kernel_q;
  double kernel_phi = 0.0;  ///< times Phi
  Vec3 slope;
  Vec3 slope_phi;
  Mat3 slope_q;
  Vec3 twist;  ///< q x slope
  Vec3 twist_phi;
  Mat3 twist_q;

  void add(const KernelNode& node, double potential) noexcept {
    const KernelValue& k = node.kernel;
    kernel += k.weight;
    kernel_q += k.weight * node.q;
    kernel_phi += k.weight * potential;
    slope += k.slope;
    slope_phi += potential * k.slope;
    slope_q.add_outer(1.0, k.slope, node.q);
    twist += k.twist;
    twist_phi += potential * k.twist;
    twist_q.add_outer(1.0, k.twist, node.q);
  }
};

/// Force and torque, in the tool's frame, of the sums: sum of (G - mean) Phi with the mean spread
/// as the kernel is, so that a constant Phi gives nothing, then the 3 x 3 correction that makes a
/// linear Phi exact: the sum of G q^T is -I for the integral and nearly so on a lattice. The torque
/// has the density q x G, zero for a ball; a linear Phi's is known, so what the lattice gives for
/// it is taken away. False when the lattice does not resolve the kernel.
bool energy_contact(const EnergySums& sums, Vec3& force, Vec3& torque) noexcept {
  assert(sums.kernel > 0.0);
  const double scale = 1.0 / sums.kernel;
  const double energy = sums.kernel_phi * scale;
  const Vec3 mean_q = sums.kernel_q * scale;
  const Vec3 mean = scale * sums.slope;
  Mat3 moment;
  for (std::size_t i = 0; i < 3; ++i) {
    moment.row[i] = -scale * sums.slope_q.row[i] + mean[i] * mean_q;
  }
  if (!(determinant(moment) > kLeastDeterminant)) return false;
  force = solve(moment, scale * sums.slope_phi - mean * energy);

  const Vec3 mean_twist = scale * sums.twist;
  torque = scale * sums.twist_phi - mean_twist * energy;
  for (std::size_t i = 0; i < 3; ++i) {
    torque[i] += dot(scale * sums.twist_q.row[i] - mean_twist[i] * mean_q, force);
  }
  return true;
}

/// The energy law; false when the lattice does not resolve the kernel.
bool energy_force(const FieldWindowView& window, const ForceTool& tool,
                  const ForceMaterial& material, ForceResult& result) noexcept {
  const KernelNodes nodes(window, tool);
  const ContactLaw law(material);
  EnergySums sums;
  DragSums drag;
  result.outside_window = nodes.outside_window();
  nodes.for_each([&](const KernelNode& node) {
    const double u = law.density(node.phi_mm);
    sums.add(node, law.potential_nmm(u));
    if (u > 0.0) drag.add(node.kernel.weight * u, node.r);
    ++result.samples;
  });
  if (result.samples < kFewestSamples) return false;
  Vec3 force;
  Vec3 torque;
  if (!energy_contact(sums, force, torque)) return false;
  result.contact_n = rotate(tool.orientation, force);
  result.contact_nmm = rotate(tool.orientation, torque);
  result.energy_nmm = sums.kernel_phi / sums.kernel;
  apply_drag(drag, sums.kernel, tool, material, result);
  return true;
}

/// Eq. 2 over the body: the kernel times the law along the unit gradient, which is zero where the
/// field is flat. False when the lattice does not resolve the kernel.
bool blanch_force(const FieldWindowView& window, const ForceTool& tool,
                  const ForceMaterial& material, ForceResult& result) noexcept {
  const KernelNodes nodes(window, tool);
  const ContactLaw law(material);
  double weight_sum = 0.0;
  Vec3 force;
  Vec3 torque;
  DragSums drag;
  result.outside_window = nodes.outside_window();
  nodes.for_each([&](const KernelNode& node) {
    const double weight = node.kernel.weight;
    weight_sum += weight;
    ++result.samples;
    const double u = law.density(node.phi_mm);
    if (u <= 0.0) return;
    drag.add(weight * u, node.r);
    const Vec3 outward = node_gradient(window, node.i, node.j, node.k);
    const double steepness = length(outward);
    if (steepness < kLeastGradient) return;
    const Vec3 push = (weight * law.pressure(u) / steepness) * outward;
    force += push;
    torque += cross(node.r, push);
  });
  if (result.samples < kFewestSamples) return false;
  result.contact_n = (material.surface_force_n / weight_sum) * force;
  result.contact_nmm = (material.surface_force_n / weight_sum) * torque;
  apply_drag(drag, weight_sum, tool, material, result);
  return true;
}

}  // namespace

ForceResult volume_force(const FieldWindowView& window, const ForceTool& tool,
                         const ForceMaterial& material, ForceLaw law) noexcept {
  assert(tool.radii_mm.x > 0.0 && tool.radii_mm.y > 0.0 && tool.radii_mm.z > 0.0);
  ForceResult result;
  const bool resolved = law == ForceLaw::energy ? energy_force(window, tool, material, result)
                                                : blanch_force(window, tool, material, result);
  if (resolved) return result;
  const bool partial = result.outside_window;
  result = point_force(window, tool, material);
  result.outside_window = result.outside_window || partial;
  if (law == ForceLaw::blanch) result.energy_nmm = 0.0;
  return result;
}

ForceResult point_force(const FieldWindowView& window, const ForceTool& tool,
                        const ForceMaterial& material) noexcept {
  ForceResult result;
  const FieldSample sample = sample_field(window, tool.position_mm);
  result.outside_window = !sample.inside;
  if (!sample.inside) return result;
  const ContactLaw law(material);
  const double u = law.density(sample.phi_mm);
  const double steepness = length(sample.gradient);
  result.samples = 1;
  result.energy_nmm = law.potential_nmm(u);
  if (u > 0.0 && steepness >= kLeastGradient) {
    result.contact_n = (material.surface_force_n * law.pressure(u) / steepness) * sample.gradient;
  }
  result.viscosity_n =
      -(material.viscosity_s_per_mm * material.viscosity_force_n * u) * tool.velocity_mm_per_s;
  return result;
}

bool point_is_enough(double radius_mm, double phi_mm, const ForceMaterial& material) noexcept {
  assert(radius_mm > 0.0);
  const ContactLaw law(material);
  const double u = law.density(phi_mm);
  const double reach = kKernelSupport * radius_mm / material.skin_mm;  // in units of u
  const double to_clamp = law.clamp_density() - u;
  if (to_clamp <= -reach) return true;              // the clamped force all over the kernel
  if (u < reach || to_clamp < reach) return false;  // a kink of the law under the kernel
  const double curvature = material.exponent * (material.exponent - 1.0);
  return radius_mm * radius_mm * curvature <= 0.1 * material.skin_mm * material.skin_mm * u * u;
}

bool point_is_enough(const FieldWindowView& window, const ForceTool& tool,
                     const ForceMaterial& material) noexcept {
  constexpr double kTolerance = 0.005;  // in each way, so that together they stay within 1 %
  const Vec3& radii = tool.radii_mm;
  const double radius = std::max({radii.x, radii.y, radii.z});
  const FieldSample middle = sample_field(window, tool.position_mm);
  if (!middle.inside || !point_is_enough(radius, middle.phi_mm, material)) return false;
  // Even bending shifts the mean of phi over the kernel (second moment R^2 / 5) and so the force;
  // odd bending, as beside an edge, turns it. Looked for as far as the kernel reaches: a kink that
  // only its rim touches turns the force by some percent.
  const double reach = kKernelSupport * radius;
  double shift_mm = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3 step;
    step[axis] = reach;
    const Vec3 next = tool.position_mm + step;
    const Vec3 last = tool.position_mm - step;
    if (!is_inside(window, next) || !is_inside(window, last)) return false;
    const double ahead_mm = distance_at(window, next);
    const double behind_mm = distance_at(window, last);
    const double slope = (ahead_mm - behind_mm) / (2.0 * reach);
    if (std::abs(slope - middle.gradient[axis]) > kTolerance) return false;
    shift_mm +=
        (ahead_mm + behind_mm - 2.0 * middle.phi_mm) / (10.0 * kKernelSupport * kKernelSupport);
  }
  const double u = std::max(1.0 - middle.phi_mm / material.skin_mm, 1e-3);
  return std::abs(shift_mm) <= kTolerance * material.skin_mm * u / material.exponent;
}

}  // namespace argil::haptics

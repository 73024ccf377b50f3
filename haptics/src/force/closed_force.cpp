// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/haptics/force/closed_force.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "force/force_law.h"
#include "force/tool_kernel.h"
#include "math/unit.h"

namespace argil::haptics {
namespace {

// Notation: z is the height within the kernel's support as a fraction of its half height, from -1
// to 1 along the way out of the clay; `outer` and `inner` are the z of the law's two kinks, where u
// is 0 and where the clamp sets in. `slice` is the kernel's weight at z.

/// Gauss-Legendre with 12 nodes: exact for polynomials up to degree 23.
constexpr std::array<double, 6> kGaussNode{0.1252334085114689, 0.3678314989981802,
                                           0.5873179542866175, 0.7699026741943047,
                                           0.9041172563704749, 0.9815606342467192};
constexpr std::array<double, 6> kGaussWeight{0.2491470458134028, 0.2334925365383548,
                                             0.2031674267230659, 0.1600783285433462,
                                             0.1069393259953184, 0.0471753363865118};

/// The integral of f(z) over -1 to 1, cut where the law has a kink.
template <class Function>
auto integrate(const Function& function, double kink, double other_kink) {
  std::array<double, 4> end{-1.0, std::clamp(kink, -1.0, 1.0), std::clamp(other_kink, -1.0, 1.0),
                            1.0};
  std::sort(end.begin(), end.end());
  decltype(function(0.0)) sum{};
  for (std::size_t n = 0; n + 1 < end.size(); ++n) {
    const double middle = 0.5 * (end[n] + end[n + 1]);
    const double half = 0.5 * (end[n + 1] - end[n]);
    for (std::size_t g = 0; g < kGaussNode.size(); ++g) {
      sum += (half * kGaussWeight[g]) * function(middle + half * kGaussNode[g]);
      sum += (half * kGaussWeight[g]) * function(middle - half * kGaussNode[g]);
    }
  }
  return sum;
}

/// Normalises (1 - z^2)^5 over -1 to 1.
constexpr double kSliceNorm = 693.0 / 512.0;

double slice(double z) noexcept {
  assert(z >= -1.0 && z <= 1.0);
  const double t = 1.0 - z * z;
  return kSliceNorm * t * t * t * t * t;
}

}  // namespace

ForceResult plane_force(const Vec3& normal, double offset_mm, const ForceTool& tool,
                        const ForceMaterial& material) noexcept {
  assert(tool.shape == ToolShape::ellipsoid);
  assert(is_finite(tool.position_mm) && is_unit(normal));
  const Vec3 reach = ToolKernel(tool).reach_mm();
  const std::array<Vec3, 3> axes = axes_of(tool.orientation);
  // The slice at height z has its middle at z * lean.
  Vec3 lean;
  for (std::size_t a = 0; a < 3; ++a) {
    lean += (reach[a] * reach[a] * dot(axes[a], normal)) * axes[a];
  }
  const double height = std::sqrt(dot(lean, normal));
  assert(height > 0.0);
  lean *= 1.0 / height;
  const ContactLaw law(material);
  const double middle = dot(normal, tool.position_mm) - offset_mm;
  const double outer = (law.skin_mm() - middle) / height;
  const double inner = outer - law.clamp_density() * law.skin_mm() / height;
  const auto density = [&](double z) { return law.density(middle + height * z); };

  ForceResult result;
  const double force =
      integrate([&](double z) { return slice(z) * law.force_n(density(z)); }, outer, inner);
  const double leaning =
      integrate([&](double z) { return slice(z) * z * law.force_n(density(z)); }, outer, inner);
  result.contact_n = force * normal;
  result.contact_nmm = leaning * cross(lean, normal);
  result.energy_nmm =
      integrate([&](double z) { return slice(z) * law.potential_nmm(density(z)); }, outer, inner);
  result.samples = 1;
  return result;
}

ForceResult ball_force(const Vec3& center_mm, double radius_mm, const ForceTool& tool,
                       const ForceMaterial& material) noexcept {
  assert(tool.shape == ToolShape::ellipsoid && tool.radii_mm.x == tool.radii_mm.y &&
         tool.radii_mm.y == tool.radii_mm.z);
  const double reach = kKernelSupport * tool.radii_mm.x;
  const Vec3 outward = tool.position_mm - center_mm;
  const double apart = length(outward);
  assert(is_finite(outward) && apart > reach && radius_mm > 0.0);
  const ContactLaw law(material);
  const double outer = (law.skin_mm() + radius_mm - apart) / reach;
  const double inner = outer - law.clamp_density() * law.skin_mm() / reach;
  // Shell of radius rho about the clay's centre: its cap within the kernel is cut at 1 - t = (rho -
  // apart)^2 / reach^2 ... 1, and weighs rho / apart times the plane slice.
  const auto weight = [&](double z) { return slice(z) * (apart + reach * z) / apart; };
  // The push of a shell leans over its cap; along the axis the mean cosine comes with it.
  const auto push = [&](double z) {
    const double rho = apart + reach * z;
    const double t = 1.0 - z * z;
    // cos = (apart^2 + rho^2 - s^2) / (2 apart rho), s the distance from the tool's centre; the
    // mean of 1 - s^2 / reach^2 over the cap, weighed with its fourth power, is 5 / 6 of its
    // largest.
    const double mean_square = reach * reach * (1.0 - 5.0 / 6.0 * t);
    return weight(z) * (apart * apart + rho * rho - mean_square) / (2.0 * apart * rho);
  };
  const auto density = [&](double z) { return law.density(apart + reach * z - radius_mm); };

  ForceResult result;
  const double force =
      integrate([&](double z) { return push(z) * law.force_n(density(z)); }, outer, inner);
  result.contact_n = (force / apart) * outward;
  result.energy_nmm =
      integrate([&](double z) { return weight(z) * law.potential_nmm(density(z)); }, outer, inner);
  result.samples = 1;
  return result;
}

}  // namespace argil::haptics

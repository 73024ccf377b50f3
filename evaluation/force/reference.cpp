// SPDX-License-Identifier: GPL-3.0-or-later
#include "force/reference.h"

#include <cassert>
#include <cmath>
#include <vector>

#include "force/law.h"

namespace argil::evaluation {
namespace {

using haptics::ForceMaterial;
using haptics::ForceTool;

// Notation as in haptics/src/force/tool_force.cpp: q the position in the tool's frame, here as a
// fraction of the support, t = 1 - |q|^2, the kernel t^4.

constexpr Vec3 scaled(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

class Integral {
 public:
  Integral(const Distance& distance, double probe_mm, const ForceTool& tool,
           const ForceMaterial& material)
      : distance_(distance), probe_mm_(probe_mm), tool_(tool), material_(material) {
    for (const double exponent : kExponents) {
      ForceMaterial other = material;
      other.exponent = exponent;
      laws_.emplace_back(other);
    }
    support_ = haptics::kKernelSupport * tool.radii_mm;
  }

  void add(const Vec3& q) {
    const double t = 1.0 - dot(q, q);
    if (t <= 0.0) return;
    // The kernel is t^4, its slope -8 t^3 q.
    const double t3 = t * t * t;
    weight_ += t3 * t;
    // A linear potential has to give its own slope: the sum is divided by this, the same integral
    // over the same points.
    slope_ += 8.0 / 3.0 * t3 * dot(q, q);
    const Vec3 r = scaled(support_, q);
    const Vec3 point = tool_.position_mm + rotate(tool_.orientation, r);
    const double u = 1.0 - distance_(point) / material_.skin_mm;
    if (u <= 0.0) return;
    const Vec3 inverse{1.0 / support_.x, 1.0 / support_.y, 1.0 / support_.z};
    const Vec3 slope = -8.0 * t3 * scaled(q, inverse);
    const Vec3 outward =
        rotate(conjugate(tool_.orientation), direction(distance_, point, probe_mm_));
    const Vec3 slope_turn = cross(r, slope);
    const Vec3 outward_turn = cross(r, outward);
    for (std::size_t e = 0; e < kExponents.size(); ++e) {
      const double potential = laws_[e].potential(u);
      const double push = t3 * t * laws_[e].pressure(u);
      sums_.energy[e].force_n += potential * slope;
      sums_.energy[e].torque_nmm += potential * slope_turn;
      sums_.push_n[e] += push;
      sums_.blanch[e].force_n += push * outward;
      sums_.blanch[e].torque_nmm += push * outward_turn;
    }
  }

  /// Divided by the weights' sum, and the slopes by what they give for a linear potential.
  Reference result() const {
    assert(weight_ > 0.0 && slope_ > 0.0);
    const double newton = material_.surface_force_n;
    Reference scaled_sums = sums_;
    for (std::size_t e = 0; e < kExponents.size(); ++e) {
      finish(newton * material_.skin_mm / slope_, scaled_sums.energy[e]);
      finish(newton / weight_, scaled_sums.blanch[e]);
      scaled_sums.push_n[e] *= newton / weight_;
    }
    return scaled_sums;
  }

 private:
  void finish(double scale, Wrench& wrench) const {
    wrench.force_n = scale * rotate(tool_.orientation, wrench.force_n);
    wrench.torque_nmm = scale * rotate(tool_.orientation, wrench.torque_nmm);
  }

  const Distance& distance_;
  double probe_mm_;
  const ForceTool& tool_;
  const ForceMaterial& material_;
  std::vector<Law> laws_;
  Vec3 support_;
  double weight_ = 0.0;
  double slope_ = 0.0;
  Reference sums_;
};

}  // namespace

Reference reference_force(const Distance& distance, double probe_mm, const ForceTool& tool,
                          const ForceMaterial& material, int across) {
  Integral integral(distance, probe_mm, tool, material);
  assert(across > 0 && probe_mm > 0.0);
  const double step = 2.0 / (haptics::kKernelSupport * across);
  const int half = static_cast<int>(std::ceil(1.0 / step));
  for (int i = -half; i < half; ++i) {
    for (int j = -half; j < half; ++j) {
      for (int k = -half; k < half; ++k) {
        // The midpoint rule, whose nodes avoid the centre and the axes.
        integral.add(step * Vec3{i + 0.5, j + 0.5, k + 0.5});
      }
    }
  }
  return integral.result();
}

}  // namespace argil::evaluation

// SPDX-License-Identifier: GPL-3.0-or-later
// The surface goes a fraction of its way at each step. How far a point goes is said by the noise
// where the point began, on the form as it was when the stroke began: the surface becomes a height
// over that form, with the spectrum of the noise. Read where points come by, noise would be steeper
// on one side of its waves than on the other.
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "action/action.h"
#include "action/dab.h"
#include "brush/displace.h"
#include "brush/form_field.h"
#include "brush/stroke_motion.h"
#include "edit/redistance.h"
#include "tool/band_noise.h"

namespace argil {
namespace {

/// Of a noise: beyond 4 standard deviations there is next to nothing.
constexpr double kPeak = 4.0 / 3.0;

double wavelength_of(const Tool& tool, const LevelStack& stack) {
  return std::max(noise_wavelength(tool), kLeastNoiseVoxels * stack.voxel_mm(0));
}

class NoiseLaw final : public MoveLaw {
 public:
  /// `side` is 1, or -1 where heights and hollows are exchanged.
  NoiseLaw(const FormField& form, const std::vector<PosedTool>& dabs, const BandNoise& noise,
           double side)
      : form_(form), dabs_(dabs), noise_(noise), side_(side) {}

  void set_step(DisplaceStep step) { step_ = step; }

  /// To the point of the form below or above: there the falloff is read too.
  void shift_feet(std::span<const std::size_t> near, LeafFeet& feet) const override {
    for (std::size_t n = 0; n < kLeafNodes; ++n) {
      if (!feet.rows.has_band[n / kRowNodes]) continue;
      const Vec3 foot = feet.point_mm(n);
      const auto dab = std::find_if(near.begin(), near.end(), [&](std::size_t each) {
        return dabs_[each].bounds_mm().meets({foot, foot});
      });
      if (dab == near.end()) continue;
      const Vec3 voxels = (form_.foot_mm(*dab, foot, 2) - feet.origin_mm) / feet.voxel_mm;
      feet.rows.at.x[n] = static_cast<float>(voxels.x);
      feet.rows.at.y[n] = static_cast<float>(voxels.y);
      feet.rows.at.z[n] = static_cast<float>(voxels.z);
    }
  }

  void moves(std::size_t image, const LeafFeet& feet, LeafMoves& out) const override {
    for_each_pulled(feet, [&](std::size_t n) {
      out.mm[n] = 0.0F;
      const auto height = static_cast<double>(feet.rows.pull[n]);
      if (height > 0.0) out.mm[n] = static_cast<float>(move(image, feet.point_mm(n), height));
    });
  }

 private:
  /// Along the form's normal, of which a slope leaves its cosine along the surface's own.
  double move(std::size_t dab, const Vec3& start, double height) const {
    const BandNoise::Value noise = noise_.at(unturned(dabs_[dab].dab(), start));
    Vec3 slope = turned(dabs_[dab].dab(), noise.rise);
    const Vec3 up = form_.at(dab, start).rise;
    const double square = dot(up, up);
    if (square > 0.0) slope -= (dot(up, slope) / square) * up;
    const double gone = (step_.at + 0.5) / step_.count;
    slope *= gone * height;
    return -side_ * height * noise.value / (step_.count * std::sqrt(1.0 + dot(slope, slope)));
  }

  const FormField& form_;
  const std::vector<PosedTool>& dabs_;
  const BandNoise& noise_;
  double side_;
  DisplaceStep step_;
};

}  // namespace

void actions::noise(EditTarget& target, const Tool& tool, std::span<const Dab> path,
                    std::size_t images) {
  const LevelStack& stack = target.stack;
  std::vector<PosedTool> dabs = posed_along(tool, path);
  std::erase_if(dabs, [](const PosedTool& dab) { return layer_height_mm(dab) <= 0.0; });
  if (dabs.empty()) return;
  double most_mm = 0.0;
  for (const PosedTool& dab : dabs) most_mm = std::max(most_mm, layer_height_mm(dab));
  const double wavelength = wavelength_of(tool, stack);
  const int level = level_of_tool(stack, std::min(smallest_radius(tool), wavelength));
  const FormField form(stack, dabs, images);
  const BandNoise noise(wavelength, tool.seed);
  NoiseLaw law(form, dabs, noise, tool.strength < 0.0 ? -1.0 : 1.0);
  std::vector<Box3> reached;
  for (const PosedTool& dab : dabs) reached.push_back(dab.bounds_mm());
  int steps = 1;
  for (int step = 0; step < steps; ++step) {
    Edit edit(target);
    const int finest = plan_displaced(edit, stack, dabs, level);
    if (step == 0) steps = steps_of(kPeak * most_mm, stack.voxel_mm(finest));
    law.set_step({step, steps});
    for (int n = 0; n < edit.count(); ++n)
      displace(edit.level(n), dabs, law, PullLaw::swept_height);
    commit_displaced(target, edit);
    flush_queue(target, reached);
  }
}

}  // namespace argil

// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/decimate.h"

#include <array>
#include <cstdio>
#include <memory>
#include <string>

#include "argil/core/no_throw.h"
#include "argil/core/pace.h"

#include "compare/block_proof.h"
#include "compare/field_error.h"
#include "compare/sampler_pool.h"
#include "convert/decimate_extracted.h"

namespace argil::io {
namespace {

/// A clay as mesh::decimate sees it.
class ClayTarget final : public mesh::DecimationTarget {
 public:
  explicit ClayTarget(ExtractedSurface& surface) : surface_(surface), samplers_(surface.clay()) {}

  double voxel_mm() const override { return surface_.voxel_mm(); }
  std::unique_ptr<DistanceProbe> probe() const override {
    return std::make_unique<SamplerPool::Lent>(samplers_);
  }
  double own_error_mm(const Pace& pace) const override {
    return field_error(surface_.mesh(), surface_, pace).max_mm();
  }
  std::unique_ptr<mesh::BoundProof> proof(double bound_mm, const Pace& pace) const override {
    return std::make_unique<BlockProof>(surface_, bound_mm, pace);
  }

 private:
  ExtractedSurface& surface_;
  mutable SamplerPool samplers_;
};

/// Nothing could be proven there, which would show only after all the work.
Error not_told_apart(const Vec3& at) {
  std::array<char, 96> place;
  std::snprintf(place.data(), place.size(), "(%.4g, %.4g, %.4g) mm", at.x, at.y, at.z);
  return {
      ErrorKind::bad_input,
      std::string("no mesh can be proven to lie within a bound of this clay: the component at ") +
          place.data() +
          " was left out, and the clay does not tell it from what is beside it within one "
          "voxel; leave it in the surface, or give no bound"};
}

}  // namespace

Result<mesh::Decimated> decimate_extracted(ExtractedSurface& surface,
                                           const mesh::DecimateOptions& options,
                                           const Progress& progress) {
  return no_throw("removing triangles", [&]() -> Result<mesh::Decimated> {
    Pace pace(progress, "decimate");
    if (options.max_error_mm > 0.0 && !surface.left_out().triangles.empty()) {
      surface.prepare(pace.part(0.0, 0.1));
      if (const auto& ambiguous = surface.ambiguous(); !ambiguous.empty()) {
        return not_told_apart(surface.left_out().positions[ambiguous.front()]);
      }
      pace = pace.part(0.1, 1.0);
    }
    return mesh::decimate(surface.mesh(), ClayTarget(surface), options, pace.progress());
  });
}

Result<mesh::Decimated> decimate(const TriangleMesh& surface, const Clay& clay,
                                 const mesh::DecimateOptions& options, const TriangleMesh& left_out,
                                 const Progress& progress) {
  ExtractedSurface extracted(surface, clay, left_out);
  return decimate_extracted(extracted, options, progress);
}

}  // namespace argil::io

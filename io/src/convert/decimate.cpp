// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/decimate.h"

#include <memory>

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

}  // namespace

Result<mesh::Decimated> decimate_extracted(ExtractedSurface& surface,
                                           const mesh::DecimateOptions& options,
                                           const Progress& progress) {
  return mesh::decimate(surface.mesh(), ClayTarget(surface), options, progress);
}

Result<mesh::Decimated> decimate(const TriangleMesh& surface, const Clay& clay,
                                 const mesh::DecimateOptions& options, const TriangleMesh& left_out,
                                 const Progress& progress) {
  ExtractedSurface extracted(surface, clay, left_out);
  return decimate_extracted(extracted, options, progress);
}

}  // namespace argil::io

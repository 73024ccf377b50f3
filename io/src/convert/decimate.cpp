// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/decimate.h"

#include <memory>
#include <vector>

#include "compare/block_proof.h"
#include "compare/field_error.h"
#include "compare/sampler_pool.h"

namespace argil::io {
namespace {

/// A clay as mesh::decimate sees it.
class ClayTarget final : public mesh::DecimationTarget {
 public:
  ClayTarget(const TriangleMesh& surface, const Clay& clay, const TriangleMesh& left_out)
      : surface_(surface), clay_(clay), left_out_(left_out), samplers_(clay) {}

  double voxel_mm() const override { return clay_.options().voxel_mm; }
  std::unique_ptr<DistanceProbe> probe() const override {
    return std::make_unique<SamplerPool::Lent>(samplers_);
  }
  double own_error_mm(const Pace& pace) const override {
    return field_error(surface_, surface_, clay_, left_out_, pace).max_mm();
  }
  std::unique_ptr<mesh::BoundProof> proof(double bound_mm, const Pace& pace) const override {
    return std::make_unique<BlockProof>(surface_, clay_, left_out_, bound_mm, pace);
  }

 private:
  const TriangleMesh& surface_;
  const Clay& clay_;
  const TriangleMesh& left_out_;
  mutable SamplerPool samplers_;
};

}  // namespace

Result<mesh::Decimated> decimate(const TriangleMesh& surface, const Clay& clay,
                                 const mesh::DecimateOptions& options, const TriangleMesh& left_out,
                                 const Progress& progress) {
  return mesh::decimate(surface, ClayTarget(surface, clay, left_out), options, progress);
}

}  // namespace argil::io

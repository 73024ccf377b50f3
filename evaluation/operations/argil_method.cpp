// SPDX-License-Identifier: GPL-3.0-or-later
// Argil's own operations: each is taken back before the next, which gives the clay its bits again.
#include <memory>
#include <utility>

#include "argil/engine/clay.h"
#include "argil/engine/clay_copy.h"
#include "argil/engine/import.h"
#include "argil/engine/surface.h"

#include "operations/method.h"

namespace argil::evaluation {
namespace {

class ArgilMethod final : public OperationMethod {
 public:
  ArgilMethod(const char* name, double tolerance_voxels)
      : name_(name), tolerance_voxels_(tolerance_voxels) {}

  const char* name() const override { return name_; }
  double most_million(Task) const override { return 10.0; }

  void take(const WorkedBody& body) override {
    body_ = &body;
    clay_.reset();
  }

  Result<RunTime> run(Task task) override {
    if (task == Task::import) return import();
    if (clay_ == nullptr) return Error{ErrorKind::bad_input, "its import failed"};
    clay_->undo();
    const Operation operation = operation_of(task);
    const RunClock clock;
    if (auto applied = clay_->apply(operation); !applied) return applied.error();
    return clock.read();
  }

  TriangleMesh result() override { return extract_surface(*clay_); }

 private:
  Result<RunTime> import() {
    clay_.reset();
    const RunClock clock;
    auto made = clay_of(*body_, tolerance_voxels_);
    if (!made) return made.error();
    const RunTime time = clock.read();
    clay_ = std::make_unique<Clay>(std::move(made).value());
    return time;
  }

  Operation operation_of(Task task) const {
    if (task == Task::hollow) return Hollow{kWallMm, {}};
    if (task == Task::resample) return Resample{kResampledMm};
    if (task != Task::unite) return Offset{offset_mm(task)};
    Combine combine;
    combine.clay = std::make_shared<const Clay>(copy_of(*clay_));
    combine.placement = copy_placement(*body_);
    return combine;
  }

  const char* name_;
  double tolerance_voxels_;
  const WorkedBody* body_ = nullptr;
  std::unique_ptr<Clay> clay_;
};

}  // namespace

Result<Clay> clay_of(const WorkedBody& body, double tolerance_voxels) {
  ClayOptions options;
  options.voxel_mm = kVoxelMm;
  options.tolerance_voxels = tolerance_voxels;
  options.edge_radius_mm = 0.0;
  auto made = import_mesh(*body.mesh, options);
  if (!made) return made.error();
  return std::move(made.value().clay);
}

std::unique_ptr<OperationMethod> argil_method() {
  return std::make_unique<ArgilMethod>("argil", ClayOptions{}.tolerance_voxels);
}

std::unique_ptr<OperationMethod> fine_argil_method() {
  constexpr double kLeastTolerance = 0.01;  // validate_options
  return std::make_unique<ArgilMethod>("argil_fine", kLeastTolerance);
}

}  // namespace argil::evaluation

// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <optional>
#include <utility>

#include "operations/method.h"
#include "rivals/openvdb_levels.h"

namespace argil::evaluation {
namespace {

class OpenvdbMethod final : public OperationMethod {
 public:
  const char* name() const override { return "openvdb"; }
  double most_million(Task task) const override {
    // It goes by half a voxel a step.
    return task == Task::deep_inward || task == Task::hollow ? 1.0 : 10.0;
  }

  void take(const WorkedBody& body) override {
    body_ = &body;
    imported_.reset();
    made_.reset();
  }

  Result<RunTime> run(Task task) override {
    made_.reset();
    if (task == Task::import) {
      imported_.reset();
      const RunClock clock;
      imported_.emplace(*body_->mesh, kVoxelMm);
      return clock.read();
    }
    if (!imported_) return Error{ErrorKind::bad_input, "its import failed"};
    made_.emplace(imported_->copy());
    const RunClock clock;
    apply(task);
    return clock.read();
  }

  TriangleMesh result() override { return (made_ ? *made_ : *imported_).surface(); }

 private:
  void apply(Task task) {
    if (task == Task::hollow) return made_->hollow(kWallMm);
    if (task == Task::resample) return made_->resample(kResampledMm);
    if (task == Task::unite) return made_->unite_with_copy(copy_placement(*body_));
    made_->offset(offset_mm(task));
  }

  const WorkedBody* body_ = nullptr;
  std::optional<OpenvdbLevels> imported_;
  std::optional<OpenvdbLevels> made_;
};

}  // namespace

std::unique_ptr<OperationMethod> openvdb_method() { return std::make_unique<OpenvdbMethod>(); }

}  // namespace argil::evaluation

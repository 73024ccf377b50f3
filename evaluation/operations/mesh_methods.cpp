// SPDX-License-Identifier: GPL-3.0-or-later
// Rivals that work meshes: they import as a mesh made anew, and have no like of the other tasks.
#include <cassert>
#include <memory>
#include <optional>
#include <utility>

#include "blender/made_mesh.h"
#include "operations/method.h"
#include "rivals/cgal_solids.h"

namespace argil::evaluation {
namespace {

class CgalMethod final : public OperationMethod {
 public:
  const char* name() const override { return "cgal"; }
  double most_million(Task task) const override {
    if (task == Task::import) return 0.12;
    return task == Task::unite ? 0.6 : 0.0;
  }
  void take(const WorkedBody& body) override { body_ = &body; }

  Result<RunTime> run(Task task) override {
    assert(most_million(task) > 0.0);
    if (task == Task::import) {
      // As wide as voxels are, and as near as the manual's own ratio of both has it.
      constexpr double kOffsetMm = kVoxelMm / 30.0;
      const RunClock clock;
      made_ = cgal_wrapped(*body_->mesh, kVoxelMm, kOffsetMm);
      return clock.read();
    }
    const TriangleMesh copy = placed(*body_->mesh, copy_placement(*body_));
    const RunClock clock;
    auto made = cgal_united(*body_->mesh, copy);
    const RunTime time = clock.read();
    if (!made) return Error{ErrorKind::internal, "CGAL finds no two-manifold union"};
    made_ = *std::move(made);
    return time;
  }

  TriangleMesh result() override { return std::move(made_); }

 private:
  const WorkedBody* body_ = nullptr;
  TriangleMesh made_;
};

class BlenderMethod final : public OperationMethod {
 public:
  explicit BlenderMethod(Progress progress) : progress_(std::move(progress)) {}

  const char* name() const override { return "blender"; }
  double most_million(Task task) const override {
    if (task == Task::import) return 2.5;
    return task == Task::unite ? 0.12 : 0.0;
  }
  void take(const WorkedBody& body) override { body_ = &body; }

  Result<RunTime> run(Task task) override {
    assert(most_million(task) > 0.0);
    auto made = task == Task::import
                    ? blender_remesh(*body_->mesh, kVoxelMm, 1, progress_)
                    : blender_union(*body_->mesh, placed(*body_->mesh, copy_placement(*body_)), 1,
                                    progress_);
    if (!made) return made.error();
    BlenderMesh& mesh = made.value();
    made_.positions = std::move(mesh.positions);
    made_.triangles = std::move(mesh.triangles);
    return RunTime{1e-6 * mesh.cpu_us, 1e-6 * mesh.wall_us};
  }

  TriangleMesh result() override { return std::move(made_); }

 private:
  Progress progress_;
  const WorkedBody* body_ = nullptr;
  TriangleMesh made_;
};

}  // namespace

std::unique_ptr<OperationMethod> cgal_method() { return std::make_unique<CgalMethod>(); }

std::unique_ptr<OperationMethod> blender_method(const Progress& progress) {
  return std::make_unique<BlenderMethod>(progress);
}

}  // namespace argil::evaluation

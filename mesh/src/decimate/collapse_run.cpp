// SPDX-License-Identifier: GPL-3.0-or-later
// Edges are collapsed in order of cost. A quadric (M. Garland, P. Heckbert, "Surface
// simplification using quadric error metrics", 1997) proposes where the vertex goes and ranks the
// edges cheaply; the field itself, sampled on the triangles that a step would make, then gives the
// true cost of the step.
#include "decimate/collapse_run.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "argil/mesh/triangle_geometry.h"

#include "decimate/collapse_mesh.h"
#include "decimate/cost_queue.h"
#include "decimate/quadric.h"
#include "decimate/sample_assignment.h"

namespace argil::mesh {
namespace {

/// With a bound, an edge that was refused more often is left alone.
constexpr int kMostRefusals = 5;
constexpr int kClassesOfTwo = 4;  ///< of the queue

/// A triangle that a step changes: the moved vertex, then two that stay, seen from outside.
struct StarTriangle {
  std::uint32_t number = 0;
  Vec3 right, left;
  Vec3 area_normal;    ///< as it was
  double shape = 0.0;  ///< as it was: twice its area to its longest side squared
};

class CollapseRun {
 public:
  CollapseRun(CollapseMesh mesh, const TriangleMesh& surface, const DecimationTarget& target,
              const CollapseGoal& goal, const std::vector<bool>& locked)
      : mesh_(std::move(mesh)),
        field_(target.probe()),
        goal_(goal),
        locked_(locked),
        centre_(bounds(surface).center()),
        quadrics_(surface.positions.size()),
        queue_(mesh_.half_edges()),
        refusals_(mesh_.half_edges(), 0) {
    assert(locked.size() == surface.positions.size() && target.voxel_mm() > 0.0);
    add_quadrics(surface);
    // Costs are in mm^4: a squared distance times an area. Here a thousandth of a voxel over the
    // area of one voxel.
    const double h = target.voxel_mm();
    first_wait_ = CostQueue::class_for(1e-6 * h * h * h * h);
    // The squared diagonal times an area as large.
    const Vec3 size = bounds(surface).size();
    last_wait_ = CostQueue::class_for(dot(size, size) * dot(size, size));
    if (goal_.reach_mm > 0.0) samples_.emplace(surface);
  }

  Collapsed run(const Pace& pace);

 private:
  struct Step {
    HalfEdge edge = 0;
    Vec3 position;
    double cost = 0.0;
  };

  void add_quadrics(const TriangleMesh& surface);
  HalfEdge edge_of(HalfEdge h) const noexcept { return std::min(h, mesh_.twin(h)); }
  bool is_bounded() const noexcept { return goal_.reach_mm > 0.0; }
  bool is_locked(HalfEdge h) const { return locked_[mesh_.from(h)] || locked_[mesh_.to(h)]; }
  Step step_for(HalfEdge edge) const;
  void put(HalfEdge h);
  void put_all();
  void gather_star(HalfEdge edge);
  void gather_fan(HalfEdge from, HalfEdge edge);
  double least_shape(HalfEdge edge) const;
  bool keeps_shape(const Step& step) const;
  std::optional<double> field_cost(const Vec3& position);
  bool keeps_samples(const Step& step);
  void refuse(HalfEdge edge);
  bool try_step(HalfEdge edge);
  bool is_allowed(const Step& step);
  void apply(const Step& step);

  CollapseMesh mesh_;
  std::unique_ptr<DistanceProbe> field_;
  CollapseGoal goal_;
  const std::vector<bool>& locked_;
  Vec3 centre_;  ///< quadrics are about it
  std::vector<Quadric> quadrics_;
  CostQueue queue_;
  std::vector<std::uint8_t> refusals_;  ///< of each edge
  std::optional<SampleAssignment> samples_;
  // Between these classes what was refused is tried again each time steps cost twice as much.
  std::uint16_t first_wait_ = 0;  ///< what costs less is nothing: a thousandth of a voxel
  std::uint16_t last_wait_ = 0;   ///< no step costs more
  std::vector<StarTriangle> star_;
  std::vector<std::uint32_t> replaced_;
  std::vector<SampleAssignment::NewTriangle> made_;
};

void CollapseRun::add_quadrics(const TriangleMesh& surface) {
  // Draws a vertex on a plane to the middle of its matter, a thousandth as firmly as off the plane.
  constexpr double kPointFraction = 1e-6;
  for (const Triangle& t : surface.triangles) {
    const Vec3 a = surface.positions[t[0]] - centre_;
    const Vec3 b = surface.positions[t[1]] - centre_;
    const Vec3 c = surface.positions[t[2]] - centre_;
    const Vec3 area_normal = cross(b - a, c - a);
    Quadric q;
    q.add_plane(normalized(area_normal), (a + b + c) / 3.0, length(area_normal) / 6.0,
                kPointFraction);
    for (const std::uint32_t v : t) quadrics_[v] += q;
  }
}

CollapseRun::Step CollapseRun::step_for(HalfEdge edge) const {
  const std::uint32_t a = mesh_.from(edge);
  const std::uint32_t b = mesh_.to(edge);
  const Quadric q = quadrics_[a] + quadrics_[b];
  const Vec3 pa = mesh_.position(a) - centre_;
  const Vec3 pb = mesh_.position(b) - centre_;
  const Vec3 middle = 0.5 * (pa + pb);
  Step step{edge, middle, q.at(middle)};
  const std::optional<Vec3> least = q.least();
  // A far optimum belongs to planes that are nearly one.
  if (least && dot(*least - middle, *least - middle) <= 4.0 * dot(pb - pa, pb - pa)) {
    step.position = *least;
    step.cost = q.at(*least);
  } else {
    // No least point, or a far one: the best of the middle and the ends.
    for (const Vec3& end : {pa, pb}) {
      if (const double cost = q.at(end); cost < step.cost) step = {edge, end, cost};
    }
  }
  step.position += centre_;
  return step;
}

void CollapseRun::put(HalfEdge h) {
  const HalfEdge edge = edge_of(h);
  if (queue_.holds(edge) || is_locked(edge) || (is_bounded() && refusals_[edge] > kMostRefusals)) {
    return;
  }
  // What was refused waits until its surroundings have gone further, each time twice as far.
  const int wait = kClassesOfTwo * refusals_[edge];
  queue_.put(edge, static_cast<std::uint16_t>(CostQueue::class_for(step_for(edge).cost) + wait));
}

void CollapseRun::put_all() {
  for (HalfEdge h = 0; h < mesh_.half_edges(); ++h) {
    if (!mesh_.is_gone(h) && h < mesh_.twin(h)) put(h);
  }
}

/// The triangles around `from`'s first vertex, but for the two that go.
void CollapseRun::gather_fan(HalfEdge from, HalfEdge edge) {
  const std::size_t first = triangle_of(edge);
  const std::size_t second = triangle_of(mesh_.twin(edge));
  HalfEdge h = from;
  do {
    const std::size_t t = triangle_of(h);
    if (t != first && t != second) {
      const Vec3& apex = mesh_.position(mesh_.from(h));
      const Vec3& right = mesh_.position(mesh_.to(h));
      const Vec3& left = mesh_.position(mesh_.to(next_in_triangle(h)));
      const Vec3 area_normal = cross(right - apex, left - apex);
      const double side = longest_side(apex, right, left);
      star_.push_back({static_cast<std::uint32_t>(t), right, left, area_normal,
                       length(area_normal) / (side * side)});
    }
    h = mesh_.next_around(h);
  } while (h != from);
}

void CollapseRun::gather_star(HalfEdge edge) {
  assert(!mesh_.is_gone(edge));
  star_.clear();
  gather_fan(edge, edge);
  gather_fan(mesh_.twin(edge), edge);
}

/// What the shape of a triangle that had more shall not fall below. Without a bound an edge may
/// make triangles half as wide each time it was refused: needles along a sharp rim miss less of the
/// clay than what else is left to collapse.
double CollapseRun::least_shape(HalfEdge edge) const {
  constexpr double kLeastShape = 0.05;
  return is_bounded() ? kLeastShape : std::ldexp(kLeastShape, -int{refusals_[edge]});
}

/// No triangle turns by more than 75 degrees or becomes a needle where it was none.
bool CollapseRun::keeps_shape(const Step& step) const {
  constexpr double kLeastCosine = 0.25;
  const double least = least_shape(step.edge);
  const Vec3& position = step.position;
  for (const StarTriangle& t : star_) {
    const Vec3 n = cross(t.right - position, t.left - position);
    const double area = length(n);
    if (!(dot(n, t.area_normal) > kLeastCosine * area * length(t.area_normal))) return false;
    const double side = longest_side(position, t.right, t.left);
    if (area < std::min(least, t.shape) * side * side) return false;
  }
  return true;
}

/// What the new triangles cost by the field's own distance; nothing when one is out of reach.
std::optional<double> CollapseRun::field_cost(const Vec3& position) {
  constexpr int kMostSplits = 16;
  constexpr double kStepVoxels = 2.0;
  double squares = 0.0;
  const FieldValue at_position = field_->value(position);
  const double step_mm = kStepVoxels * at_position.voxel_mm;
  double worst = std::abs(at_position.distance_mm);
  double area = 0.0;
  for (const StarTriangle& t : star_) {
    // At most 256 samples a triangle: the cost of a step must not grow with its size.
    const int n = splits_for(longest_side(position, t.right, t.left), step_mm, kMostSplits);
    const double part = 0.5 * length(cross(t.right - position, t.left - position)) / (n * n);
    for_each_sample(n, [&](const std::array<double, 3>& w) {
      const double d = field_->distance_mm(w[0] * position + w[1] * t.right + w[2] * t.left);
      squares += part * d * d;
      worst = std::max(worst, std::abs(d));
    });
    area += part * n * n;
    if (goal_.reach_mm > 0.0) {
      // Samples lie inside the triangles; with a bound the middle of each new edge counts too.
      worst = std::max(worst, std::abs(field_->distance_mm(0.5 * (position + t.right))));
      if (worst > goal_.reach_mm) return std::nullopt;
    }
  }
  // A single peak costs as if a quarter of the star stood off so far.
  return std::max(squares, 0.25 * area * worst * worst);
}

bool CollapseRun::keeps_samples(const Step& step) {
  if (!samples_) return true;
  replaced_.assign({static_cast<std::uint32_t>(triangle_of(step.edge)),
                    static_cast<std::uint32_t>(triangle_of(mesh_.twin(step.edge)))});
  made_.clear();
  for (const StarTriangle& t : star_) {
    replaced_.push_back(t.number);
    made_.push_back({t.number, step.position, t.right, t.left});
  }
  samples_->gather(replaced_);
  return samples_->assign(made_, goal_.reach_mm);
}

/// Whether the step keeps the surface whole, its shape and its reach, and costs no more than the
/// present class; puts the edge where it belongs when it costs more.
bool CollapseRun::is_allowed(const Step& step) {
  // The cheapest test first.
  if (!mesh_.can_collapse(step.edge)) return false;
  gather_star(step.edge);
  if (!keeps_shape(step)) return false;
  const std::optional<double> cost = field_cost(step.position);
  if (!cost) return false;
  if (CostQueue::class_for(*cost) > queue_.now()) {
    queue_.put(step.edge, CostQueue::class_for(*cost));
    return false;
  }
  return keeps_samples(step);
}

/// With a bound an edge waits until its surroundings change, and soon for good. Without one the
/// count must be reached: before much is paid elsewhere, what is cheap gets its chance again.
void CollapseRun::refuse(HalfEdge edge) {
  if (refusals_[edge] <= kMostRefusals) ++refusals_[edge];
  if (is_bounded()) return;
  const int later = std::max(queue_.now(), first_wait_) + kClassesOfTwo;
  if (later < last_wait_) queue_.put(edge, static_cast<std::uint16_t>(later));
}

/// Whether the surface changed.
bool CollapseRun::try_step(HalfEdge edge) {
  const Step step = step_for(edge);
  const std::uint16_t by_quadric = CostQueue::class_for(step.cost);
  if (by_quadric > queue_.now()) {
    queue_.put(edge, by_quadric);
    return false;
  }
  if (!is_allowed(step)) {
    if (!queue_.holds(edge)) refuse(edge);
    return false;
  }
  apply(step);
  return true;
}

void CollapseRun::apply(const Step& step) {
  assert(!mesh_.is_gone(step.edge) && !is_locked(step.edge) && is_finite(step.position));
  const std::uint32_t stays = mesh_.from(step.edge);
  quadrics_[stays] += quadrics_[mesh_.to(step.edge)];
  for (const HalfEdge side : {step.edge, mesh_.twin(step.edge)}) {
    const HalfEdge second = next_in_triangle(side);
    // An edge is known by the lower of its half-edges, which may go with its triangle: the edges
    // around are taken out first and put in again below.
    for (const HalfEdge h : {second, next_in_triangle(second)}) {
      queue_.forget(edge_of(h));
      refusals_[mesh_.twin(h)] = 0;  // its triangle stays, and gets a new other side
    }
  }
  mesh_.collapse(step.edge, step.position);
  if (samples_) samples_->commit(replaced_);
  const HalfEdge first = mesh_.any_from(stays);
  HalfEdge h = first;
  do {
    put(h);
    h = mesh_.next_around(h);
  } while (h != first);
}

Collapsed CollapseRun::run(const Pace& pace) {
  constexpr std::int64_t kBetweenReports = 4096;
  Collapsed done;
  const auto from = static_cast<double>(mesh_.triangles());
  // No closed mesh has fewer than the four triangles of a tetrahedron.
  const auto enough = static_cast<std::size_t>(std::max<std::int64_t>(goal_.triangles, 4));
  const double whole = std::max(1.0, from - static_cast<double>(enough));
  put_all();
  std::uint32_t edge = 0;
  while (mesh_.triangles() > enough) {
    if (!queue_.take(edge)) break;
    const double done_part = (from - static_cast<double>(mesh_.triangles())) / whole;
    if (done.steps % kBetweenReports == 0) pace.at(done_part);
    if (!mesh_.is_gone(edge) && try_step(edge)) ++done.steps;
  }
  done.mesh = mesh_.mesh(done.kept);
  assert(done.kept.size() == done.mesh.positions.size() &&
         done.mesh.triangles.size() == mesh_.triangles());
  return done;
}

}  // namespace

Result<Collapsed> collapse_edges(const TriangleMesh& surface, const DecimationTarget& target,
                                 const CollapseGoal& goal, const std::vector<bool>& locked,
                                 const Pace& pace) {
  std::optional<CollapseMesh> mesh = CollapseMesh::build(surface);
  if (!mesh) {
    return Error{ErrorKind::bad_input,
                 "the surface is not closed and two-manifold; repair it before removing triangles"};
  }
  return CollapseRun(std::move(*mesh), surface, target, goal, locked).run(pace);
}

}  // namespace argil::mesh

// SPDX-License-Identifier: GPL-3.0-or-later
// Edges are collapsed in order of cost. A quadric (M. Garland, P. Heckbert, "Surface
// simplification using quadric error metrics", 1997) proposes where the vertex goes and ranks the
// edges cheaply; where that is asked, the field itself, sampled on the triangles that a step would
// make, then gives the true cost of the step.
#include "decimate/collapse_block.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include <tbb/parallel_for.h>

#include "argil/mesh/triangle_geometry.h"

namespace argil::mesh {
namespace {

/// With a bound, an edge that was refused more often is left alone.
constexpr int kMostRefusals = 5;
constexpr int kClassesOfTwo = 4;  ///< of the queue
/// How much less far steps go where one was taken back.
constexpr double kCautious = 0.8;

}  // namespace

CollapseState::CollapseState(CollapseMesh made, const Box3& box, double voxel_mm)
    : mesh(std::move(made)),
      centre(box.center()),
      quadrics(mesh.vertices()),
      class_of(mesh.half_edges(), CostQueue::kNone),
      refusals(mesh.half_edges(), 0),
      stays(mesh.vertices(), 0),
      moved(mesh.vertices(), 0),
      last_step(mesh.vertices(), 0),
      caution(mesh.vertices(), 0) {
  assert(voxel_mm > 0.0);
  // Draws a vertex on a plane to the middle of its matter, a thousandth as firmly as off the plane.
  constexpr double kPointFraction = 1e-6;
  tbb::parallel_for(std::size_t{0}, quadrics.size(), [&](std::size_t v) {
    const HalfEdge first = mesh.any_from(static_cast<std::uint32_t>(v));
    if (first == CollapseMesh::kGone) return;
    const Vec3 a = mesh.position(static_cast<std::uint32_t>(v)) - centre;
    HalfEdge h = first;
    do {
      const Vec3 b = mesh.position(mesh.to(h)) - centre;
      const Vec3 c = mesh.position(mesh.to(next_in_triangle(h))) - centre;
      const Vec3 area_normal = cross(b - a, c - a);
      const double twice_area = length(area_normal);
      quadrics[v].add_plane(twice_area > 0.0 ? area_normal / twice_area : Vec3{}, (a + b + c) / 3.0,
                            twice_area / 6.0, kPointFraction);
      h = mesh.next_around(h);
    } while (h != first);
  });
  // Costs are in mm^4: a squared distance times an area. Here a thousandth of a voxel over the
  // area of one voxel.
  first_wait = CostQueue::class_for(1e-6 * voxel_mm * voxel_mm * voxel_mm * voxel_mm);
  // The squared diagonal times an area as large.
  const Vec3 size = box.size();
  last_wait = CostQueue::class_for(dot(size, size) * dot(size, size));
}

std::vector<std::uint32_t> CollapseState::compact() {
  std::vector<std::uint32_t> number;
  CollapseMesh left = mesh.compacted(number);
  std::vector<Quadric> quadrics_left;
  std::vector<std::uint8_t> moved_left;
  quadrics_left.reserve(left.vertices());
  moved_left.reserve(left.vertices());
  for (std::uint32_t v = 0; v < mesh.vertices(); ++v) {
    if (mesh.any_from(v) == CollapseMesh::kGone) continue;
    quadrics_left.push_back(quadrics[v]);
    moved_left.push_back(moved[v]);
  }
  mesh = std::move(left);
  quadrics = std::move(quadrics_left);
  class_of = std::vector<std::uint16_t>(mesh.half_edges(), CostQueue::kNone);
  refusals = std::vector<std::uint8_t>(mesh.half_edges(), 0);
  stays = std::vector<std::uint8_t>(mesh.vertices(), 0);
  moved = std::move(moved_left);
  caution = stays;
  last_step = std::vector<std::uint32_t>(mesh.vertices(), 0);
  assert(quadrics.size() == mesh.vertices());
  return number;
}

CollapseBlock::CollapseBlock(CollapseState& state, const VertexBlock& vertices,
                             const CollapseRules& rules)
    : state_(state),
      mesh_(state.mesh),
      vertices_left_(vertices.size()),
      rules_(rules),
      queue_(state.class_of) {
  for (const std::uint32_t v : vertices) state_.last_step[v] = 0;
  put_all(vertices);
}

void CollapseBlock::put_all(const VertexBlock& vertices) {
  const auto for_each_edge = [&](const auto& use) {
    for (const std::uint32_t v : vertices) {
      if (state_.stays[v] != 0) continue;
      const HalfEdge first = mesh_.any_from(v);
      HalfEdge h = first;
      do {
        if (h < mesh_.twin(h)) use(h);
        h = mesh_.next_around(h);
      } while (h != first);
    }
  };
  // Queues before this one may have left some in.
  for_each_edge([&](HalfEdge edge) {
    queue_.forget(edge);
    if (is_bounded()) state_.refusals[edge] = 0;
  });
  for_each_edge([&](HalfEdge edge) { put(edge); });
}

HalfEdge CollapseBlock::edge_of(HalfEdge h) const noexcept { return std::min(h, mesh_.twin(h)); }

CollapseBlock::Step CollapseBlock::step_for(HalfEdge edge) const {
  const std::uint32_t a = mesh_.from(edge);
  const std::uint32_t b = mesh_.to(edge);
  const Quadric q = state_.quadrics[a] + state_.quadrics[b];
  const Vec3 pa = mesh_.position(a) - state_.centre;
  const Vec3 pb = mesh_.position(b) - state_.centre;
  const Vec3 middle = 0.5 * (pa + pb);
  Step step{edge, middle, 0.0};
  const std::optional<Vec3> least = q.least();
  // A far optimum belongs to planes that are nearly one.
  if (least && dot(*least - middle, *least - middle) <= 4.0 * dot(pb - pa, pb - pa)) {
    step.position = *least;
    step.cost = q.at(*least);
  } else {
    // No least point, or a far one: the best of the middle and the ends.
    step.cost = q.at(middle);
    for (const Vec3& end : {pa, pb}) {
      if (const double cost = q.at(end); cost < step.cost) step = {edge, end, cost};
    }
  }
  step.position += state_.centre;
  return step;
}

void CollapseBlock::put(HalfEdge h) {
  const HalfEdge edge = edge_of(h);
  if (state_.stays[mesh_.from(edge)] != 0 || state_.stays[mesh_.to(edge)] != 0) return;
  if (caution_at(edge) >= CollapseState::kStays) return;
  if (queue_.holds(edge) || (is_bounded() && state_.refusals[edge] > kMostRefusals)) return;
  // What was refused waits until its surroundings have gone further, each time twice as far.
  const int wait = kClassesOfTwo * state_.refusals[edge];
  queue_.put(edge, static_cast<std::uint16_t>(CostQueue::class_for(step_for(edge).cost) + wait));
}

/// The triangles around `from`'s first vertex, but for the two that go.
void CollapseBlock::gather_fan(HalfEdge from, HalfEdge edge) {
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
      star_.push_back({right, left, area_normal, length(area_normal) / (side * side)});
    }
    h = mesh_.next_around(h);
  } while (h != from);
}

void CollapseBlock::gather_star(HalfEdge edge) {
  assert(!mesh_.is_gone(edge));
  star_.clear();
  gather_fan(edge, edge);
  gather_fan(mesh_.twin(edge), edge);
}

/// What the shape of a triangle that had more shall not fall below. Without a bound an edge may
/// make triangles half as wide each time it was refused: needles along a sharp rim miss less of the
/// clay than what else is left to collapse.
double CollapseBlock::least_shape(HalfEdge edge) const {
  constexpr double kLeastShape = 0.05;
  return is_bounded() ? kLeastShape : std::ldexp(kLeastShape, -int{state_.refusals[edge]});
}

/// No triangle turns by more than 75 degrees or becomes a needle where it was none.
bool CollapseBlock::keeps_shape(const Step& step) const {
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

int CollapseBlock::caution_at(HalfEdge edge) const noexcept {
  return std::max(state_.caution[mesh_.from(edge)], state_.caution[mesh_.to(edge)]);
}

/// What the new triangles cost by the field's own distance; nothing when one is out of reach.
std::optional<double> CollapseBlock::field_cost(const Step& step) {
  // Within a bound what is between the samples is proven later.
  const int most_splits = is_bounded() ? 5 : 16;
  const double kStepVoxels = is_bounded() ? 3.0 : 2.0;
  const Vec3& position = step.position;
  double reach_mm = rules_.reach_mm;
  for (int taken_back = caution_at(step.edge); taken_back > 0; --taken_back) reach_mm *= kCautious;
  const FieldValue at_position = field_->value(position);
  const double step_mm = kStepVoxels * at_position.voxel_mm;
  double worst = std::abs(at_position.distance_mm);
  if (is_bounded()) {
    // Samples lie inside the triangles; with a bound the middle of each new edge counts too, and
    // before them: few tell most of the steps that go too far.
    if (worst > reach_mm) return std::nullopt;
    for (const StarTriangle& t : star_) {
      worst = std::max(worst, std::abs(field_->distance_mm(0.5 * (position + t.right))));
      if (worst > reach_mm) return std::nullopt;
    }
  }
  double squares = 0.0;
  double area = 0.0;
  for (const StarTriangle& t : star_) {
    // At most 25 or 256 samples a triangle: the cost of a step must not grow with its size.
    const int n = splits_for(longest_side(position, t.right, t.left), step_mm, most_splits);
    const double part = 0.5 * length(cross(t.right - position, t.left - position)) / (n * n);
    for_each_sample(n, [&](const std::array<double, 3>& w) {
      const double d = field_->distance_mm(w[0] * position + w[1] * t.right + w[2] * t.left);
      squares += part * d * d;
      worst = std::max(worst, std::abs(d));
    });
    area += part * n * n;
    if (is_bounded() && worst > reach_mm) return std::nullopt;
  }
  // A single peak costs as if a quarter of the star stood off so far.
  return std::max(squares, 0.25 * area * worst * worst);
}

bool CollapseBlock::has_cost(const Step& step) {
  const std::optional<double> cost = field_cost(step);
  if (!cost) return false;
  const std::uint16_t cost_class = CostQueue::class_for(*cost);
  if (cost_class <= queue_.now()) return true;
  queue_.put(step.edge, cost_class);
  asked_[step.edge] = {cost_class, steps_};
  return false;
}

/// Whether the field was asked before, it costs no more than the present class, and no vertex
/// around has moved since: then the step has its shape and its reach too.
bool CollapseBlock::has_cost_still(HalfEdge edge) {
  const auto asked = asked_.find(edge);
  if (asked == asked_.end()) return false;
  const auto [cost_class, after_step] = asked->second;
  asked_.erase(asked);
  if (cost_class > queue_.now()) return false;
  for (const HalfEdge end : {edge, mesh_.twin(edge)}) {
    HalfEdge h = end;
    do {
      if (state_.last_step[mesh_.to(h)] > after_step) return false;
      h = mesh_.next_around(h);
    } while (h != end);
  }
  return true;
}

/// Whether the step keeps the surface whole, its shape and its reach, and costs no more than the
/// present class; puts the edge where it belongs when it costs more.
bool CollapseBlock::is_allowed(const Step& step) {
  // The cheapest test first.
  if (!mesh_.can_collapse(step.edge, ring_)) return false;
  if (has_cost_still(step.edge)) return true;
  gather_star(step.edge);
  if (!keeps_shape(step)) return false;
  const bool asks = queue_.now() >= rules_.first_asking || caution_at(step.edge) > 0;
  return !asks || has_cost(step);
}

/// With a bound an edge waits until its surroundings change, and soon for good. Without one the
/// count must be reached: before much is paid elsewhere, what is cheap gets its chance again.
void CollapseBlock::refuse(HalfEdge edge) {
  if (state_.refusals[edge] <= kMostRefusals) ++state_.refusals[edge];
  if (is_bounded()) return;
  const int later = std::max(queue_.now(), state_.first_wait) + kClassesOfTwo;
  if (later < state_.last_wait) queue_.put(edge, static_cast<std::uint16_t>(later));
}

/// Whether the surface changed.
bool CollapseBlock::try_step(HalfEdge edge) {
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

void CollapseBlock::apply(const Step& step) {
  assert(!mesh_.is_gone(step.edge) && is_finite(step.position));
  assert(state_.stays[mesh_.from(step.edge)] == 0 && state_.stays[mesh_.to(step.edge)] == 0);
  const std::uint32_t stays = mesh_.from(step.edge);
  const std::uint32_t goes = mesh_.to(step.edge);
  state_.quadrics[stays] += state_.quadrics[goes];
  state_.caution[stays] = std::max(state_.caution[stays], state_.caution[goes]);
  for (const HalfEdge side : {step.edge, mesh_.twin(step.edge)}) {
    const HalfEdge second = next_in_triangle(side);
    // An edge is known by the lower of its half-edges, which may go with its triangle: the edges
    // around are taken out first and put in again below.
    for (const HalfEdge h : {second, next_in_triangle(second)}) {
      queue_.forget(edge_of(h));
      state_.refusals[mesh_.twin(h)] = 0;  // its triangle stays, and gets a new other side
    }
  }
  mesh_.collapse(step.edge, step.position);
  state_.moved[stays] = 1;
  state_.last_step[stays] = ++steps_;
  --vertices_left_;
  const HalfEdge first = mesh_.any_from(stays);
  HalfEdge h = first;
  do {
    put(h);
    h = mesh_.next_around(h);
  } while (h != first);
}

/// `goes_on(looked, steps)` is asked before each edge, with how many were looked at and became
/// steps.
template <class GoesOn>
std::size_t CollapseBlock::advance_while(std::uint16_t last, DistanceProbe& field,
                                         const GoesOn& goes_on) {
  field_ = &field;
  std::size_t steps = 0;
  HalfEdge edge = 0;
  for (std::size_t looked = 0; goes_on(looked, steps) && queue_.take(edge, last); ++looked) {
    if (!mesh_.is_gone(edge) && try_step(edge)) ++steps;
  }
  field_ = nullptr;
  return steps;
}

std::size_t CollapseBlock::advance(std::uint16_t last, std::size_t most, DistanceProbe& field) {
  return advance_while(last, field,
                       [most](std::size_t, std::size_t steps) { return steps < most; });
}

std::size_t CollapseBlock::look_at(std::uint16_t last, std::size_t edges, DistanceProbe& field) {
  return advance_while(last, field,
                       [edges](std::size_t looked, std::size_t) { return looked < edges; });
}

/// A few blocks at a time: those find the field's cells in the cache.
std::size_t advance_to_end(std::vector<CollapseBlock>& blocks, std::uint16_t last,
                           ThreadProbes& probes, const Pace& pace) {
  constexpr std::size_t kAtATime = 16;
  constexpr std::size_t kEdges = 2048;  // some 10 ms where they ask the field
  std::vector<std::size_t> steps(blocks.size(), 0);
  for (std::size_t first = 0; first < blocks.size(); first += kAtATime) {
    const std::size_t end = std::min(blocks.size(), first + kAtATime);
    const auto has_more = [&] {
      return std::any_of(blocks.begin() + static_cast<std::ptrdiff_t>(first),
                         blocks.begin() + static_cast<std::ptrdiff_t>(end),
                         [last](CollapseBlock& block) { return block.next_class() <= last; });
    };
    while (has_more()) {
      pace.at(static_cast<double>(first) / static_cast<double>(blocks.size()));
      tbb::parallel_for(first, end, [&](std::size_t b) {
        steps[b] += blocks[b].look_at(last, kEdges, probes.mine());
      });
    }
  }
  return std::accumulate(steps.begin(), steps.end(), std::size_t{0});
}

}  // namespace argil::mesh

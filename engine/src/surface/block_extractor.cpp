// SPDX-License-Identifier: GPL-3.0-or-later
// Marching over the 8^3 cells of one leaf. Rows of inside bits find the cells that the surface
// passes and, with the levels around, the loops in which it cuts them: that numbers all vertices.
// They are then computed many at once, and the loops filled. A cell whose loops would cross is
// filled by pyramids, and what comes after it is planned again. Vertices lie on lattice edges and
// are named by them, so neighbouring blocks make the same vertex to the bit and weld() can join
// them by name.
#include "surface/block_extractor.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "surface/contour_pyramid.h"

namespace argil {

namespace {

constexpr std::uint32_t kNoVertex = 0xffffffff;
constexpr double kCentreMargin = 0.02;  // of a cell: how far a centre vertex keeps from its faces

Coord low_of(const TracedCut& cut) { return {cut.low[0], cut.low[1], cut.low[2]}; }

// Only cells of this leaf touch an edge off the leaf's boundary.
bool strictly_inside(const Coord& low, int axis) {
  for (int a = 0; a < 3; ++a) {
    if (a != axis && (low[a] == 0 || low[a] == kLeafSide)) return false;
  }
  return true;
}

Vec3 blended(const std::array<float, 3>& a, const std::array<float, 3>& b, double t) {
  const auto mix = [&](std::size_t i) {
    return static_cast<double>(a[i]) + t * (static_cast<double>(b[i]) - static_cast<double>(a[i]));
  };
  return {mix(0), mix(1), mix(2)};
}

}  // namespace

std::uint64_t lattice_edge_key(int level, const Coord& low, int axis) noexcept {
  assert(level >= 0 && level < 32 && axis >= 0 && axis < 3);
  const auto bits = [](int v) { return static_cast<std::uint64_t>(v + kMaxNode) & 0x7ffff; };
  return bits(low.x()) << 45 | bits(low.y()) << 26 | bits(low.z()) << 7 |
         static_cast<std::uint64_t>(axis) << 5 | static_cast<std::uint64_t>(level);
}

BlockExtractor::BlockExtractor(const ShownLeaves& leaves) : view_(leaves) {}

BlockExtractor::Rows BlockExtractor::inside_rows() const {
  Rows rows;
  for (int x = 0; x < 9; ++x) {
    for (int y = 0; y < 9; ++y) {
      rows[static_cast<std::size_t>(x)][static_cast<std::size_t>(y)] = view_.inside_row(x, y);
    }
  }
  return rows;
}

static std::uint64_t hash_rows(const std::array<std::array<std::uint16_t, 9>, 9>& rows) {
  std::uint64_t hash = 0x9e3779b97f4a7c15ULL;
  for (const auto& plane : rows) {
    for (const std::uint16_t row : plane) {
      hash = (hash ^ row) * 0xff51afd7ed558ccdULL;
      hash ^= hash >> 32;
    }
  }
  return hash;
}

std::uint64_t BlockExtractor::signs(int level, const Coord& origin) {
  if (!view_.open(level, origin)) return 0;
  view_.gather(false);
  return hash_rows(inside_rows());
}

const SurfaceBlock* BlockExtractor::extract(int level, const Coord& origin) {
  if (!view_.open(level, origin)) return nullptr;
  out_.mesh.clear();
  voxel_mm_ = view_.stack().voxel_mm(level);
  out_.trace.reads_coarser = view_.reads_coarser();
  // Next to a transition nodes between this level's decide too; the insides alone do not tell.
  out_.trace.values_coarser = out_.trace.reads_coarser && !view_.uniform();
  out_.trace.signs = 0;
  if (!view_.uniform() || path_ != Path::fastest) {
    find_quiet_octants();
    if (std::all_of(skip_.begin(), skip_.end(), [](bool skip) { return skip; })) {
      return &out_;
    }
  }
  view_.gather();
  rows_ = inside_rows();
  if (view_.uniform()) out_.trace.signs = hash_rows(rows_);
  contour();
  return &out_;
}

void BlockExtractor::find_quiet_octants() {
  for (int o = 0; o < 8; ++o) {
    const Coord low((o >> 2) * 4, (o >> 1 & 1) * 4, (o & 1) * 4);
    const bool quiet = path_ == Path::fastest && view_.live(low) && view_.quiet(low);
    skip_[static_cast<std::size_t>(o)] = quiet || !view_.live(low);
  }
}

void BlockExtractor::contour() {
  vertex_of_.fill(kNoVertex);
  finer_vertex_.clear();
  planned_.clear();
  traced_.clear();
  divided_cells_.forget_many();
  for (int from = 0; from < kSteps;) {
    const std::size_t placed = planned_.size();
    plan(from);
    place(placed);
    const auto crossing =
        std::find_if(cells_.begin(), cells_.end(), [&](const auto& cell) { return !fill(cell); });
    if (crossing == cells_.end()) return;
    forget_planned(crossing->vertices);
    fill_with_pyramids(crossing->cell);
    planned_.resize(out_.mesh.positions.size());
    from = crossing->step + 1;
  }
}

/// From a step on.
void BlockExtractor::plan(int from) {
  cells_.clear();
  corners_.clear();
  for (int row = from / kStepsOfRow; row < kLeafSide * kLeafSide; ++row) {
    plan_row(row / kLeafSide, row % kLeafSide, from);
  }
}

void BlockExtractor::plan_row(int x, int y, int from) {
  const auto i = static_cast<std::size_t>(x);
  const auto j = static_cast<std::size_t>(y);
  const std::array<unsigned, 4> r{rows_[i][j], rows_[i][j + 1], rows_[i + 1][j],
                                  rows_[i + 1][j + 1]};
  const unsigned any = r[0] | r[1] | r[2] | r[3];
  const unsigned all = r[0] & r[1] & r[2] & r[3];
  unsigned mixed = ((any | any >> 1) & ~(all & all >> 1)) & 0xffU;
  const int first_step = kStepsOfRow * (kLeafSide * x + y);
  if (!view_.uniform() || path_ != Path::fastest) {
    const std::size_t octants = static_cast<std::size_t>((x >> 2) << 2 | (y >> 2) << 1);
    const unsigned skipped = (skip_[octants] ? 0x0fU : 0U) | (skip_[octants + 1] ? 0xf0U : 0U);
    mixed &= ~skipped;
    unsigned general = view_.divided_row(x, y) & ~skipped;
    if (path_ != Path::fastest) general |= mixed;
    mixed &= ~general;
    if (general != 0 && path_ == Path::fastest && view_.depth() == 1) {
      general &= view_.mixed_around(x, y);
    }
    for (; general != 0; general &= general - 1) {
      const int z = std::countr_zero(general);
      if (first_step + z >= from) plan_general_cell(Coord(x, y, z), first_step + z);
    }
  }
  for (; mixed != 0; mixed &= mixed - 1) {
    const int z = std::countr_zero(mixed);
    const int step = first_step + kLeafSide + z;
    if (step < from) continue;
    unsigned pattern = 0;
    for (unsigned c = 0; c < 4; ++c) pattern |= (r[c] >> z & 3U) << (2 * c);
    assert(pattern > 0 && pattern < 255 && view_.live(Coord(x, y, z)));
    plan_cell(Coord(x, y, z), undivided_cells()[pattern], step, false);
  }
}

/// One beside finer cells; any, where the path is for tests.
void BlockExtractor::plan_general_cell(const Coord& cell, int step) {
  const bool is_divided = (view_.divided_row(cell.x(), cell.y()) >> cell.z() & 1U) != 0;
  const int depth = is_divided ? view_.depth() : 0;
  const TracedCell* traced =
      depth == 1 && path_ == Path::fastest
          ? divided_cells_.find(view_.refined_around(cell), view_.inside_around(cell))
          : &trace(cell, depth, step);
  if (traced != nullptr) plan_cell(cell, *traced, step, path_ == Path::pyramids);
}

/// What no table has; without loops where the surface does not pass.
const TracedCell& BlockExtractor::trace(const Coord& cell, int depth, int step) {
  const auto known = traced_.find(step);
  if (known != traced_.end()) return known->second;
  cell_.build(view_, cell, depth);
  if (!find_insides(cell)) return traced_[step];
  cell_.trace();
  return traced_.emplace(step, traced(cell_)).first->second;
}

void BlockExtractor::plan_cell(const Coord& cell, const TracedCell& traced, int step,
                               bool is_pyramids) {
  if (traced.cuts.empty()) return;  // hanging nodes alone
  const std::size_t first = corners_.size();
  corners_.resize(first + traced.cuts.size());
  std::uint32_t* corner = corners_.data() + first;
  const std::size_t slot = edge_slot(cell.x(), cell.y(), cell.z(), 0);
  for (const TracedCut& cut : traced.cuts) {
    std::uint32_t& known =
        cut.finer == 0 ? vertex_of_[slot + cut.slot] : vertex_of_finer(cell, cut);
    if (known == kNoVertex) known = plan_vertex(cell, cut);
    *corner++ = known;
  }
  const auto vertices = static_cast<std::uint32_t>(planned_.size());
  cells_.push_back({&traced, static_cast<std::uint32_t>(first), vertices, step, cell, is_pyramids});
  if (traced.centres != 0) {
    planned_.resize(vertices + std::size_t{traced.centres});
  }
}

std::uint32_t& BlockExtractor::vertex_of_finer(const Coord& cell, const TracedCut& cut) {
  const Coord node = ((view_.origin() + cell) << cut.finer) + low_of(cut);
  const std::uint64_t key = lattice_edge_key(view_.level() - cut.finer, node, cut.axis);
  return finer_vertex_.try_emplace(key, kNoVertex).first->second;
}

std::uint32_t BlockExtractor::plan_vertex(const Coord& cell, const TracedCut& cut) {
  const Coord low = (cell << cut.finer) + low_of(cut);
  planned_.push_back({cut.finer,
                      cut.axis,
                      {static_cast<std::int16_t>(low.x()), static_cast<std::int16_t>(low.y()),
                       static_cast<std::int16_t>(low.z())}});
  return static_cast<std::uint32_t>(planned_.size() - 1);
}

/// All but the first so many vertices, and what they were made for.
void BlockExtractor::forget_planned(std::size_t vertices) {
  for (std::size_t n = vertices; n < planned_.size(); ++n) {
    const auto& [finer, axis, low] = planned_[n];
    if (axis == kCentre) continue;
    const Coord at(low[0], low[1], low[2]);
    if (finer == 0) {
      vertex_of_[edge_slot(at.x(), at.y(), at.z(), axis)] = kNoVertex;
    } else {
      finer_vertex_.erase(
          lattice_edge_key(view_.level() - finer, (view_.origin() << finer) + at, axis));
    }
  }
  planned_.resize(vertices);
  out_.mesh.keys.resize(vertices);
  out_.mesh.positions.resize(vertices);
  out_.mesh.normals.resize(vertices);
}

/// Puts all planned vertices from `first` on into the mesh; centres follow with their loops.
void BlockExtractor::place(std::size_t first) {
  ContourMesh& mesh = out_.mesh;
  mesh.keys.resize(planned_.size(), ContourMesh::kNoKey);
  mesh.positions.resize(planned_.size());
  mesh.normals.resize(planned_.size());
  in_lanes_.clear();
  for (std::size_t n = first; n < planned_.size(); ++n) {
    if (planned_[n].axis == kCentre) continue;
    const auto vertex = static_cast<std::uint32_t>(n);
    if (planned_[n].finer > 0) {
      place_finer(vertex);
      continue;
    }
    in_lanes_.push_back(vertex);
    if (in_lanes_.size() < CutEdges::kLanes) continue;
    place_lanes(in_lanes_);
    in_lanes_.clear();
  }
  if (!in_lanes_.empty()) place_lanes(in_lanes_);
}

/// Up to CutEdges::kLanes vertices on edges of the leaf's own level.
void BlockExtractor::place_lanes(std::span<const std::uint32_t> vertices) {
  constexpr std::array<int, 3> kStep{SurfaceView::kSide * SurfaceView::kSide, SurfaceView::kSide,
                                     1};
  const Coord& origin = view_.origin();
  for (std::size_t lane = 0; lane < vertices.size(); ++lane) {
    const Planned& planned = planned_[vertices[lane]];
    const float* at =
        view_.dense() + SurfaceView::index(planned.low[0], planned.low[1], planned.low[2]);
    const float* next = at + kStep[planned.axis];
    assert((*at < 0.0F) != (*next < 0.0F));
    lanes_.low[lane] = *at;
    lanes_.high[lane] = *next;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lanes_.node[axis][lane] =
          static_cast<std::int32_t>(origin[static_cast<int>(axis)]) + planned.low[axis];
      lanes_.along[axis][lane] = 0.0;
      lanes_.before[axis][lane] = at[kStep[axis]] - at[-kStep[axis]];
      lanes_.after[axis][lane] = next[kStep[axis]] - next[-kStep[axis]];
    }
    lanes_.along[planned.axis][lane] = 1.0;
  }
  lanes_.compute(voxel_mm_);
  for (std::size_t lane = 0; lane < vertices.size(); ++lane) take_lane(lane, vertices[lane]);
}

/// Puts a vertex that was computed into its place.
void BlockExtractor::take_lane(std::size_t lane, std::uint32_t vertex) {
  const Planned& planned = planned_[vertex];
  const Coord low(planned.low[0], planned.low[1], planned.low[2]);
  if (out_.trace.reads_coarser && !out_.trace.values_coarser) note_coarser(low, planned.axis);
  if (!view_.uniform() || !strictly_inside(low, planned.axis)) {
    out_.mesh.keys[vertex] = lattice_edge_key(view_.level(), view_.origin() + low, planned.axis);
  }
  out_.mesh.positions[vertex] = {lanes_.position[0][lane], lanes_.position[1][lane],
                                 lanes_.position[2][lane]};
  Vec3& normal = out_.mesh.normals[vertex];
  if (lanes_.square[lane] > 0.0) {
    normal = {lanes_.normal[0][lane], lanes_.normal[1][lane], lanes_.normal[2][lane]};
  } else {  // zero, or a border value not yet known
    const double t = cut_parameter(static_cast<double>(lanes_.low[lane]),
                                   static_cast<double>(lanes_.high[lane]));
    normal = this->normal(0, low, planned.axis, t);
  }
  assert(is_finite(out_.mesh.positions[vertex]) && is_finite(normal));
}

/// A vertex on an edge of a finer level.
void BlockExtractor::place_finer(std::uint32_t vertex) {
  const Planned& planned = planned_[vertex];
  const int depth = planned.finer;
  const Coord low(planned.low[0], planned.low[1], planned.low[2]);
  Coord high = low;
  ++high[planned.axis];
  const double t = cut_parameter(static_cast<double>(view_.value(depth, low)),
                                 static_cast<double>(view_.value(depth, high)));
  const Coord node = (view_.origin() << depth) + low;
  const int level = view_.level() - depth;
  Vec3 position{static_cast<double>(node.x()), static_cast<double>(node.y()),
                static_cast<double>(node.z())};
  position[planned.axis] += t;
  position *= view_.stack().voxel_mm(level);
  out_.mesh.keys[vertex] = lattice_edge_key(level, node, planned.axis);
  out_.mesh.positions[vertex] = position;
  out_.mesh.normals[vertex] = normal(depth, low, planned.axis, t);
}

/// Fills the loops of a cell; false, and no triangle is added, when they would cross.
bool BlockExtractor::fill(const PlannedCell& cell) {
  if (cell.is_pyramids) return false;
  ContourMesh& mesh = out_.mesh;
  const std::size_t triangles = mesh.triangles.size();
  const TracedCell& traced = *cell.traced;
  loop_corners_.resize(traced.cuts.size());
  for (std::size_t i = 0; i < traced.cuts.size(); ++i) {
    const std::uint32_t vertex = corners_[cell.first_corner + i];
    loop_corners_[i] = {mesh.positions[vertex], vertex, traced.cuts[i].planes};
  }
  const LoopBody about = traced.centres != 0 ? body(cell.cell) : LoopBody();
  std::uint32_t centre = cell.vertices;
  std::size_t first = 0;
  for (const TracedLoop& traced_loop : traced.loops) {
    const auto loop = std::span(loop_corners_).subspan(first, traced_loop.length);
    if (traced_loop.has_centre) {
      fill_about_centre(loop, about, centre++, mesh);
    } else {
      fill_plainly(loop, mesh);
    }
    first += traced_loop.length;
  }
  if (!traced.may_cross || !triangles_cross(mesh, triangles, voxel_mm_)) return true;
  mesh.triangles.resize(triangles);
  return false;
}

// The sides of all nodes of the cell's polygons; false when they are all the same.
bool BlockExtractor::find_insides(const Coord& cell) {
  const int n = (1 << cell_.depth()) + 1;
  values_.resize(static_cast<std::size_t>(n * n * n));
  bool any = false;
  bool all = true;
  for (const std::uint16_t node : cell_.nodes()) {
    const float value = view_.value(cell_.depth(), (cell << cell_.depth()) + cell_.position(node));
    values_[node] = value;
    cell_.set_inside(node, value < 0.0F);
    any |= value < 0.0F;
    all &= value < 0.0F;
  }
  return any && !all;
}

/// Its vertices on lattice edges are in the mesh.
void BlockExtractor::fill_with_pyramids(const Coord& cell) {
  const bool is_divided = (view_.divided_row(cell.x(), cell.y()) >> cell.z() & 1U) != 0;
  cell_.build(view_, cell, is_divided ? view_.depth() : 0);
  find_insides(cell);
  cell_.trace();
  const TracedCell loops = traced(cell_);
  std::vector<LoopCorner> corners(cell_.cuts().size());
  for (std::size_t i = 0; i < loops.cuts.size(); ++i) {
    const TracedCut& cut = loops.cuts[i];
    const std::uint32_t at = cut.finer == 0
                                 ? vertex_of_[edge_slot(cell.x(), cell.y(), cell.z(), 0) + cut.slot]
                                 : vertex_of_finer(cell, cut);
    assert(at != kNoVertex);
    corners[cell_.loop_cuts()[i]] = {out_.mesh.positions[at], at, loops.cuts[i].planes};
  }
  const Coord node = view_.origin() + cell;
  const PyramidInput input{corners,
                           {node.x() * voxel_mm_, node.y() * voxel_mm_, node.z() * voxel_mm_},
                           voxel_mm_,
                           values_};
  fill_by_pyramids(cell_, input, out_.mesh);
}

LoopBody BlockExtractor::body(const Coord& cell) const {
  const Coord node = view_.origin() + cell;
  const double near = kCentreMargin;
  const double far = 1.0 - kCentreMargin;
  const auto point = [&](double f) {
    return Vec3{(node.x() + f) * voxel_mm_, (node.y() + f) * voxel_mm_, (node.z() + f) * voxel_mm_};
  };
  return {point(near), point(far), point(0.5)};
}

Vec3 BlockExtractor::normal(int depth, const Coord& low, int axis, double t) {
  Coord high = low;
  ++high[axis];
  const Vec3 g = blended(gradient(depth, low), gradient(depth, high), t);
  const double square = dot(g, g);
  if (square > 0.0) return g * (1.0 / std::sqrt(square));
  Vec3 along;  // the field says nothing but where the outside is
  along[static_cast<std::size_t>(axis)] = view_.value(depth, low) < 0.0F ? 1.0 : -1.0;
  return along;
}

std::array<float, 3> BlockExtractor::gradient(int depth, const Coord& node) {
  std::array<float, 3> g;
  for (int axis = 0; axis < 3; ++axis) {
    Coord before = node;
    Coord after = node;
    --before[axis];
    ++after[axis];
    g[static_cast<std::size_t>(axis)] = view_.value(depth, after) - view_.value(depth, before);
  }
  return g;
}

// Remembers when a value that shaped this vertex came from a coarser level.
void BlockExtractor::note_coarser(const Coord& low, int axis) {
  const bool is_far_inside =
      low.x() > 0 && low.y() > 0 && low.z() > 0 && low.x() < 6 && low.y() < 6 && low.z() < 6;
  if (is_far_inside) return;
  Coord high = low;
  ++high[axis];
  for (int a = 0; a < 3; ++a) {
    Coord step(0);
    step[a] = 1;
    for (const Coord& node : {low - step, low + step, high - step, high + step}) {
      if (view_.absent(node)) out_.trace.values_coarser = true;
    }
  }
}

}  // namespace argil

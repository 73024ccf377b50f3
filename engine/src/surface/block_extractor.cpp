// SPDX-License-Identifier: GPL-3.0-or-later
// Marching over the 8^3 cells of one leaf. Rows of inside bits find the cells that the surface
// passes; regular ones go through the table, those at transitions through ContourCell, and those
// whose loops would cross through pyramids. Vertices lie on lattice edges and are named by them, so
// neighbouring blocks make the same vertex to the bit and weld() can join them by name.
#include "surface/block_extractor.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "surface/contour_pyramid.h"
#include "surface/contour_table.h"

namespace argil {

namespace {

constexpr std::uint32_t kNoVertex = 0xffffffff;
constexpr double kCentreMargin = 0.02;  // of a cell: how far a centre vertex keeps from its faces

// Where the field passes zero between the low and the high end of an edge, kept off both.
double cut_parameter(float low, float high) {
  assert((low < 0.0F) != (high < 0.0F));
  const double a = static_cast<double>(low);
  const double t = a / (a - static_cast<double>(high));
  return t > kCutClamp ? (t < 1.0 - kCutClamp ? t : 1.0 - kCutClamp) : kCutClamp;
}

std::size_t vertex_slot(const Coord& low, int axis) {
  assert(axis >= 0 && axis < 3 && low.x() >= 0 && low.x() < 9 && low.y() >= 0 && low.y() < 9 &&
         low.z() >= 0 && low.z() < 9);
  return static_cast<std::size_t>(((axis * 9 + low.x()) * 9 + low.y()) * 9 + low.z());
}

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
  vertex_of_.fill(kNoVertex);
  finer_vertex_.clear();
  for (int x = 0; x < kLeafSide; ++x) {
    for (int y = 0; y < kLeafSide; ++y) contour_row(x, y);
  }
  return &out_;
}

void BlockExtractor::find_quiet_octants() {
  for (int o = 0; o < 8; ++o) {
    const Coord low((o >> 2) * 4, (o >> 1 & 1) * 4, (o & 1) * 4);
    const bool quiet = path_ == Path::fastest && view_.live(low) && view_.quiet(low);
    skip_[static_cast<std::size_t>(o)] = quiet || !view_.live(low);
  }
}

void BlockExtractor::contour_row(int x, int y) {
  const auto i = static_cast<std::size_t>(x);
  const auto j = static_cast<std::size_t>(y);
  const std::array<unsigned, 4> r{rows_[i][j], rows_[i][j + 1], rows_[i + 1][j],
                                  rows_[i + 1][j + 1]};
  const unsigned any = r[0] | r[1] | r[2] | r[3];
  const unsigned all = r[0] & r[1] & r[2] & r[3];
  unsigned mixed = ((any | any >> 1) & ~(all & all >> 1)) & 0xff;
  if (!view_.uniform() || path_ != Path::fastest) {
    for (int z = 0; z < kLeafSide; ++z) {
      const Coord cell(x, y, z);
      const unsigned bit = 1U << z;
      if (skip_[static_cast<std::size_t>((x >> 2) << 2 | (y >> 2) << 1 | z >> 2)]) {
        mixed &= ~bit;
        continue;
      }
      const bool divided = view_.divided(cell);
      if (!divided && (path_ == Path::fastest || (mixed & bit) == 0)) continue;
      const bool quiet = path_ == Path::fastest && (mixed & bit) == 0 && view_.quiet_cell(cell);
      mixed &= ~bit;
      if (!quiet) contour_general_cell(cell);
    }
  }
  for (; mixed != 0; mixed &= mixed - 1) {
    const int z = std::countr_zero(mixed);
    unsigned pattern = 0;
    for (unsigned c = 0; c < 4; ++c) pattern |= (r[c] >> z & 3U) << (2 * c);
    contour_table_cell(Coord(x, y, z), pattern);
  }
}

void BlockExtractor::contour_table_cell(const Coord& cell, unsigned pattern) {
  assert(pattern > 0 && pattern < 255 && view_.live(cell));
  const ContourCase& entry = contour_cases()[pattern];
  std::array<LoopCorner, 12> corners;
  std::array<std::uint16_t, 4> lengths{};
  std::size_t count = 0;
  for (std::size_t loop = 0; loop < entry.loops; ++loop) {
    lengths[loop] = entry.lengths[loop];
    count += entry.lengths[loop];
  }
  for (std::size_t i = 0; i < count; ++i) {
    const ContourEdge& edge = contour_edges()[entry.cuts[i]];
    const Coord low = cell.offsetBy(edge.low[0], edge.low[1], edge.low[2]);
    const std::uint32_t at = vertex(0, low, edge.axis);
    corners[i] = {out_.mesh.positions[at], at, edge.planes};
  }
  if (!fill_loops(std::span(corners).first(count), std::span(lengths).first(entry.loops), cell,
                  true)) {
    cell_.build(view_, cell, 0);
    find_insides(cell);
    fill_with_pyramids(cell);
  }
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

void BlockExtractor::contour_general_cell(const Coord& cell) {
  cell_.build(view_, cell, view_.divided(cell) ? view_.depth() : 0);
  if (!find_insides(cell)) return;
  if (path_ == Path::pyramids) return fill_with_pyramids(cell);
  cell_.trace();
  corners_.clear();
  const int depth = cell_.depth();
  for (const std::uint16_t index : cell_.loop_cuts()) {
    const ContourCut& cut = cell_.cuts()[index];
    const Coord low = cell_.position(cut.low);
    const int length = (cell_.position(cut.high) - low)[cut.axis];
    const int shift = std::countr_zero(static_cast<unsigned>(length));
    const Coord node = ((cell << depth) + low) >> shift;
    const std::uint32_t at = vertex(depth - shift, node, cut.axis);
    corners_.push_back({out_.mesh.positions[at], at, cut.planes});
  }
  const auto found = cell_.loop_lengths();
  lengths_.assign(found.begin(), found.end());
  if (!fill_loops(corners_, lengths_, cell, depth == 0)) fill_with_pyramids(cell);
}

// Fills the cell's loops; false, and nothing is added but vertices already shared, when the
// triangles would cross. A lone loop cannot cross itself while it has four corners or a centre, nor
// with five in a regular cell: those project to a convex pentagon.
bool BlockExtractor::fill_loops(std::span<const LoopCorner> corners,
                                std::span<const std::uint16_t> lengths, const Coord& cell,
                                bool regular) {
  ContourMesh& mesh = out_.mesh;
  const std::size_t triangles = mesh.triangles.size();
  const std::size_t vertices = mesh.positions.size();
  bool test = lengths.size() > 1;
  // Regular loops up to five corners never want a centre.
  const bool plain = regular && lengths.size() == 1 && corners.size() < 6;
  const LoopBody about = plain ? LoopBody() : body(cell);
  std::size_t first = 0;
  for (const std::uint16_t length : lengths) {
    const LoopFill fill = fill_loop(corners.subspan(first, length), about, mesh);
    test |= fill == LoopFill::triangles && length > 4 && !regular;
    first += length;
  }
  if (!test || !triangles_cross(mesh, triangles, voxel_mm_)) return true;
  mesh.triangles.resize(triangles);
  mesh.positions.resize(vertices);
  mesh.normals.resize(vertices);
  mesh.keys.resize(vertices);
  return false;
}

// cell_ is built and its insides are known.
void BlockExtractor::fill_with_pyramids(const Coord& cell) {
  cell_.trace();
  if (cell_.loop_cuts().empty()) return;
  cut_corners_.assign(cell_.cuts().size(), LoopCorner());
  for (const std::uint16_t index : cell_.loop_cuts()) {
    const ContourCut& cut = cell_.cuts()[index];
    const Coord low = cell_.position(cut.low);
    const int length = (cell_.position(cut.high) - low)[cut.axis];
    const int shift = std::countr_zero(static_cast<unsigned>(length));
    const std::uint32_t at =
        vertex(cell_.depth() - shift, ((cell << cell_.depth()) + low) >> shift, cut.axis);
    cut_corners_[index] = {out_.mesh.positions[at], at, cut.planes};
  }
  const Coord node = view_.origin() + cell;
  const PyramidInput input{cut_corners_,
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

// The vertex on an edge `depth` levels finer, `low` counted from the leaf in nodes of that level.
std::uint32_t BlockExtractor::vertex(int depth, const Coord& low, int axis) {
  if (depth == 0) {
    std::uint32_t& known = vertex_of_[vertex_slot(low, axis)];
    if (known == kNoVertex) known = add_vertex(depth, low, axis);
    return known;
  }
  const std::uint64_t key =
      lattice_edge_key(view_.level() - depth, (view_.origin() << depth) + low, axis);
  const auto [at, fresh] = finer_vertex_.try_emplace(key, 0);
  if (fresh) at->second = add_vertex(depth, low, axis);
  return at->second;
}

std::uint32_t BlockExtractor::add_vertex(int depth, const Coord& low, int axis) {
  Coord high = low;
  ++high[axis];
  const double t = cut_parameter(view_.value(depth, low), view_.value(depth, high));
  const Coord node = (view_.origin() << depth) + low;
  const int level = view_.level() - depth;
  const double voxel = view_.stack().voxel_mm(level);
  Vec3 position{static_cast<double>(node.x()), static_cast<double>(node.y()),
                static_cast<double>(node.z())};
  position[static_cast<std::size_t>(axis)] += t;
  position *= voxel;
  if (depth == 0 && out_.trace.reads_coarser && !out_.trace.values_coarser) note_coarser(low, axis);
  const bool own = depth == 0 && view_.uniform() && strictly_inside(low, axis);
  const std::uint64_t key = own ? ContourMesh::kNoKey : lattice_edge_key(level, node, axis);
  return out_.mesh.add_vertex(
      key, position, depth == 0 ? dense_normal(low, axis, t) : normal(depth, low, axis, t));
}

// Gradients at both ends from the dense block; the same sums as `normal`, without its look-ups.
Vec3 BlockExtractor::dense_normal(const Coord& low, int axis, double t) {
  constexpr std::array<int, 3> kStep{SurfaceView::kSide * SurfaceView::kSide, SurfaceView::kSide,
                                     1};
  const float* at = view_.dense() + SurfaceView::index(low.x(), low.y(), low.z());
  const float* next = at + kStep[static_cast<std::size_t>(axis)];
  std::array<float, 3> a;
  std::array<float, 3> b;
  for (std::size_t i = 0; i < 3; ++i) {
    a[i] = at[kStep[i]] - at[-kStep[i]];
    b[i] = next[kStep[i]] - next[-kStep[i]];
  }
  const Vec3 g = blended(a, b, t);
  const double square = dot(g, g);
  if (!(square > 0.0)) return normal(0, low, axis, t);  // zero, or a border value not yet known
  return g * (1.0 / std::sqrt(square));
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

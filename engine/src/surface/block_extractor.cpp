// SPDX-License-Identifier: GPL-3.0-or-later
// Marching over the 8^3 cells of one leaf. Rows of inside bits find the cells that the surface
// passes and the edges that it cuts, whose vertices are numbered and computed many at once. Cells
// beside finer ones follow, with the vertices that only they have. Then the loops are filled, those
// of four corners many at once, and last, by pyramids, the cells whose loops would cross. Vertices
// lie on lattice edges and are named by them, so neighbouring blocks make the same vertex to the
// bit and weld() can join them by name.
#include "surface/block_extractor.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>
#include <span>
#include <utility>

#include "surface/contour_pyramid.h"

namespace argil {

namespace {

constexpr double kCentreMargin = 0.02;  // of a cell: how far a centre vertex keeps from its faces

Coord low_of(const TracedCut& cut) { return {cut.low[0], cut.low[1], cut.low[2]}; }

/// Where the field says nothing but on which side the outside is.
Vec3 out_along(int axis, float at_low) {
  Vec3 along;
  along[static_cast<std::size_t>(axis)] = at_low < 0.0F ? 1.0 : -1.0;
  return along;
}

/// What decides which leaves the nodes about an edge belong to: its axis, and along each axis
/// whether it begins at 0, before 6, at 6, 7 or 8.
constexpr std::size_t kPlaces = 3 * 5 * 5 * 5;
std::size_t place_among_leaves(unsigned code) noexcept {
  constexpr std::array<std::uint8_t, 9> kKind{0, 1, 1, 1, 1, 1, 2, 3, 4};
  const Coord low = CutEdges::low_of(code);
  auto place = static_cast<std::size_t>(CutEdges::axis_of(code));
  for (int axis = 0; axis < 3; ++axis) {
    place = 5 * place + kKind[static_cast<std::size_t>(low[axis])];
  }
  return place;
}

/// Of the 27 leaves in and around a leaf those with a node whose value shapes the vertex on an
/// edge, by place_among_leaves(); bits as SurfaceView::absent_neighbours().
const std::array<std::uint32_t, kPlaces>& leaves_read() {
  static const std::array<std::uint32_t, kPlaces> leaves = [] {
    std::array<std::uint32_t, kPlaces> read{};
    for (unsigned n = 0; n < 3 * 9 * 9 * 9; ++n) {
      const unsigned code = n / 729 << 24 | n / 81 % 9 << 16 | n / 9 % 9 << 8 | n % 9;
      const Coord low = CutEdges::low_of(code);
      Coord high = low;
      ++high[CutEdges::axis_of(code)];
      for (int axis = 0; axis < 3; ++axis) {
        Coord step(0);
        step[axis] = 1;
        for (const Coord& node : {low - step, low + step, high - step, high + step}) {
          const Coord leaf = (node >> 3) + Coord(1);
          read[place_among_leaves(code)] |= 1U << (9 * leaf.x() + 3 * leaf.y() + leaf.z());
        }
      }
    }
    return read;
  }();
  return leaves;
}

}  // namespace

std::uint64_t lattice_edge_key(int level, const Coord& low, int axis) noexcept {
  assert(level >= 0 && level < 32 && axis >= 0 && axis < 3);
  // Sums, as rows/contour_impl.h goes on from one edge to others: a coordinate of kMaxNode carries.
  const auto shifted = [](int v, int by) { return static_cast<std::uint64_t>(v + kMaxNode) << by; };
  return shifted(low.x(), 45) + shifted(low.y(), 26) + shifted(low.z(), 7) +
         (static_cast<std::uint64_t>(axis) << 5) + static_cast<std::uint64_t>(level);
}

BlockExtractor::BlockExtractor(const ShownLeaves& leaves) : view_(leaves) {}

InsideRows BlockExtractor::inside_rows() const {
  InsideRows rows;
  for (int x = 0; x < 9; ++x) {
    for (int y = 0; y < 9; ++y) {
      rows[static_cast<std::size_t>(x)][static_cast<std::size_t>(y)] = view_.inside_row(x, y);
    }
  }
  return rows;
}

static std::uint64_t hash_rows(const InsideRows& rows) {
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
  if (!is_plain()) {
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

const std::array<BlockExtractor::PlainCell, 256>& BlockExtractor::plain_cells() {
  static const std::array<PlainCell, 256> cells = [] {
    std::array<PlainCell, 256> made;
    for (std::size_t pattern = 0; pattern < made.size(); ++pattern) {
      const TracedCell& traced = undivided_cells()[pattern];
      PlainCell& plain = made[pattern];
      assert(traced.cuts.size() <= plain.slots.size() &&
             traced.loops.size() <= plain.shapes.size());
      plain.loops = static_cast<std::uint8_t>(traced.loops.size());
      plain.may_cross = traced.may_cross;
      std::copy(traced.loops.begin(), traced.loops.end(), plain.shapes.begin());
      std::transform(
          traced.cuts.begin(), traced.cuts.end(), plain.slots.begin(), [](const TracedCut& cut) {
            const Coord low = low_of(cut);
            return static_cast<std::uint16_t>(edge_slot(low.x(), low.y(), low.z(), cut.axis));
          });
    }
    return made;
  }();
  return cells;
}

void BlockExtractor::contour() {
  find_cells();
  if (!is_plain()) edges_.forget_vertices();
  edges_.number(rows_, plain_, !is_plain());
  finer_.clear();
  general_cells_.clear();
  if (!is_plain()) plan_general_cells();
  place_edges();
  for (std::size_t place = 0; place < finer_.size(); ++place) place_finer(place);
  if (out_.trace.reads_coarser && !out_.trace.values_coarser) {
    out_.trace.values_coarser = some_value_is_coarser();
  }
  crossing_.clear();
  fill_plain_cells();
  for (const GeneralCell& cell : general_cells_) fill_general_cell(cell);
  fill_waiting();
  for (const Coord& cell : crossing_) fill_with_pyramids(cell);
}

/// Of those that the surface passes, or may pass.
void BlockExtractor::find_cells() {
  for (std::size_t x = 0; x < kLeafSide; ++x) {
    for (std::size_t y = 0; y < kLeafSide; ++y) {
      const std::array<unsigned, 4> r{rows_[x][y], rows_[x][y + 1], rows_[x + 1][y],
                                      rows_[x + 1][y + 1]};
      const unsigned any = r[0] | r[1] | r[2] | r[3];
      const unsigned all = r[0] & r[1] & r[2] & r[3];
      unsigned mixed = ((any | any >> 1) & ~(all & all >> 1)) & 0xffU;
      unsigned general = 0;
      if (!is_plain()) {
        const std::size_t octants = (x >> 2) << 2 | (y >> 2) << 1;
        const unsigned skipped = (skip_[octants] ? 0x0fU : 0U) | (skip_[octants + 1] ? 0xf0U : 0U);
        const int i = static_cast<int>(x);
        const int j = static_cast<int>(y);
        mixed &= ~skipped;
        general = view_.divided_row(i, j) & ~skipped;
        if (path_ != Path::fastest) general |= mixed;
        mixed &= ~general;
        if (general != 0 && path_ == Path::fastest && view_.depth() == 1) {
          general &= view_.mixed_around(i, j);
        }
      }
      plain_[kLeafSide * x + y] = static_cast<std::uint8_t>(mixed);
      general_[kLeafSide * x + y] = static_cast<std::uint8_t>(general);
    }
  }
}

void BlockExtractor::plan_general_cells() {
  corners_.clear();
  finer_place_.clear();
  traced_.clear();
  divided_cells_.forget_many();
  for (int row = 0; row < kLeafSide * kLeafSide; ++row) {
    unsigned cells = general_[static_cast<std::size_t>(row)];
    for (; cells != 0; cells &= cells - 1) {
      plan_general_cell({row / kLeafSide, row % kLeafSide, std::countr_zero(cells)});
    }
  }
}

/// One beside finer cells; any, where the path is for tests.
void BlockExtractor::plan_general_cell(const Coord& cell) {
  const bool is_divided = (view_.divided_row(cell.x(), cell.y()) >> cell.z() & 1U) != 0;
  const int depth = is_divided ? view_.depth() : 0;
  const TracedCell* traced =
      depth == 1 && path_ == Path::fastest
          ? divided_cells_.find(view_.refined_around(cell), view_.inside_around(cell))
          : &trace(cell, depth);
  if (traced == nullptr || traced->cuts.empty()) return;  // none, or hanging nodes alone
  general_cells_.push_back({traced, corners_.size(), cell});
  for (const TracedCut& cut : traced->cuts) corners_.push_back(plan_corner(cell, cut));
}

std::uint32_t BlockExtractor::plan_corner(const Coord& cell, const TracedCut& cut) {
  const Coord low = (cell << cut.finer) + low_of(cut);
  if (cut.finer == 0) return edges_.find_or_add(low, cut.axis);
  const Coord node = (view_.origin() << cut.finer) + low;
  const std::uint64_t key = lattice_edge_key(view_.level() - cut.finer, node, cut.axis);
  assert(key != ContourMesh::kNoKey);
  const auto fresh = static_cast<std::uint32_t>(finer_.size());
  const std::uint32_t place = finer_place_.find_or_insert(key, fresh);
  if (place == fresh) {
    finer_.push_back({cut.finer,
                      cut.axis,
                      {static_cast<std::int16_t>(low.x()), static_cast<std::int16_t>(low.y()),
                       static_cast<std::int16_t>(low.z())}});
  }
  return place | kFiner;
}

/// What no table has; without loops where the surface does not pass.
const TracedCell& BlockExtractor::trace(const Coord& cell, int depth) {
  cell_.build(view_, cell, depth);
  if (!find_insides(cell)) return traced_.emplace_back();
  cell_.trace();
  return traced_.emplace_back(traced(cell_));
}

/// Puts the vertices on edges of the leaf's own level into the mesh, and makes room for the finer.
void BlockExtractor::place_edges() {
  ContourMesh& mesh = out_.mesh;
  const auto count = static_cast<std::size_t>(edges_.count());
  const std::size_t room = count + CutJob::kLanes;
  mesh.keys.resize(room);
  mesh.positions.resize(room);
  mesh.normals.resize(room);
  flat_.resize(room);
  if (!is_plain() || view_.reads_coarser()) {
    edges_.mark_staying([this](const Coord& node) { return is_where_levels_meet(node); });
  }
  const CutJob job = cut_job(view_.dense() + SurfaceView::index(0, 0, 0), SurfaceView::kSide,
                             view_.level(), view_.origin());
  const int flats =
      row_loops().place_cuts(job, edges_.codes(), edges_.count(), vertices_from(0), flat_.data());
  // Where a node about the edge was not looked up yet, or the field is flat.
  constexpr unsigned kFlags = CutJob::kIsShared | CutJob::kLowStays | CutJob::kHighStays;
  for (std::size_t n = 0; n < static_cast<std::size_t>(flats); ++n) {
    const unsigned code = edges_.codes()[flat_[n]];
    place_alone(0, CutEdges::low_of(code), CutEdges::axis_of(code), code & kFlags, flat_[n]);
  }
  for (std::size_t n = 0; n < count; ++n) {
    assert(is_finite(mesh.positions[n]) && is_finite(mesh.normals[n]));
  }
  mesh.keys.resize(count + finer_.size());
  mesh.positions.resize(count + finer_.size());
  mesh.normals.resize(count + finer_.size());
}

/// Whether some of the eight cells about the node are of another level. There vertices keep to
/// their edges, since triangles of both sides share the edges of the face between them.
bool BlockExtractor::is_where_levels_meet(const Coord& node) const {
  for (int corner = 0; corner < 8; ++corner) {
    const Coord cell = node.offsetBy(-(corner >> 2), -(corner >> 1 & 1), -(corner & 1));
    if (view_.absent(cell) || !view_.live(cell)) return true;
  }
  return false;
}

/// Of the level's lattice, nodes of whose field lie in a cube of so many.
CutJob BlockExtractor::cut_job(const float* origin_in_cube, int side, int level,
                               const Coord& origin) const {
  return {origin_in_cube,
          side * side,
          side,
          {origin.x(), origin.y(), origin.z()},
          view_.stack().voxel_mm(level),
          kCutMargin,
          kMovedCutMargin,
          lattice_edge_key(level, origin, 0)};
}

CutVertices BlockExtractor::vertices_from(std::size_t first) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  ContourMesh& mesh = out_.mesh;
  return {&mesh.positions[first].x, &mesh.normals[first].x, mesh.keys.data() + first};
}

void BlockExtractor::place_finer(std::size_t place) {
  const FinerVertex& planned = finer_[place];
  place_alone(planned.finer, {planned.low[0], planned.low[1], planned.low[2]}, planned.axis,
              CutJob::kIsShared | CutJob::kLowStays | CutJob::kHighStays,
              static_cast<std::size_t>(edges_.count()) + place);
}

/// The vertex on an edge whose nodes are looked up one by one; by the same loop as those of a
/// block's own level, so that whichever block makes it gives it the same bits.
void BlockExtractor::place_alone(int depth, const Coord& low, int axis, unsigned flags,
                                 std::size_t vertex) {
  constexpr int kSide = 4;  // the edge's nodes and those beside them
  constexpr int kLow = (kSide + 1) * kSide + 1;
  constexpr std::array<int, 3> kStride{kSide * kSide, kSide, 1};
  const auto own = static_cast<std::size_t>(axis);
  std::array<float, kSide * kSide * kSide> cube;
  cube.fill(std::numeric_limits<float>::quiet_NaN());
  for (int end = 0; end < 2; ++end) {
    Coord at = low;
    at[axis] += end;
    const int place_in_cube = kLow + end * kStride[own];
    cube[static_cast<std::size_t>(place_in_cube)] = view_.value(depth, at);
    for (std::size_t across = 0; across < 3; ++across) {
      for (const int step : {-1, 1}) {
        Coord beside = at;
        beside[static_cast<int>(across)] += step;
        const int there = place_in_cube + step * kStride[across];
        cube[static_cast<std::size_t>(there)] = view_.value(depth, beside);
      }
    }
  }
  const CutJob job =
      cut_job(cube.data() + kLow, kSide, view_.level() - depth, (view_.origin() << depth) + low);
  std::array<unsigned, CutJob::kLanes> codes;
  codes.fill(static_cast<unsigned>(axis) << 24 | flags);
  std::array<Vec3, CutJob::kLanes> positions;
  std::array<Vec3, CutJob::kLanes> normals;
  std::array<std::uint64_t, CutJob::kLanes> keys;
  std::array<unsigned short, 2> flat;
  const int flats = row_loops().place_cuts(
      job, codes.data(), 1, {&positions[0].x, &normals[0].x, keys.data()}, flat.data());
  out_.mesh.keys[vertex] = keys[0];
  out_.mesh.positions[vertex] = positions[0];
  out_.mesh.normals[vertex] =
      flats == 0 ? normals[0] : out_along(axis, cube[static_cast<std::size_t>(kLow)]);
}

void BlockExtractor::fill_plain_cells() {
  const auto& table = plain_cells();
  waiting_.clear();
  waiting_at_.clear();
  for (std::size_t x = 0; x < kLeafSide; ++x) {
    for (std::size_t y = 0; y < kLeafSide; ++y) {
      unsigned cells = plain_[kLeafSide * x + y];
      if (cells == 0) continue;
      const std::array<unsigned, 4> r{rows_[x][y], rows_[x][y + 1], rows_[x + 1][y],
                                      rows_[x + 1][y + 1]};
      for (; cells != 0; cells &= cells - 1) {
        const int z = std::countr_zero(cells);
        unsigned pattern = 0;
        for (unsigned c = 0; c < 4; ++c) pattern |= (r[c] >> z & 3U) << (2 * c);
        assert(pattern > 0 && pattern < 255);
        fill_plain_cell({static_cast<int>(x), static_cast<int>(y), z}, table[pattern]);
      }
    }
  }
}

void BlockExtractor::fill_plain_cell(const Coord& cell, const PlainCell& plain) {
  assert(view_.live(cell));
  const std::size_t vertices = out_.mesh.positions.size();
  const std::size_t triangles = out_.mesh.triangles.size();
  const std::size_t slot = edge_slot(cell.x(), cell.y(), cell.z(), 0);
  const std::uint16_t* corner = plain.slots.data();
  std::array<std::uint32_t, 12> loop;
  for (std::size_t n = 0; n < plain.loops; ++n) {
    const LoopShape& shape = plain.shapes[n];
    for (std::size_t i = 0; i < shape.length; ++i) loop[i] = edges_.vertex(slot + *corner++);
    fill_loop(shape, loop.data(), cell, !plain.may_cross);
  }
  if (plain.may_cross) look_for_crossings(cell, vertices, triangles);
}

void BlockExtractor::fill_general_cell(const GeneralCell& general) {
  const TracedCell& traced = *general.traced;
  if (path_ == Path::pyramids) return crossing_.push_back(general.cell);
  const std::size_t vertices = out_.mesh.positions.size();
  const std::size_t triangles = out_.mesh.triangles.size();
  std::size_t corner = general.first_corner;
  for (const LoopShape& shape : traced.loops) {
    loop_.resize(shape.length);
    for (std::uint32_t& vertex : loop_) vertex = vertex_of(corners_[corner++]);
    fill_loop(shape, loop_.data(), general.cell, !traced.may_cross);
  }
  if (traced.may_cross) look_for_crossings(general.cell, vertices, triangles);
}

/// `may_wait`: until fill_waiting().
void BlockExtractor::fill_loop(const LoopShape& shape, const std::uint32_t* loop, const Coord& cell,
                               bool may_wait) {
  ContourMesh& mesh = out_.mesh;
  const std::span<const std::uint32_t> corners(loop, shape.length);
  if (shape.has_centre()) return fill_about_centre(corners, shape, body(cell), mesh);
  constexpr unsigned kBoth = 3;
  if (!may_wait || shape.length != 4 || shape.joins != kBoth) {
    return fill_plainly(corners, shape, mesh);
  }
  waiting_.push_back({{loop[0], loop[1], loop[2], loop[3]}});
  waiting_at_.push_back(mesh.triangles.size());
  mesh.triangles.resize(mesh.triangles.size() + 2);
}

void BlockExtractor::fill_waiting() {
  ContourMesh& mesh = out_.mesh;
  if (waiting_.empty()) return;
  is_even_.resize(waiting_.size());
  row_loops().choose_diagonals(&mesh.positions[0].x, waiting_.data(),
                               static_cast<int>(waiting_.size()), is_even_.data());
  for (std::size_t n = 0; n < waiting_.size(); ++n) {
    const auto& v = waiting_[n].vertex;
    fill_along({v[0], v[1], v[2], v[3]}, is_even_[n] != 0, &mesh.triangles[waiting_at_[n]]);
  }
}

/// Takes back what was made of a cell since there were so many, and leaves the cell to pyramids.
void BlockExtractor::look_for_crossings(const Coord& cell, std::size_t vertices,
                                        std::size_t triangles) {
  ContourMesh& mesh = out_.mesh;
  if (!triangles_cross(mesh, triangles, voxel_mm_)) return;
  mesh.triangles.resize(triangles);
  mesh.keys.resize(vertices);
  mesh.positions.resize(vertices);
  mesh.normals.resize(vertices);
  crossing_.push_back(cell);
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
  [[maybe_unused]] const std::pair before(edges_.count(), finer_.size());
  for (std::size_t i = 0; i < loops.cuts.size(); ++i) {
    const std::uint32_t vertex = vertex_of(plan_corner(cell, loops.cuts[i]));
    assert(vertex < out_.mesh.positions.size());
    corners[cell_.loop_cuts()[i]] = {vertex, loops.cuts[i].planes};
  }
  assert(before == std::pair(edges_.count(), finer_.size()));  // all were there
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

/// Whether a value that shaped a vertex of this uniform block came from a coarser level.
bool BlockExtractor::some_value_is_coarser() const {
  const auto& read = leaves_read();
  for (int n = 0; n < edges_.count(); ++n) {
    if ((read[place_among_leaves(edges_.codes()[n])] & view_.absent_neighbours()) != 0) return true;
  }
  return false;
}

}  // namespace argil

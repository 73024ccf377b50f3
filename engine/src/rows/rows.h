// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "argil/engine/falloff.h"

namespace argil {

// Inner loops, most of them over the rows of a leaf, eight nodes along z each, compiled once for
// each instruction set. What is included here must not define inline functions but those that are
// always inlined: the linker would keep one copy of each, perhaps that of an instruction set the
// machine does not have.

inline constexpr int kRowNodes = 8;
inline constexpr int kLeafRows = 64;

/// A leaf's nodes with two beside them along each axis: what differences across it read.
struct HaloBlock {
  static constexpr int kHalo = 2;
  static constexpr int kSide = kRowNodes + 2 * kHalo;
  static constexpr int kRow = 16;   ///< floats from one row along z to the next
  static constexpr int kFirst = 4;  ///< where the leaf's own nodes begin in a row

  /// Of the leaf's node (i, j, k), each from -kHalo to kRowNodes + kHalo - 1.
  __attribute__((always_inline)) static constexpr int index(int i, int j, int k) noexcept {
    return ((i + kHalo) * kSide + j + kHalo) * kRow + kFirst + k;
  }

  alignas(64) float value[kSide * kSide * kRow];
};

/// One flag for each node of a leaf, as wide as its value.
struct NodeFlags {
  alignas(64) int is_set[kLeafRows * kRowNodes];
};

/// A point for each node of a leaf, in voxels from the leaf's origin.
struct PointBlock {
  alignas(64) float x[kLeafRows * kRowNodes];
  alignas(64) float y[kLeafRows * kRowNodes];
  alignas(64) float z[kLeafRows * kRowNodes];
  bool is_asked[kLeafRows];  ///< rows for which anything is to be done
};

/// A leaf's feet: for each node within the band the nearest point of the surface, and how strongly
/// the tool pulls there.
struct FeetBlock {
  PointBlock at;             ///< asked: some pull of the row is not 0
  bool has_band[kLeafRows];  ///< some node of the row is within the band; else nothing is set
  alignas(64) float pull[kLeafRows * kRowNodes];
};

/// height (1 - r^2)^2, with r the distance in radii of the tool from where it is or, with a path,
/// from its path; 0 outside.
struct PullJob {
  float first[3];        ///< the leaf's origin from the tool, turned and in radii
  float along[3][3];     ///< a voxel along x, y, z likewise
  float path[3];         ///< likewise, from the tool on; zero for none
  float inverse_square;  ///< 1 / |path|^2, or 0
  float height;
  Falloff falloff;
};

/// A push towards an axis through a tool's middle, by how the tool pulls.
struct PinchJob {
  PullJob pull;
  float first[3];   ///< the leaf's origin from the middle, in voxels
  float normal[3];  ///< of the axis, unit
  float inward;     ///< of the distance from the axis
};

/// A profile that a surface sinks by along a straight path over it, seen from where the path
/// begins, in mm: at a distance s across from the path by scale (1 - c)^2, where c is s / width,
/// but for x = s / width below `round` (x^2 / round + round) / 2, so that the middle is a parabola.
/// What lies a quarter of the reach below the plane already sinks less, and half of it not at all.
struct ProfileJob {
  float first[3];        ///< the leaf's origin
  float voxel;           ///< of the leaf
  float normal[3];       ///< of the plane that fits the surface, unit
  float path[3];         ///< within the plane
  float inverse_square;  ///< 1 / |path|^2, or 0
  float above;           ///< how far over the plane the path begins
  float scale[2];        ///< where the path begins, and how much more where it ends
  float width[2];        ///< likewise; above 0 at both ends
  float round;           ///< above 0, at most 1
  float inverse_reach;   ///< 1 / how far off the path along the normal the surface may lie
  float side;            ///< 1; -1: the surface is raised
  float deepest;         ///< how far the surface moves at most
  float band;            ///< of the leaf's level
  float known;           ///< a start as far from the surface says no more than its side
};

/// A push by as much everywhere, as far as a tool pulls.
struct DragJob {
  PullJob pull;
  float shift[3];  ///< at full pull, in voxels
};

/// A plane to which a surface is drawn, in steps: see DisplaceStep.
struct PlaneJob {
  float first;     ///< how far the leaf's origin is above it, in mm
  float along[3];  ///< and a voxel along x, y, z
  float least;     ///< what is farther below
  float most;      ///< or above counts as no farther than this
  float weight;    ///< the part of the distance that all steps cover at full pull
  float step;
  float steps;
};

/// A dense field that is read between its nodes.
struct FieldJob {
  const float* value;  ///< z fastest
  int count[3];        ///< at least 2 along each axis
  float first[3];      ///< the leaf's origin in the field's nodes, from its first one
  float scale;         ///< of the leaf's voxels in the field's
};

/// A ball on a straight path, seen from where the path begins.
struct BallJob {
  float x[kRowNodes];  ///< of a leaf's nodes along each axis
  float y[kRowNodes];
  float z;        ///< of the first one,
  float step;     ///< and from one to the next
  float axis[3];  ///< of the path, unit; zero where there is none
  float path;     ///< its length
  float radius;
};

/// The 27 leaves of a level that decide the nodes of a leaf of the next coarser one, by place along
/// each axis: the one before those that the coarse leaf covers, and the two that it covers.
struct RestrictJob {
  const float* leaves[27];  ///< none null; what is not there has values outside the band
  float band;
  float voxel;
};

/// The lattice edges of a leaf that the surface cuts. An edge's code: bits 0 to 23 are its low
/// node, counted from the leaf's origin, z lowest, 8 bits each; bits 24 and 25 its axis; kIsShared.
struct CutJob {
  static constexpr int kLanes = 4;
  static constexpr unsigned kIsShared = 1U << 26;  ///< it gets a key
  /// A vertex in that half of it stays on it.
  static constexpr unsigned kLowStays = 1U << 27;
  static constexpr unsigned kHighStays = 1U << 28;

  /// The field is smooth along an edge where its second differences at both ends are below the
  /// first and no farther apart than the second, voxels, and the cosine between the gradients is
  /// above the third. It is smooth at a node where the first holds along all axes, and the square
  /// of its slope lies between the last two: then vertices near the node may leave their edges.
  static constexpr double kMostBend = 0.3;
  static constexpr double kMostChange = 0.15;
  static constexpr double kLeastCosine = 0.8;
  static constexpr double kLeastSlope = 0.5;
  static constexpr double kMostSlope = 1.5;
  static constexpr double kMostStep = 0.15;  ///< of a vertex off its edge, voxels

  const float* dense;  ///< of the leaf's origin; the nodes beside both ends are read
  int plane;           ///< floats from a node to the next along x
  int row;             ///< and along y
  int node[3];         ///< the leaf's origin
  double voxel;
  /// How far a vertex keeps from the ends of its edge, as a fraction of it, and one that may leave
  /// the edge.
  double margin;
  double moved_margin;
  std::uint64_t key;  ///< of the edge along x from the origin
};

/// What becomes of them, space for a multiple of kLanes.
struct CutVertices {
  double* position;    ///< 3 each
  double* normal;      ///< 3 each; of those that are flat, anything
  std::uint64_t* key;  ///< as lattice_edge_key(); all bits where not shared
};

struct Quadrilateral {
  unsigned vertex[4];
};

/// The smallest boxes around the points of eight clusters; an empty one is inverted and infinite.
struct ClusterBoxes {
  static constexpr int kClusters = 8;
  float low[3][kClusters];
  float high[3][kClusters];
};

/// What points of layers are made by.
struct LayerRule {
  float voxel;
  float band;         ///< values as far from the surface are cut short
  float layer;        ///< voxels from the surface to a layer
  float averaged;     ///< how far averaging moved the layer, by Laplacian
  bool is_wanted[2];  ///< outside, then inside; a layer that is not has no points
};

/// The points of both layers at the nodes of a leaf, from its origin, in eight clusters of 4^3
/// nodes.
struct LayerPoints {
  static constexpr int kFields = 7;                          ///< place, normal, mean curvature
  static constexpr int kMost = 64;                           ///< the nodes of a cluster
  float values[2][ClusterBoxes::kClusters][kFields][kMost];  ///< outside, then inside
  int count[2][ClusterBoxes::kClusters];
  ClusterBoxes feet[2];     ///< around the points themselves
  ClusterBoxes surface[2];  ///< around the points of the surface below them
};

/// Clusters of a leaf, and a cube around a tile's centre that asks how far they are.
struct ClusterJob {
  const ClusterBoxes* feet;
  const ClusterBoxes* surface;
  float offset[3];  ///< of the boxes' origin from the tile's centre
  float half;       ///< of the cube's side
  float outer;      ///< points of the surface matter that are no farther along any axis,
  float inner;      ///< and not nearer along all; -infinite: all matter
};

/// Of each cluster: squares of how near its points and the cube may be, and of how far apart; both
/// infinite where none of its points matters, the second also where only some do.
struct ClusterSquares {
  float nearest[ClusterBoxes::kClusters];
  float farthest[ClusterBoxes::kClusters];
  unsigned cut;  ///< bits of those of which only some may matter
};

/// Points on a layer beside the surface, at most LayerPoints::kMost.
struct LayerCluster {
  const float* values;  ///< LayerPoints::kFields arrays, `stride` from one to the next
  int stride;
  int count;            ///< a multiple of kRowNodes
  std::uint64_t label;  ///< one bit
  float offset[3];      ///< added to places
};

/// Clusters of points on a layer, no two as near as the nodes are exact, and a block of 4^3 nodes
/// that asks how far it is from it.
struct LayerJob {
  static constexpr int kSide = 4;
  static constexpr int kNodes = kSide * kSide * kSide;

  const LayerCluster* cluster;
  const float* low[3];   ///< the boxes around places of `clusters`, a multiple of kRowNodes; those
  const float* high[3];  ///< that fill the last vector are far from all
  const float* unsure;   ///< infinite for those and where some points are nowhere, or else 0
  int clusters;
  float first[3];         ///< the block's first node
  float step;             ///< from one node to the next
  float layer;            ///< the distance of the layer from the surface, >= 0
  float patch;            ///< how far from its foot a bent patch reaches, along the layer
  float* kept[3];         ///< memory for all points and kRowNodes more
  int* which;             ///< and for as many indices
  int* chosen;            ///< and as many more
  float* nearness;        ///< memory for `clusters`
  std::uint64_t* labels;  ///< gets those of all clusters from which some node was told
  bool by_surface;        ///< bounds are ways to the surface, and not over feet
  float enough;  ///< where all nodes are certainly nearer to the surface, both are told as 0
};

/// A function that is linear on the lattice: at a leaf's origin, and what a voxel along x, y, z
/// adds.
struct LatticeFunction {
  float first;
  float along[3];
};

/// A triangle seen from a leaf, in voxels and in its own plane.
struct LeafTriangle {
  LatticeFunction height;     ///< above the plane
  LatticeFunction beyond[3];  ///< beyond the lines along its sides, within the plane
  LatticeFunction along[3];   ///< along each side
  float from[3];              ///< where that begins
  float to[3];                ///< and ends
  int first[2];               ///< the rows that it may reach, by their places along x and y
  int last[2];
};

/// Balls, and a cube of nodes that asks which of them may hold what is nearest to it.
struct BallsJob {
  const float* at[3];  ///< the balls' middles
  const float* radius;
  int count;  ///< a multiple of kRowNodes; balls beyond all reach fill the last vector
  float middle[3];
  float half;   ///< of the cube's side
  float reach;  ///< nothing farther counts
};

/// Where a node lies along an axis of a block: `t`, 0 to 1, from the second to the third of the
/// four nodes of the block that begin with `first`.
struct CurvePlace {
  int first;
  float t;
};

/// A block seen as [outer][nodes][inner], and places along its middle index. Second differences
/// above `crease` are those of a crease where the one beside them is much smaller.
struct CurveJob {
  const float* from;
  int outer;
  int nodes;
  int inner;
  const CurvePlace* places;
  int count;
  float crease;
};

/// A ray among boxes and triangles, in floats and any unit of length.
struct RayJob {
  float origin[3];
  float inverse[3];  ///< 1 over the direction along each axis, none infinite or NaN
  int axis[3];       ///< the last is that along which the ray runs most; the first two turn to the
                     ///< left for whoever looks against the ray
  float shear[2];    ///< how far the ray goes along these for each step along the last
  double per_step;   ///< how far it goes for each step along the last, with its sign
};

/// Eight boxes; those that are not there may hold anything but NaN.
struct EightBoxes {
  static constexpr int kCount = 8;
  alignas(32) float low[3][kCount];
  alignas(32) float high[3][kCount];
};

struct BoxEntry {
  float along;  ///< where the ray enters, 0 where it begins inside
  int box;
};

/// The triangles of a block, counter-clockwise from outside.
struct TrianglesJob {
  static constexpr int kVertexFloats = 6;

  const float* vertices;  ///< kVertexFloats each, a place first
  int vertex_count;
  const unsigned* triangles;  ///< 3 each
  int triangle_count;
  float* x;              ///< memory for a number for each vertex,
  float* y;              ///< another,
  unsigned char* sides;  ///< and a byte
};

/// Where a ray meets a triangle.
struct TriangleHit {
  double along;
  double weight[3];  ///< of its corners, none negative, in all 1
  int triangle;
};

/// What a distance may look like.
struct GradientBounds {
  float within_voxels;  ///< of the surface; farther nodes are not judged
  float least;          ///< of the larger of upwind and central |grad phi|
  float most;           ///< of the upwind one
};

/// On which side of the surface, and what counts; see edit/short_nodes.cpp.
struct UpwindJob {
  float side;  ///< 1 outside, -1 inside
  float voxel;
  float band;
  float least_slope;  ///< of upwind differences
  float least_rise;   ///< along an axis, in voxels
};

/// Bits along z, by row.
struct UpwindRows {
  unsigned char told[kLeafRows];   ///< within the band on that side, and none beside it across
  unsigned char slow[kLeafRows];   ///< of these, which rise too slowly
  unsigned char by[6][kLeafRows];  ///< which are told by the node before them along x, behind, ...
};

/// What the clay says and what feet say, in one length, one after the other by its size; see
/// operation/moved_level.h.
struct JoinJob {
  const float* near;     ///< what the clay says at a leaf's nodes
  const float* told[2];  ///< what feet say outside and inside, null where
                         ///< none are asked; of nodes up to `low` any number
  float low, high;       ///< up to `low` the clay is right, from `high` on feet are
  float known, stretch;  ///< up to `known` feet differ from the clay by `stretch` at most
  float limit;           ///< what feet say that are not there
  float offset, band;    ///< of what comes out
};

/// The loops of one instruction set. `out` is a leaf's nodes, and part of no argument.
struct RowLoops {
  /// The leaf's nodes with those next to a sign change measured, as sweep_distances() says, where
  /// they are not `kept`; all such are kept afterwards.
  void (*seed)(const HaloBlock& from, const NodeFlags& anew, float voxel, NodeFlags& kept,
               float* out) noexcept;
  /// The leaf's nodes with those that are not `kept` solved from the others, in these `rows` only
  /// (bit 8 x + y); `kept` and `plain` are bits along z, by row. Nodes that are plain are solved by
  /// first differences, and so are all that move farther than `settled` afterwards; none without
  /// `plain`. Returns the rows in which some node moved farther.
  std::uint64_t (*sweep)(const HaloBlock& from, const unsigned char* kept, float voxel, float band,
                         float settled, std::uint64_t rows, unsigned char* plain,
                         float* out) noexcept;
  /// Distances from the surface, without sign, deeper into unknown nodes: the nodes of these `rows`
  /// that are not `kept` solved as by `sweep`, each row from the latest of the others; in another
  /// order for each of four passes. Nothing exceeds `limit`, which is also what is unknown. Returns
  /// the rows in which some node moved farther than `settled`.
  std::uint64_t (*deepen)(HaloBlock& block, const unsigned char* kept, float voxel, float limit,
                          float settled, std::uint64_t rows, int pass) noexcept;
  /// Lowers squares of the distances of a leaf's nodes to those from the triangles.
  void (*lower_to_triangles)(const LeafTriangle* triangles, int count, float* squares) noexcept;
  /// The same for the cube of 2^3 nodes of which `first` is the lowest, and these triangles.
  void (*lower_cube)(const LeafTriangle* triangles, const int* chosen, int count, const int* first,
                     float* squares) noexcept;
  /// The balls of which a point may be nearer to some node of the cube than all of any other ball,
  /// in their order; returns how many.
  int (*choose_balls)(const BallsJob& job, int* chosen) noexcept;
  /// Distances of a leaf's nodes from squares of them in voxels: at most the band, negative where
  /// the bit of a node, along z by row, is set; 0 below `least` voxels.
  void (*sign_distances)(const float* squares, const unsigned char* inside, float voxel, float band,
                         float least, float* out) noexcept;
  /// Bits along z, by row, of the nodes that are out of bounds. None of which a neighbour is NaN or
  /// on the other side.
  void (*find_out_of_bounds)(const HaloBlock& from, const GradientBounds& bounds, float voxel,
                             unsigned char* rows) noexcept;
  /// The distances of a leaf's nodes.
  void (*ball_distances)(const BallJob& job, float* out) noexcept;
  /// Values of a coarse leaf's nodes, where they are decided; bits along z, by row, of the nodes
  /// that are, and of those that are averages. See edit/restriction.h.
  void (*restrict_leaf)(const RestrictJob& job, float* value, unsigned char* decided,
                        unsigned char* averaged) noexcept;
  /// Vertices where the field passes zero on edges, each as if it were alone, and unit normals by
  /// central differences. Where the field is smooth along the edge: of the cubic through four
  /// nodes; one that may leave the edge is moved along the normal by what the margin has left of
  /// the value. Codes are read up to a multiple of kLanes. Returns how many are flat,
  /// having no gradient or an unknown one, and sets which; space for one more than `count`.
  int (*place_cuts)(const CutJob& job, const unsigned* codes, int count, const CutVertices& out,
                    unsigned short* flat) noexcept;
  /// Which quadrilaterals are to be cut from corner 0 to 2, the worse of whose triangles is
  /// then at least as good as that of the other cut: see fill_plainly(). `position`: 3 each, by
  /// vertex.
  void (*choose_diagonals)(const double* position, const Quadrilateral* quads, int count,
                           unsigned char* is_even) noexcept;
  /// Sets feet and `has_band`. Values that are NaN are unknown.
  void (*find_feet)(const HaloBlock& from, float voxel, float band, FeetBlock& feet) noexcept;
  /// Sets pulls in rows that have a band, and which rows are asked.
  void (*pull)(const PullJob& job, FeetBlock& feet) noexcept;
  /// Of each foot in rows that are asked, how far the surface faces as the plane does, -1 to 1,
  /// becomes how far the distance grows where it is drawn there.
  void (*draw_to_plane)(const PlaneJob& job, const FeetBlock& feet, float* moves) noexcept;
  /// Adds moves to the values in rows that are asked, each at most as far as `most`; values stay
  /// within the band, and those outside it stay. Returns the farthest that was asked for.
  float (*displace)(const float* moves, const bool* is_asked, float band, float most,
                    float* values) noexcept;
  /// The field, trilinear, at the points that are asked for; points beyond it read its rim.
  void (*read)(const FieldJob& job, const PointBlock& points, float* out) noexcept;
  /// The same by Catmull-Rom. Points, counted from the field's first node and rounded, have at
  /// least one node before them and two behind.
  void (*read_cubic)(const FieldJob& job, const PointBlock& points, float* out) noexcept;
  /// Moves each point against the push at its node, and asks for the rows in which some node is
  /// pushed.
  void (*add_pinch)(const PinchJob& job, PointBlock& points) noexcept;
  /// Moves each point against the push where it is, and asks for the rows in which some point is
  /// pushed.
  void (*add_drag)(const DragJob& job, PointBlock& points) noexcept;
  /// Values become those of the surface that the profile makes of the one that `start` is the
  /// distance to, where that moves them to its side. `free` is the part of the profile that each
  /// node gets, 0 to 1. Starts that are NaN are unknown, but none of the leaf's own.
  void (*lay_profile)(const ProfileJob& job, const HaloBlock& start, const float* free,
                      float* values) noexcept;
  /// Interpolates at the places as resample() says: `out` is [outer][count][inner].
  void (*curve_along)(const CurveJob& job, float* out) noexcept;
  /// The points of both layers that cross the cubes of a leaf's nodes; `values` as LeafAndFaces.
  void (*project_to_layers)(const float* values, const LayerRule& rule, LayerPoints& out) noexcept;
  void (*measure_clusters)(const ClusterJob& job, ClusterSquares& out) noexcept;
  /// For each node of the block: where the way over the layer's nearest foot is shorter than
  /// `bound`, that becomes the bound, and `distance` what the patch around the foot says; of feet
  /// as near as each other the first counts. Or with `by_surface` where the way to the surface
  /// below that foot is, which can be compared from one layer to another.
  void (*lower_to_layer)(const LayerJob& job, float* bound, float* distance) noexcept;
  /// Which of `count` boxes the ray meets before `far`, in their order; returns how many, and wants
  /// space for one more than that.
  int (*enter_boxes)(const RayJob& ray, const EightBoxes* boxes, int count, float far,
                     BoxEntry* out) noexcept;
  /// The first triangle that the ray meets from its front, if it is nearer than the hit that is
  /// given; of those as near as each other that with the lowest number. No ray passes between two
  /// triangles whose common corners have the same bits, not even those of two blocks.
  void (*meet_triangles)(const RayJob& ray, const TrianglesJob& job, TriangleHit& hit) noexcept;
  /// By which of their neighbours nodes on one side are told, and which too slowly. What is missing
  /// is NaN and tells none.
  void (*find_upwind)(const HaloBlock& from, const UpwindJob& job, UpwindRows& out) noexcept;
  /// The distances of a leaf's nodes, joined, less the offset, within the band.
  void (*join_told)(const JoinJob& job, float* out) noexcept;
};

/// Those of the fastest set that may be used here (best_simd()).
const RowLoops& row_loops() noexcept;

namespace baseline {
extern const RowLoops kRowLoops;
}
namespace avx2 {
extern const RowLoops kRowLoops;  ///< only where the machine has AVX2
}

}  // namespace argil

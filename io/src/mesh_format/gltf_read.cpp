// SPDX-License-Identifier: GPL-3.0-or-later
// glTF 2.0, binary and text: metres and y up become mm and z up; vertices that were split for
// normals or textures are welded. Skins and morph targets are taken as the file stands at rest.
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "argil/mesh/point_welder.h"

#include "format/text_scan.h"
#include "mesh_format/face_collector.h"
#include "mesh_format/gltf_document.h"
#include "mesh_format/gltf_scene.h"
#include "mesh_format/mesh_read.h"

namespace argil::io {
namespace {

constexpr std::size_t kMostPrimitives = 1'000'000;  // of all nodes
constexpr double kMetre = 1000.0;
// Modes have OpenGL's numbers: below these are points and lines, which have no surface.
constexpr std::size_t kTriangles = 4;
constexpr std::size_t kStrip = 5;
constexpr std::size_t kFan = 6;

/// How the vertices of a primitive get to where they are at rest.
struct RestPose {
  std::size_t node = 0;
  GltfMatrix placement{};              ///< of the node; without meaning where there are joints
  std::span<const GltfMatrix> joints;  ///< empty: the vertices follow the node
  const Json::array_t* weights;        ///< of the morph targets

  /// A mirrored mesh would face inward.
  bool mirrors() const noexcept {
    return determinant(joints.empty() ? placement : joints.front()) < 0.0;
  }
};

/// Four joints of each vertex and how much it follows each.
struct JointSet {
  GltfValues joints;
  GltfValues weights;
};

/// One morph target with its weight.
struct Morph {
  GltfValues moves;
  double weight = 0.0;
};

class GltfParse {
 public:
  GltfParse(const std::string& name, const ReadBeside& beside)
      : document_(name, beside), name_(name), welder_(mesh_.positions) {}

  Result<TriangleMesh> glb(std::span<const std::byte> bytes, double unit_mm) {
    return guarded([&] { return document_.open_glb(bytes); }, unit_mm);
  }
  Result<TriangleMesh> text(std::string_view text, double unit_mm) {
    return guarded([&] { return document_.open_text(text); }, unit_mm);
  }

 private:
  template <class Open>
  Result<TriangleMesh> guarded(const Open& open, double unit_mm);
  Result<void> add_scene(double unit_mm);
  Result<void> add_mesh(const PlacedNode& placed);
  Result<std::span<const GltfMatrix>> joints_of(const Json& node);
  Result<void> add_primitive(const Json& primitive, const RestPose& pose);
  Result<void> add_triangles(const Json& primitive, std::size_t mode, bool turns);
  Result<void> count_primitive();
  Result<void> count_vertices(std::size_t vertices);
  Result<void> number_vertices(const Json& primitive, const GltfValues& points,
                               const RestPose& pose);
  Result<std::vector<JointSet>> joint_sets(const Json& attributes, const GltfValues& points,
                                           std::size_t joints);
  Result<std::vector<Morph>> morphs(const Json& primitive, const GltfValues& points,
                                    const RestPose& pose);
  Error bad(const std::string& what) const { return document_.bad(what); }

  GltfDocument document_;
  const std::string& name_;
  TriangleMesh mesh_;
  mesh::PointWelder welder_;
  std::unordered_map<std::size_t, GltfMatrix> placement_of_;  ///< nodes
  std::map<std::size_t, std::vector<GltfMatrix>> skins_;
  std::size_t primitives_seen_ = 0;
  std::size_t vertices_seen_ = 0;  ///< of all nodes, before they are welded
  /// The node, and the lists of points, joints and weights, that `number_` is of: many primitives
  /// often share them.
  std::array<std::size_t, 4> numbered_ = kNone;
  std::vector<std::uint32_t> number_;  ///< of those vertices in the mesh

  static constexpr std::size_t kNo = std::numeric_limits<std::size_t>::max();
  static constexpr std::array<std::size_t, 4> kNone{kNo, kNo, kNo, kNo};
};

/// A small file may name one primitive in many nodes, and one list of vertices in many primitives.
Result<void> GltfParse::count_primitive() {
  if (++primitives_seen_ <= kMostPrimitives) return {};
  return bad("its nodes place more than " + std::to_string(kMostPrimitives) +
             " primitives; join them");
}

/// Whatever has to be looked at for them, morph targets and joints too.
Result<void> GltfParse::count_vertices(std::size_t vertices) {
  if (vertices > kMostPlaced - vertices_seen_) {
    return bad("its placed meshes have more than " + std::to_string(kMostPlaced) +
               " vertices; split it");
  }
  vertices_seen_ += vertices;
  return {};
}

Result<std::vector<JointSet>> GltfParse::joint_sets(const Json& attributes,
                                                    const GltfValues& points, std::size_t joints) {
  std::vector<JointSet> sets;
  for (std::size_t n = 0; joints > 0; ++n) {
    const auto which = attributes.find("JOINTS_" + std::to_string(n));
    if (which == attributes.end()) break;
    auto indices = document_.values(whole_number(*which), "VEC4", 4);
    if (!indices) return indices.error();
    auto weights =
        document_.values(whole_number(attributes.at("WEIGHTS_" + std::to_string(n))), "VEC4", 4);
    if (!weights) return weights.error();
    if (auto counted = count_vertices(points.count()); !counted) return counted.error();
    const int type = indices.value().type();
    if ((type != GltfValues::kUnsignedByte && type != GltfValues::kUnsignedShort) ||
        indices.value().count() != points.count() || weights.value().count() != points.count()) {
      return bad("a mesh of " + std::to_string(points.count()) +
                 " vertices has other joints or weights than one set each; export it again");
    }
    for (std::size_t v = 0; v < points.count(); ++v) {
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t joint = indices.value().index(v, k);
        if (joint < joints) continue;
        return bad("vertex " + std::to_string(v) + " of a mesh follows joint " +
                   std::to_string(joint) + " of only " + std::to_string(joints) +
                   "; export it again");
      }
    }
    sets.push_back({std::move(indices).value(), std::move(weights).value()});
  }
  return sets;
}

Result<std::vector<Morph>> GltfParse::morphs(const Json& primitive, const GltfValues& points,
                                             const RestPose& pose) {
  std::vector<Morph> found;
  const Json::array_t& targets = list_in(primitive, "targets");
  const std::size_t count = std::min(targets.size(), pose.weights->size());
  if (auto counted = count_vertices(count); !counted) return counted.error();
  for (std::size_t n = 0; n < count; ++n) {
    const auto which = targets[n].find("POSITION");
    const double weight = (*pose.weights)[n].get<double>();
    if (weight == 0.0 || which == targets[n].end()) continue;
    if (auto counted = count_vertices(points.count()); !counted) return counted.error();
    auto moves = document_.values(whole_number(*which), "VEC3", 3);
    if (!moves) return moves.error();
    if (moves.value().count() != points.count()) {
      return bad("morph target " + std::to_string(n) + " moves " +
                 std::to_string(moves.value().count()) + " of " + std::to_string(points.count()) +
                 " vertices; export it again");
    }
    found.push_back({std::move(moves).value(), weight});
  }
  return found;
}

/// Where joints take a point together; weights need not add up to 1.
Vec3 followed(std::span<const GltfMatrix> joints, const std::vector<JointSet>& sets,
              std::size_t vertex, const Vec3& point) {
  Vec3 sum;
  double weights = 0.0;
  for (const JointSet& set : sets) {
    for (std::size_t k = 0; k < 4; ++k) {
      const double weight = set.weights.number(vertex, k);
      if (weight == 0.0) continue;
      sum += weight * moved(joints[set.joints.index(vertex, k)], point);
      weights += weight;
    }
  }
  return weights == 0.0 ? moved(joints.front(), point) : sum / weights;
}

Result<void> GltfParse::number_vertices(const Json& primitive, const GltfValues& points,
                                        const RestPose& pose) {
  const auto sets = joint_sets(primitive.at("attributes"), points, pose.joints.size());
  if (!sets) return sets.error();
  const auto targets = morphs(primitive, points, pose);
  if (!targets) return targets.error();
  number_.clear();
  number_.reserve(points.count());
  for (std::size_t n = 0; n < points.count(); ++n) {
    Vec3 point = points.vec3(n);
    for (const Morph& morph : targets.value()) point += morph.weight * morph.moves.vec3(n);
    const Vec3 at = sets.value().empty() ? moved(pose.placement, point)
                                         : followed(pose.joints, sets.value(), n, point);
    if (const std::string problem = position_problem(at); !problem.empty()) {
      return bad("vertex " + std::to_string(n) + " of a mesh, as its node places it: " + problem);
    }
    number_.push_back(welder_.add(at));
  }
  return {};
}

/// Corners of triangle `t` as places in the list of indices.
std::array<std::size_t, 3> corners_of(std::size_t mode, std::size_t t) noexcept {
  if (mode == kFan) return {t + 1, t + 2, 0};
  if (mode == kStrip) return {t, t + 1 + t % 2, t + 2 - t % 2};
  return {3 * t, 3 * t + 1, 3 * t + 2};
}

Result<void> GltfParse::add_triangles(const Json& primitive, std::size_t mode, bool turns) {
  std::optional<GltfValues> indices;
  if (primitive.contains("indices")) {
    auto read = document_.values(whole_number(primitive.at("indices")), "SCALAR", 1);
    if (!read) return read.error();
    if (!read.value().has_bytes() || read.value().type() == GltfValues::kFloat) {
      return bad("the corners of a mesh are not whole numbers of their own; export it again");
    }
    indices = std::move(read).value();
  }
  const std::size_t corners = indices ? indices->count() : number_.size();
  const std::size_t in_a_row = corners < 3 ? 0 : corners - 2;
  const std::size_t count = mode == kTriangles ? corners / 3 : in_a_row;
  if (count > kMostPlaced - mesh_.triangles.size()) {
    return bad("its placed meshes have more than " + std::to_string(kMostPlaced) +
               " triangles; split it");
  }
  for (std::size_t t = 0; t < count; ++t) {
    Triangle triangle{};
    const auto places = corners_of(mode, t);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t v = indices ? indices->index(places[k]) : places[k];
      if (v >= number_.size()) {
        return bad("triangle " + std::to_string(t) + " names vertex " + std::to_string(v) + " of " +
                   std::to_string(number_.size()));
      }
      triangle[k] = number_[v];
    }
    // Strips turn corners and hop by triangles of no area.
    const auto [a, b, c] = triangle;
    if (mode != kTriangles && (a == b || b == c || c == a)) continue;
    if (turns) std::swap(triangle[1], triangle[2]);
    mesh_.triangles.push_back(triangle);
  }
  return {};
}

Result<void> GltfParse::add_primitive(const Json& primitive, const RestPose& pose) {
  if (auto counted = count_primitive(); !counted) return counted;
  const std::size_t mode = whole_number(primitive, "mode", kTriangles);
  if (mode < kTriangles) return {};
  if (mode > kFan) return bad("a mesh of mode " + std::to_string(mode) + "; must be 0 to 6");
  const Json& attributes = primitive.at("attributes");
  const std::array<std::size_t, 4> lists{pose.node, whole_number(attributes.at("POSITION")),
                                         whole_number(attributes, "JOINTS_0", kNo),
                                         whole_number(attributes, "WEIGHTS_0", kNo)};
  if (lists != numbered_) {
    const auto points = document_.values(lists[1], "VEC3", 3);
    if (!points) return points.error();
    if (!points.value().has_bytes() || points.value().type() == GltfValues::kUnsignedInt) {
      return bad("positions are not floats or short integers of their own; export it again");
    }
    if (auto counted = count_vertices(points.value().count()); !counted) return counted;
    if (auto done = number_vertices(primitive, points.value(), pose); !done) return done;
    // Further joints and targets differ between primitives of the same points.
    const bool is_shared = !attributes.contains("JOINTS_1") && !primitive.contains("targets");
    numbered_ = is_shared ? lists : kNone;
  }
  return add_triangles(primitive, mode, pose.mirrors());
}

/// Empty where the node has no skin.
Result<std::span<const GltfMatrix>> GltfParse::joints_of(const Json& node) {
  if (!node.contains("skin")) return std::span<const GltfMatrix>();
  const std::size_t skin = whole_number(node.at("skin"));
  const auto known = skins_.find(skin);
  if (known != skins_.end()) return std::span<const GltfMatrix>(known->second);
  auto joints = joint_matrices(document_, skin, placement_of_);
  if (!joints) return joints.error();
  return std::span<const GltfMatrix>(skins_[skin] = std::move(joints).value());
}

Result<void> GltfParse::add_mesh(const PlacedNode& placed) {
  const Json& node = document_.json().at("nodes").at(placed.node);
  if (!node.contains("mesh")) return {};
  const Json& mesh = document_.json().at("meshes").at(whole_number(node.at("mesh")));
  const auto joints = joints_of(node);
  if (!joints) return joints.error();
  const RestPose pose{placed.node, placed.placement, joints.value(),
                      &list_in(node.contains("weights") ? node : mesh, "weights")};
  for (const Json& primitive : list_in(mesh, "primitives")) {
    if (auto added = add_primitive(primitive, pose); !added) return added;
  }
  return {};
}

Result<void> GltfParse::add_scene(double unit_mm) {
  const auto nodes = placed_nodes(document_, to_mm_with_z_up(unit_mm));
  if (!nodes) return nodes.error();
  for (const PlacedNode& placed : nodes.value()) placement_of_[placed.node] = placed.placement;
  for (const PlacedNode& placed : nodes.value()) {
    if (auto added = add_mesh(placed); !added) return added;
  }
  return {};
}

template <class Open>
Result<TriangleMesh> GltfParse::guarded(const Open& open, double unit_mm) {
  try {
    if (Result<void> opened = open(); !opened) return opened.error();
    if (Result<void> added = add_scene(unit_mm); !added) return added.error();
  } catch (const Json::exception& fault) {
    // Behind "[json.exception...] ".
    const std::string_view what = fault.what();
    const std::size_t begin = what.find("] ");
    return bad("not glTF as it should be (" +
               std::string(what.substr(begin == what.npos ? 0 : begin + 2)) + "); export again");
  }
  if (mesh_.triangles.empty()) return no_triangles(name_);
  return std::move(mesh_);
}

}  // namespace

Result<TriangleMesh> parse_glb(std::span<const std::byte> bytes, const std::string& name) {
  return parse_glb_in(bytes, name, {}, kMetre);
}

Result<TriangleMesh> parse_glb_in(std::span<const std::byte> bytes, const std::string& name,
                                  const ReadBeside& beside, double unit_mm) {
  return GltfParse(name, beside).glb(bytes, unit_mm);
}

Result<TriangleMesh> parse_gltf_in(std::span<const std::byte> bytes, const std::string& name,
                                   const ReadBeside& beside, double unit_mm) {
  return GltfParse(name, beside).text(as_text(bytes), unit_mm);
}

}  // namespace argil::io

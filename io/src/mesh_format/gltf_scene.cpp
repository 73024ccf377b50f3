// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_format/gltf_scene.h"

#include <array>
#include <string>
#include <utility>

namespace argil::io {
namespace {

constexpr int kDeepestNode = 64;

GltfMatrix matrix_of(const Json& node) {
  if (node.contains("matrix")) return node.at("matrix").get<GltfMatrix>();
  const auto t = node.value("translation", std::array<double, 3>{});
  const auto q = node.value("rotation", std::array<double, 4>{0, 0, 0, 1});
  const auto s = node.value("scale", std::array<double, 3>{1, 1, 1});
  // The matrix of T * R * S, column by column; the scalar of the quaternion comes last.
  const auto [x, y, z, w] = q;
  return {s[0] * (1 - 2 * (y * y + z * z)),
          s[0] * 2 * (x * y + z * w),
          s[0] * 2 * (x * z - y * w),
          0,
          s[1] * 2 * (x * y - z * w),
          s[1] * (1 - 2 * (x * x + z * z)),
          s[1] * 2 * (y * z + x * w),
          0,
          s[2] * 2 * (x * z + y * w),
          s[2] * 2 * (y * z - x * w),
          s[2] * (1 - 2 * (x * x + y * y)),
          0,
          t[0],
          t[1],
          t[2],
          1};
}

class SceneWalk {
 public:
  explicit SceneWalk(const GltfDocument& document)
      : document_(document), nodes_(list_in(document.json(), "nodes")) {}

  Result<std::vector<PlacedNode>> run(const GltfMatrix& whole) {
    for (const std::size_t root : roots()) {
      if (auto added = add(root, whole, 0); !added) return added.error();
    }
    return std::move(placed_);
  }

 private:
  std::vector<std::size_t> roots() const;
  Result<void> add(std::size_t index, const GltfMatrix& above, int depth);

  const GltfDocument& document_;
  const Json::array_t& nodes_;
  std::vector<PlacedNode> placed_;
};

std::vector<std::size_t> SceneWalk::roots() const {
  const Json& json = document_.json();
  std::vector<std::size_t> found;
  if (!list_in(json, "scenes").empty()) {
    const Json& scene = json.at("scenes").at(whole_number(json, "scene", 0));
    for (const Json& node : list_in(scene, "nodes")) found.push_back(whole_number(node));
    return found;
  }
  std::vector<bool> has_parent(nodes_.size(), false);
  for (const Json& node : nodes_) {
    for (const Json& child : list_in(node, "children")) {
      if (whole_number(child) < nodes_.size()) has_parent[whole_number(child)] = true;
    }
  }
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    if (!has_parent[n]) found.push_back(n);
  }
  return found;
}

Result<void> SceneWalk::add(std::size_t index, const GltfMatrix& above, int depth) {
  if (depth > kDeepestNode) {
    return document_.bad("nodes are nested more than 64 deep, or in a circle");
  }
  const Json& node = document_.json().at("nodes").at(index);
  // Nodes form trees: one met again would be placed twice, and a circle would never end.
  if (placed_.size() >= nodes_.size()) return document_.bad("a node stands under two others");
  const GltfMatrix placement = product(above, matrix_of(node));
  placed_.push_back({index, placement});
  for (const Json& child : list_in(node, "children")) {
    if (auto added = add(whole_number(child), placement, depth + 1); !added) return added;
  }
  return {};
}

}  // namespace

Result<std::vector<PlacedNode>> placed_nodes(const GltfDocument& document,
                                             const GltfMatrix& whole) {
  return SceneWalk(document).run(whole);
}

Result<std::vector<GltfMatrix>> joint_matrices(
    GltfDocument& document, std::size_t skin_index,
    const std::unordered_map<std::size_t, GltfMatrix>& placement_of) {
  const Json& skin = document.json().at("skins").at(skin_index);
  const Json::array_t& joints = list_in(skin, "joints");
  const std::string where = "skin " + std::to_string(skin_index);
  std::vector<GltfMatrix> matrices;
  for (const Json& joint : joints) {
    const auto placed = placement_of.find(whole_number(joint));
    if (placed == placement_of.end()) {
      return document.bad(where + " has the joint " + std::to_string(whole_number(joint)) +
                          ", which is not in the scene; export it again");
    }
    matrices.push_back(placed->second);
  }
  if (!skin.contains("inverseBindMatrices")) return matrices;
  const auto inverse = document.values(whole_number(skin.at("inverseBindMatrices")), "MAT4", 16);
  if (!inverse) return inverse.error();
  if (inverse.value().count() < matrices.size()) {
    return document.bad(where + " has " + std::to_string(inverse.value().count()) +
                        " inverse bind matrices for " + std::to_string(matrices.size()) +
                        " joints; export it again");
  }
  for (std::size_t j = 0; j < matrices.size(); ++j) {
    GltfMatrix bind{};
    for (std::size_t k = 0; k < 16; ++k) bind[k] = inverse.value().number(j, k);
    matrices[j] = product(matrices[j], bind);
  }
  return matrices;
}

}  // namespace argil::io

// SPDX-License-Identifier: GPL-3.0-or-later
// Binary glTF 2.0: metres and y up become mm and z up; vertices that were split for normals or
// textures are welded.
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include "argil/mesh/point_welder.h"

#include "file/load_bytes.h"
#include "format/face_collector.h"
#include "format/json_read.h"
#include "format/mesh_read.h"
#include "format/text_scan.h"

namespace argil::io {
namespace {

/// Column-major, as in the file.
using Matrix = std::array<double, 16>;

// Layout and letters: Khronos, glTF 2.0 specification, chapter 4.
constexpr std::uint32_t kMagic = 0x46546c67;  // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;
constexpr std::uint32_t kBinaryChunk = 0x004e4942;
constexpr int kDeepestNode = 64;
constexpr std::size_t kMostPrimitives = 1'000'000;  // of all nodes
// Modes and component types have OpenGL's numbers: 5121, 5123 and 5125 are unsigned integers of
// one, two and four bytes.
constexpr int kTriangles = 4;
constexpr int kFloat = 5126;

/// From glTF to mm with z up.
constexpr Matrix kToMm{1000, 0, 0, 0, 0, 0, 1000, 0, 0, -1000, 0, 0, 0, 0, 0, 1};

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 4; ++row) {
      for (std::size_t k = 0; k < 4; ++k) c[4 * column + row] += a[4 * k + row] * b[4 * column + k];
    }
  }
  return c;
}

Vec3 moved(const Matrix& m, const Vec3& p) {
  const auto row = [&](std::size_t r) {
    return m[r] * p.x + m[4 + r] * p.y + m[8 + r] * p.z + m[12 + r];
  };
  return {row(0), row(1), row(2)};
}

double determinant(const Matrix& m) {
  return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[4] * (m[1] * m[10] - m[2] * m[9]) +
         m[8] * (m[1] * m[6] - m[2] * m[5]);
}

/// What one accessor names: `count` values `stride` bytes apart.
struct AccessorValues {
  const std::byte* first = nullptr;
  std::size_t count = 0;
  std::size_t stride = 0;
  int type = 0;
};

std::size_t bytes_of_type(int type) {
  if (type == 5121) return 1;
  if (type == 5123) return 2;
  return type == 5125 || type == kFloat ? 4 : 0;
}

/// The list of this name, which an object may have. Throws as Json::at where it is no list.
const Json::array_t& list_in(const Json& object, const char* name) {
  static const Json::array_t kNoItems;
  const auto found = object.find(name);
  return found == object.end() ? kNoItems : found->get_ref<const Json::array_t&>();
}

class GlbParse {
 public:
  GlbParse(std::span<const std::byte> bytes, const std::string& name)
      : bytes_(bytes), name_(name), welder_(mesh_.positions) {}

  Result<TriangleMesh> run();

 private:
  Error bad(const std::string& what) const { return {ErrorKind::bad_input, name_ + ": " + what}; }
  Result<void> read_chunks();
  Result<AccessorValues> values_of(std::size_t accessor, const char* shape,
                                   std::size_t parts) const;
  Result<void> add_node(std::size_t node, const Matrix& above, int depth);
  Result<void> add_primitive(const Json& primitive, const Matrix& placement);
  Result<void> count_primitive(std::size_t vertices);
  Result<void> number_vertices(const AccessorValues& corners, const Matrix& placement);
  Matrix matrix_of(const Json& node) const;

  std::span<const std::byte> bytes_;
  const std::string& name_;
  Json json_;
  std::span<const std::byte> binary_;
  TriangleMesh mesh_;
  mesh::PointWelder welder_;
  std::size_t nodes_seen_ = 0;
  std::size_t primitives_seen_ = 0;
  std::pair<const std::byte*, Matrix> numbered_{};  ///< the list of `number_`, as it is placed
  std::vector<std::uint32_t> number_;               ///< of its vertices in the mesh
  std::size_t vertices_seen_ = 0;                   ///< of all nodes, before they are welded
};

Result<void> GlbParse::read_chunks() {
  if (bytes_.size() < 20 || load<std::uint32_t>(bytes_.data()) != kMagic) {
    return bad("byte 0: not a binary glTF file; export as GLB");
  }
  const auto version = load<std::uint32_t>(bytes_.data() + 4);
  if (version != 2) {
    return bad("byte 4: glTF version " + std::to_string(version) + "; must be 2");
  }
  const std::size_t whole = load<std::uint32_t>(bytes_.data() + 8);
  if (whole != bytes_.size()) {
    return bad("byte 8: the header says " + std::to_string(whole) + " bytes, but the file has " +
               std::to_string(bytes_.size()) + "; it is truncated");
  }
  std::size_t at = 12;
  while (at + 8 <= bytes_.size()) {
    const std::size_t size = load<std::uint32_t>(bytes_.data() + at);
    const auto kind = load<std::uint32_t>(bytes_.data() + at + 4);
    if (size > bytes_.size() - at - 8) {
      return bad("byte " + std::to_string(at) + ": a chunk of " + std::to_string(size) +
                 " bytes goes beyond the end; the file is truncated");
    }
    const auto body = bytes_.subspan(at + 8, size);
    // Chunks of other kinds are to be skipped, by the specification.
    if (kind == kJsonChunk && json_.is_null()) {
      auto read = read_json_object(as_text(body), name_ + ": byte " + std::to_string(at + 8));
      if (!read) return read.error();
      json_ = std::move(read).value();
    }
    if (kind == kBinaryChunk && binary_.empty()) binary_ = body;
    at += 8 + size;
  }
  if (json_.is_null()) return bad("byte 12: no chunk holds its JSON; export it again");
  return {};
}

Result<AccessorValues> GlbParse::values_of(std::size_t index, const char* shape,
                                           std::size_t parts) const {
  const Json& accessor = json_.at("accessors").at(index);
  const std::string where = "accessor " + std::to_string(index);
  AccessorValues values;
  values.type = accessor.at("componentType").get<int>();
  values.count = accessor.at("count").get<std::size_t>();
  const std::size_t size = parts * bytes_of_type(values.type);
  const bool fits = accessor.at("type") == shape && size > 0 && accessor.contains("bufferView") &&
                    !accessor.contains("sparse");
  if (!fits)
    return bad(where + " is not a plain list of " + shape + "; export without compression");
  const Json& view = json_.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
  if (view.value("buffer", 0) != 0) return bad(where + " is in another file; export as one GLB");
  const auto start = view.value("byteOffset", std::size_t{0});
  const auto length = view.at("byteLength").get<std::size_t>();
  const auto offset = accessor.value("byteOffset", std::size_t{0});
  values.stride = view.value("byteStride", size);
  // Each step compares with what is left, since a sum of numbers from a file may overflow.
  const bool is_inside =
      start <= binary_.size() && length <= binary_.size() - start && offset <= length &&
      values.stride >= size &&
      (values.count == 0 ||
       (size <= length - offset && values.count - 1 <= (length - offset - size) / values.stride));
  if (!is_inside) return bad(where + " goes beyond its data; the file is truncated");
  values.first = binary_.data() + start + offset;
  return values;
}

Matrix GlbParse::matrix_of(const Json& node) const {
  if (node.contains("matrix")) return node.at("matrix").get<Matrix>();
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

/// A small file may name one primitive in many nodes, and one list of vertices in many primitives.
Result<void> GlbParse::count_primitive(std::size_t vertices) {
  if (++primitives_seen_ > kMostPrimitives) {
    return bad("its nodes place more than " + std::to_string(kMostPrimitives) +
               " primitives; join them");
  }
  if (vertices > kMostPlaced - vertices_seen_) {
    return bad("its placed meshes have more than " + std::to_string(kMostPlaced) +
               " vertices; split it");
  }
  vertices_seen_ += vertices;
  return {};
}

Result<void> GlbParse::number_vertices(const AccessorValues& corners, const Matrix& placement) {
  numbered_ = {};
  number_.clear();
  number_.reserve(corners.count);
  for (std::size_t n = 0; n < corners.count; ++n) {
    const auto p = load<std::array<float, 3>>(corners.first + n * corners.stride);
    const Vec3 at = moved(placement, {double{p[0]}, double{p[1]}, double{p[2]}});
    if (const std::string problem = position_problem(at); !problem.empty()) {
      return bad("vertex " + std::to_string(n) + " of a mesh, as its node places it: " + problem);
    }
    number_.push_back(welder_.add(at));
  }
  return {};
}

Result<void> GlbParse::add_primitive(const Json& primitive, const Matrix& placement) {
  const int mode = primitive.value("mode", kTriangles);
  if (mode < kTriangles) return count_primitive(0);  // points and lines have no surface
  if (mode != kTriangles) return bad("a mesh of triangle strips or fans; export triangles");
  const auto corners = values_of(primitive.at("attributes").at("POSITION"), "VEC3", 3);
  if (!corners) return corners.error();
  if (corners.value().type != kFloat) return bad("positions are not floats; export uncompressed");
  // Of one list of vertices often many primitives are made, a material each.
  const std::pair<const std::byte*, Matrix> list{corners.value().first, placement};
  if (auto counted = count_primitive(list == numbered_ ? 0 : corners.value().count); !counted) {
    return counted;
  }
  if (list != numbered_) {
    if (auto numbered = number_vertices(corners.value(), placement); !numbered) return numbered;
    numbered_ = list;
  }
  const std::vector<std::uint32_t>& number = number_;
  std::optional<AccessorValues> indices;
  if (primitive.contains("indices")) {
    const auto read = values_of(primitive.at("indices"), "SCALAR", 1);
    if (!read) return read.error();
    indices = read.value();
  }
  const auto index = [&](std::size_t n) -> std::size_t {
    if (!indices) return n;
    const std::byte* at = indices->first + n * indices->stride;
    if (indices->type == 5121) return load<std::uint8_t>(at);
    return indices->type == 5123 ? load<std::uint16_t>(at) : load<std::uint32_t>(at);
  };
  const std::size_t count = (indices ? indices->count : number.size()) / 3;
  if (count > kMostPlaced - mesh_.triangles.size()) {
    return bad("its placed meshes have more than " + std::to_string(kMostPlaced) +
               " triangles; split it");
  }
  // A mirrored mesh would face inward.
  const bool turns = determinant(placement) < 0.0;
  for (std::size_t t = 0; t < count; ++t) {
    Triangle triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t v = index(3 * t + k);
      if (v >= number.size()) {
        return bad("triangle " + std::to_string(t) + " names vertex " + std::to_string(v) + " of " +
                   std::to_string(number.size()));
      }
      triangle[k] = number[v];
    }
    if (turns) std::swap(triangle[1], triangle[2]);
    mesh_.triangles.push_back(triangle);
  }
  return {};
}

Result<void> GlbParse::add_node(std::size_t index, const Matrix& above, int depth) {
  if (depth > kDeepestNode) return bad("nodes are nested more than 64 deep, or in a circle");
  // Nodes form trees: one met again would be placed twice, and a circle would never end.
  if (++nodes_seen_ > json_.at("nodes").size()) return bad("a node stands under two others");
  const Json& node = json_.at("nodes").at(index);
  const Matrix placement = product(above, matrix_of(node));
  if (node.contains("mesh")) {
    const Json& mesh = json_.at("meshes").at(node.at("mesh").get<std::size_t>());
    for (const Json& primitive : list_in(mesh, "primitives")) {
      if (auto added = add_primitive(primitive, placement); !added) return added;
    }
  }
  for (const Json& child : list_in(node, "children")) {
    if (auto added = add_node(child.get<std::size_t>(), placement, depth + 1); !added) return added;
  }
  return {};
}

Result<TriangleMesh> GlbParse::run() {
  if (auto read = read_chunks(); !read) return read.error();
  try {
    const Json& scene = json_.at("scenes").at(json_.value("scene", std::size_t{0}));
    for (const Json& node : list_in(scene, "nodes")) {
      if (auto added = add_node(node.get<std::size_t>(), kToMm, 0); !added) return added.error();
    }
  } catch (const Json::exception& fault) {
    return bad(std::string("not glTF as it should be (") + fault.what() + "); export again");
  }
  if (mesh_.triangles.empty()) return no_triangles(name_);
  return std::move(mesh_);
}

}  // namespace

Result<TriangleMesh> parse_glb(std::span<const std::byte> bytes, const std::string& name) {
  return GlbParse(bytes, name).run();
}

}  // namespace argil::io

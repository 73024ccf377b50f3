// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/io/mesh_frame.h"

namespace argil::io {

/// Where something stands: p -> p.x rows[0] + p.y rows[1] + p.z rows[2] + rows[3], in mm, as the
/// row vectors of 3MF have it. It may turn, scale, shear and mirror.
struct Affine {
  std::array<Vec3, 4> rows{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{}};

  Vec3 turned(const Vec3& p) const noexcept {
    return p.x * rows[0] + p.y * rows[1] + p.z * rows[2];
  }
  Vec3 applied(const Vec3& p) const noexcept { return turned(p) + rows[3]; }
  /// First this, then `outer`.
  Affine then(const Affine& outer) const noexcept {
    return {{outer.turned(rows[0]), outer.turned(rows[1]), outer.turned(rows[2]),
             outer.applied(rows[3])}};
  }
  bool mirrors() const noexcept { return dot(rows[0], cross(rows[1], rows[2])) < 0.0; }
  /// Whether lengths stay as they are: it turns, moves and mirrors, but for rounding.
  bool keeps_lengths() const noexcept;
  bool is_identity() const noexcept { return rows == Affine{}.rows; }
};

/// Red, green and blue.
using Srgb = std::array<std::uint8_t, 3>;

/// A shape, wherever and however often it stands.
struct AssemblyObject {
  std::string name;           ///< UTF-8 of at most kLongestName bytes; empty: none
  std::optional<Srgb> color;  ///< of all of it
  TriangleMesh mesh;          ///< in mm, in its own frame
};

struct PlacedObject {
  std::size_t object = 0;  ///< of Assembly::objects
  Affine to_mm;
};

/// What a slicer takes for one thing to print: of one part, or of several that keep together.
struct AssemblyItem {
  std::string name;  ///< of several parts together; empty where it has none but its part's
  std::vector<PlacedObject> placements;
};

struct Assembly {
  static constexpr std::size_t kLongestName = 255;

  std::vector<AssemblyObject> objects;  ///< each with triangles, and placed at least once
  std::vector<AssemblyItem> items;      ///< in the order of the file
};

/// A part as it stands: one placement of one object.
struct PlacedPart {
  /// Never empty, and no other part's: that of its object, else of its item, else "part 3"; where
  /// parts share one, "bolt", "bolt (2)".
  std::string name;
  std::size_t object = 0;
  Affine to_mm;
};
/// In the order of the items.
std::vector<PlacedPart> placed_parts(const Assembly& assembly);

/// The mesh of a part where it stands; a mirror turns its triangles, so that they still face
/// outward.
TriangleMesh placed_mesh(const TriangleMesh& mesh, const Affine& to_mm);

/// The bounds of its triangles there.
Box3 placed_bounds(const TriangleMesh& mesh, const Affine& to_mm);

/// The same parts at the same places, by places that keep lengths: an object that was placed
/// larger, smaller or askew becomes one that is so. For what measures objects in their own frames.
Assembly with_true_sizes(Assembly assembly);

/// All parts as one mesh, in the order of placed_parts.
TriangleMesh joined(Assembly assembly);

struct ReadAssembly {
  Assembly assembly;
  FrameReport frame;  ///< as of read_framed_mesh
  /// What the file has and the assembly has not, a sentence each; at most ten and how many more.
  std::vector<std::string> notes;
};

/// Reads a file as the parts it is made of. 3MF: an object for each mesh, by its `name` or the one
/// that PrusaSlicer, Bambu Studio or OrcaSlicer keep beside the model; what PrusaSlicer merged into
/// one mesh is parted by the ranges that it notes, and what is no part for it (modifiers, blockers)
/// is left out. Its color is the one it has, or that most of its triangles have. Other formats: one
/// object with the name of the file.
///
/// Units, errors, safety   as read_framed_mesh (mesh_frame.h); read_mesh is `joined` of this.
/// Threads      any.
Result<ReadAssembly> read_assembly(const std::filesystem::path& file, const MeshFrame& wanted = {});

/// Writes a 3MF in mm: an object for each mesh with its name and color, and an item of the build
/// for each item, by way of an object of components where it has a name of its own or several
/// parts. Coordinates are rounded to float, names to what XML can hold. The same assembly gives the
/// same bytes. As write_mesh, nothing is lost when it fails.
///
/// Errors   bad_input for an ending other than .3mf, an object without triangles, or what the
///          format cannot hold; disk; interrupted.
/// Threads  any.
Result<void> write_assembly(const std::filesystem::path& file, const Assembly& assembly,
                            const Progress& progress = {});

}  // namespace argil::io

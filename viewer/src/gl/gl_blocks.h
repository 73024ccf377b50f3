// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "argil/core/result.h"
#include "argil/core/vec3.h"

#include "gl/gl_object.h"
#include "gl/gl_ranges.h"
#include "picture/camera.h"
#include "picture/renderer.h"

namespace argil::viewer {

/// A plane of a picture's bounds: inside is where dot(normal, p) + offset >= 0.
struct BoundPlane {
  Vec3 normal;
  double offset = 0.0;
};

/// Which blocks a draw shows.
struct BlockChoice {
  std::vector<BoundPlane> bounds;  ///< those that are not wholly outside of a plane
  /// Those with a triangle that this lens sees from outside; null: also the others.
  const Lens* outside_of = nullptr;
};

/// The directions in which a block's triangles look: all within a cone, if that is narrow enough to
/// tell anything.
struct NormalCone {
  std::array<float, 3> axis{};  ///< unit
  float sine = 2.0F;            ///< of half its opening; above 1: any direction
};
NormalCone cone_of(const BlockMesh& block);

/// The clay's blocks on the graphics card, in pages: vertex and index buffers that many blocks
/// fraction, so that a page is drawn by few calls. The mask has a buffer of their own, which a
/// page without any does not have.
///
/// Vertex attributes  0 position, 1 normal, 2 mask (0 free to 1 masked).
/// Threads            the one that has the context current.
class GlBlocks {
 public:
  explicit GlBlocks(ObjectCount& count) : count_(count) {}

  /// Takes a block in the place of the one of that name; one without triangles is dropped. Uploads
  /// 24 bytes for each vertex, 12 for each triangle and, where some are masked, 1 for each vertex.
  /// Errors memory: the block is not there then.
  Result<void> put(const BlockMesh& block);
  void drop(const BlockId& id);
  void clear();

  /// Chooses what the next draw shows. Some 20 ns a block. Returns how many triangles they have.
  std::int64_t choose(const BlockChoice& choice);

  /// Draws what was chosen, level after level, the finest first; calls `begin` with the number of
  /// each before. A call of OpenGL for each page and level, two where a page has masked blocks.
  void draw(const std::function<void(int level)>& begin) const;

  /// Where a block lies; nothing where it is not there.
  std::optional<Box3> bounds_of(const BlockId& id) const;

  std::int64_t blocks() const noexcept { return static_cast<std::int64_t>(locations_.size()); }
  std::int64_t triangles() const noexcept { return triangles_; }
  std::int64_t uploaded_bytes() const noexcept { return uploaded_bytes_; }
  std::int64_t memory_bytes() const noexcept { return memory_bytes_; }

 private:
  /// A block in a page.
  struct Slot {
    BlockId id;
    std::array<float, 3> center_mm{};
    std::array<float, 3> half_mm{};
    NormalCone cone;
    std::uint32_t first_vertex = 0;
    std::uint32_t vertex_room = 0;
    std::uint32_t first_triangle = 0;
    std::uint32_t triangle_room = 0;
    std::uint32_t triangles = 0;
    bool has_mask = false;
  };
  /// The chosen blocks of a page that are drawn by one call.
  struct Batch {
    std::vector<int> counts;
    std::vector<const void*> offsets;
    std::vector<int> base_vertices;
  };
  struct Page {
    Page(std::uint32_t vertices_room, std::uint32_t triangles_room)
        : vertex_gaps(vertices_room), triangle_gaps(triangles_room) {}
    FreeRanges vertex_gaps;
    FreeRanges triangle_gaps;
    GlBuffer vertices;
    GlBuffer triangles;
    GlBuffer mask;  ///< only where a block has masked vertices
    GlVertexArray layout;
    GlVertexArray masked_layout;
    std::vector<Slot> slots;
    std::vector<Batch> batches;  ///< two for each level: without masked vertices, with
  };
  struct Location {
    Page* page = nullptr;
    std::size_t slot = 0;
  };
  struct IdHash {
    std::size_t operator()(const BlockId& id) const noexcept;
  };

  Result<Location> location_for(const BlockMesh& block);
  Result<Page*> page_with_room(std::uint32_t vertex_room, std::uint32_t triangle_room);
  Result<void> add_mask(Page& page);
  void upload(Page& page, const Slot& slot, const BlockMesh& block);
  static void choose_in(Page& page, const BlockChoice& choice);

  ObjectCount& count_;
  std::vector<std::unique_ptr<Page>> pages_;
  std::unordered_map<BlockId, Location, IdHash> locations_;
  std::int64_t triangles_ = 0;
  std::int64_t uploaded_bytes_ = 0;
  std::int64_t memory_bytes_ = 0;
};

}  // namespace argil::viewer

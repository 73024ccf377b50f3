// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
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
  bool is_coarse = false;  ///< by fewer triangles, where the blocks have them
};

/// The directions in which a block's triangles look: all within a cone, if that is narrow enough to
/// tell anything.
struct NormalCone {
  std::array<float, 3> axis{};  ///< unit
  float sine = 2.0F;            ///< of half its opening; above 1: any direction
};
NormalCone cone_of(std::span<const DisplayVertex> vertices,
                   std::initializer_list<std::span<const Triangle>> triangles);

/// The clay's blocks on the graphics card, in pages: vertex and index buffers that many blocks
/// share. Indices count from the page's first vertex, so that blocks whose triangles lie beside
/// each other are drawn as one: on a software renderer a range costs more than its hundred
/// triangles. The mask has a buffer of its own, which a page without any does not have.
///
/// Vertex attributes  0 position, 1 normal, 2 mask (0 free to 1 masked).
/// Threads            the one that has the context current.
class GlBlocks {
 public:
  /// `has_coarse`: of each block also its coarse triangles are kept (coarse_block.h).
  explicit GlBlocks(ObjectCount& count, bool has_coarse = false)
      : count_(count), has_coarse_(has_coarse) {}

  /// Takes a block in the place of the one of that name; one without triangles is dropped. Uploads
  /// 24 bytes for each vertex, 12 for each triangle, coarse ones too and their number rounded up to
  /// kRoomStep, and, where some are masked, 1 for each vertex.
  /// Errors memory: the block is not there then.
  Result<void> put(const BlockMesh& block);
  void drop(const BlockId& id);
  void clear();

  /// Chooses what the next draw shows. Some 20 ns a block, where any can lie within the bounds.
  /// Returns how many triangles they have.
  std::int64_t choose(const BlockChoice& choice);

  /// Draws what was chosen, level after level, the finest first; calls `begin` with the number of
  /// each before. A call of OpenGL for each page and level, two where a page has masked blocks.
  /// Blocks that were not chosen may be drawn as well where they lie between two that were: what
  /// cannot be seen is not seen.
  void draw(const std::function<void(int level)>& begin) const;

  /// Where a block lies; nothing where it is not there.
  std::optional<Box3> bounds_of(const BlockId& id) const;

  std::int64_t blocks() const noexcept { return static_cast<std::int64_t>(locations_.size()); }
  std::int64_t triangles() const noexcept { return triangles_; }
  std::int64_t uploaded_bytes() const noexcept { return uploaded_bytes_; }
  std::int64_t memory_bytes() const noexcept { return memory_bytes_; }

  /// Rooms are multiples of this, so that most edits of a block find its new version fits where the
  /// old one was, and gaps fit other blocks.
  static constexpr std::uint32_t kRoomStep = 16;

 private:
  enum Detail : std::size_t { kFine, kCoarse };

  /// A block's triangles in one of a page's index buffers; those of its room beyond them have no
  /// area.
  struct Range {
    std::uint32_t first = 0;
    std::uint32_t room = 0;
    std::uint32_t count = 0;
  };
  /// A block in a page.
  struct Slot {
    BlockId id;
    std::array<float, 3> center_mm{};
    std::array<float, 3> half_mm{};
    NormalCone cone;
    std::uint32_t first_vertex = 0;
    std::uint32_t vertex_room = 0;
    std::array<Range, 2> ranges;  ///< by Detail; a coarse one only where there is any
    bool has_mask = false;

    /// Two for each level: without masked vertices, with.
    std::size_t batch() const noexcept {
      return 2 * static_cast<std::size_t>(id.level) + (has_mask ? 1 : 0);
    }
  };
  /// The chosen ranges of a page that are drawn by one call.
  struct Batch {
    std::vector<int> counts;
    std::vector<const void*> offsets;
  };
  /// One of a page's index buffers, and how it is drawn.
  struct Faces {
    explicit Faces(std::uint32_t room) : gaps(room) {}
    FreeRanges gaps;
    GlBuffer triangles;
    GlVertexArray layout;
    GlVertexArray masked_layout;
    std::vector<std::size_t> order;  ///< of the slots, by where they begin; empty: to be sorted
  };
  struct Page {
    Page(std::uint32_t vertices_room, std::uint32_t triangles_room)
        : vertex_gaps(vertices_room), faces{Faces(triangles_room), Faces(triangles_room)} {}
    FreeRanges vertex_gaps;
    GlBuffer vertices;
    GlBuffer mask;               ///< only where a block has masked vertices
    std::array<Faces, 2> faces;  ///< by Detail; the buffer of the coarse ones is made when needed
    std::vector<Slot> slots;
    std::vector<Batch> batches;  ///< by Slot::batch
  };
  struct Location {
    Page* page = nullptr;
    std::size_t slot = 0;
  };
  struct IdHash {
    std::size_t operator()(const BlockId& id) const noexcept;
  };

  Result<Location> location_for(const BlockMesh& block, std::span<const Triangle> coarse);
  Result<Page*> page_with_room(const Slot& slot);
  Result<void> add_faces(Page& page, Faces& faces);
  Result<void> add_mask(Page& page);
  static std::int64_t bytes_of(const Page& page);
  static const std::vector<std::size_t>& order_of(Page& page, Detail detail);
  void upload(Page& page, const Slot& slot, const BlockMesh& block,
              std::span<const Triangle> coarse);
  static void choose_none(Page& page);
  std::int64_t choose_in(Page& page, const BlockChoice& choice);

  ObjectCount& count_;
  bool has_coarse_;
  std::vector<std::unique_ptr<Page>> pages_;
  std::unordered_map<BlockId, Location, IdHash> locations_;
  Box3 reach_mm_;  ///< around all blocks that have been here since it was empty
  std::int64_t triangles_ = 0;
  std::int64_t uploaded_bytes_ = 0;
  std::int64_t memory_bytes_ = 0;
  Detail chosen_ = kFine;
  std::vector<Triangle> sent_;  ///< scratch of upload
};

}  // namespace argil::viewer

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/core/vec3.h"
#include "argil/engine/display_surface.h"
#include "argil/engine/operation.h"
#include "argil/engine/render.h"

#include "picture/camera.h"
#include "picture/reference_image.h"

namespace argil::viewer {

/// The surface in one block, a copy that any thread may keep.
struct BlockMesh {
  BlockId id;
  std::vector<DisplayVertex> vertices;
  std::vector<Triangle> triangles;
  std::vector<std::uint8_t> mask;  ///< 0 (free) to 255 at each vertex; empty: nothing is masked
  Box3 bounds_mm;
};

/// A piece of a sculpture, by a number that stays with it whatever it is called.
using PieceKey = std::uint32_t;

/// A piece that a picture shows, where it stands.
struct ShownPiece {
  PieceKey piece = 0;
  Placement placement = {};                  ///< of its blocks; of unit length
  std::optional<Vec3> color = std::nullopt;  ///< linear; none: clay's own
  bool is_active = true;  ///< the one that is sculpted: where two have one surface it is seen
  double scale = 1.0;     ///< lengths of its blocks times this: how large it is about to become
  friend bool operator==(const ShownPiece& a, const ShownPiece& b) {
    return a.piece == b.piece && a.placement.position_mm == b.placement.position_mm &&
           a.placement.orientation == b.placement.orientation && a.color == b.color &&
           a.is_active == b.is_active && a.scale == b.scale;
  }
};

/// How the clay is shown.
enum class Shading { matcap, plain, curvature, level };

/// A ring that lies on a surface: the brush.
struct RingMark {
  Vec3 center_mm;
  Vec3 normal;  ///< unit
  double radius_mm = 1.0;
  Vec3 color{1.0, 1.0, 1.0};  ///< linear, as all colours here
  bool is_filled = false;     ///< faintly: a contact patch
  friend bool operator==(const RingMark&, const RingMark&) = default;
};

struct ArrowMark {
  Vec3 from_mm;
  Vec3 to_mm;
  Vec3 color{1.0, 0.8, 0.1};
  friend bool operator==(const ArrowMark&, const ArrowMark&) = default;
};

/// A square with a frame: a plane of symmetry, or of a cut that is to be made.
struct PlaneMark {
  Vec3 point_mm;
  Vec3 normal;
  double half_side_mm = 10.0;
  Vec3 color{0.3, 0.6, 1.0};
  bool is_filled = true;  ///< tints what is behind it; else it is only a frame, and faint
  friend bool operator==(const PlaneMark&, const PlaneMark&) = default;
};

/// A pin at a point, shown through the clay where it lies behind: a problem of the print.
struct PinMark {
  Vec3 at_mm;
  Vec3 color{1.0, 0.1, 0.1};
  friend bool operator==(const PinMark&, const PinMark&) = default;
};

/// A line from point to point over the clay: a path.
struct LineMark {
  std::vector<Vec3> points_mm;
  Vec3 color{0.1, 0.9, 0.5};
  friend bool operator==(const LineMark&, const LineMark&) = default;
};

/// A part of a gizmo: a line, closed or open, that nothing hides.
struct HandleMark {
  std::vector<Vec3> points_mm;
  Vec3 color;
  bool is_filled = false;  ///< convex, and closed
  friend bool operator==(const HandleMark&, const HandleMark&) = default;
};

/// Signed distances over a rectangle, drawn as the material's cross-section: a cut through the
/// clay.
struct SlicePicture {
  Vec3 corner_mm;  ///< of the first value
  Vec3 along_mm;   ///< from there to the end of the first row
  Vec3 down_mm;    ///< and to the start of the last row
  int columns = 0;
  int rows = 0;
  std::vector<float> distance_mm;  ///< row by row
  friend bool operator==(const SlicePicture&, const SlicePicture&) = default;
};

/// The colours behind the clay at the lower and the upper edge of the picture, 0 to 1, encoded as
/// sRGB.
struct Ground {
  Vec3 low{0.160, 0.164, 0.176};
  Vec3 high{0.349, 0.356, 0.369};
  friend bool operator==(const Ground&, const Ground&) = default;
};

/// All that a picture shows but the blocks.
struct Picture {
  Lens lens;
  std::optional<Lens>
      right_lens;  ///< stereo: `lens` for the left half of the frame, this the right
  std::vector<ShownPiece> pieces{ShownPiece{}};  ///< blocks of others are not drawn
  Ground ground;
  Shading shading = Shading::matcap;
  bool has_wires = false;     ///< the triangles' edges over the shading
  bool has_occlusion = true;  ///< ambient occlusion (Shading::plain)
  bool is_moving = false;     ///< the camera turns: the clay may be drawn more coarsely
  std::vector<RingMark> rings;
  std::vector<ArrowMark> arrows;
  std::vector<PlaneMark> planes;
  std::vector<PinMark> pins;
  std::vector<LineMark> lines;
  std::vector<HandleMark> handles;
  std::optional<SlicePicture> slice;
  /// Of a part of a picture: where it begins and ends between the bottom and the top of the whole,
  /// whose background it has.
  std::pair<double, double> ground_rows{0.0, 1.0};
  std::vector<ReferenceMark> references;  ///< the later over the earlier
  friend bool operator==(const Picture&, const Picture&) = default;
};

/// Depth of every pixel of the last picture, in mm along the view from the eye's plane; infinite
/// where there is no clay. Rows from the top. One that moves may have been drawn in fewer pixels.
struct DepthMap {
  int width = 0;
  int height = 0;
  std::vector<float> depth_mm;
  /// 1 where that is another piece than the active one; empty: nowhere.
  std::vector<std::uint8_t> is_other;
};

struct RendererCounts {
  std::int64_t pictures = 0;        ///< drawn so far; not those that were only shown again
  std::int64_t whole_pictures = 0;  ///< of them those for which all of the clay was drawn
  std::int64_t blocks = 0;
  std::int64_t triangles = 0;  ///< of all blocks
  /// When the clay was drawn last: blocks that cannot be seen are left out, and where only some
  /// changed, those that lie elsewhere in the picture.
  std::int64_t drawn_triangles = 0;
  std::int64_t uploaded_bytes = 0;  ///< so far
  std::int64_t memory_bytes = 0;    ///< on the graphics card, for blocks
  std::int64_t objects = 0;         ///< OpenGL objects that live
  std::int64_t errors = 0;          ///< that OpenGL reported (debug contexts only)
};

/// Draws blocks of clay and what belongs to them. The one place that knows a graphics interface.
///
/// Threads  the one that has the context current.
class Renderer {
 public:
  virtual ~Renderer() = default;
  Renderer() = default;
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Takes a block of a piece, in its own frame, in the place of the one of that name; uploads it
  /// and nothing else. Errors  memory.
  virtual Result<void> put(PieceKey piece, const BlockMesh& block) = 0;
  virtual void drop(PieceKey piece, const BlockId& id) = 0;
  virtual void drop(PieceKey piece) = 0;  ///< all of its blocks
  virtual void clear() = 0;               ///< drops all blocks

  /// Keeps an image for panels; its number for Dear ImGui, never 0, which no other one has as long
  /// as it is kept.
  virtual std::uintptr_t keep_image(const ReferencePixels& pixels) = 0;
  virtual void drop_image(std::uintptr_t number) = 0;  ///< that was given (assert)

  /// Draws into a framebuffer (0: the window) of this size in pixels, and clears it before. A
  /// picture that it holds it only shows again.
  /// Errors  device where the driver cannot draw a picture of that size; the framebuffer is cleared
  ///         then, and another size may do.
  virtual Result<void> draw(const Picture& picture, unsigned framebuffer, int width,
                            int height) = 0;

  /// Whether that picture is the last one drawn, of that size, and no block has changed since.
  virtual bool holds(const Picture& picture, int width, int height) const = 0;

  /// The depth of the pieces in the last picture, marks left out: of its eye 0 or, in stereo, also
  /// 1, the right. Empty for an eye that it does not have.
  virtual DepthMap read_depth(std::size_t eye = 0) = 0;

  /// What is in a framebuffer now.
  virtual Image read_image(unsigned framebuffer, int width, int height) = 0;

  virtual RendererCounts counts() const = 0;
  virtual std::string last_error() const = 0;  ///< of a debug context; ""
};

}  // namespace argil::viewer

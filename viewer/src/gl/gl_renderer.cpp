// SPDX-License-Identifier: GPL-3.0-or-later
// A picture is drawn into targets of the renderer's own and then copied to where it is shown, so
// that it can be shown again below other panels without being drawn. For each eye, in this order:
// the background; the active piece, then the others, whose depth is then kept; occlusion or
// curvature, worked out from that depth; the slice. This is the clay's layer, which stays as long
// as neither the lens nor the shading changes; where blocks change, the parts of it that show them
// are drawn anew. The picture is a copy of it with the marks. On a software renderer clay that
// moves has a layer of half the size, of which the picture is a stretched copy.
#include "gl/gl_renderer.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>

#include <epoxy/gl.h>
#include <malloc.h>

#include "gl/gl_blocks.h"
#include "gl/gl_clay.h"
#include "gl/gl_clay_shaders.h"
#include "gl/gl_debug.h"
#include "gl/gl_marks.h"
#include "gl/gl_overlay.h"
#include "gl/gl_references.h"
#include "gl/gl_screen_shaders.h"
#include "gl/gl_slice.h"
#include "gl/gl_targets.h"
#include "gl/gl_touched.h"
#include "picture/stereo.h"

namespace argil::viewer {
namespace {

constexpr int kSamples = 4;  // a pixel, on a graphics card

/// What the renderer compiles once.
struct Passes {
  GlProgram background;
  GlVertexArray nothing;  ///< of vertices without attributes
  GlClay clay;
  GlOverlay overlay;
  GlSlice slice;
  GlMarks marks;
  GlReferences references;

  static Result<Passes> make(ObjectCount& count);
};

Result<Passes> Passes::make(ObjectCount& count) {
  auto background =
      GlProgram::make(count, {"background", kColorFunctions, kScreenVertex, kBackgroundFragment});
  if (!background) return background.error();
  auto clay = GlClay::make(count);
  if (!clay) return clay.error();
  auto overlay = GlOverlay::make(count);
  if (!overlay) return overlay.error();
  auto slice = GlSlice::make(count);
  if (!slice) return slice.error();
  auto marks = GlMarks::make(count);
  if (!marks) return marks.error();
  auto references = GlReferences::make(count);
  if (!references) return references.error();
  return Passes{std::move(background).value(), GlVertexArray(count),     std::move(clay).value(),
                std::move(overlay).value(),    std::move(slice).value(), std::move(marks).value(),
                std::move(references).value()};
}

/// The eyes of a picture, from left to right; one where there is no room for two.
std::vector<EyeView> eyes_of(const Picture& picture, int width, int height) {
  if (!picture.right_lens || width < 2) return {{picture.lens, {0, 0, width, height}}};
  const int half = left_half(width);
  return {{picture.lens, {0, 0, half, height}},
          {*picture.right_lens, {half, 0, std::max(width - half, 1), height}}};
}

/// A slice that was never worked out has no values.
bool is_drawable(const std::optional<SlicePicture>& slice) {
  return slice && slice->columns > 0 && slice->rows > 0;
}

/// Whether two pictures differ in their marks alone.
bool have_same_clay(const Picture& a, const Picture& b) {
  return a.lens == b.lens && a.right_lens == b.right_lens && a.pieces == b.pieces &&
         a.ground == b.ground && a.ground_rows == b.ground_rows && a.shading == b.shading &&
         a.has_wires == b.has_wires && a.has_occlusion == b.has_occlusion &&
         a.is_moving == b.is_moving && a.slice == b.slice && a.references == b.references;
}

/// Whether a pixel of the clay shows what is around it.
bool has_overlay(const Picture& picture) {
  return picture.shading == Shading::curvature ||
         (picture.shading == Shading::plain && picture.has_occlusion);
}

/// What others who draw in this context may have left on.
void reset_state() {
  for (const GLenum off : std::initializer_list<GLenum>{
           GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_BLEND, GL_CULL_FACE, GL_PRIMITIVE_RESTART,
           GL_FRAMEBUFFER_SRGB, GL_COLOR_LOGIC_OP, GL_DEPTH_CLAMP, GL_RASTERIZER_DISCARD,
           GL_POLYGON_OFFSET_FILL, GL_SAMPLE_ALPHA_TO_COVERAGE, GL_CLIP_DISTANCE0})
    glDisable(off);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glDepthRange(0.0, 1.0);
  glClearDepth(1.0);
  glBlendEquation(GL_FUNC_ADD);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glBindSampler(0, 0);
  glBindSampler(1, 0);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

class GlRenderer final : public Renderer {
 public:
  GlRenderer(std::unique_ptr<ObjectCount> count, std::unique_ptr<GlDebug> debug, Passes passes,
             const GlRendererOptions& options)
      : debug_(std::move(debug)),
        count_(std::move(count)),
        passes_(std::move(passes)),
        has_coarse_(options.has_coarse),
        shrinks_(options.has_coarse && options.samples == 0),
        targets_(*count_, options.samples),
        small_(*count_, 0) {
    assert(options.samples >= 0);
  }

  Result<void> put(PieceKey piece, const BlockMesh& block) override {
    const auto [known, is_new] = pieces_.try_emplace(piece, *count_, has_coarse_);
    // The first of others: from now on the active piece's own depth is kept, all of it.
    if (is_new) touched_.add_all();
    GlBlocks& blocks = known->second;
    touch(piece, blocks, block.id);
    touched_.add(piece, block.bounds_mm);
    return blocks.put(block);
  }
  std::uintptr_t keep_image(const ReferencePixels& pixels) override {
    reset_state();  // no buffer that Dear ImGui or a pass left bound is read instead
    GlTexture texture = texture_of(*count_, pixels);
    const std::uintptr_t number = texture.name();
    images_.emplace(number, std::move(texture));
    return number;
  }
  void drop_image(std::uintptr_t number) override {
    const auto known = images_.find(number);
    assert(known != images_.end());
    images_.erase(known);
  }

  void drop(PieceKey piece, const BlockId& id) override {
    const auto known = pieces_.find(piece);
    if (known == pieces_.end()) return;
    touch(piece, known->second, id);
    known->second.drop(id);
  }
  void drop(PieceKey piece) override {
    const auto known = pieces_.find(piece);
    if (known == pieces_.end()) return;
    dropped_bytes_ += known->second.uploaded_bytes();
    pieces_.erase(known);
    drawn_.reset();
    touched_.add_all();
  }
  void clear() override {
    drawn_.reset();
    touched_.add_all();
    for (const auto& [piece, blocks] : pieces_) dropped_bytes_ += blocks.uploaded_bytes();
    pieces_.clear();
  }
  Result<void> draw(const Picture& picture, unsigned framebuffer, int width, int height) override;
  bool holds(const Picture& picture, int width, int height) const override;
  DepthMap read_depth(std::size_t eye) override;
  Image read_image(unsigned framebuffer, int width, int height) override;
  RendererCounts counts() const override;
  std::string last_error() const override { return debug_->last_error(); }

 private:
  void touch(PieceKey piece, const GlBlocks& blocks, const BlockId& id);
  GlTargets& layer_of(const Picture& picture) noexcept {
    return picture.is_moving && shrinks_ ? small_ : targets_;
  }
  std::vector<PieceView> views_of(const Picture& picture, const EyeView& eye, const ClipPlane& cut,
                                  bool is_active) const;
  Result<void> draw_pieces(const Picture& picture, const EyeView& eye, const PixelRect& area,
                           const ClipPlane& cut, GlTargets& to);
  Result<void> draw_picture(const Picture& picture, int width, int height);
  Result<void> draw_clay(const Picture& picture, GlTargets& to);
  Result<void> draw_area(const Picture& picture, const EyeView& eye, const PixelRect& area,
                         GlTargets& to);

  std::unique_ptr<GlDebug> debug_;
  std::unique_ptr<ObjectCount> count_;  ///< before all that it counts
  Passes passes_;
  std::map<std::uintptr_t, GlTexture> images_;  ///< for panels
  std::map<PieceKey, GlBlocks> pieces_;
  bool has_coarse_;
  bool shrinks_;  ///< clay that moves, which then fills a quarter of the pixels
  GlTargets targets_;
  GlTargets small_;  ///< of half the width and height, for the layer of clay that moves
  std::optional<Picture> drawn_;  ///< what the targets hold; none: not the blocks as they are now
  std::optional<Picture> drawn_clay_;  ///< what the clay's layer holds, up to what was touched
  Touched touched_;
  std::int64_t drawn_pictures_ = 0;
  std::int64_t whole_pictures_ = 0;
  std::int64_t drawn_triangles_ = 0;
  std::int64_t dropped_bytes_ = 0;  ///< uploaded for pieces that are gone
};

Result<void> GlRenderer::draw(const Picture& picture, unsigned framebuffer, int width, int height) {
  if (width <= 0 || height <= 0) return {};  // a window that is minimised
  reset_state();
  Result<void> drawn;
  if (!holds(picture, width, height)) drawn = draw_picture(picture, width, height);
  glViewport(0, 0, width, height);
  if (drawn) {
    targets_.show(framebuffer);
  } else {
    drawn_.reset();
    drawn_clay_.reset();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glClear(GL_COLOR_BUFFER_BIT);
  }
  // Dear ImGui draws next in this context: nothing of ours stays bound.
  glBindVertexArray(0);
  glUseProgram(0);
  return drawn;
}

/// The place of a block in the picture is to be drawn anew.
void GlRenderer::touch(PieceKey piece, const GlBlocks& blocks, const BlockId& id) {
  drawn_.reset();
  if (const auto former = blocks.bounds_of(id)) touched_.add(piece, *former);
}

/// The active piece, or those that are not; only pieces that have blocks.
std::vector<PieceView> GlRenderer::views_of(const Picture& picture, const EyeView& eye,
                                            const ClipPlane& cut, bool is_active) const {
  std::vector<PieceView> views;
  for (const ShownPiece& piece : picture.pieces) {
    const auto known = pieces_.find(piece.piece);
    if (piece.is_active != is_active || known == pieces_.end()) continue;
    views.push_back(view_of_piece(piece, &known->second, eye, cut));
  }
  return views;
}

Result<void> GlRenderer::draw_picture(const Picture& picture, int width, int height) {
  const bool is_resized = width != targets_.width() || height != targets_.height();
  if (auto made = targets_.resize(width, height); !made) return made;
  GlTargets& clay = layer_of(picture);
  if (&clay == &small_) {
    if (auto made = small_.resize((width + 1) / 2, (height + 1) / 2); !made) return made;
  }
  if (is_resized || !drawn_clay_ || !have_same_clay(*drawn_clay_, picture)) touched_.add_all();
  if (!touched_.empty()) {
    if (auto drawn = draw_clay(picture, clay); !drawn) return drawn;
  }
  targets_.begin_picture(clay);
  for (const EyeView& eye : eyes_of(picture, width, height)) {
    glViewport(eye.part.x, eye.part.y, eye.part.width, eye.part.height);
    passes_.references.draw(picture.references, true, eye);
    passes_.marks.draw(picture, eye, targets_);
  }
  drawn_ = picture;
  ++drawn_pictures_;
  return {};
}

/// Draws what was touched. Uploads the slice's values where they are new.
Result<void> GlRenderer::draw_clay(const Picture& picture, GlTargets& to) {
  if (is_drawable(picture.slice) && !(drawn_clay_ && drawn_clay_->slice == picture.slice)) {
    passes_.slice.take(*count_, *picture.slice);
  }
  if (has_overlay(picture)) touched_.add_all();
  passes_.references.take(*count_, picture.references);
  drawn_triangles_ = 0;
  bool is_whole = true;
  for (const EyeView& eye : eyes_of(picture, to.width(), to.height())) {
    std::vector<PieceView> seen = views_of(picture, eye, {}, true);
    const std::vector<PieceView> others = views_of(picture, eye, {}, false);
    seen.insert(seen.end(), others.begin(), others.end());
    for (const PixelRect& area : touched_.areas_in(eye, seen)) {
      is_whole = is_whole && area == eye.part;
      if (auto drawn = draw_area(picture, eye, area, to); !drawn) return drawn;
    }
  }
  if (is_whole) ++whole_pictures_;
  drawn_clay_ = picture;
  touched_.clear();
  return {};
}

bool GlRenderer::holds(const Picture& picture, int width, int height) const {
  return drawn_ && width == targets_.width() && height == targets_.height() && *drawn_ == picture;
}

Result<void> GlRenderer::draw_area(const Picture& picture, const EyeView& eye,
                                   const PixelRect& area, GlTargets& to) {
  to.bind_clay();
  glViewport(eye.part.x, eye.part.y, eye.part.width, eye.part.height);
  glEnable(GL_SCISSOR_TEST);
  glScissor(area.x, area.y, area.width, area.height);
  glClear(GL_DEPTH_BUFFER_BIT);
  glDisable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  // One triangle that covers the screen, made from the numbers of its corners; OpenGL's core
  // profile wants some vertex array all the same.
  passes_.background.use();
  passes_.background.set("low", picture.ground.low);
  passes_.background.set("high", picture.ground.high);
  const auto& [bottom, top] = picture.ground_rows;
  passes_.background.set("rows", bottom, top - bottom);
  glBindVertexArray(passes_.nothing.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthMask(GL_TRUE);
  passes_.references.draw(picture.references, false, eye);

  const bool has_slice = is_drawable(picture.slice);
  const ClipPlane cut = has_slice ? ClipPlane(cut_by(*picture.slice, eye.lens)) : std::nullopt;
  if (auto drawn = draw_pieces(picture, eye, area, cut, to); !drawn) {
    glDisable(GL_SCISSOR_TEST);
    return drawn;
  }
  // Kept before the slice is drawn: strokes and occlusion are about the clay alone.
  to.keep_depth(area);
  glBindVertexArray(passes_.nothing.name());
  if (has_overlay(picture)) {
    // It is drawn at another size, and only of all that an eye sees.
    glDisable(GL_SCISSOR_TEST);
    const auto overlay =
        picture.shading == Shading::curvature ? Overlay::curvature : Overlay::occlusion;
    if (auto drawn = passes_.overlay.draw(*count_, overlay, to, eye); !drawn) return drawn;
    glEnable(GL_SCISSOR_TEST);
  }
  to.bind_clay();
  if (has_slice) passes_.slice.draw(*picture.slice, eye);
  glDisable(GL_SCISSOR_TEST);
  return {};
}

/// The active piece first, so that its depth alone can be kept where there are others.
Result<void> GlRenderer::draw_pieces(const Picture& picture, const EyeView& eye,
                                     const PixelRect& area, const ClipPlane& cut, GlTargets& to) {
  const auto draw = [&](const std::vector<PieceView>& views, bool is_behind) {
    for (const PieceView& view : views) {
      // A cut shows the inside, which looks away.
      const BlockChoice choice{bounds_of(view.eye, area, view.cut), cut ? nullptr : &view.eye.lens,
                               picture.is_moving};
      drawn_triangles_ += pieces_.at(view.piece).choose(choice);
    }
    passes_.clay.draw(views, picture, is_behind);
  };
  draw(views_of(picture, eye, cut, true), false);
  const std::vector<PieceView> others = views_of(picture, eye, cut, false);
  if (others.empty()) return {};
  if (auto kept = to.keep_active_depth(area); !kept) return kept;
  to.bind_clay();
  draw(others, true);
  return {};
}

DepthMap GlRenderer::read_depth(std::size_t eye) {
  DepthMap map;
  if (!drawn_clay_) return map;
  const GlTargets& layer = layer_of(*drawn_clay_);
  const std::vector<EyeView> eyes = eyes_of(*drawn_clay_, layer.width(), layer.height());
  if (eye >= eyes.size()) return map;
  const EyeView& drawn = eyes[eye];
  map.width = drawn.part.width;
  map.height = drawn.part.height;
  map.depth_mm = layer.read_depth(drawn.part);
  if (!views_of(*drawn_clay_, drawn, {}, false).empty()) {
    const std::vector<float> active = layer.read_active_depth(drawn.part);
    map.is_other.reserve(active.size());
    for (std::size_t n = 0; n < active.size(); ++n) {
      map.is_other.push_back(map.depth_mm[n] < active[n] ? 1 : 0);
    }
  }
  // From the depth buffer's 0 to 1 back to mm: the inverse of Lens::projection.
  const double near = drawn.lens.near_mm;
  const double far = drawn.lens.far_mm;
  for (float& depth : map.depth_mm) {
    const double d = depth;
    if (d >= 1.0) {
      depth = std::numeric_limits<float>::infinity();
    } else if (drawn.lens.is_parallel) {
      depth = static_cast<float>(near + d * (far - near));
    } else {
      depth = static_cast<float>(near * far / (far - d * (far - near)));
    }
  }
  return map;
}

Image GlRenderer::read_image(unsigned framebuffer, int width, int height) {
  assert(width >= 0 && height >= 0);
  Image image{width, height, {}};
  const std::size_t row = 3 * static_cast<std::size_t>(width);
  std::vector<std::uint8_t> upward(row * static_cast<std::size_t>(height));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  // Rows of an Image have no padding; OpenGL's usual rows begin at multiples of 4 bytes.
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, upward.data());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  // OpenGL's rows begin at the bottom, those of an Image at the top.
  image.rgb.resize(upward.size());
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
    const std::size_t from = (static_cast<std::size_t>(height) - 1 - y) * row;
    std::copy_n(upward.begin() + static_cast<std::ptrdiff_t>(from), row,
                image.rgb.begin() + static_cast<std::ptrdiff_t>(y * row));
  }
  return image;
}

RendererCounts GlRenderer::counts() const {
  RendererCounts counts;
  counts.pictures = drawn_pictures_;
  counts.whole_pictures = whole_pictures_;
  counts.drawn_triangles = drawn_triangles_;
  counts.uploaded_bytes = dropped_bytes_;
  for (const auto& [piece, blocks] : pieces_) {
    counts.blocks += blocks.blocks();
    counts.triangles += blocks.triangles();
    counts.uploaded_bytes += blocks.uploaded_bytes();
    counts.memory_bytes += blocks.memory_bytes();
  }
  counts.objects = count_->here();
  counts.errors = debug_->errors();
  return counts;
}

/// A string of the driver; "" where it has none.
std::string text_of(GLenum name) {
  const GLubyte* text = glGetString(name);
  return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

/// A software renderer asks for tens of megabytes in each frame and gives them back: they stay with
/// the process, or every frame would begin with page faults (a fifth of its time at a million
/// triangles).
void keep_frame_memory() {
#ifdef __GLIBC__
  constexpr int kMostKept = 256 << 20;
  // glibc's takes the lock of the heap; unsafe is only what reads these without it, as nobody does.
  mallopt(M_TRIM_THRESHOLD, kMostKept);      // NOLINT(concurrency-mt-unsafe)
  mallopt(M_MMAP_THRESHOLD, kMostKept / 4);  // NOLINT(concurrency-mt-unsafe)
#endif
}

bool is_software() { return text_of(GL_RENDERER).find("llvmpipe") != std::string::npos; }

/// A software renderer takes four times as long for four samples, and cannot turn a large clay
/// fluently in full detail, which a graphics card can.
GlRendererOptions options_of_card() {
  if (is_software()) return {0, true};
  GLint most = 0;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  return {std::min(kSamples, most), false};
}

}  // namespace

Result<std::unique_ptr<Renderer>> make_gl_renderer_with(const GlRendererOptions& options) {
  constexpr int kLeastVersion = 33;  // as epoxy counts: ten times the version
  if (!epoxy_is_desktop_gl() || epoxy_gl_version() < kLeastVersion) {
    return Error{ErrorKind::device, "the viewer needs OpenGL 3.3 and this is " +
                                        text_of(GL_VERSION) + "; update the graphics driver"};
  }
  // Before everything else, so that errors of the passes are reported too.
  auto debug = std::make_unique<GlDebug>();
  auto count = std::make_unique<ObjectCount>();
  auto passes = Passes::make(*count);
  if (!passes) return passes.error();
  return std::unique_ptr<Renderer>(std::make_unique<GlRenderer>(
      std::move(count), std::move(debug), std::move(passes).value(), options));
}

Result<std::unique_ptr<Renderer>> make_gl_renderer() {
  if (is_software()) keep_frame_memory();
  return make_gl_renderer_with(options_of_card());
}

}  // namespace argil::viewer

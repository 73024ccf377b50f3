// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/core/result.h"

#include "gl/gl_object.h"
#include "picture/renderer.h"

namespace argil::viewer {

/// A part of a picture in pixels, from its lower left corner as OpenGL has it.
struct PixelRect {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  bool empty() const noexcept { return width <= 0 || height <= 0; }
  friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

/// Whether the driver can draw into the framebuffer that is bound, whose attachments were made of
/// this size and so many samples a pixel (0: without multisampling).
/// Errors  device, naming both, what the driver takes at most, and the remedy.
Result<void> check_framebuffer(int width, int height, int samples);

/// Where pictures are drawn before they are shown, in two layers of colour over one 32-bit depth,
/// with several samples a pixel or one: the clay, and the picture, which is a copy of it with the
/// marks, so that marks that move do not cost a drawing of the clay. Textures keep the clay's depth
/// and colour while it is drawn further.
class GlTargets {
 public:
  /// `samples` a pixel, 0 for one without multisampling.
  GlTargets(ObjectCount& count, int samples) : count_(count), samples_(samples) {}

  /// Makes all of this size, when they are not.
  /// Errors  as check_framebuffer; nothing can be drawn then until another size was made.
  Result<void> resize(int width, int height);
  /// Draws go into the clay's layer from now on.
  void bind_clay() const;
  /// The picture becomes a copy of the clay's colours, and draws go into it; its depth is the
  /// clay's, which they must leave as it is. The clay may be another's, of another size: it is
  /// stretched, and its depth takes the place of this one's. Both then without multisampling
  /// (assert).
  void begin_picture(const GlTargets& clay) const;
  /// Copies the depth of a part of the clay's layer into the texture.
  void keep_depth(const PixelRect& part) const;
  unsigned kept_depth() const noexcept { return depth_texture_.name(); }
  /// The same for the active piece alone, before others are drawn. Errors  as check_framebuffer.
  Result<void> keep_active_depth(const PixelRect& part);
  /// Copies the colour of the clay's layer into the other texture, with one sample a pixel.
  void keep_color() const;
  unsigned kept_color() const noexcept { return color_texture_.name(); }
  /// Copies the picture's colour into a framebuffer of the same size.
  void show(unsigned framebuffer) const;

  /// The kept depth, 0 to 1, of a part; rows from the top. Waits for the graphics card.
  std::vector<float> read_depth(const PixelRect& part) const { return read_from(kept_, part); }
  /// As last kept of the active piece.
  std::vector<float> read_active_depth(const PixelRect& part) const {
    return read_from(active_, part);
  }

  int width() const noexcept { return width_; }
  int height() const noexcept { return height_; }

 private:
  Result<void> make_layers(int width, int height);
  void copy_color(const GlFramebuffer& from, unsigned to) const;
  Result<void> make_kept(int width, int height);
  void copy_depth(const GlFramebuffer& to, const PixelRect& part) const;
  std::vector<float> read_from(const GlFramebuffer& kept, const PixelRect& part) const;

  ObjectCount& count_;
  int samples_;
  int width_ = 0;
  int height_ = 0;
  GlFramebuffer clay_;
  GlFramebuffer picture_;
  GlRenderbuffer clay_color_;
  GlRenderbuffer color_;
  GlRenderbuffer depth_;  ///< of both
  GlFramebuffer kept_;    ///< of the textures
  GlTexture depth_texture_;
  GlTexture color_texture_;
  GlFramebuffer active_;  ///< with one depth; made when it is needed
  GlTexture active_texture_;
};

}  // namespace argil::viewer

// SPDX-License-Identifier: GPL-3.0-or-later
#include "gl/gl_targets.h"

#include <algorithm>
#include <cassert>
#include <sstream>
#include <utility>

#include <epoxy/gl.h>

#include "gl/gl_state.h"

namespace argil::viewer {
namespace {

/// Gives a renderbuffer its storage.
void store(const GlRenderbuffer& buffer, int samples, GLenum format, int width, int height) {
  glBindRenderbuffer(GL_RENDERBUFFER, buffer.name());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
}

/// A texture for depth, bound.
void store_depth(const GlTexture& texture, int width, int height) {
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, texture.name());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, width, height, 0, GL_DEPTH_COMPONENT,
               GL_FLOAT, nullptr);
  set_texture(GL_NEAREST);
}

void attach_buffer(GLenum attachment, const GlRenderbuffer& buffer) {
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer.name());
}

}  // namespace

Result<void> check_framebuffer(int width, int height, int samples) {
  const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status == GL_FRAMEBUFFER_COMPLETE) return {};
  GLint most_pixels = 0;
  GLint most_samples = 0;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most_pixels);
  glGetIntegerv(GL_MAX_SAMPLES, &most_samples);
  std::ostringstream text;
  text << "the graphics driver cannot draw a picture of " << width << " x " << height << " pixels"
       << (samples > 0 ? " with " + std::to_string(samples) + " samples each" : "")
       << " (OpenGL's status 0x" << std::hex << status << std::dec << "); it takes at most "
       << most_pixels << " pixels a side and " << most_samples
       << " samples; make the window smaller, close other programs that draw, or update the driver";
  return Error{ErrorKind::device, text.str()};
}

Result<void> GlTargets::resize(int width, int height) {
  assert(width > 0 && height > 0);
  if (width == width_ && height == height_) return {};
  width_ = 0;
  height_ = 0;
  active_ = {};
  active_texture_ = {};
  if (auto made = make_layers(width, height); !made) return made;
  if (auto made = make_kept(width, height); !made) return made;
  width_ = width;
  height_ = height;
  return {};
}

// New objects rather than new storage: attachments of framebuffers stay complete.

Result<void> GlTargets::make_layers(int width, int height) {
  depth_ = GlRenderbuffer(count_);
  // 32 bits of float: strokes are measured by this depth (SurfaceProbe).
  store(depth_, samples_, GL_DEPTH_COMPONENT32F, width, height);
  for (const auto& [layer, color] :
       {std::pair<GlFramebuffer&, GlRenderbuffer&>{clay_, clay_color_}, {picture_, color_}}) {
    layer = GlFramebuffer(count_);
    color = GlRenderbuffer(count_);
    store(color, samples_, GL_RGBA8, width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, layer.name());
    attach_buffer(GL_COLOR_ATTACHMENT0, color);
    attach_buffer(GL_DEPTH_ATTACHMENT, depth_);
    if (auto made = check_framebuffer(width, height, samples_); !made) return made;
  }
  return {};
}

Result<void> GlTargets::make_kept(int width, int height) {
  kept_ = GlFramebuffer(count_);
  depth_texture_ = GlTexture(count_);
  color_texture_ = GlTexture(count_);
  store_depth(depth_texture_, width, height);
  glBindTexture(GL_TEXTURE_2D, color_texture_.name());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  set_texture(GL_NEAREST);
  glBindTexture(GL_TEXTURE_2D, 0);
  glBindFramebuffer(GL_FRAMEBUFFER, kept_.name());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_texture_.name(),
                         0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_texture_.name(),
                         0);
  return check_framebuffer(width, height, 0);
}

void GlTargets::bind_clay() const { glBindFramebuffer(GL_FRAMEBUFFER, clay_.name()); }

void GlTargets::begin_picture(const GlTargets& clay) const {
  const bool is_stretched = &clay != this;
  assert(!is_stretched || (samples_ == 0 && clay.samples_ == 0));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, clay.clay_.name());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, picture_.name());
  const auto copy = [&](GLbitfield what, GLenum filter) {
    glBlitFramebuffer(0, 0, clay.width_, clay.height_, 0, 0, width_, height_, what, filter);
  };
  copy(GL_COLOR_BUFFER_BIT, is_stretched ? GL_LINEAR : GL_NEAREST);
  if (is_stretched) {
    copy(GL_DEPTH_BUFFER_BIT, GL_NEAREST);
    keep_depth({0, 0, width_, height_});  // pins ask for it
  }
  glBindFramebuffer(GL_FRAMEBUFFER, picture_.name());
}

void GlTargets::keep_depth(const PixelRect& part) const { copy_depth(kept_, part); }

Result<void> GlTargets::keep_active_depth(const PixelRect& part) {
  if (!active_.is_there()) {
    active_ = GlFramebuffer(count_);
    active_texture_ = GlTexture(count_);
    store_depth(active_texture_, width_, height_);
    glBindTexture(GL_TEXTURE_2D, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, active_.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D,
                           active_texture_.name(), 0);
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
    if (auto made = check_framebuffer(width_, height_, 0); !made) {
      active_ = {};
      return made;
    }
  }
  copy_depth(active_, part);
  return {};
}

void GlTargets::copy_depth(const GlFramebuffer& to, const PixelRect& part) const {
  const int right = part.x + part.width;
  const int top = part.y + part.height;
  assert(part.x >= 0 && part.y >= 0 && right <= width_ && top <= height_);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, clay_.name());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to.name());
  glBlitFramebuffer(part.x, part.y, right, top, part.x, part.y, right, top, GL_DEPTH_BUFFER_BIT,
                    GL_NEAREST);
}

void GlTargets::copy_color(const GlFramebuffer& from, unsigned to) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from.name());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
  glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void GlTargets::keep_color() const { copy_color(clay_, kept_.name()); }

void GlTargets::show(unsigned framebuffer) const {
  // Several samples may only become one in the same format, which a window's need not be.
  if (samples_ > 0) copy_color(picture_, kept_.name());
  copy_color(samples_ > 0 ? kept_ : picture_, framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
}

std::vector<float> GlTargets::read_from(const GlFramebuffer& kept, const PixelRect& part) const {
  assert(part.x >= 0 && part.y >= 0 && part.x + part.width <= width_ &&
         part.y + part.height <= height_);
  const auto row = static_cast<std::size_t>(part.width);
  std::vector<float> depth(row * static_cast<std::size_t>(part.height));
  // Read between frames, by strokes that begin: what is bound stays so.
  GLint bound = 0;
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &bound);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, kept.name());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(part.x, part.y, part.width, part.height, GL_DEPTH_COMPONENT, GL_FLOAT, depth.data());
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(bound));
  // OpenGL's rows begin at the bottom.
  for (std::size_t up = 0, down = static_cast<std::size_t>(part.height); up + 1 < down; ++up) {
    --down;
    std::swap_ranges(depth.begin() + static_cast<std::ptrdiff_t>(up * row),
                     depth.begin() + static_cast<std::ptrdiff_t>((up + 1) * row),
                     depth.begin() + static_cast<std::ptrdiff_t>(down * row));
  }
  return depth;
}

}  // namespace argil::viewer

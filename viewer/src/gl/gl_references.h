// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "argil/core/result.h"

#include "gl/gl_clay.h"
#include "gl/gl_program.h"
#include "gl/gl_stream.h"
#include "picture/reference_image.h"

namespace argil::viewer {

/// An image as a texture, for drawing it also much smaller than it is. Leaves none bound.
GlTexture texture_of(ObjectCount& count, const ReferencePixels& pixels);

/// Draws reference images. Each is uploaded when a picture first shows it, and kept while anything
/// has its pixels: a view that is looked into again does not wait for them.
class GlReferences {
 public:
  static Result<GlReferences> make(ObjectCount& count);

  /// Uploads what is new, and forgets what nothing has any more: once a picture.
  void take(ObjectCount& count, const std::vector<ReferenceMark>& marks);
  /// Those behind the clay, or those over it, whatever is in front. What blends is the picture's
  /// own colour, without a depth.
  void draw(const std::vector<ReferenceMark>& marks, bool is_over, const EyeView& eye) const;

 private:
  struct Kept {
    std::weak_ptr<const ReferencePixels> pixels;
    GlTexture texture;
  };
  GlProgram program_;
  GlStream stream_;
  std::map<const ReferencePixels*, Kept> textures_;
};

}  // namespace argil::viewer
